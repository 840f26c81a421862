// layout.c - where each volume of a scene goes in a device's memory.
#include "world/layout.h"

#include <inttypes.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "shared/grid.h"
#include "volume/volume.h"
#include "world/brick.h"
#include "world/model.h"
#include "world/style.h"

// Buffers are addressed with 31 bits per lane, whatever the device would allow.
static const uint64_t buffer_limit = (uint64_t)1 << 31;

// Slabs start at multiples of this, so that wide loads are aligned.
static const uint64_t slab_alignment = 256;

// Slices of its neighbour that a slab repeats: the gradient at a place less than one voxel beyond
// its own needs a place one voxel further, and a cubic filter the voxel behind the next there.
enum { CUT_BORDER = 3 };

_Static_assert(PEL_DIMENSION_MAX + 2 <= BRICK_ALONG_MAX, "no volume is too wide for bricks");

int pel_voxel_class(enum pel_voxel_type type) {
    switch (type) {
    case PEL_VOXEL_U8:
    case PEL_VOXEL_I8:
        return 0;
    case PEL_VOXEL_U16:
    case PEL_VOXEL_I16:
        return 1;
    case PEL_VOXEL_F32:
        return 2;
    case PEL_VOXEL_RGB8:
    case PEL_VOXEL_RGBA8:
        break;
    }
    return 3;
}

size_t pel_voxel_class_bytes(int class_index) {
    return (size_t[VOXEL_CLASS_COUNT]){1, 2, 4, 4}[class_index];
}

void pel_slab_dims(const struct pel_slab *slab, const struct pel_volume *volume, size_t dims[3]) {
    dims[0] = (size_t)volume->dims[0] + 2;
    dims[1] = (size_t)volume->dims[1] + 2;
    dims[2] = (size_t)slab->border[0] + (size_t)slab->count + (size_t)slab->border[1];
}

double pel_reader_factor(enum pel_reader reader, int class_index) {
    if (reader != PEL_READER_IMAGE)
        return 1;
    return (double[VOXEL_CLASS_COUNT]){255, 65535, 1, 255}[class_index];
}

// One layer of a volume's bricks.
static uint64_t layer_bytes(const struct pel_volume *volume, int border) {
    return (uint64_t)pel_brick_count((size_t)volume->dims[0] + 2) *
           pel_brick_count((size_t)volume->dims[1] + 2) * BRICK_VOXELS_OF(border) *
           pel_brick_element_bytes(pel_voxel_class_bytes(pel_voxel_class(volume->type)));
}

// All stored bytes of the scene, borders included but not those between slabs.
static uint64_t scene_bytes(const struct pel_scene *scene) {
    uint64_t bytes = 0;
    for (int v = 0; v < scene->volume_count; v++)
        bytes += layer_bytes(scene->volumes[v], 0) *
                 pel_brick_count((size_t)scene->volumes[v]->dims[2] + 2);
    return bytes;
}

static struct pel_slab *add_slab(struct pel_layout *layout, const struct pel_scene *scene, int v,
                                 int first, int count) {
    if (layout->slab_count == WORLD_PART_MAX) {
        pel_fail(PEL_ERROR_DEVICE, "the volumes would have to be cut into more than %d slabs",
                 WORLD_PART_MAX);
        return NULL;
    }
    struct pel_slab *slab = &layout->slabs[layout->slab_count++];
    // Layouts are compared byte by byte, so padding is cleared as well.
    memset(slab, 0, sizeof *slab);
    // A recipe may change without anything here changing.
    slab->serial = scene->volumes[v]->hypertexture ? 0 : scene->volumes[v]->serial;
    slab->volume = v;
    slab->class_index = pel_voxel_class(scene->volumes[v]->type);
    slab->first = first;
    slab->count = count;
    slab->border[0] = first > 0 ? CUT_BORDER : 1;
    slab->border[1] = first + count < scene->volumes[v]->dims[2] ? CUT_BORDER : 1;
    slab->ranges = (u32)layout->range_count;
    size_t dims[3], cells = 1;
    pel_slab_dims(slab, scene->volumes[v], dims);
    for (int i = 0; i < 3; i++)
        cells *= pel_grid_cells(dims[i], (size_t)layout->cell_side);
    layout->range_count += cells;
    return slab;
}

