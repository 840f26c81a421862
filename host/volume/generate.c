// generate.c - synthetic volumes by name.
//
// Every kind is a field of a natural size, centred at the world's origin. Another spacing scales
// the object with its grid, except for the heads: those keep their size, so that the transform
// between the two stays true, and a smaller spacing shows a smaller part.
//
// Values are stored as they are in F32, and in integers through slope and intercept, so that
// slope * raw + intercept is always the field's value. U8 and U16 span what the field can reach;
// where values are whole numbers as scanners store them, U16 has slope 1.
#include "volume/generate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "base/text.h"
#include "volume/volume.h"

enum { SIZE_DEFAULT = 64 };

// The largest distance to the surface within the sphere's box: at its corners, outside.
#define SPHERE_LOW_MM (PEL_SPHERE_RADIUS_MM - 32 * 1.7320508075688772)

static const struct kind {
    const char *name, *unit, *space;
    double extent_mm[3]; // of the box, outer cell face to outer cell face, at natural size
    double stretch;      // spacing along k over that along i and j
    double low, high;    // values that integers must reach
    bool whole;          // U16 stores whole numbers
    bool fixed_size;     // does not scale with the spacing
    bool is_length;      // values are lengths, and scale as the object does
    bool labels;         // whole numbers that every type stores as they are
    void (*fill)(const struct pel_generate_row *row, float *values);
} kinds[] = {
    {.name = "sphere",
     .unit = "mm",
     .space = "distance to a sphere, 3/8 of the box in radius",
     .extent_mm = {64, 64, 64},
     .stretch = 1,
     .low = SPHERE_LOW_MM,
     .high = PEL_SPHERE_RADIUS_MM,
     .is_length = true,
     .fill = pel_generate_sphere},
    {.name = "box",
     .space = "box of 40 x 28 x 20 sixty-fourths",
     .extent_mm = {64, 64, 64},
     .stretch = 1,
     .high = 1,
     .fill = pel_generate_box},
    {.name = "shells",
     .space = "five concentric shells",
     .extent_mm = {64, 64, 64},
     .stretch = 1,
     .high = 1,
     .fill = pel_generate_shells},
    {.name = "c60",
     .unit = "e/A^3",
     .space = "molecule, 10 mm = 1 Angstrom",
     .extent_mm = {112, 112, 112},
     .stretch = 1,
     .high = 3.25,
     .fill = pel_generate_c60},
    {.name = "hydrogen",
     .unit = "1/a0^3",
     .space = "orbital 3d_z2, 2 mm = 1 Bohr radius",
     .extent_mm = {96, 96, 96},
     .stretch = 1,
     .high = 7.7e-4,
     .fill = pel_generate_hydrogen},
    {.name = "marschner-lobb",
     .space = "[-1,1]^3, 32 mm = 1",
     .extent_mm = {64, 64, 64},
     .stretch = 1,
     .high = 1,
     .fill = pel_generate_marschner_lobb},
    {.name = "shepp-logan",
     .space = "[-1,1]^3, 100 mm = 1",
     .extent_mm = {200, 200, 200},
     .stretch = 1,
     .high = 1,
     .fill = pel_generate_shepp_logan},
    {.name = "head-ct",
     .unit = "HU",
     .space = "head",
     .extent_mm = {208, 240, 240},
     .stretch = 1,
     .low = -1024,
     .high = 3056,
     .whole = true,
     .fixed_size = true,
     .fill = pel_generate_head_ct},
    {.name = "head-mri",
     .space = "off the CT: rotate 12.3 deg about 3,-2,4; move 7,-5,9 mm",
     .extent_mm = {224, 272, 272},
     .stretch = 1.25,
     .high = 1020,
     .whole = true,
     .fixed_size = true,
     .fill = pel_generate_head_mri},
    {.name = "head-labels",
     .space = "head",
     .extent_mm = {208, 240, 240},
     .stretch = 1,
     .high = 10,
     .fixed_size = true,
     .labels = true,
     .fill = pel_generate_head_labels},
};

enum { KIND_COUNT = sizeof kinds / sizeof *kinds };

const char *const *pel_generator_names(void) {
    static const char *const names[] = {
        "sphere",      "box",     "shells",   "c60",         "hydrogen",  "marschner-lobb",
        "shepp-logan", "head-ct", "head-mri", "head-labels", "head-pair", NULL};
    return names;
}

// "head-pair" is its two members under one name.
static const struct kind *find_kind(const char *name, bool second) {
    bool pair = strcmp(name, "head-pair") == 0;
    if (second && !pair) {
        pel_fail(PEL_ERROR_ARGUMENT, "generator '%s' makes no second volume", name);
        return NULL;
    }
    if (pair)
        name = second ? "head-mri" : "head-ct";
    for (int i = 0; i < KIND_COUNT; i++)
        if (strcmp(name, kinds[i].name) == 0)
            return &kinds[i];
    const char *const *names = pel_generator_names(), *nearest = pel_text_nearest(name, names);
    char list[256];
    pel_text_list(list, sizeof list, names, pel_text_count(names), " and ");
    if (nearest)
        pel_fail(PEL_ERROR_ARGUMENT, "no generator '%.64s'; did you mean '%s'", name, nearest);
    else
        pel_fail(PEL_ERROR_ARGUMENT, "no generator '%.64s'; there are %s", name, list);
    return NULL;
}

