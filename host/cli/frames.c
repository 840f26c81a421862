// frames.c - which frames of an animation are wanted, and what their files are called.
//
// A pattern comes from the user, so it never becomes the format of a printf: it is taken apart
// here.
#include "cli/frames.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

// Reads a decimal number and moves behind it; false when there is none.
static bool read_number(const char **text, int *value) {
    char *end;
    if (!isdigit((unsigned char)**text))
        return false;
    long number = strtol(*text, &end, 10);
    *value = number > INT_MAX ? INT_MAX : (int)number;
    *text = end;
    return true;
}

static bool read_range(struct frames *frames, const char *text) {
    *frames = (struct frames){.stride = 1};
    if (!read_number(&text, &frames->end))
        return false;
    if (*text == '\0')
        return true;
    frames->first = frames->end;
    if (*text++ != ':' || !read_number(&text, &frames->end))
        return false;
    if (*text == ':') {
        text++;
        if (!read_number(&text, &frames->stride))
            return false;
    }
    return *text == '\0';
}

bool frames_parse(struct frames *frames, const char *text, int frame_count) {
    if (strcmp(text, "all") == 0) {
        *frames = (struct frames){0, frame_count, 1};
        return true;
    }
    bool good = false;
    if (!read_range(frames, text) || frames->stride < 1)
        cli_fail(PEL_ERROR_ARGUMENT, "--frames: '%s' is not of the form 0:120, 0:120:2, 10 or all",
                 text);
    else if (frames->first >= frames->end)
        cli_fail(PEL_ERROR_ARGUMENT, "--frames: '%s' has no frame in it", text);
    else if (frames->end > frame_count)
        cli_fail(PEL_ERROR_ARGUMENT, "--frames: '%s' goes beyond the %d frames of the animation",
                 text, frame_count);
    else
        good = true;
    return good;
}

int frames_count(const struct frames *frames) {
    return (frames->end - frames->first + frames->stride - 1) / frames->stride;
}

// Length of the conversion that begins at a '%', 0 when it is none that we know; its width and
// whether zeros fill it.
static size_t read_conversion(const char *text, int *width, bool *zeros) {
    const char *c = text + 1;
    *zeros = *c == '0';
    c += *zeros;
    *width = 0;
    for (int digits = 0; digits < 2 && isdigit((unsigned char)*c); digits++)
        *width = 10 * *width + (*c++ - '0');
    return *c == 'd' ? (size_t)(c - text) + 1 : 0;
}

bool frames_is_pattern(const char *pattern) {
    int conversions = 0, width;
    bool zeros;
    for (const char *c = strchr(pattern, '%'); c; c = strchr(c, '%')) {
        size_t length = c[1] == '%' ? 2 : read_conversion(c, &width, &zeros);
        if (length == 0)
            return false;
        conversions += c[1] != '%';
        c += length;
    }
    return conversions == 1;
}

void frames_name(char *name, size_t bytes, const char *pattern, int frame) {
    size_t used = 0;
    while (*pattern && used + 1 < bytes) {
        int width;
        bool zeros;
        size_t length = *pattern != '%'     ? 0
                        : pattern[1] == '%' ? 2
                                            : read_conversion(pattern, &width, &zeros);
        if (length == 0 || pattern[1] == '%') {
            name[used++] = *pattern;
            pattern += length ? length : 1;
            continue;
        }
        int written = snprintf(name + used, bytes - used, zeros ? "%0*d" : "%*d", width, frame);
        used += (size_t)written < bytes - used ? (size_t)written : bytes - used - 1;
        pattern += length;
    }
    name[used] = '\0';
}
