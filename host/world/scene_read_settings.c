// scene_read_settings.c - the parts of a scene file that do not need its volumes: background,
// render settings and output, read and written.
#include "world/scene_plan.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "world/bricks.h"
#include "world/scene_write.h"

enum { PICTURE_MAX = 32768 };

static const char *const render_keys[] = {"comment",
                                          "size",
                                          "mixing",
                                          "step",
                                          "step_mm",
                                          "adaptive_step",
                                          "phase",
                                          "termination",
                                          "origin",
                                          "skip",
                                          "bricks",
                                          "supersampling",
                                          "jitter",
                                          "debug",
                                          "model",
                                          "order",
                                          "emission_scale",
                                          "preintegration",
                                          "quality",
                                          "region",
                                          "shadows",
                                          "ambient_occlusion",
                                          "filter",
                                          "gradient",
                                          "lod",
                                          NULL};
static const char *const brick_keys[] = {"comment", "size", "cluster", "walk",
                                         "cull",    "pool", NULL};
static const char *const supersampling_keys[] = {"comment", "n",        "pattern", "filter",
                                                 "seed",    "adaptive", NULL};
static const char *const output_keys[] = {"comment", "file", "depth", "alpha", NULL};

// In the order of their enums.
static const char *const origin_names[] = {"volumes", "bounds", NULL};
static const char *const skip_names[] = {"auto",   "none", "grid",   "distance",
                                         "octree", "bvh",  "blocks", NULL};
static const char *const pool_names[] = {"auto", "off", "on", NULL};
static const char *const debug_names[] = {"none",       "samples",   "spans", "volumes",
                                          "work-group", "work-item", "time",  "clusters",
                                          "nodes",      NULL};
static const char *const pattern_names[] = {"regular",        "jittered",   "n-rooks",
                                            "multi-jittered", "hammersley", NULL};
static const char *const reconstruction_names[] = {"box", "gaussian", NULL};
static const char *const alpha_names[] = {"straight", "premultiplied", NULL};

static const char *const background_names[] = {"black", "white",   "grey", "red",
                                               "green", "blue",    "cyan", "yellow",
                                               "navy",  "magenta", "none", NULL};
static const double background_values[][4] = {
    {0, 0, 0, 1}, {1, 1, 1, 1}, {0.5, 0.5, 0.5, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1},
    {0, 1, 1, 1}, {1, 1, 0, 1}, {0, 0, 0.2, 1},     {1, 0, 1, 1}, {0, 0, 0, 0}};

// "#rrggbb" or "#rrggbbaa"; the alpha stays as it is in the former.
static bool read_hex(const char *text, double rgba[4]) {
    size_t digits = strlen(text + 1);
    if ((digits != 6 && digits != 8) || strspn(text + 1, "0123456789abcdefABCDEF") != digits)
        return false;
    for (size_t i = 0; i < digits / 2; i++) {
        char pair[3] = {text[1 + 2 * i], text[2 + 2 * i], '\0'};
        rgba[i] = (double)strtol(pair, NULL, 16) / 255;
    }
    return true;
}

bool pel_scene_read_colour(double rgba[4], const struct pel_scene_node *object, const char *key) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, object, key))
        return true;
    if (json_is_array(node.value)) {
        size_t count = json_array_size(node.value) == 4 ? 4 : 3;
        return pel_node_check_numbers(&node, count, &pel_unit_number, rgba);
    }
    const char *text = json_string_value(node.value);
    if (text && *text == '#')
        return read_hex(text, rgba) ||
               pel_node_fail(&node, "must be #rrggbb or #rrggbbaa, not \"%.40s\"", text);
    int which;
    if (!pel_node_check_name(&node, background_names, &which))
        return false;
    memcpy(rgba, background_values[which], sizeof background_values[which]);
    return true;
}

