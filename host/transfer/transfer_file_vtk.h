// transfer_file_vtk.h - inside transfer_file*.c: what reads a transfer function, and other
// programs' formats.
#ifndef PEL_TRANSFER_TRANSFER_FILE_VTK_H
#define PEL_TRANSFER_TRANSFER_FILE_VTK_H

#include "pellucid.h"

struct json_t;

#define PEL_PLACE_BYTES 96

// The function in the making, and where in the JSON the reader is: what is wrong is there.
struct pel_transfer_reader {
    struct pel_transfer *transfer;
    char place[PEL_PLACE_BYTES];
};

// Notes that the reader is now at that path.
void pel_transfer_reader_at(struct pel_transfer_reader *reader, const char *format, ...)
    PEL_PRINTF(2, 3);

// Takes a number; false (FORMAT) for anything else.
bool pel_transfer_read_number(const struct json_t *json, double *number);

// Reads one ParaView colour map. Its own maps reach from 0 to 1 and are stretched over the data
// when chosen, so those become relative; those that users save hold the values they had. `prefix`
// is the path of `map`, with a dot at the end unless it is empty.
bool pel_transfer_read_paraview(struct pel_transfer_reader *reader, const struct json_t *map,
                                const char *prefix);

// Reads a volume property of 3D Slicer (.vp.json), of which the first component counts.
bool pel_transfer_read_slicer(struct pel_transfer_reader *reader, const struct json_t *root);

#endif
