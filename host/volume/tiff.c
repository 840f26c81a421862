// tiff.c - reads TIFF stacks: one file of many pages, or many files of one.
//
// Placement: x grows to the right of the picture and y downwards, voxel (0,0,0) at the world's
// origin. As in ITK, and so in 3D Slicer, these are the axes of LPS, so that in RAS
//
//     world_from_voxel = diag(-spacing_x, -spacing_y, spacing_z).
//
// Sizes are believed as far as the file could hold them: the decompressed bytes of all pages that
// are read must not exceed the file's size times the most its compression can expand.
#include "volume/tiff.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/volume.h"

// A stack being read. Voxels go straight into the volume, or into `wide` where no volume has their
// type.
struct stack {
    const char *name;
    bool split;                  // samples are channels, not a colour
    bool indices;                // palettes are a way to look at the data, not the data
    struct pel_tiff_shape shape; // of all pages
    struct pel_tiff_page page;   // the first one
    struct pel_tiff_stack meta;  // of the first file
    int dims[3];
    size_t plane_bytes;
    bool warned; // of libtiff's first warning
    struct pel_volume *volume;
    void *wide;
};

// ---- What is lost ------------------------------------------------------------------------------

// The name of a colour space whose translation to RGB loses something; NULL for the others.
static const char *lossy_colours(uint16_t photometric) {
    switch (photometric) {
    case PHOTOMETRIC_SEPARATED:
        return "CMYK";
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
        return "L*a*b*";
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
        return "logarithmic";
    default:
        return NULL;
    }
}

static void warn_about(const struct stack *stack) {
    const struct pel_tiff_page *page = &stack->page;
    const struct pel_tiff_shape *shape = &stack->shape;
    const char *lossy = lossy_colours(page->photometric);
    if (lossy && (shape->rendered || shape->cmyk))
        pel_warn("%s: %s colours became 8-bit RGB", stack->name, lossy);
    else if (shape->components > 1 && page->bits != 8 && page->palette == PEL_PALETTE_NONE)
        pel_warn("%s: colours of %d bits became 8-bit ones; taking single channels keeps them",
                 stack->name, page->bits);
    if (shape->components == 3 && page->photometric == PHOTOMETRIC_RGB && page->samples == 4)
        pel_warn("%s: the fourth sample is no alpha and is left out", stack->name);
    if (shape->components == 1 && page->samples == 2 &&
        (page->alpha == EXTRASAMPLE_ASSOCALPHA || page->alpha == EXTRASAMPLE_UNASSALPHA))
        pel_warn("%s: the alpha of a grey picture is left out", stack->name);
    if (page->photometric == PHOTOMETRIC_MINISWHITE && page->format == SAMPLEFORMAT_IEEEFP)
        pel_warn("%s: 0 is white in these floating-point values; they are kept as they are",
                 stack->name);
}

// ---- Sizes -------------------------------------------------------------------------------------

// Fails when `bytes` are more than files of `file_bytes` in all can hold.
static bool check_justified(uint64_t bytes, uint64_t file_bytes, uint16_t compression) {
    uint64_t most;
    if (__builtin_mul_overflow(file_bytes, pel_tiff_expansion(compression), &most))
        most = UINT64_MAX;
    if (bytes > most)
        return pel_fail(PEL_ERROR_FORMAT, "the pages need %llu bytes, %llu bytes of file hold %llu",
                        (unsigned long long)bytes, (unsigned long long)file_bytes,
                        (unsigned long long)most);
    return true;
}

static enum pel_voxel_type voxel_type_of(const struct pel_tiff_shape *shape) {
    if (shape->components > 1)
        return shape->components == 3 ? PEL_VOXEL_RGB8 : PEL_VOXEL_RGBA8;
    // The wide types are checked as the float they may become.
    return shape->element <= PEL_ELEMENT_F32 ? (enum pel_voxel_type)shape->element : PEL_VOXEL_F32;
}

// Makes room for `depth` planes.
static bool allocate(struct stack *stack, int depth) {
    const struct pel_tiff_shape *shape = &stack->shape;
    size_t bytes;
    if (!pel_volume_check_size((int64_t[]){shape->width, shape->height, depth},
                               voxel_type_of(shape), SIZE_MAX, &bytes))
        return false;
    stack->dims[0] = (int)shape->width;
    stack->dims[1] = (int)shape->height;
    stack->dims[2] = depth;
    stack->plane_bytes = (size_t)shape->width * shape->height * (size_t)shape->components *
                         pel_element_bytes(shape->element);
    if (shape->element <= PEL_ELEMENT_F32) {
        stack->volume = pel_volume_create(stack->name, stack->dims, voxel_type_of(shape));
        return stack->volume;
    }
    if (!pel_size_multiply(&bytes, 2, (size_t[]){stack->plane_bytes, (size_t)depth}))
        return false;
    stack->wide = pel_allocate_voxels(bytes);
    return stack->wide;
}

