// mask_option.c - `--mask` of `pellucid render`: where a volume is shown, by another one's values.
#include "cli/mask_option.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/report.h"

enum { KEY_BYTES = 96, NAME_BYTES = 64 };

// The mask of a scene file. `other` is a volume's name, or its index.
static json_t *make_mask(const struct pel_mask *mask, const char *other) {
    bool index = strspn(other, "0123456789") == strlen(other);
    json_t *object = json_object(), *ranges = json_array();
    double threshold = INFINITY;
    for (int n = 0; n < mask->range_count; n++) {
        const struct pel_value_range *range = &mask->ranges[n];
        if (range->high == INFINITY)
            threshold = fmin(threshold, range->low);
        else
            json_array_append_new(ranges, report_numbers((double[]){range->low, range->high}, 2));
    }
    json_object_set_new(object, "volume",
                        index ? json_integer(strtol(other, NULL, 10)) : json_string(other));
    if (json_array_size(ranges) > 0)
        json_object_set(object, "ranges", ranges);
    if (threshold < INFINITY)
        json_object_set_new(object, "threshold", json_real(threshold));
    json_object_set_new(object, "invert", json_boolean(mask->inverted));
    json_decref(ranges);
    return object;
}

// Takes VOLUME=OTHER:VALUES apart.
static bool read_mask(char key[KEY_BYTES], char other[NAME_BYTES], struct pel_mask *mask,
                      const char *text) {
    const char *equals = strchr(text, '='), *colon = strrchr(text, ':');
    if (!equals || !colon || colon < equals)
        return false;
    mask->inverted = equals > text && equals[-1] == '!';
    int name_bytes = (int)(equals - text) - mask->inverted, other_bytes = (int)(colon - equals) - 1;
    return name_bytes > 0 && other_bytes > 0 && other_bytes < NAME_BYTES &&
           snprintf(key, KEY_BYTES, "volumes.%.*s.mask", name_bytes, text) < KEY_BYTES &&
           snprintf(other, NAME_BYTES, "%.*s", other_bytes, equals + 1) > 0 &&
           pel_mask_read_values(mask, colon + 1);
}

bool mask_option_add(struct overrides *overrides, const char *text) {
    struct pel_mask mask = {0};
    char key[KEY_BYTES], other[NAME_BYTES];
    if (!read_mask(key, other, &mask, text)) {
        cli_fail(PEL_ERROR_ARGUMENT,
                 "--mask: '%s' is not like 0=labels:7,8, ct!=labels:1,3..5 or ct=other:>=0.5",
                 text);
        return false;
    }
    json_t *object = make_mask(&mask, other);
    char *value = json_dumps(object, JSON_COMPACT);
    if (value)
        overrides_add(overrides, key, value);
    else
        cli_fail(PEL_ERROR_ARGUMENT, "--mask: '%s' is not valid UTF-8", text);
    free(value);
    json_decref(object);
    return value != NULL;
}