static bool read_size(struct pel_render_settings *render, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    double size[2];
    const struct pel_range range = {.low = 1, .high = PICTURE_MAX};
    if (!pel_node_member(&node, object, "size"))
        return true;
    if (!pel_node_check_numbers(&node, 2, &range, size))
        return false;
    if (size[0] != floor(size[0]) || size[1] != floor(size[1]))
        return pel_node_fail(&node, "must be whole numbers, not %g x %g", size[0], size[1]);
    render->width = (int)size[0];
    render->height = (int)size[1];
    return true;
}

static bool read_region(struct pel_render_settings *render, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    double region[4];
    const struct pel_range range = {.low = 0, .high = PICTURE_MAX};
    if (!pel_node_member(&node, object, "region"))
        return true;
    if (!pel_node_check_numbers(&node, 4, &range, region))
        return false;
    for (int i = 0; i < 4; i++) {
        render->region[i] = (int)region[i];
        if (region[i] != floor(region[i]))
            return pel_node_fail(&node, "must be whole numbers, not %g", region[i]);
    }
    if (region[2] < 1 || region[3] < 1 || region[0] + region[2] > render->width ||
        region[1] + region[3] > render->height)
        return pel_node_fail(&node, "%g, %g, %g, %g is not inside the picture of %d x %d",
                             region[0], region[1], region[2], region[3], render->width,
                             render->height);
    return true;
}

static void write_region(struct pel_scene_writer *writer, json_t *object) {
    const int *region = writer->scene->render.region;
    if (region[2] > 0)
        pel_write_numbers(writer, object, "region", 4,
                          (double[]){region[0], region[1], region[2], region[3]});
}

static bool read_supersampling(struct pel_supersampling *supersampling,
                               const struct pel_scene_node *render) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, render, "supersampling"))
        return true;
    int pattern = (int)supersampling->pattern, filter = (int)supersampling->filter;
    int seed = (int)supersampling->seed;
    bool good = pel_node_check_object(&node, supersampling_keys) &&
                pel_node_get_integer(&node, "n", 1, PEL_SUPERSAMPLING_MAX, &supersampling->n) &&
                pel_node_get_name(&node, "pattern", pattern_names, &pattern) &&
                pel_node_get_name(&node, "filter", reconstruction_names, &filter) &&
                pel_node_get_integer(&node, "seed", 0, INT_MAX, &seed) &&
                pel_node_get_number(&node, "adaptive", &pel_unit_number, &supersampling->adaptive);
    supersampling->pattern = (enum pel_pattern)pattern;
    supersampling->filter = (enum pel_reconstruction)filter;
    supersampling->seed = (uint32_t)seed;
    return good;
}

static void write_supersampling(struct pel_scene_writer *writer, json_t *render) {
    const struct pel_supersampling *supersampling = &writer->scene->render.supersampling;
    json_t *object = pel_write_object(writer, render, "supersampling");
    pel_write_number(writer, object, "n", supersampling->n, 0);
    pel_write_name(writer, object, "pattern", pattern_names, supersampling->pattern, 0);
    pel_write_name(writer, object, "filter", reconstruction_names, supersampling->filter, 0);
    pel_write_number(writer, object, "seed", supersampling->seed, 0);
    pel_write_number(writer, object, "adaptive", supersampling->adaptive, 0);
    if (json_object_size(object) == 0)
        json_object_del(render, "supersampling");
}

