// names.c - what the scene's choices are called in menus.
#include "viewer/names.h"

#include <stddef.h>

const char *const *pel_names_model(void) {
    static const char *const names[] = {"the scene's", "absorption", "emission", "mip", "minip",
                                        "average",     "iso",        "thesis",   NULL};
    return names;
}

const char *const *pel_names_filter(void) {
    static const char *const names[] = {"linear", "nearest", "cubic B-spline", "Catmull-Rom", NULL};
    return names;
}

const char *const *pel_names_shading(void) {
    static const char *const names[] = {"none", "Blinn and Phong", "Phong", NULL};
    return names;
}

const char *const *pel_names_light(void) {
    static const char *const names[] = {"headlight", "camera", "directional", "point", NULL};
    return names;
}

const char *const *pel_names_skip(void) {
    static const char *const names[] = {"automatic", "none", "grid",   "distance",
                                        "octree",    "bvh",  "blocks", NULL};
    return names;
}

const char *const *pel_names_pattern(void) {
    static const char *const names[] = {"regular",        "jittered",   "n-rooks",
                                        "multi-jittered", "Hammersley", NULL};
    return names;
}

const char *const *pel_names_reconstruction(void) {
    static const char *const names[] = {"box", "Gaussian", NULL};
    return names;
}

const char *const *pel_names_debug(void) {
    static const char *const names[] = {"none",       "samples",   "spans", "volumes",
                                        "work-group", "work-item", "time",  NULL};
    return names;
}

int pel_names_count(const char *const *names) {
    int count = 0;
    while (names[count])
        count++;
    return count;
}
