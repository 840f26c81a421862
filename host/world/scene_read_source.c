// scene_read_source.c - where the voxels of a volume in a scene file come from: a file, with what
// is needed to read it, or a generator.
#include "world/scene_plan.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/text.h"
#include "world/scene_write.h"

static const char *const raw_keys[] = {"comment", "dims",   "type",   "spacing",
                                       "origin",  "offset", "endian", NULL};
static const char *const generate_keys[] = {"comment", "kind",   "size", "spacing",
                                            "type",    "second", NULL};

static const char *const hypertexture_keys[] = {"comment", "recipe", "size",   "type", "seed",
                                                "time",    "live",   "object", "wrap", NULL};

static const char *const endian_names[] = {"little", "big", NULL};

// In the order of enum pel_voxel_type; generators make three of them.
static const char *const type_names[] = {"uint8",   "int8", "uint16", "int16",
                                         "float32", "rgb8", "rgba8",  NULL};
static const char *const generate_type_names[] = {"uint8", "uint16", "float32", NULL};
static const enum pel_voxel_type generate_types[] = {PEL_VOXEL_U8, PEL_VOXEL_U16, PEL_VOXEL_F32};

enum { DIMENSION_MAX = 65536, GENERATE_MAX = 2048 };
enum { HYPERTEXTURE_SIZE = 64, HYPERTEXTURE_MAX = 1024 };

static bool read_dims(int dims[3], const struct pel_scene_node *raw) {
    struct pel_scene_node node;
    double numbers[3];
    const struct pel_range range = {.low = 1, .high = DIMENSION_MAX};
    if (!pel_node_member(&node, raw, "dims"))
        return pel_node_fail(raw, "needs 'dims'");
    if (!pel_node_check_numbers(&node, 3, &range, numbers))
        return false;
    for (int i = 0; i < 3; i++) {
        dims[i] = (int)numbers[i];
        if (dims[i] != numbers[i])
            return pel_node_fail(&node, "must be whole numbers, not %g", numbers[i]);
    }
    return true;
}

static bool read_raw(struct pel_load_options *load, const struct pel_scene_node *volume) {
    struct pel_scene_node node, member;
    if (!pel_node_member(&node, volume, "raw"))
        return true;
    // Doubles hold every offset a file can have.
    const struct pel_range offset_range = {.low = 0, .high = 0x1p53};
    double offset = 0;
    int type = PEL_VOXEL_U8, endian = 0;
    if (!pel_node_check_object(&node, raw_keys) || !read_dims(load->raw.dims, &node) ||
        !pel_node_get_name(&node, "type", type_names, &type) ||
        !pel_node_get_numbers(&node, "spacing", 3, &pel_positive_number, load->raw.spacing) ||
        !pel_node_get_numbers(&node, "origin", 3, &pel_any_number, load->raw.origin) ||
        !pel_node_get_number(&node, "offset", &offset_range, &offset) ||
        !pel_node_get_name(&node, "endian", endian_names, &endian))
        return false;
    load->raw.type = (enum pel_voxel_type)type;
    load->raw.offset = (size_t)offset;
    load->raw.big_endian = endian == 1;
    if (offset != (double)load->raw.offset) {
        pel_node_member(&member, &node, "offset");
        return pel_node_fail(&member, "must be a whole number, not %g", offset);
    }
    return true;
}

static bool read_labels(enum pel_label_choice *choice, const struct pel_scene_node *volume) {
    struct pel_scene_node node;
    bool labels = false;
    if (!pel_node_member(&node, volume, "labels"))
        return true;
    *choice = PEL_LABELS_NO;
    if (!pel_node_get_bool(volume, "labels", &labels))
        return false;
    if (labels)
        *choice = PEL_LABELS_YES;
    return true;
}

static bool read_file(struct pel_volume_plan *plan, const struct pel_scene_node *node) {
    struct pel_scene_node file, channel;
    const char *name;
    if (!pel_node_get_text(node, "file", &name))
        return false;
    pel_node_member(&file, node, "file");
    if (!*name)
        return pel_node_fail(&file, "is empty");
    plan->load.split_channels = pel_node_member(&channel, node, "channel");
    if (!read_raw(&plan->load, node) || !read_labels(&plan->load.labels, node) ||
        !pel_node_get_integer(node, "time", 0, INT_MAX, &plan->load.time) ||
        !pel_node_get_integer(node, "channel", 0, INT_MAX, &plan->load.channel))
        return false;
    plan->file = pel_node_path(&file, name);
    return plan->file != NULL;
}