static bool read_bricks(struct pel_brick_settings *bricks, const struct pel_scene_node *render) {
    struct pel_scene_node node, size;
    if (!pel_node_member(&node, render, "bricks"))
        return true;
    bool cluster = !bricks->apart, walk = !bricks->stay, cull = !bricks->keep;
    int pool = (int)bricks->pool;
    if (!pel_node_check_object(&node, brick_keys) ||
        !pel_node_get_integer(&node, "size", 8, 128, &bricks->size) ||
        !pel_node_get_bool(&node, "cluster", &cluster) ||
        !pel_node_get_bool(&node, "walk", &walk) || !pel_node_get_bool(&node, "cull", &cull) ||
        !pel_node_get_name(&node, "pool", pool_names, &pool))
        return false;
    bricks->pool = (enum pel_pool_use)pool;
    bricks->apart = !cluster;
    bricks->stay = !walk;
    bricks->keep = !cull;
    if (pel_bricks_check(bricks))
        return true;
    pel_node_member(&size, &node, "size");
    return pel_node_fail(&size, "must be 8, 16, 32, 64 or 128, not %d", bricks->size);
}

static void write_bricks(struct pel_scene_writer *writer, json_t *render) {
    const struct pel_brick_settings *bricks = &writer->scene->render.bricks;
    json_t *object = pel_write_object(writer, render, "bricks");
    pel_write_number(writer, object, "size", bricks->size, 0);
    pel_write_bool(writer, object, "cluster", !bricks->apart, true);
    pel_write_bool(writer, object, "walk", !bricks->stay, true);
    pel_write_bool(writer, object, "cull", !bricks->keep, true);
    pel_write_name(writer, object, "pool", pool_names, (int)bricks->pool, PEL_POOL_AUTO);
    if (json_object_size(object) == 0)
        json_object_del(render, "bricks");
}

static const char *const lod_names[] = {"off", "auto", NULL};

// A word, or the number of a level.
static bool read_lod(struct pel_render_settings *render, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    int which;
    if (!pel_node_member(&node, object, "lod"))
        return true;
    if (json_is_number(node.value)) {
        render->lod = PEL_LOD_LEVEL;
        return pel_node_get_integer(object, "lod", 0, PEL_LOD_LEVEL_MAX, &render->lod_level);
    }
    if (!pel_node_check_name(&node, lod_names, &which))
        return false;
    render->lod = (enum pel_lod)which;
    return true;
}

static void write_lod(struct pel_scene_writer *writer, json_t *object) {
    const struct pel_render_settings *render = &writer->scene->render;
    if (render->lod == PEL_LOD_LEVEL)
        pel_write_number(writer, object, "lod", render->lod_level, -1);
    else
        pel_write_name(writer, object, "lod", lod_names, (int)render->lod, PEL_LOD_OFF);
}

static bool read_render(struct pel_render_settings *render, const struct pel_scene_node *scene) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, scene, "render"))
        return true;
    const struct pel_range termination_range = {.low = 0, .high = 1, .low_open = true};
    int mixing = (int)render->mixing, origin = (int)render->origin, skip = (int)render->skip;
    int debug = (int)render->debug;
    bool good =
        pel_node_check_object(&node, render_keys) && read_size(render, &node) &&
        read_region(render, &node) &&
        pel_node_get_name(&node, "mixing", pel_mixing_names(), &mixing) &&
        pel_scene_read_march(render, &node) &&
        pel_node_get_number(&node, "phase", &pel_unit_number, &render->phase) &&
        pel_node_get_number(&node, "termination", &termination_range, &render->termination) &&
        pel_node_get_name(&node, "origin", origin_names, &origin) &&
        pel_node_get_name(&node, "skip", skip_names, &skip) &&
        read_bricks(&render->bricks, &node) && read_supersampling(&render->supersampling, &node) &&
        pel_node_get_bool(&node, "jitter", &render->jitter) &&
        pel_node_get_name(&node, "debug", debug_names, &debug) &&
        pel_scene_read_secondary(render, &node) && read_lod(render, &node);
    render->mixing = (enum pel_mixing)mixing;
    render->origin = (enum pel_sample_origin)origin;
    render->skip = (enum pel_skip)skip;
    render->debug = (enum pel_debug)debug;
    return good;
}