static void *plane_at(const struct stack *stack, int z) {
    char *first = stack->wide ? stack->wide : stack->volume->voxels;
    return first + (size_t)z * stack->plane_bytes;
}

// ---- One file ----------------------------------------------------------------------------------

// Reads the shape of the first page and the metadata.
static bool begin(struct stack *stack, const struct pel_tiff_file *file, bool alone,
                  const struct pel_load_options *options) {
    int channel_count;
    stack->page = file->pages[0];
    stack->split = options->split_channels || pel_tiff_is_composite(file);
    stack->indices = pel_tiff_is_imagej(file);
    if (!pel_tiff_shape_of(&stack->shape, &channel_count, &stack->page, stack->split,
                           stack->indices))
        return pel_fail_in("page 0");
    if (!pel_tiff_stack_init(&stack->meta, file, stack->name, channel_count, alone, options))
        return false;
    stack->shape.first_sample = stack->meta.sample;
    warn_about(stack);
    return true;
}

// Reads one page into plane z, if it is like the first.
static bool read_plane(struct stack *stack, struct pel_tiff_file *file, int page_index, int z) {
    const struct pel_tiff_page *page = &file->pages[page_index];
    struct pel_tiff_shape shape;
    int channel_count;
    if (!pel_tiff_shape_of(&shape, &channel_count, page, stack->split, stack->indices))
        return pel_fail_in("page %d", page_index);
    const struct pel_tiff_shape *first = &stack->shape;
    shape.first_sample = first->first_sample;
    if (shape.width != first->width || shape.height != first->height)
        return pel_fail(PEL_ERROR_FORMAT, "page %d: %u x %u pixels, the first page has %u x %u",
                        page_index, shape.width, shape.height, first->width, first->height);
    if (shape.element != first->element || shape.components != first->components ||
        page->samples <= shape.first_sample)
        return pel_fail(PEL_ERROR_FORMAT,
                        "page %d: %d samples of %d bits, not of the first page's type (%d of %d)",
                        page_index, page->samples, page->bits, stack->page.samples,
                        stack->page.bits);
    if (!pel_tiff_read_page(file, page, &shape, plane_at(stack, z)))
        return pel_fail_in("page %d", page_index);
    if (file->reports.warning[0] && !stack->warned)
        pel_warn("%s: plane %d: libtiff warns: %s", stack->name, z, file->reports.warning);
    stack->warned = stack->warned || file->reports.warning[0];
    return true;
}

static bool read_pages(struct stack *stack, struct pel_tiff_file *file) {
    uint64_t decoded = 0;
    for (int z = 0; z < stack->meta.plane_count; z++) {
        const struct pel_tiff_page *page = &file->pages[stack->meta.planes[z]];
        if (__builtin_add_overflow(decoded, page->decoded_bytes, &decoded))
            decoded = UINT64_MAX;
    }
    if (!check_justified(decoded, file->bytes, stack->page.compression) ||
        !allocate(stack, stack->meta.plane_count))
        return false;
    for (int z = 0; z < stack->meta.plane_count; z++)
        if (!read_plane(stack, file, stack->meta.planes[z], z))
            return false;
    return true;
}

// The planes of ImageJ's large stacks follow the first, raw, in the byte order of the file.
static bool read_following(struct stack *stack, struct pel_tiff_file *file, const char *path) {
    const struct pel_tiff_page *page = &stack->page;
    const struct pel_tiff_shape *shape = &stack->shape;
    size_t voxel_bytes = (size_t)shape->components * pel_element_bytes(shape->element);
    if (page->photometric == PHOTOMETRIC_MINISWHITE || page->bits % 8 ||
        page->orientation != ORIENTATION_TOPLEFT ||
        voxel_bytes * 8 != (size_t)page->bits * page->samples)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "a raw stack of %d samples of %d bits, photometric interpretation %d",
                        page->samples, page->bits, page->photometric);
    uint64_t start = TIFFGetStrileOffset(file->handle, 0);
    uint64_t last = 0, end;
    for (int z = 0; z < stack->meta.plane_count; z++)
        last = (uint64_t)stack->meta.planes[z] > last ? (uint64_t)stack->meta.planes[z] : last;
    uint64_t plane = (uint64_t)shape->width * shape->height * voxel_bytes;
    if (__builtin_mul_overflow(plane, last + 1, &end) || __builtin_add_overflow(end, start, &end) ||
        end > file->bytes)
        return pel_fail(PEL_ERROR_FORMAT, "%llu planes of %llu bytes are more than the file has",
                        (unsigned long long)last + 1, (unsigned long long)plane);
    if (!allocate(stack, stack->meta.plane_count))
        return false;
    FILE *stream = fopen(path, "rb");
    bool done = stream;
    for (int z = 0; done && z < stack->meta.plane_count; z++)
        done = fseeko(stream, (off_t)(start + plane * (uint64_t)stack->meta.planes[z]), SEEK_SET) ==
                   0 &&
               fread(plane_at(stack, z), 1, (size_t)plane, stream) == plane;
    if (stream)
        fclose(stream);
    if (!done)
        return pel_fail(PEL_ERROR_FILE, "cannot read its raw planes");
    size_t count =
        (size_t)plane * (size_t)stack->meta.plane_count / pel_element_bytes(shape->element);
    if (TIFFIsByteSwapped(file->handle))
        pel_swap_bytes(plane_at(stack, 0), count, pel_element_bytes(shape->element));
    return true;
}

