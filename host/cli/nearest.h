// nearest.h - the word somebody probably meant.
#ifndef PEL_CLI_NEAREST_H
#define PEL_CLI_NEAREST_H

// Of `count` known words the one with the fewest letters to insert, delete or replace, at most two;
// NULL when none is that near.
const char *cli_nearest(const char *word, const char *const *known, int count);

#endif
