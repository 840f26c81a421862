// report.h - how commands write numbers for people and for programs.
#ifndef PEL_CLI_REPORT_H
#define PEL_CLI_REPORT_H

#include <jansson.h>

#include "pellucid.h"

enum { REPORT_TEXT_BYTES = 32 };

// "6.8 MiB". Writes into `text` and returns it.
const char *report_bytes(char text[REPORT_TEXT_BYTES], uint64_t bytes);

// "auto", "buffer" or "image".
const char *report_reader(enum pel_reader reader);
const char *report_skip(enum pel_skip skip);

// A JSON number, or null for NaN and infinities.
json_t *report_number(double value);

// A JSON array of `count` numbers.
json_t *report_numbers(const double *values, int count);

// A JSON string of any bytes: what is not UTF-8, such as a file's name, becomes '?'.
json_t *report_text(const char *text);

// Prints `value` on standard output and releases it; returns the exit status.
int report_json(json_t *value);

// Flushes standard output; returns `status`, or FILE with a sentence when it could not be written.
int report_finish(int status);

#endif