// One of pel_generator_names.
static bool read_kind(struct pel_volume_plan *plan, const struct pel_scene_node *node) {
    struct pel_scene_node kind;
    int which;
    if (!pel_node_member(&kind, node, "kind"))
        return pel_node_fail(node, "needs 'kind'");
    const char *const *names = pel_generator_names();
    if (!pel_node_check_name(&kind, names, &which))
        return false;
    plan->kind = names[which];
    return true;
}

static bool read_generate(struct pel_volume_plan *plan, const struct pel_scene_node *node) {
    struct pel_generate_options *options = &plan->generate;
    int type = 0;
    if (!pel_node_check_object(node, generate_keys) || !read_kind(plan, node) ||
        !pel_node_get_integer(node, "size", 2, GENERATE_MAX, &options->size) ||
        !pel_node_get_number(node, "spacing", &pel_positive_number, &options->spacing_mm) ||
        !pel_node_get_name(node, "type", generate_type_names, &type) ||
        !pel_node_get_bool(node, "second", &options->second))
        return false;
    options->type = generate_types[type];
    return true;
}

// A preset or a file by its name, or the recipe itself, which becomes its text.
static bool read_recipe(struct pel_volume_plan *plan, const struct pel_scene_node *node) {
    struct pel_scene_node recipe;
    const char *name = NULL;
    if (!pel_node_member(&recipe, node, "recipe"))
        return pel_node_fail(node, "needs 'recipe'");
    if (json_is_object(recipe.value)) {
        char *text = json_dumps(recipe.value, JSON_COMPACT);
        plan->recipe = text ? pel_copy_text(text) : NULL;
        free(text);
        return plan->recipe || pel_fail(PEL_ERROR_MEMORY, "cannot allocate a recipe");
    }
    if (!pel_node_get_text(node, "recipe", &name))
        return false;
    bool file = strchr(name, '/') || pel_path_has_extension(name, ".json");
    plan->recipe = file ? pel_node_path(&recipe, name) : pel_copy_text(name);
    return plan->recipe != NULL;
}

static bool read_hypertexture(struct pel_volume_plan *plan, const struct pel_scene_node *node) {
    const struct pel_range time_range = {.low = -1e6, .high = 1e6};
    int type = 0, seed = 0;
    plan->bake.size = HYPERTEXTURE_SIZE;
    if (!pel_node_check_object(node, hypertexture_keys) || !read_recipe(plan, node) ||
        !pel_node_get_integer(node, "size", 2, HYPERTEXTURE_MAX, &plan->bake.size) ||
        !pel_node_get_name(node, "type", generate_type_names, &type) ||
        !pel_node_get_integer(node, "seed", 0, INT_MAX, &seed) ||
        !pel_node_get_number(node, "time", &time_range, &plan->bake.time) ||
        !pel_node_get_bool(node, "live", &plan->live) ||
        !pel_node_get_bool(node, "wrap", &plan->bake.wrap) ||
        !pel_node_get_text(node, "object", &plan->object_name))
        return false;
    plan->bake.seed = (uint32_t)seed;
    plan->bake.type = generate_types[type];
    return true;
}

bool pel_scene_read_source(struct pel_volume_plan *plan, const struct pel_scene_node *node) {
    static const char *const only_files[] = {"raw", "time", "channel", "labels", NULL};
    struct pel_scene_node file, generate, member;
    bool has_file = pel_node_member(&file, node, "file");
    bool has_generate = pel_node_member(&generate, node, "generate");
    struct pel_scene_node hypertexture;
    bool has_hypertexture = pel_node_member(&hypertexture, node, "hypertexture");
    if (has_file && has_generate)
        return pel_node_fail(&generate, "there is a 'file' already");
    if (has_hypertexture && (has_file || has_generate))
        return pel_node_fail(&hypertexture, "there is a '%s' already",
                             has_file ? "file" : "generate");
    if (!has_file && !has_generate && !has_hypertexture)
        return pel_node_fail(node, "needs 'file', 'generate' or 'hypertexture'");
    if (has_file)
        return read_file(plan, node);
    for (int i = 0; only_files[i]; i++)
        if (pel_node_member(&member, node, only_files[i]))
            return pel_node_fail(&member, "applies to files only");
    if (has_hypertexture && pel_node_member(&member, node, "spacing"))
        return pel_node_fail(&member, "applies to voxels, of which a hypertexture has 'size'");
    return has_generate ? read_generate(plan, &generate) : read_hypertexture(plan, &hypertexture);
}

