// error.h - failures and warnings, as sentences.
//
// A fallible function says `return pel_fail(PEL_ERROR_FORMAT, "page %d: %d bits", page, bits);`.
// Its callers add where that was on the way up: `return pel_fail_in("%s", path);`. The user reads
// `two.json:7:5: volume 'ct': bunny.tif: page 2: 12 bits`.
#ifndef PEL_BASE_ERROR_H
#define PEL_BASE_ERROR_H

#include "pellucid.h"

// Records code and sentence for this thread. Always returns false.
bool pel_fail(enum pel_error code, const char *format, ...) PEL_PRINTF(2, 3);

// Puts a context and ": " before this thread's sentence. Always returns false.
bool pel_fail_in(const char *format, ...) PEL_PRINTF(1, 2);

// Hands a warning to whoever registered for them.
void pel_warn(const char *format, ...) PEL_PRINTF(1, 2);

// Forgets this thread's last failure, for code that goes on after one.
void pel_error_clear(void);

#endif
