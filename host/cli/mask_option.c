// mask_option.c - `--mask` of `pellucid render`: where a volume is shown, by another one's values.
#include "cli/mask_option.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

enum { LIST_BYTES = 1024, KEY_BYTES = 96 };

// The lists that the values become, each without its brackets.
struct values {
    char labels[LIST_BYTES], ranges[LIST_BYTES], threshold[32];
};

// Reads a number that ends where `wanted` begins, and moves on behind that.
static bool read_number(const char **at, const char *wanted, double *number) {
    char *end;
    *number = strtod(*at, &end);
    // "3..5" is no number followed by ".5".
    if (end != *at && wanted[0] == '.' && end[-1] == '.' && *end == '.')
        end--;
    if (end == *at || strncmp(end, wanted, strlen(wanted)) != 0)
        return false;
    *at = end + strlen(wanted);
    return true;
}

static bool append(char list[LIST_BYTES], const char *text) {
    size_t length = strlen(list);
    int written = snprintf(list + length, LIST_BYTES - length, "%s%s", length ? "," : "", text);
    return written > 0 && (size_t)written < LIST_BYTES - length;
}

// "7", "3..5" or ">=0.5"
static bool add_value(struct values *values, const char *text) {
    char written[80];
    double low, high;
    const char *at = text;
    if (strncmp(text, ">=", 2) == 0) {
        at += 2;
        if (!read_number(&at, "", &low) || *at)
            return false;
        snprintf(values->threshold, sizeof values->threshold, "%.17g", low);
        return true;
    }
    if (strstr(text, "..")) {
        if (!read_number(&at, "..", &low) || !read_number(&at, "", &high) || *at)
            return false;
        snprintf(written, sizeof written, "[%.17g,%.17g]", low, high);
        return append(values->ranges, written);
    }
    if (!read_number(&at, "", &low) || *at)
        return false;
    snprintf(written, sizeof written, "%.17g", low);
    return append(values->labels, written);
}

static bool read_values(struct values *values, const char *text) {
    while (*text) {
        char word[80];
        size_t length = strcspn(text, ",");
        if (length >= sizeof word)
            return false;
        snprintf(word, sizeof word, "%.*s", (int)length, text);
        if (!add_value(values, word))
            return false;
        text += length + (text[length] == ',');
    }
    return true;
}

static bool add_mask(struct overrides *overrides, const char *text) {
    const char *equals = strchr(text, '='), *colon = strrchr(text, ':');
    if (!equals || !colon || colon < equals)
        return false;
    bool inverted = equals > text && equals[-1] == '!';
    int name = (int)(equals - text) - inverted, other = (int)(colon - equals) - 1;
    struct values values = {.labels = ""};
    char key[KEY_BYTES], value[3 * LIST_BYTES];
    if (name < 1 || other < 1 || strpbrk(text, "\"\\") || !colon[1] ||
        !read_values(&values, colon + 1) ||
        snprintf(key, sizeof key, "volumes.%.*s.mask", name, text) >= KEY_BYTES)
        return false;
    bool index = strspn(equals + 1, "0123456789") == (size_t)other;
    const char *quote = index ? "" : "\"";
    int length =
        snprintf(value, sizeof value, "{\"volume\":%s%.*s%s", quote, other, equals + 1, quote);
    const char *lists[] = {values.labels, values.ranges};
    for (int n = 0; n < 2; n++)
        if (*lists[n])
            length += snprintf(value + length, sizeof value - (size_t)length, ",\"%s\":[%s]",
                               n ? "ranges" : "labels", lists[n]);
    if (*values.threshold)
        length += snprintf(value + length, sizeof value - (size_t)length, ",\"threshold\":%s",
                           values.threshold);
    snprintf(value + length, sizeof value - (size_t)length, ",\"invert\":%s}",
             inverted ? "true" : "false");
    overrides_add(overrides, key, value);
    return true;
}

bool mask_option_add(struct overrides *overrides, const char *text) {
    if (add_mask(overrides, text))
        return true;
    cli_fail(PEL_ERROR_ARGUMENT,
             "--mask: '%s' is not like 0=labels:7,8, ct!=labels:1,3..5 or ct=other:>=0.5", text);
    return false;
}
