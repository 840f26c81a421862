// json.h - JSON as people write it: what fits on a line stands on one, and numbers have no more
// digits than it takes to read the same number back.
#ifndef PEL_BASE_JSON_H
#define PEL_BASE_JSON_H

#include <stdbool.h>

struct json_t;

// The text of a value, with lines of at most `columns` characters where that is possible, indented
// by four spaces; 0 puts everything on one line. Memory to free(), or NULL (MEMORY).
char *pel_json_print(const struct json_t *value, int columns);

// Writes it to a file with a line feed at its end, through a temporary that is renamed.
bool pel_json_save(const struct json_t *value, const char *path, int columns);

#endif
