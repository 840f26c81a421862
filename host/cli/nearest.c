// nearest.c - the word somebody probably meant.
#include "cli/nearest.h"

#include <stddef.h>
#include <string.h>

enum { WORD_BYTES = 32, WORTH_NAMING = 3 };

// How many letters must be inserted, deleted or replaced to make `b` of `a` (Levenshtein 1966);
// both are shorter than WORD_BYTES. row[j] is the distance from what was read of `a` to the first j
// letters of `b`.
static int edit_distance(const char *a, const char *b) {
    int row[WORD_BYTES];
    int length = (int)strlen(b);
    for (int j = 0; j <= length; j++)
        row[j] = j;
    for (int i = 0; a[i]; i++) {
        int diagonal = row[0];
        row[0] = i + 1;
        for (int j = 1; j <= length; j++) {
            int least = diagonal + (a[i] != b[j - 1]);
            if (row[j] + 1 < least)
                least = row[j] + 1;
            if (row[j - 1] + 1 < least)
                least = row[j - 1] + 1;
            diagonal = row[j];
            row[j] = least;
        }
    }
    return row[length];
}

const char *cli_nearest(const char *word, const char *const *known, int count) {
    const char *nearest = NULL;
    int least = WORTH_NAMING;
    for (int i = 0; i < count && strlen(word) < WORD_BYTES; i++) {
        int distance = edit_distance(word, known[i]);
        if (distance < least) {
            least = distance;
            nearest = known[i];
        }
    }
    return nearest;
}