static void write_render(struct pel_scene_writer *writer, json_t *scene) {
    const struct pel_render_settings *render = &writer->scene->render;
    const struct pel_render_settings *usual = &writer->usual->render;
    json_t *object = pel_write_object(writer, scene, "render");
    pel_write_numbers(writer, object, "size", 2, (double[]){render->width, render->height});
    write_region(writer, object);
    pel_write_name(writer, object, "mixing", pel_mixing_names(), render->mixing, usual->mixing);
    pel_scene_write_march(writer, object);
    pel_write_number(writer, object, "phase", render->phase, usual->phase);
    pel_write_number(writer, object, "termination", render->termination, usual->termination);
    pel_write_name(writer, object, "origin", origin_names, render->origin, usual->origin);
    pel_write_name(writer, object, "skip", skip_names, render->skip, usual->skip);
    write_bricks(writer, object);
    write_supersampling(writer, object);
    pel_write_bool(writer, object, "jitter", render->jitter, false);
    pel_write_name(writer, object, "debug", debug_names, render->debug, PEL_DEBUG_NONE);
    pel_scene_write_secondary(writer, object);
    write_lod(writer, object);
}

static bool read_output_file(struct pel_output_settings *output,
                             const struct pel_scene_node *object) {
    struct pel_scene_node node;
    const char *text;
    if (!pel_node_member(&node, object, "file"))
        return true;
    if (!pel_node_get_text(object, "file", &text))
        return false;
    if (!*text)
        return pel_node_fail(&node, "is empty");
    // "-" is the standard output wherever the scene lies.
    char *path = strcmp(text, "-") == 0 ? pel_copy_text(text) : pel_node_path(&node, text);
    if (!path)
        return false;
    bool fits = strlen(path) < sizeof output->path;
    if (fits)
        strcpy(output->path, path);
    free(path);
    return fits || pel_node_fail(&node, "is longer than %zu bytes", sizeof output->path - 1);
}

static bool read_output(struct pel_output_settings *output, const struct pel_scene_node *scene) {
    struct pel_scene_node node, depth;
    if (!pel_node_member(&node, scene, "output"))
        return true;
    int alpha = 0;
    if (!pel_node_check_object(&node, output_keys) || !read_output_file(output, &node) ||
        !pel_node_get_integer(&node, "depth", 8, 16, &output->depth) ||
        !pel_node_get_name(&node, "alpha", alpha_names, &alpha))
        return false;
    if (output->depth != 8 && output->depth != 16) {
        pel_node_member(&depth, &node, "depth");
        return pel_node_fail(&depth, "must be 8 or 16, not %d", output->depth);
    }
    output->premultiplied = alpha == 1;
    return true;
}

static void write_output(struct pel_scene_writer *writer, json_t *scene) {
    const struct pel_output_settings *output = &writer->scene->output;
    json_t *object = pel_write_object(writer, scene, "output");
    if (strcmp(output->path, "-") == 0)
        pel_write_text(writer, object, "file", "-");
    else if (*output->path)
        pel_write_path(writer, object, "file", output->path);
    pel_write_number(writer, object, "depth", output->depth, writer->usual->output.depth);
    pel_write_name(writer, object, "alpha", alpha_names, output->premultiplied, 0);
    if (json_object_size(object) == 0)
        json_object_del(scene, "output");
}

bool pel_scene_read_settings(struct pel_scene *scene, const struct pel_scene_node *node) {
    return pel_scene_read_colour(scene->background, node, "background") &&
           pel_scene_read_lights(scene, node) &&
           pel_scene_read_clips(node, true, &scene->clip_count, scene->clips) &&
           read_render(&scene->render, node) && read_output(&scene->output, node);
}

void pel_scene_write_settings(struct pel_scene_writer *writer, json_t *root) {
    const double *background = writer->scene->background;
    if (memcmp(background, writer->usual->background, sizeof writer->usual->background) != 0)
        pel_write_colour(writer, root, "background", background, true);
    write_render(writer, root);
    write_output(writer, root);
}