// First fit: the slab goes into the first buffer that still has room.
static bool place_slab(struct pel_layout *layout, struct pel_slab *slab, uint64_t bytes,
                       uint64_t limit) {
    for (int b = 0; b < VOXEL_BUFFERS; b++) {
        uint64_t start =
            (layout->buffer_bytes[b] + slab_alignment - 1) / slab_alignment * slab_alignment;
        if (start + bytes <= limit) {
            slab->buffer = b;
            slab->offset_bytes = start;
            layout->buffer_bytes[b] = start + bytes;
            return true;
        }
    }
    return false;
}

static bool plan_buffers(struct pel_layout *layout, const struct pel_scene *scene,
                         const struct pel_layout_limits *limits) {
    layout->reader = PEL_READER_BUFFER;
    uint64_t limit =
        limits->max_allocation_bytes < buffer_limit ? limits->max_allocation_bytes : buffer_limit;
    for (int v = 0; v < scene->volume_count; v++) {
        const struct pel_volume *volume = scene->volumes[v];
        if (volume->hypertexture) {
            if (!add_slab(layout, scene, v, 0, volume->dims[2]))
                return false;
            continue;
        }
        uint64_t layer = layer_bytes(volume, layout->border);
        // Slices that fit into one buffer, border included.
        uint64_t most = limit / layer * BRICK_SIDE;
        if (most > BRICK_SLICES_MAX)
            most = BRICK_SLICES_MAX;
        bool whole = most >= (uint64_t)volume->dims[2] + 2;
        if (!whole && most == 0)
            return pel_fail(PEL_ERROR_DEVICE,
                            "volume '%s': a layer of %d slices needs %" PRIu64
                            " bytes, the device's largest allocation is %" PRIu64,
                            volume->name, BRICK_SIDE, layer, limit);
        int slices = whole ? volume->dims[2] : (int)(most - 2 * CUT_BORDER);
        for (int first = 0; first < volume->dims[2]; first += slices) {
            int count = volume->dims[2] - first < slices ? volume->dims[2] - first : slices;
            struct pel_slab *slab = add_slab(layout, scene, v, first, count);
            if (!slab)
                return false;
            size_t stored = (size_t)(slab->border[0] + count + slab->border[1]);
            if (!place_slab(layout, slab, layer * pel_brick_count(stored), limit))
                return pel_fail(
                    PEL_ERROR_DEVICE,
                    "the volumes need %" PRIu64 " bytes, the device takes %d buffers of %" PRIu64
                    " bytes; a smaller copy (pellucid convert --downsample 2) would fit",
                    scene_bytes(scene), VOXEL_BUFFERS, limit);
        }
    }
    uint64_t total = 0;
    for (int b = 0; b < VOXEL_BUFFERS; b++)
        total += layout->buffer_bytes[b];
    if (total > limits->memory_bytes)
        return pel_fail(PEL_ERROR_DEVICE,
                        "the volumes need %" PRIu64 " bytes, the device has %" PRIu64
                        "; a smaller copy (pellucid convert --downsample 2) would fit",
                        total, limits->memory_bytes);
    return true;
}

// Stacks the volumes of one class along `axis` and returns the atlas's size in texels, 0 if none
// occur.
static uint64_t stack_atlas(const struct pel_scene *scene, int class_index, int axis,
                            size_t dims[3]) {
    memset(dims, 0, 3 * sizeof *dims);
    for (int v = 0; v < scene->volume_count; v++) {
        const struct pel_volume *volume = scene->volumes[v];
        if (pel_voxel_class(volume->type) != class_index)
            continue;
        for (int i = 0; i < 3; i++) {
            size_t extent = (size_t)volume->dims[i] + 2;
            dims[i] = i == axis ? dims[i] + extent : extent > dims[i] ? extent : dims[i];
        }
    }
    return (uint64_t)dims[0] * dims[1] * dims[2];
}

