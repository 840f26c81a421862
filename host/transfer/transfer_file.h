// transfer_file.h - the one reader of transfer functions in JSON, for files and for scenes.
#ifndef PEL_TRANSFER_TRANSFER_FILE_H
#define PEL_TRANSFER_TRANSFER_FILE_H

#include "pellucid.h"

struct json_t;

// Makes a transfer function of parsed JSON: the name of a preset; an object of Pellucid's own, as
// scenes/README.md describes it; a ParaView colour map (also the array around it); or a Slicer
// volume property. The function is checked but not resolved. `json` is only read.
// Returns NULL on failure (FORMAT; ARGUMENT for an unknown preset; MEMORY); `*bad_key` is then the
// path below `json` of what is wrong, such as "opacities.3" or "" for the whole, as
// pel_text_locate takes it. It stays valid until this thread's next call.
struct pel_transfer *pel_transfer_parse(const struct json_t *json, const char **bad_key);

// The JSON that is parsed to the same transfer function, which must be a valid one: `points` where
// both curves have the same values, two lists otherwise. The caller owns it; NULL (out of memory).
struct json_t *pel_transfer_write(const struct pel_transfer *transfer);

#endif
