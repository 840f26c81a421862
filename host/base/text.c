// text.c - the optimal string alignment distance (Levenshtein's, with swapped neighbours), and a
// walk through JSON text that knows where it is, which jansson's parsed values do not.
#include "base/text.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// Longer words are not slips of anything we know.
enum { WORD_MAX = 48 };
// Shorter words are the beginning of too many.
enum { BEGINNING_MIN = 3 };

static int least(int a, int b) {
    return a < b ? a : b;
}

static int lower(const char *text, int i) {
    return tolower((unsigned char)text[i]);
}

// Both words have at most WORD_MAX letters.
static int distance(const char *a, const char *b) {
    int a_length = (int)strlen(a), b_length = (int)strlen(b);
    // Row i holds the distances of a's first i letters to every beginning of b.
    int rows[3][WORD_MAX + 1];
    int *before = rows[0], *above = rows[1], *row = rows[2];
    for (int j = 0; j <= b_length; j++)
        row[j] = j;
    for (int i = 1; i <= a_length; i++) {
        int *recycled = before;
        before = above;
        above = row;
        row = recycled;
        row[0] = i;
        for (int j = 1; j <= b_length; j++) {
            int replaced = above[j - 1] + (lower(a, i - 1) != lower(b, j - 1));
            row[j] = least(replaced, 1 + least(above[j], row[j - 1]));
            if (i > 1 && j > 1 && lower(a, i - 1) == lower(b, j - 2) &&
                lower(a, i - 2) == lower(b, j - 1))
                row[j] = least(row[j], before[j - 2] + 1);
        }
    }
    return row[b_length];
}

// Where a walk through JSON text has got to.
struct cursor {
    const char *at;
    int line, column;
};

// Goes over one byte. A character of several bytes counts as one column, as jansson counts.
static void step(struct cursor *cursor) {
    unsigned char byte = (unsigned char)*cursor->at++;
    if (byte == '\n') {
        cursor->line++;
        cursor->column = 1;
    } else if ((byte & 0xc0) != 0x80) {
        cursor->column++;
    }
}

static void skip_space(struct cursor *cursor) {
    while (*cursor->at && strchr(" \t\r\n,:", *cursor->at))
        step(cursor);
}

static void skip_string(struct cursor *cursor) {
    step(cursor);
    while (*cursor->at && *cursor->at != '"') {
        if (*cursor->at == '\\')
            step(cursor);
        if (*cursor->at)
            step(cursor);
    }
    if (*cursor->at)
        step(cursor);
}

// Goes over one value. Only the depth of brackets matters, since the text is valid.
static void skip_value(struct cursor *cursor) {
    int depth = 0;
    do {
        if (*cursor->at == '"') {
            skip_string(cursor);
        } else if (*cursor->at && strchr("[]{}", *cursor->at)) {
            depth += *cursor->at == '[' || *cursor->at == '{' ? 1 : -1;
            step(cursor);
        } else {
            while (*cursor->at && !strchr("[]{}\", \t\r\n:", *cursor->at))
                step(cursor);
        }
        if (depth > 0)
            skip_space(cursor);
    } while (depth > 0 && *cursor->at);
}

// From the bracket of an array or object to the element or member of that name. `*place` becomes
// where the user sees it, and the cursor where its value starts. A key that is escaped in the text
// is not found, which no key of ours is.
static bool enter(struct cursor *cursor, const char *name, size_t length, struct cursor *place) {
    bool object = *cursor->at == '{';
    if (!object && *cursor->at != '[')
        return false;
    char *end;
    long index = object ? 0 : strtol(name, &end, 10);
    if (!object && (end == name || end != name + length))
        return false;
    step(cursor);
    skip_space(cursor);
    while (*cursor->at && *cursor->at != ']' && *cursor->at != '}') {
        *place = *cursor;
        bool found =
            object ? strncmp(cursor->at + 1, name, length) == 0 && cursor->at[1 + length] == '"'
                   : index-- == 0;
        if (object) {
            skip_string(cursor);
            skip_space(cursor);
        }
        if (found)
            return true;
        skip_value(cursor);
        skip_space(cursor);
    }
    return false;
}

int pel_text_count(const char *const *words) {
    int count = 0;
    while (words[count])
        count++;
    return count;
}

void pel_text_list(char *text, size_t bytes, const char *const *words, int count,
                   const char *last) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count && used < bytes; i++) {
        const char *between = i == 0 ? "" : i + 1 < count ? ", " : last;
        used += (size_t)snprintf(text + used, bytes - used, "%s%s", between, words[i]);
    }
}

const char *pel_text_nearest(const char *word, const char *const *known) {
    size_t length = strlen(word);
    if (length > WORD_MAX)
        return NULL;
    int allowed = length <= 5 ? 1 : length <= 8 ? 2 : 3;
    const char *nearest = NULL, *const *first = known;
    for (; *known; known++) {
        if (strlen(*known) > WORD_MAX)
            continue;
        int slips = distance(word, *known);
        if (slips <= allowed) {
            nearest = *known;
            allowed = slips - 1;
        }
    }
    for (; !nearest && length >= BEGINNING_MIN && *first; first++)
        if (strncasecmp(word, *first, length) == 0)
            nearest = *first;
    return nearest;
}

bool pel_text_locate(const char *json, const char *path, int *line, int *column) {
    struct cursor cursor = {.at = json, .line = 1, .column = 1};
    skip_space(&cursor);
    struct cursor place = cursor;
    bool found = true;
    while (*path && found) {
        size_t length = strcspn(path, ".");
        struct cursor deeper;
        found = enter(&cursor, path, length, &deeper);
        if (found)
            place = deeper;
        path += length;
        path += *path == '.';
    }
    *line = place.line;
    *column = place.column;
    return found;
}