// Chooses the axis along which the class's volumes waste least; -1 when the stack fits along none.
static int choose_axis(const struct pel_scene *scene, int class_index,
                       const struct pel_layout_limits *limits, size_t dims[3]) {
    int best = -1;
    uint64_t best_texels = UINT64_MAX;
    for (int axis = 2; axis >= 0; axis--) {
        size_t stacked[3];
        uint64_t texels = stack_atlas(scene, class_index, axis, stacked);
        bool fits = texels * pel_voxel_class_bytes(class_index) <= limits->max_allocation_bytes;
        for (int i = 0; i < 3; i++)
            fits = fits && stacked[i] <= limits->max_image[i];
        if (fits && texels < best_texels) {
            best = axis;
            best_texels = texels;
            memcpy(dims, stacked, sizeof stacked);
        }
    }
    return best;
}

static bool plan_images(struct pel_layout *layout, const struct pel_scene *scene,
                        const struct pel_layout_limits *limits) {
    layout->reader = PEL_READER_IMAGE;
    if (!limits->images)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "the device has no 3-D images; use --reader buffer");
    int axes[VOXEL_CLASS_COUNT];
    uint64_t total = 0;
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++) {
        size_t dims[3];
        uint64_t texels = stack_atlas(scene, class, 2, dims);
        if (texels > 0 && !limits->texels[class])
            return pel_fail(PEL_ERROR_UNSUPPORTED,
                            "the device has no 3-D images of this voxel type; use --reader buffer");
        axes[class] = choose_axis(scene, class, limits, layout->atlas[class]);
        if (axes[class] < 0)
            return pel_fail(PEL_ERROR_DEVICE,
                            "the volumes need an image of %zu x %zu x %zu texels, %" PRIu64
                            " bytes; the device takes %zu x %zu x %zu, %" PRIu64
                            " bytes; --reader buffer may fit",
                            dims[0], dims[1], dims[2], texels * pel_voxel_class_bytes(class),
                            limits->max_image[0], limits->max_image[1], limits->max_image[2],
                            limits->max_allocation_bytes);
        total += (uint64_t)layout->atlas[class][0] * layout->atlas[class][1] *
                 layout->atlas[class][2] * pel_voxel_class_bytes(class);
    }
    if (total > limits->memory_bytes)
        return pel_fail(PEL_ERROR_DEVICE,
                        "the volumes need %" PRIu64 " bytes, the device has %" PRIu64, total,
                        limits->memory_bytes);

    size_t next[VOXEL_CLASS_COUNT] = {0};
    for (int v = 0; v < scene->volume_count; v++) {
        struct pel_slab *slab = add_slab(layout, scene, v, 0, scene->volumes[v]->dims[2]);
        if (!slab)
            return false;
        int class = slab->class_index, axis = axes[class];
        slab->origin[axis] = next[class];
        next[class] += (size_t)scene->volumes[v]->dims[axis] + 2;
    }
    return true;
}

// Whether something is worked out at every sample.
static bool has_live(const struct pel_scene *scene) {
    for (int v = 0; v < scene->volume_count; v++)
        if (scene->volumes[v]->hypertexture)
            return true;
    return false;
}

// Whether gradients are found that a border of the bricks makes cheaper: kernels/gradient_brick.cl.
// Hidden instances count, so that voxels need not travel again when they are shown.
static bool border_pays(const struct pel_scene *scene) {
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        const struct pel_volume *volume = scene->volumes[instance->volume];
        bool words =
            !volume->hypertexture && pel_voxel_class_bytes(pel_voxel_class(volume->type)) <= 2;
        if (pel_style_needs_gradients(instance) && words && instance->filter == PEL_FILTER_LINEAR &&
            instance->gradient == PEL_GRADIENT_CENTRAL)
            return true;
    }
    return false;
}

// Plans the buffers again with a border, which makes voxels take 1.4 times the room: unless nothing
// is gained, more than half of the memory would be taken, or volumes be cut into more slabs.
static void widen(struct pel_layout *layout, const struct pel_scene *scene,
                  const struct pel_layout_limits *limits) {
    struct pel_layout wider;
    memset(&wider, 0, sizeof wider); // layouts are compared byte by byte
    wider.cell_side = layout->cell_side;
    wider.border = 1;
    if (!border_pays(scene) || !plan_buffers(&wider, scene, limits))
        return;
    uint64_t bytes = 0;
    for (int b = 0; b < VOXEL_BUFFERS; b++)
        bytes += wider.buffer_bytes[b];
    if (bytes <= limits->memory_bytes / 2 && wider.slab_count <= layout->slab_count)
        memcpy(layout, &wider, sizeof wider);
}