static void write_raw(struct pel_scene_writer *writer, json_t *volume,
                      const struct pel_load_options *load) {
    json_t *raw = pel_write_object(writer, volume, "raw");
    const double dims[3] = {load->raw.dims[0], load->raw.dims[1], load->raw.dims[2]};
    pel_write_numbers(writer, raw, "dims", 3, dims);
    pel_write_name(writer, raw, "type", type_names, load->raw.type, PEL_VOXEL_U8);
    if (load->raw.spacing[0] > 0)
        pel_write_numbers(writer, raw, "spacing", 3, load->raw.spacing);
    if (load->raw.origin[0] != 0 || load->raw.origin[1] != 0 || load->raw.origin[2] != 0)
        pel_write_numbers(writer, raw, "origin", 3, load->raw.origin);
    pel_write_number(writer, raw, "offset", (double)load->raw.offset, 0);
    pel_write_name(writer, raw, "endian", endian_names, load->raw.big_endian, 0);
}

static void write_generate(struct pel_scene_writer *writer, json_t *volume,
                           const struct pel_volume_source *source) {
    const struct pel_generate_options *options = &source->generate;
    json_t *generate = pel_write_object(writer, volume, "generate");
    int type = 0;
    while (type < 2 && generate_types[type] != options->type)
        type++;
    pel_write_text(writer, generate, "kind", source->kind);
    pel_write_number(writer, generate, "size", options->size, 0);
    pel_write_number(writer, generate, "spacing", options->spacing_mm, 0);
    pel_write_name(writer, generate, "type", generate_type_names, type, 0);
    pel_write_bool(writer, generate, "second", options->second, false);
}

// The name of an instance that shows the volume; a hidden one does as well.
static const char *name_of(const struct pel_scene *scene, const struct pel_volume *volume) {
    for (int i = 0; i < scene->instance_count; i++)
        if (scene->volumes[scene->instances[i].volume] == volume)
            return scene->instances[i].name;
    return "";
}

static void write_hypertexture(struct pel_scene_writer *writer, json_t *volume,
                               const struct pel_volume_source *source) {
    json_t *object = pel_write_object(writer, volume, "hypertexture");
    const char *recipe = source->recipe;
    int type = 0;
    while (type < 2 && generate_types[type] != source->hypertexture.type)
        type++;
    if (*recipe == '{')
        pel_write_value(writer, object, "recipe", json_loads(recipe, 0, NULL));
    else if (strchr(recipe, '/') || pel_path_has_extension(recipe, ".json"))
        pel_write_path(writer, object, "recipe", recipe);
    else
        pel_write_text(writer, object, "recipe", recipe);
    pel_write_number(writer, object, "size", source->hypertexture.size, HYPERTEXTURE_SIZE);
    pel_write_name(writer, object, "type", generate_type_names, type, 0);
    pel_write_number(writer, object, "seed", source->hypertexture.seed, 0);
    pel_write_number(writer, object, "time", source->hypertexture.time, 0);
    pel_write_bool(writer, object, "live", source->hypertexture.live, false);
    pel_write_bool(writer, object, "wrap", source->hypertexture.wrap, false);
    if (source->object)
        pel_write_text(writer, object, "object", name_of(writer->scene, source->object));
}

void pel_scene_write_source(struct pel_scene_writer *writer, json_t *volume,
                            const struct pel_volume_source *source) {
    if (source->recipe) {
        write_hypertexture(writer, volume, source);
    } else if (!source->file) {
        write_generate(writer, volume, source);
    } else {
        const struct pel_load_options *load = &source->load;
        pel_write_path(writer, volume, "file", source->file);
        if (load->raw.dims[0] > 0)
            write_raw(writer, volume, load);
        pel_write_number(writer, volume, "time", load->time, 0);
        // The key alone says that channels are taken apart.
        pel_write_number(writer, volume, "channel", load->channel, load->split_channels ? -1 : 0);
        if (load->labels != PEL_LABELS_AUTO)
            pel_write_bool(writer, volume, "labels", load->labels == PEL_LABELS_YES,
                           load->labels != PEL_LABELS_YES);
    }
    if (source->spacing[0] > 0)
        pel_write_numbers(writer, volume, "spacing", 3, source->spacing);
}
