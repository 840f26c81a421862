// names.c - what the scene's choices are called in menus.
#include "viewer/names.h"

#include <stddef.h>

const char *const *pel_names_model(void) {
    static const char *const names[] = {"the scene's", "absorption", "emission", "mip", "minip",
                                        "average",     "iso",        "thesis",   NULL};
    return names;
}

// Of a scene that says nothing it is absorption.
const char *const *pel_names_scene_model(void) {
    static const char *const names[] = {"absorption (default)",
                                        "absorption",
                                        "emission",
                                        "mip",
                                        "minip",
                                        "average",
                                        "iso",
                                        "thesis",
                                        NULL};
    return names;
}

const char *const *pel_names_gradient(void) {
    static const char *const names[] = {"central differences", "Sobel", "analytic", NULL};
    return names;
}

const char *const *pel_names_order(void) {
    static const char *const names[] = {"front to back", "back to front", NULL};
    return names;
}

const char *const *pel_names_pool(void) {
    static const char *const names[] = {"automatic", "off", "on", NULL};
    return names;
}

// The smallest is 8, each twice the one before.
const char *const *pel_names_brick(void) {
    static const char *const names[] = {"8 voxels",  "16 voxels",  "32 voxels",
                                        "64 voxels", "128 voxels", NULL};
    return names;
}

const char *const *pel_names_lod(void) {
    static const char *const names[] = {"volumes as they are", "by distance", "one level", NULL};
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
    static const char *const names[] = {"none",      "samples", "spans",    "volumes", "work-group",
                                        "work-item", "time",    "clusters", "nodes",   NULL};
    return names;
}

int pel_names_count(const char *const *names) {
    int count = 0;
    while (names[count])
        count++;
    return count;
}
