// clip_option.c - `--clip` of `pellucid render`: a plane across an axis, or a box along the axes.
#include "cli/clip_option.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

enum { VALUE_BYTES = 256 };

static bool is_end(const char *text, const char *end, char wanted) {
    return end != text && *end == wanted;
}

// "x<10"
static bool write_plane(char value[VALUE_BYTES], const char *text) {
    const char *axis = *text ? strchr("xyz", *text) : NULL;
    if (!axis || (text[1] != '<' && text[1] != '>'))
        return false;
    char *end;
    double place[3] = {0}, normal[3] = {0};
    const char *number = text + 2 + (text[2] == '=');
    place[*axis - 'x'] = strtod(number, &end);
    normal[*axis - 'x'] = text[1] == '<' ? -1 : 1;
    if (!is_end(number, end, '\0'))
        return false;
    snprintf(value, VALUE_BYTES,
             "{\"plane\":{\"point\":[%.17g,%.17g,%.17g],\"normal\":[%g,%g,%g]}}", place[0],
             place[1], place[2], normal[0], normal[1], normal[2]);
    return true;
}

// "box=X0:X1,Y0:Y1,Z0:Z1", or "cut=..." for what is outside.
static bool write_box(char value[VALUE_BYTES], const char *text) {
    bool box = strncmp(text, "box=", 4) == 0;
    if (!box && strncmp(text, "cut=", 4) != 0)
        return false;
    double ends[6];
    const char *at = text + 4;
    for (int i = 0; i < 6; i++) {
        char *end;
        ends[i] = strtod(at, &end);
        if (!is_end(at, end,
                    i == 5  ? '\0'
                    : i % 2 ? ','
                            : ':') ||
            (i % 2 && !(ends[i] > ends[i - 1])))
            return false;
        at = end + 1;
    }
    snprintf(value, VALUE_BYTES,
             "{\"box\":{\"centre\":[%.17g,%.17g,%.17g],\"size\":[%.17g,%.17g,%.17g]},"
             "\"keep\":\"%s\"}",
             (ends[0] + ends[1]) / 2, (ends[2] + ends[3]) / 2, (ends[4] + ends[5]) / 2,
             ends[1] - ends[0], ends[3] - ends[2], ends[5] - ends[4], box ? "inside" : "outside");
    return true;
}

bool clip_option_add(struct overrides *overrides, int *count, const char *text) {
    char key[32], value[VALUE_BYTES];
    if (!write_plane(value, text) && !write_box(value, text)) {
        cli_fail(PEL_ERROR_ARGUMENT,
                 "--clip: '%s' is not like x<10, box=X0:X1,Y0:Y1,Z0:Z1 or cut=X0:X1,Y0:Y1,Z0:Z1",
                 text);
        return false;
    }
    if (*count == 0)
        overrides_add(overrides, "clip", "[]");
    snprintf(key, sizeof key, "clip.%d", (*count)++);
    overrides_add(overrides, key, value);
    return true;
}
