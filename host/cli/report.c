// report.c - how commands write numbers for people and for programs.
#include "cli/report.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

const char *report_bytes(char text[REPORT_TEXT_BYTES], uint64_t bytes) {
    static const char *const units[] = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    if (bytes < 1024) {
        snprintf(text, REPORT_TEXT_BYTES, "%u bytes", (unsigned)bytes);
        return text;
    }
    double value = (double)bytes / 1024;
    int unit = 0;
    for (; value >= 1024 && unit < 5; unit++)
        value /= 1024;
    snprintf(text, REPORT_TEXT_BYTES, "%.*f %s", value < 10 ? 1 : 0, value, units[unit]);
    return text;
}

const char *report_reader(enum pel_reader reader) {
    return reader == PEL_READER_IMAGE ? "image" : reader == PEL_READER_BUFFER ? "buffer" : "auto";
}

const char *report_skip(enum pel_skip skip) {
    static const char *const names[] = {"auto",   "none", "grid",  "distance",
                                        "octree", "bvh",  "blocks"};
    return names[skip];
}

json_t *report_number(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *report_numbers(const double *values, int count) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(array, report_number(values[i]));
    return array;
}

json_t *report_text(const char *text) {
    json_t *string = json_string(text);
    if (string)
        return string;
    char *ascii = strdup(text);
    if (!ascii)
        return NULL;
    for (char *c = ascii; *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    string = json_string(ascii);
    free(ascii);
    return string;
}

int report_json(json_t *value) {
    json_dumpf(value, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12));
    json_decref(value);
    putchar('\n');
    return report_finish(PEL_OK);
}

int report_finish(int status) {
    if (fflush(stdout) != 0 || ferror(stdout))
        return cli_fail(PEL_ERROR_FILE, "standard output: cannot write: %s", strerror(errno));
    return status;
}