// How far from a sample that can be seen voxels are read: gradients and cubic filters look around.
static int pool_margin(const struct pel_scene *scene) {
    int margin = 0;
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        int reach =
            instance->filter == PEL_FILTER_LINEAR || instance->filter == PEL_FILTER_NEAREST ? 0 : 2;
        if (pel_style_needs_gradients(instance))
            reach += 2;
        margin = reach > margin ? reach : margin;
    }
    return margin;
}

// Volumes whole, with a page for each brick. How many bricks there are to be depends on what can be
// seen, so that is found out when they are sent.
static bool plan_pool(struct pel_layout *layout, const struct pel_scene *scene) {
    memset(layout, 0, sizeof *layout);
    layout->reader = PEL_READER_BUFFER;
    layout->pool = true;
    layout->cell_side = BRICK_SIDE;
    layout->margin = pool_margin(scene);
    for (int v = 0; v < scene->volume_count; v++) {
        struct pel_slab *slab = add_slab(layout, scene, v, 0, scene->volumes[v]->dims[2]);
        if (!slab)
            return false;
        slab->buffer = slab->class_index;
        if (layout->range_count > INT32_MAX)
            return pel_fail(PEL_ERROR_DEVICE, "the volumes have more than %d bricks", INT32_MAX);
    }
    return true;
}

// Whether nothing is read where nothing can be seen: a surface between two samples, for one, is
// found from values on both sides.
static bool pool_serves(const struct pel_scene *scene) {
    if (has_live(scene))
        return false;
    for (int k = 0; k < scene->instance_count; k++) {
        enum pel_model model = pel_model_of(scene, &scene->instances[k]);
        if (!scene->instances[k].hidden && model != PEL_MODEL_ABSORPTION &&
            model != PEL_MODEL_THESIS)
            return false;
    }
    return true;
}

static bool plan_bricks(struct pel_layout *layout, const struct pel_scene *scene,
                        const struct pel_layout_limits *limits) {
    memset(layout, 0, sizeof *layout);
    layout->cell_side = CELL_VOXELS;
    if (!plan_buffers(layout, scene, limits))
        return false;
    widen(layout, scene, limits);
    return true;
}

static bool plan_reader(struct pel_layout *layout, const struct pel_scene *scene,
                        const struct pel_layout_limits *limits, enum pel_reader reader,
                        enum pel_reader preferred) {
    // Images are for voxels; a kernel that works out recipes has none.
    if (has_live(scene))
        reader = PEL_READER_BUFFER;
    enum pel_reader first = reader == PEL_READER_AUTO ? preferred : reader;
    if (first != PEL_READER_IMAGE)
        return plan_bricks(layout, scene, limits);
    memset(layout, 0, sizeof *layout);
    layout->cell_side = CELL_VOXELS;
    if (plan_images(layout, scene, limits))
        return true;
    if (reader != PEL_READER_AUTO)
        return false;
    pel_warn("%s; reading from buffers instead", pel_error_message());
    return plan_bricks(layout, scene, limits);
}

bool pel_layout_plan(struct pel_layout *layout, const struct pel_scene *scene,
                     const struct pel_layout_limits *limits, enum pel_reader reader,
                     enum pel_reader preferred) {
    enum pel_pool_use use = scene->render.bricks.pool;
    bool serves = reader != PEL_READER_IMAGE && pool_serves(scene);
    if (use == PEL_POOL_ON && !serves)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        reader == PEL_READER_IMAGE
                            ? "a pool of bricks cannot be read as images; use --reader buffer"
                            : "a pool of bricks serves the optical models absorption and thesis "
                              "only");
    if (use == PEL_POOL_ON)
        return plan_pool(layout, scene);
    return plan_reader(layout, scene, limits, reader, preferred) ||
           (use == PEL_POOL_AUTO && serves && pel_error_code() == PEL_ERROR_DEVICE &&
            plan_pool(layout, scene));
}
