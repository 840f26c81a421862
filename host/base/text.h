// text.h - lists of words, finding the word somebody meant, and the place in a file somebody means.
#ifndef PEL_BASE_TEXT_H
#define PEL_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

// How many words there are in a list that ends with NULL.
int pel_text_count(const char *const *words);

// Writes the first `count` words with commas between them, but `last`, such as " or ", before the
// last one. What has no room in `bytes` is cut.
void pel_text_list(char *text, size_t bytes, const char *const *words, int count, const char *last);

// The word of `known` (its last element is NULL) that `word` most likely is a slip of: the one with
// the fewest letters to insert, delete, replace or swap with their neighbour, case aside. NULL when
// none is near: more than one slip in up to five letters, two in up to eight, three beyond. Of
// equally near words the first is taken.
const char *pel_text_nearest(const char *word, const char *const *known);

// Finds the place in JSON text that a path of keys and indices, such as "volumes.0.density", leads
// to, counted from 1. For a member that is the start of its key, for an element that of its value;
// "" is the first value. When the path ends early the place is that of its deepest part that
// exists, and the result is false. `json` must be valid JSON.
bool pel_text_locate(const char *json, const char *path, int *line, int *column);

#endif
