// transfer_file_vtk.c - ParaView's colour maps and Slicer's volume properties, which are VTK's
// transfer functions in JSON.
//
// They are full of keys that say nothing about colour, so unknown ones are passed over. Where they
// mix colours in another space than RGB, or bend opacities, points are added between, which makes
// the same curve piecewise linear.
#include "transfer/transfer_file_vtk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "base/error.h"
#include "base/memory.h"
#include "transfer/transfer.h"
#include "transfer/vtk_curve.h"

enum {
    added_points = 32, // a curved segment becomes this many straight ones
    node_limit = 2048
};

// A node of VTK's functions: value, red, green, blue; or value, opacity, midpoint, sharpness. All
// but the value are within 0..1.
typedef double node[4];

// Takes a flat list of numbers (ParaView) or a list of objects (Slicer), where the reader is.
// Returns memory to free(), or NULL.
static node *read_nodes(struct pel_transfer_reader *reader, const json_t *json, int *count) {
    static const char *const members[4] = {"x", "y", "midpoint", "sharpness"};
    static const double defaults[4] = {0, 0, 0.5, 0};
    bool flat = json_is_number(json_array_get(json, 0));
    size_t size = json_array_size(json), stride = flat ? 4 : 1;
    if (size < stride || size % stride != 0 || size / stride > node_limit) {
        pel_fail(PEL_ERROR_FORMAT, "expected a list of 1 to %d nodes", node_limit);
        return NULL;
    }
    *count = (int)(size / stride);
    node *nodes = pel_allocate((size_t)*count, sizeof *nodes);
    for (int i = 0; nodes && i < 4 * *count; i++) {
        int row = i / 4, column = i % 4;
        const json_t *object = json_array_get(json, (size_t)row);
        const json_t *colour = json_object_get(object, "color");
        const json_t *json_number = flat ? json_array_get(json, (size_t)i)
                                    : colour && column > 0
                                        ? json_array_get(colour, (size_t)column - 1)
                                        : json_object_get(object, members[column]);
        double *number = &nodes[row][column];
        *number = defaults[column];
        bool optional = !flat && !colour && column >= 2 && !json_number;
        bool good = optional || pel_transfer_read_number(json_number, number);
        if (good && column > 0 && !(*number >= 0 && *number <= 1))
            good = pel_fail(PEL_ERROR_FORMAT, "%g is outside 0..1", *number);
        if (good && column == 0 && row > 0 && *number < nodes[row - 1][0])
            good = pel_fail(PEL_ERROR_FORMAT, "value %g is less than %g before it", *number,
                            nodes[row - 1][0]);
        if (!good) {
            size_t length = strlen(reader->place);
            snprintf(reader->place + length, sizeof reader->place - length, ".%d", flat ? i : row);
            free(nodes);
            nodes = NULL;
        }
    }
    return nodes;
}

static void add_colour(struct pel_transfer *transfer, double value, const double rgb[3]) {
    struct pel_colour_point *point = &transfer->colours[transfer->colour_count++];
    point->value = value;
    memcpy(point->rgb, rgb, sizeof point->rgb);
}

static bool take_colours(struct pel_transfer_reader *reader, const json_t *json,
                         enum pel_vtk_space space) {
    int count;
    node *nodes = read_nodes(reader, json, &count);
    if (!nodes)
        return false;
    int parts = space == PEL_VTK_RGB || space == PEL_VTK_STEP ? 1 : added_points;
    struct pel_transfer *transfer = reader->transfer;
    free(transfer->colours);
    transfer->colour_count = 0;
    transfer->colours =
        pel_allocate((size_t)count * (size_t)(parts + 1), sizeof *transfer->colours);
    if (transfer->colours)
        add_colour(transfer, nodes[0][0], &nodes[0][1]);
    for (int i = 1; transfer->colours && i < count; i++) {
        const double *a = nodes[i - 1], *b = nodes[i];
        if (space == PEL_VTK_STEP)
            add_colour(transfer, a[0], &b[1]);
        for (int part = 1; part < parts; part++) {
            double rgb[3], share = (double)part / parts;
            pel_vtk_colour(rgb, space, &a[1], &b[1], share);
            add_colour(transfer, (1 - share) * a[0] + share * b[0], rgb);
        }
        add_colour(transfer, b[0], &b[1]);
    }
    free(nodes);
    return transfer->colours != NULL;
}

static void add_opacity(struct pel_transfer *transfer, double value, double opacity) {
    transfer->opacities[transfer->opacity_count++] = (struct pel_opacity_point){value, opacity};
}