static bool check_options(const struct pel_generate_options *options) {
    if (options->size < 0 || options->size > PEL_DIMENSION_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "size %d is outside 1..%d", options->size,
                        PEL_DIMENSION_MAX);
    if (!(options->spacing_mm >= 0) || isinf(options->spacing_mm))
        return pel_fail(PEL_ERROR_ARGUMENT, "spacing %g mm is not a positive number",
                        options->spacing_mm);
    if (options->type != PEL_VOXEL_U8 && options->type != PEL_VOXEL_U16 &&
        options->type != PEL_VOXEL_F32)
        return pel_fail(PEL_ERROR_ARGUMENT, "generators make uint8, uint16 or float32 only");
    return true;
}

// Stores one row in the volume's type. `scale` turns the field's values into the volume's.
static void store_row(struct pel_volume *volume, size_t first, const float *values, double scale) {
    if (volume->type == PEL_VOXEL_F32) {
        float *out = (float *)volume->voxels + first;
        for (int i = 0; i < volume->dims[0]; i++)
            out[i] = (float)(scale * values[i]);
        return;
    }
    double most = volume->type == PEL_VOXEL_U8 ? 255 : 65535;
    double raw_per_value = scale / volume->slope, zero = -volume->intercept / volume->slope;
    for (int i = 0; i < volume->dims[0]; i++) {
        double raw = floor(values[i] * raw_per_value + zero + 0.5);
        raw = raw < 0 ? 0 : raw > most ? most : raw;
        if (volume->type == PEL_VOXEL_U8)
            ((uint8_t *)volume->voxels)[first + (size_t)i] = (uint8_t)raw;
        else
            ((uint16_t *)volume->voxels)[first + (size_t)i] = (uint16_t)raw;
    }
}

// Evaluates the kind on a grid of the given spacing around the origin.
static bool fill(struct pel_volume *volume, const struct kind *kind, const double spacing_mm[3],
                 double scale) {
    float *values = pel_allocate((size_t)volume->dims[0], sizeof *values);
    if (!values)
        return false;
    double low[3];
    for (int axis = 0; axis < 3; axis++)
        low[axis] = -0.5 * (volume->dims[axis] - 1) * spacing_mm[axis];
    size_t first = 0;
    for (int k = 0; k < volume->dims[2]; k++) {
        for (int j = 0; j < volume->dims[1]; j++) {
            struct pel_generate_row row = {
                .start = {low[0], low[1] + j * spacing_mm[1], low[2] + k * spacing_mm[2]},
                .spacing = {spacing_mm[0], spacing_mm[1], spacing_mm[2]},
                .count = volume->dims[0],
            };
            kind->fill(&row, values);
            store_row(volume, first, values, scale);
            first += (size_t)volume->dims[0];
        }
    }
    free(values);
    return true;
}

struct pel_volume *pel_volume_generate(const char *kind_name,
                                       const struct pel_generate_options *options) {
    static const struct pel_generate_options defaults;
    if (!options)
        options = &defaults;
    const struct kind *kind = find_kind(kind_name, options->second);
    if (!kind || !check_options(options))
        return NULL;

    // The field is sampled in its own millimetres, `own`; the world may have others.
    double longest = fmax(fmax(kind->extent_mm[0], kind->extent_mm[1]), kind->extent_mm[2]);
    int size = options->size ? options->size : SIZE_DEFAULT;
    double natural = longest / size,
           world = options->spacing_mm > 0 ? options->spacing_mm : natural;
    double own[3];
    int dims[3];
    for (int axis = 0; axis < 3; axis++) {
        double stretch = axis == 2 ? kind->stretch : 1;
        own[axis] = stretch * (kind->fixed_size ? world : natural);
        dims[axis] = (int)fmax(floor(kind->extent_mm[axis] / (natural * stretch) + 0.5), 1);
    }
    double growth = kind->fixed_size ? 1 : world / natural, scale = kind->is_length ? growth : 1;

    struct pel_volume *volume = pel_volume_create(kind->name, dims, options->type);
    if (!volume)
        return NULL;
    for (int axis = 0; axis < 3; axis++) {
        volume->world_from_voxel.m[axis][axis] = own[axis] * growth;
        volume->world_from_voxel.m[axis][3] = -0.5 * (dims[axis] - 1) * own[axis] * growth;
    }
    if (options->type != PEL_VOXEL_F32) {
        bool byte = options->type == PEL_VOXEL_U8;
        volume->slope = kind->labels || (!byte && kind->whole)
                            ? 1
                            : scale * (kind->high - kind->low) / (byte ? 255 : 65535);
        volume->intercept = scale * kind->low;
    }
    volume->labels = kind->labels;
    snprintf(volume->unit, sizeof volume->unit, "%s", kind->unit ? kind->unit : "");
    snprintf(volume->space, sizeof volume->space, "%s", kind->space);
    if (!fill(volume, kind, own, scale)) {
        pel_volume_destroy(volume);
        return NULL;
    }
    return volume;
}