static bool read_file(struct stack *stack, const char *path,
                      const struct pel_load_options *options) {
    struct pel_tiff_file file;
    if (!pel_tiff_open(&file, path))
        return false;
    bool done =
        begin(stack, &file, true, options) &&
        (stack->meta.follow ? read_following(stack, &file, path) : read_pages(stack, &file));
    pel_tiff_close(&file);
    return done || pel_fail_in("%s", path);
}

// ---- Many files --------------------------------------------------------------------------------

// A page of ImageJ may be a whole stack.
static bool check_one_plane(const struct stack *stack) {
    if (stack->meta.follow)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "%d slices; files read together must have one each",
                        stack->meta.plane_count);
    return true;
}

static bool read_slice(struct stack *stack, const struct pel_tiff_list *list, int z,
                       uint64_t all_bytes, const struct pel_load_options *options) {
    struct pel_tiff_file file;
    if (!pel_tiff_open(&file, list->paths[z]))
        return false;
    bool done = file.page_count == 1;
    if (!done)
        pel_fail(PEL_ERROR_UNSUPPORTED, "%d pages; files read together must have one each",
                 file.page_count);
    if (done && z == 0) {
        uint64_t decoded;
        if (__builtin_mul_overflow(file.pages[0].decoded_bytes, (uint64_t)list->count, &decoded))
            decoded = UINT64_MAX;
        done = begin(stack, &file, false, options) && check_one_plane(stack) &&
               check_justified(decoded, all_bytes, stack->page.compression) &&
               allocate(stack, list->count);
    }
    done = done &&
           check_justified(file.pages[0].decoded_bytes, file.bytes, file.pages[0].compression) &&
           read_plane(stack, &file, 0, z);
    pel_tiff_close(&file);
    return done || pel_fail_in("%s", list->paths[z]);
}

static bool read_slices(struct stack *stack, const struct pel_tiff_list *list,
                        const struct pel_load_options *options) {
    uint64_t all_bytes = 0;
    for (int z = 0; z < list->count; z++) {
        size_t bytes;
        if (!pel_file_size(list->paths[z], &bytes))
            return false;
        all_bytes += bytes;
    }
    for (int z = 0; z < list->count; z++)
        if (!read_slice(stack, list, z, all_bytes, options))
            return false;
    if (stack->meta.space[0] == 'T')
        pel_warn("%s: the distance of slices is not told; taken as that of pixels, %g mm",
                 stack->name, stack->meta.spacing_mm[2]);
    return true;
}

// ---- The volume --------------------------------------------------------------------------------

static struct pel_volume *finish(struct stack *stack) {
    struct pel_volume *volume = stack->volume;
    stack->volume = NULL;
    if (stack->wide)
        volume = pel_volume_from_wide(stack->name, stack->dims,
                                      (enum pel_wide_type)(stack->shape.element - PEL_ELEMENT_I32),
                                      stack->wide);
    if (!volume)
        return NULL;
    const double *spacing = stack->meta.spacing_mm;
    volume->world_from_voxel = pel_matrix_scaling((double[]){-spacing[0], -spacing[1], spacing[2]});
    volume->slope = stack->meta.slope;
    volume->intercept = stack->meta.intercept;
    memcpy(volume->unit, stack->meta.unit, sizeof volume->unit);
    snprintf(volume->space, sizeof volume->space, "%s", stack->meta.space);
    pel_volume_mark_absent(volume);
    return volume;
}

struct pel_volume *pel_tiff_load(const char *path, const struct pel_load_options *options) {
    struct pel_tiff_list list;
    if (!pel_tiff_list_init(&list, path))
        return NULL;
    const struct pel_load_options defaults = {0};
    options = options ? options : &defaults;
    struct stack stack = {.name = pel_path_leaf(path)};
    bool done = list.count == 1 ? read_file(&stack, list.paths[0], options)
                                : read_slices(&stack, &list, options);
    struct pel_volume *volume = done ? finish(&stack) : NULL;
    pel_volume_destroy(stack.volume);
    free(stack.wide);
    pel_tiff_stack_finish(&stack.meta);
    pel_tiff_list_finish(&list);
    return volume;
}