static bool take_opacities(struct pel_transfer_reader *reader, const json_t *json) {
    int count;
    node *nodes = read_nodes(reader, json, &count);
    if (!nodes)
        return false;
    struct pel_transfer *transfer = reader->transfer;
    free(transfer->opacities);
    transfer->opacity_count = 0;
    transfer->opacities =
        pel_allocate((size_t)count * (added_points + 1), sizeof *transfer->opacities);
    if (transfer->opacities)
        add_opacity(transfer, nodes[0][0], nodes[0][1]);
    for (int i = 1; transfer->opacities && i < count; i++) {
        const double *a = nodes[i - 1], *b = nodes[i];
        double midpoint = a[2], sharpness = a[3];
        double middle = (1 - midpoint) * a[0] + midpoint * b[0];
        if (sharpness > 0.99) {
            add_opacity(transfer, middle, a[1]);
            add_opacity(transfer, middle, b[1]);
        } else if (sharpness >= 0.01) {
            for (int part = 1; part < added_points; part++) {
                double share = (double)part / added_points;
                add_opacity(transfer, (1 - share) * a[0] + share * b[0],
                            pel_vtk_opacity(a[1], b[1], midpoint, sharpness, share));
            }
        } else if (midpoint != 0.5) {
            add_opacity(transfer, middle, (a[1] + b[1]) / 2);
        }
        add_opacity(transfer, b[0], b[1]);
    }
    free(nodes);
    return transfer->opacities != NULL;
}

static bool read_space(const json_t *map, enum pel_vtk_space *space) {
    static const struct {
        const char *name;
        enum pel_vtk_space space;
    } spaces[] = {
        {"RGB", PEL_VTK_RGB},          {"HSV", PEL_VTK_HSV},
        {"Lab", PEL_VTK_LAB},          {"CIELAB", PEL_VTK_LAB},
        {"Step", PEL_VTK_STEP},        {"Diverging", PEL_VTK_DIVERGING},
        {"LabCIEDE2000", PEL_VTK_LAB}, {"Lab/CIEDE2000", PEL_VTK_LAB},
    };
    const char *name = json_string_value(json_object_get(map, "ColorSpace"));
    *space = PEL_VTK_RGB;
    for (size_t i = 0; name; i++) {
        if (i == sizeof spaces / sizeof *spaces)
            return pel_fail(PEL_ERROR_UNSUPPORTED, "unknown colour space '%.32s'", name);
        if (strcmp(name, spaces[i].name) == 0) {
            *space = spaces[i].space;
            break;
        }
    }
    if (name && strstr(name, "2000"))
        pel_warn("colour space %s is approximated by CIELAB", name);
    const json_t *wrap = json_object_get(map, "HSVWrap");
    if (*space == PEL_VTK_HSV && (json_is_true(wrap) || json_number_value(wrap) != 0))
        *space = PEL_VTK_HSV_WRAP;
    return true;
}

bool pel_transfer_read_paraview(struct pel_transfer_reader *reader, const json_t *map,
                                const char *prefix) {
    reader->transfer = pel_transfer_create(1, 2);
    if (!reader->transfer)
        return false;
    struct pel_transfer *transfer = reader->transfer;
    const json_t *colours = json_object_get(map, "RGBPoints");
    const json_t *opacities = json_object_get(map, "Points");
    if (!colours)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "the colour map has no RGBPoints");
    enum pel_vtk_space space;
    pel_transfer_reader_at(reader, "%sColorSpace", prefix);
    if (!read_space(map, &space))
        return false;
    pel_transfer_reader_at(reader, "%sRGBPoints", prefix);
    if (!take_colours(reader, colours, space))
        return false;

    double low = transfer->colours[0].value;
    double high = transfer->colours[transfer->colour_count - 1].value;
    pel_transfer_reader_at(reader, "%sPoints", prefix);
    if (opacities && !take_opacities(reader, opacities))
        return false;
    if (!opacities) {
        transfer->opacities[0] = (struct pel_opacity_point){low, 0};
        transfer->opacities[1] = (struct pel_opacity_point){high, 1};
    }
    if (low == 0 && high == 1) {
        transfer->scale = PEL_VALUES_RELATIVE;
        pel_warn("the colour map is for 0..1 and is stretched over the range of the volume");
    }
    const json_t *logarithmic = json_object_get(map, "UseLogScale");
    if (json_is_true(logarithmic) || json_number_value(logarithmic) != 0)
        pel_warn("the colour map's logarithmic scale is taken as linear");
    return true;
}

bool pel_transfer_read_slicer(struct pel_transfer_reader *reader, const json_t *root) {
    reader->transfer = pel_transfer_create(1, 1);
    if (!reader->transfer)
        return false;
    const json_t *property = json_array_get(json_object_get(root, "volumeProperties"), 0);
    const json_t *component = json_array_get(json_object_get(property, "components"), 0);
    const json_t *colours = json_object_get(component, "rgbTransferFunction");
    const json_t *opacities = json_object_get(component, "scalarOpacity");
    static const char place[] = "volumeProperties.0.components.0";
    pel_transfer_reader_at(reader, "%s.rgbTransferFunction.points", place);
    if (!take_colours(reader, json_object_get(colours, "points"), PEL_VTK_RGB))
        return false;
    pel_transfer_reader_at(reader, "%s.scalarOpacity.points", place);
    if (!take_opacities(reader, json_object_get(opacities, "points")))
        return false;
    const json_t *unit = json_object_get(component, "scalarOpacityUnitDistance");
    pel_transfer_reader_at(reader, "%s.scalarOpacityUnitDistance", place);
    return !unit || pel_transfer_read_number(unit, &reader->transfer->opacity_unit_mm);
}
