// mask_text.c - the values of a mask as people type them: numbers, ranges such as 3..5, and >=0.5,
// with commas between them.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "pellucid.h"

enum { WORD_BYTES = 80 };

// Reads a number and moves on behind it.
static bool read_number(const char **at, double *number) {
    char *end;
    *number = strtod(*at, &end);
    if (end == *at || !isfinite(*number))
        return false;
    // In "3..5" the first point is not the number's.
    if (end[-1] == '.' && *end == '.')
        end--;
    *at = end;
    return true;
}

static bool read_range(struct pel_value_range *range, const char *word) {
    const char *at = word;
    if (strncmp(at, ">=", 2) == 0) {
        at += 2;
        range->high = INFINITY;
        return read_number(&at, &range->low) && !*at;
    }
    if (!read_number(&at, &range->low))
        return false;
    range->high = range->low;
    if (strncmp(at, "..", 2) == 0) {
        at += 2;
        if (!read_number(&at, &range->high))
            return false;
    }
    return !*at && range->low <= range->high;
}

bool pel_mask_read_values(struct pel_mask *mask, const char *text) {
    struct pel_mask read = *mask;
    read.range_count = 0;
    const char *at = text;
    do {
        char word[WORD_BYTES];
        size_t length = strcspn(at, ",");
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (read.range_count == PEL_MASK_RANGE_MAX)
            return pel_fail(PEL_ERROR_ARGUMENT, "'%s' has more than %d values and ranges", text,
                            PEL_MASK_RANGE_MAX);
        if (length >= sizeof word || !read_range(&read.ranges[read.range_count++], word))
            return pel_fail(PEL_ERROR_ARGUMENT, "'%.*s' is no value, and not like 3..5 or >=0.5",
                            (int)length, at);
        at += length;
    } while (*at++ == ',');
    *mask = read;
    return true;
}

void pel_mask_write_values(const struct pel_mask *mask, char *text, size_t bytes) {
    size_t length = 0;
    text[0] = '\0';
    for (int n = 0; n < mask->range_count && length < bytes; n++) {
        const struct pel_value_range *range = &mask->ranges[n];
        const char *comma = n > 0 ? "," : "";
        int written;
        if (range->high == INFINITY)
            written = snprintf(text + length, bytes - length, "%s>=%.9g", comma, range->low);
        else if (range->low == range->high)
            written = snprintf(text + length, bytes - length, "%s%.9g", comma, range->low);
        else
            written = snprintf(text + length, bytes - length, "%s%.9g..%.9g", comma, range->low,
                               range->high);
        length += (size_t)written;
    }
}
