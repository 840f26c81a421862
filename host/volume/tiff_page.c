// tiff_page.c - the pixels of one TIFF page.
//
// A page is read block by block (strips or tiles, for separate planes one set per sample). Each row
// of a block is unpacked to 64-bit raw samples - bits packed from the high end, as TIFF has it,
// where the depth is not a whole machine word - and stored in the element type of the shape. The
// orientation tag is honoured by where a stored pixel goes: out[origin + x step_x + y step_y].
#include "volume/tiff.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

// Where stored pixels go, and what becomes of their samples.
struct sink {
    const struct pel_tiff_page *page;
    const struct pel_tiff_shape *shape;
    char *out;
    ptrdiff_t origin, step_x, step_y; // in pixels of `out`
    const uint8_t *palette;           // component-interleaved bytes; NULL when there is none
    uint64_t *raw;                    // scratch: one row of samples
};

// ---- Samples -----------------------------------------------------------------------------------

// Reads samples first, first + stride, ... of a row, whose multi-byte words libtiff has put into
// native order.
static void unpack(uint64_t *raw, const uint8_t *row, size_t first, size_t stride, size_t count,
                   int bits) {
    switch (bits) {
    case 8:
        for (size_t i = 0; i < count; i++)
            raw[i] = row[first + i * stride];
        return;
    case 16:
        for (size_t i = 0; i < count; i++)
            raw[i] = ((const uint16_t *)row)[first + i * stride];
        return;
    case 24:
        for (size_t i = 0; i < count; i++) {
            const uint8_t *byte = row + 3 * (first + i * stride);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
            raw[i] = byte[0] | (uint64_t)byte[1] << 8 | (uint64_t)byte[2] << 16;
#else
            raw[i] = byte[2] | (uint64_t)byte[1] << 8 | (uint64_t)byte[0] << 16;
#endif
        }
        return;
    case 32:
        for (size_t i = 0; i < count; i++)
            raw[i] = ((const uint32_t *)row)[first + i * stride];
        return;
    case 64:
        for (size_t i = 0; i < count; i++)
            raw[i] = ((const uint64_t *)row)[first + i * stride];
        return;
    default:
        for (size_t i = 0; i < count; i++) {
            size_t bit = (first + i * stride) * (size_t)bits;
            raw[i] = 0;
            for (int b = 0; b < bits; b++, bit++)
                raw[i] = raw[i] << 1 | (row[bit >> 3] >> (7 - (bit & 7)) & 1);
        }
    }
}

// IEEE floats of 16 bits (5 of exponent) and 24 bits (7 of exponent, Adobe's TIFF note 3).
static double small_float(uint64_t raw, int bits) {
    int exponent_bits = bits == 16 ? 5 : 7, fraction_bits = bits - 1 - exponent_bits;
    int bias = (1 << (exponent_bits - 1)) - 1, most = (1 << exponent_bits) - 1;
    int exponent = (int)(raw >> fraction_bits) & most;
    double fraction = (double)(raw & (((uint64_t)1 << fraction_bits) - 1));
    double magnitude;
    if (exponent == most)
        magnitude = fraction != 0 ? NAN : INFINITY;
    else if (exponent == 0)
        magnitude = ldexp(fraction, 1 - bias - fraction_bits);
    else
        magnitude = ldexp(fraction + ldexp(1, fraction_bits), exponent - bias - fraction_bits);
    return raw >> (bits - 1) & 1 ? -magnitude : magnitude;
}

static double float_of(uint64_t raw, int bits) {
    if (bits == 32) {
        uint32_t word = (uint32_t)raw;
        float value;
        memcpy(&value, &word, sizeof value);
        return value;
    }
    if (bits == 64) {
        double value;
        memcpy(&value, &raw, sizeof value);
        return value;
    }
    return small_float(raw, bits);
}

static int64_t signed_of(uint64_t raw, int bits) {
    return (int64_t)(raw << (64 - bits)) >> (64 - bits);
}

static uint64_t largest(int bits) {
    return UINT64_MAX >> (64 - bits);
}

// A colour sample as a byte: the type's whole range, or 0..1 of floats, onto 0..255.
static uint8_t byte_of(uint64_t raw, const struct pel_tiff_page *page) {
    int bits = page->bits;
    if (page->format == SAMPLEFORMAT_IEEEFP) {
        double value = float_of(raw, bits);
        return (uint8_t)(fmin(fmax(value, 0), 1) * 255 + 0.5);
    }
    if (page->format == SAMPLEFORMAT_INT)
        raw ^= (uint64_t)1 << (bits - 1);
    if (bits > 32)
        return (uint8_t)(raw >> (bits - 8));
    return (uint8_t)((raw * 255 + largest(bits) / 2) / largest(bits));
}

// ---- Rows --------------------------------------------------------------------------------------

#define STORE(TYPE, EXPRESSION)                                                                    \
    for (size_t i = 0; i < count; i++, at += step)                                                 \
        ((TYPE *)sink->out)[at] = (TYPE)(EXPRESSION);                                              \
    return

// Stores `count` grey samples at element `at` of the output and on.
static void store_greys(const struct sink *sink, ptrdiff_t at, ptrdiff_t step, size_t count) {
    const uint64_t *raw = sink->raw;
    int bits = sink->page->bits;
    switch (sink->shape->element) {
    case PEL_ELEMENT_U8:
        STORE(uint8_t, raw[i]);
    case PEL_ELEMENT_I8:
        STORE(int8_t, signed_of(raw[i], bits));
    case PEL_ELEMENT_U16:
        STORE(uint16_t, raw[i]);
    case PEL_ELEMENT_I16:
        STORE(int16_t, signed_of(raw[i], bits));
    case PEL_ELEMENT_F32:
        STORE(float, float_of(raw[i], bits));
    case PEL_ELEMENT_I32:
        STORE(int32_t, signed_of(raw[i], bits));
    case PEL_ELEMENT_U32:
        STORE(uint32_t, raw[i]);
    case PEL_ELEMENT_I64:
        STORE(int64_t, signed_of(raw[i], bits));
    case PEL_ELEMENT_U64:
        STORE(uint64_t, raw[i]);
    case PEL_ELEMENT_F64:
        STORE(double, float_of(raw[i], bits));
    }
}

// Puts the row of samples in sink->raw, which starts at stored pixel (x, y), into the output.
static void store_row(const struct sink *sink, uint32_t x, uint32_t y, size_t count,
                      int component) {
    const struct pel_tiff_page *page = sink->page;
    int components = sink->shape->components;
    uint64_t *raw = sink->raw;
    ptrdiff_t pixel = sink->origin + (ptrdiff_t)x * sink->step_x + (ptrdiff_t)y * sink->step_y;
    ptrdiff_t at = pixel * components + component, step = sink->step_x * components;
    uint8_t *bytes = (uint8_t *)sink->out;
    if (sink->palette) {
        for (size_t i = 0; i < count; i++, at += step)
            memcpy(bytes + at, sink->palette + raw[i] * (uint64_t)components, (size_t)components);
        return;
    }
    if (components > 1) {
        for (size_t i = 0; i < count; i++, at += step)
            bytes[at] = byte_of(raw[i], page);
        return;
    }
    bool floats = page->format == SAMPLEFORMAT_IEEEFP;
    if (page->photometric == PHOTOMETRIC_MINISWHITE && !floats)
        for (size_t i = 0; i < count; i++)
            raw[i] ^= largest(page->bits);
    bool expanded = page->bits == 1 || page->bits == 2 || page->bits == 4;
    if (expanded && page->photometric != PHOTOMETRIC_PALETTE && page->format != SAMPLEFORMAT_INT)
        for (size_t i = 0; i < count; i++)
            raw[i] *= 255 / largest(page->bits);
    store_greys(sink, at, step, count);
}

// A strip or a tile: its place in the stored picture, and how many of its pixels lie within.
struct block {
    uint32_t x, y, width, height;
    size_t row_bytes;
    int plane; // of separate planes; -1 when the samples of a pixel lie together
};

static void store_block(const struct sink *sink, const struct block *block, const uint8_t *data) {
    const struct pel_tiff_page *page = sink->page;
    size_t stride = block->plane >= 0 ? 1 : page->samples;
    int components = sink->palette ? 1 : sink->shape->components;
    for (uint32_t y = 0; y < block->height; y++) {
        const uint8_t *row = data + y * block->row_bytes;
        for (int c = 0; c < components; c++) {
            int sample = sink->shape->first_sample + c;
            if (block->plane >= 0 && block->plane != sample)
                continue;
            unpack(sink->raw, row, block->plane >= 0 ? 0 : (size_t)sample, stride, block->width,
                   page->bits);
            store_row(sink, block->x, block->y + y, block->width, c);
        }
    }
}

// ---- Blocks ------------------------------------------------------------------------------------

static bool read_tiles(struct pel_tiff_file *file, const struct sink *sink, uint8_t *data,
                       size_t bytes, int plane) {
    const struct pel_tiff_page *page = sink->page;
    uint32_t width = 0, height = 0;
    TIFFGetField(file->handle, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(file->handle, TIFFTAG_TILELENGTH, &height);
    for (uint32_t y = 0; y < page->height; y += height) {
        for (uint32_t x = 0; x < page->width; x += width) {
            uint32_t tile =
                TIFFComputeTile(file->handle, x, y, 0, (uint16_t)(plane < 0 ? 0 : plane));
            struct block block = {
                .x = x,
                .y = y,
                .width = width < page->width - x ? width : page->width - x,
                .height = height < page->height - y ? height : page->height - y,
                .row_bytes = (size_t)TIFFTileRowSize64(file->handle),
                .plane = plane,
            };
            if (TIFFReadEncodedTile(file->handle, tile, data, (tmsize_t)bytes) < (tmsize_t)bytes)
                return pel_tiff_fail(file, "a tile is too short") || pel_fail_in("tile %u", tile);
            store_block(sink, &block, data);
            if (width >= page->width - x)
                break;
        }
        if (height >= page->height - y)
            break;
    }
    return true;
}

static bool read_strips(struct pel_tiff_file *file, const struct sink *sink, uint8_t *data,
                        uint32_t rows, int plane) {
    const struct pel_tiff_page *page = sink->page;
    size_t row_bytes = (size_t)TIFFScanlineSize64(file->handle);
    for (uint32_t y = 0; y < page->height; y += rows) {
        uint32_t strip = TIFFComputeStrip(file->handle, y, (uint16_t)(plane < 0 ? 0 : plane));
        struct block block = {
            .y = y,
            .width = page->width,
            .height = rows < page->height - y ? rows : page->height - y,
            .row_bytes = row_bytes,
            .plane = plane,
        };
        tmsize_t bytes = (tmsize_t)(block.height * row_bytes);
        if (TIFFReadEncodedStrip(file->handle, strip, data, bytes) < bytes)
            return pel_tiff_fail(file, "a strip is too short") || pel_fail_in("strip %u", strip);
        store_block(sink, &block, data);
        if (rows >= page->height - y)
            break;
    }
    return true;
}

// The bytes a row of a block must have, so that unpacking stays inside of it.
static bool check_row(const struct pel_tiff_page *page, uint64_t width, uint64_t row_bytes) {
    uint64_t samples = page->planar == PLANARCONFIG_SEPARATE ? 1 : page->samples;
    uint64_t need = (width * samples * page->bits + 7) / 8;
    if (row_bytes < need)
        return pel_fail(PEL_ERROR_FORMAT, "a row has %llu bytes and needs %llu",
                        (unsigned long long)row_bytes, (unsigned long long)need);
    return true;
}

static bool read_blocks(struct pel_tiff_file *file, struct sink *sink) {
    const struct pel_tiff_page *page = sink->page;
    bool tiled = TIFFIsTiled(file->handle), done = true;
    uint32_t rows = page->height, width = page->width;
    uint64_t row_bytes = tiled ? TIFFTileRowSize64(file->handle) : TIFFScanlineSize64(file->handle);
    if (tiled)
        TIFFGetField(file->handle, TIFFTAG_TILEWIDTH, &width);
    else if (TIFFGetFieldDefaulted(file->handle, TIFFTAG_ROWSPERSTRIP, &rows) &&
             rows > page->height)
        rows = page->height;
    if (rows == 0 || width == 0)
        return pel_fail(PEL_ERROR_FORMAT, "strips or tiles of no size");
    if (!check_row(page, width, row_bytes))
        return false;
    size_t bytes = tiled ? (size_t)TIFFTileSize64(file->handle) : rows * (size_t)row_bytes;
    uint8_t *data = pel_allocate(bytes, 1);
    sink->raw = pel_allocate(width, sizeof *sink->raw);
    bool separate = page->planar == PLANARCONFIG_SEPARATE && page->samples > 1;
    int first = separate ? sink->shape->first_sample : -1;
    int last = separate ? first + (sink->palette ? 1 : sink->shape->components) - 1 : -1;
    done = data && sink->raw;
    for (int plane = first; done && plane <= last; plane++)
        done = tiled ? read_tiles(file, sink, data, bytes, plane)
                     : read_strips(file, sink, data, rows, plane);
    free(sink->raw);
    free(data);
    return done;
}

// ---- Pages -------------------------------------------------------------------------------------

// Which way the stored rows and columns run (TIFF 6.0, Orientation).
static void orient(struct sink *sink) {
    ptrdiff_t w = sink->page->width, h = sink->page->height;
    ptrdiff_t right = 1, down = (ptrdiff_t)sink->shape->width;
    switch (sink->page->orientation) {
    case ORIENTATION_TOPRIGHT:
        sink->origin = (w - 1) * right;
        sink->step_x = -right, sink->step_y = down;
        break;
    case ORIENTATION_BOTRIGHT:
        sink->origin = (w - 1) * right + (h - 1) * down;
        sink->step_x = -right, sink->step_y = -down;
        break;
    case ORIENTATION_BOTLEFT:
        sink->origin = (h - 1) * down;
        sink->step_x = right, sink->step_y = -down;
        break;
    case ORIENTATION_LEFTTOP:
        sink->step_x = down, sink->step_y = right;
        break;
    case ORIENTATION_RIGHTTOP:
        sink->origin = (h - 1) * right;
        sink->step_x = down, sink->step_y = -right;
        break;
    case ORIENTATION_RIGHTBOT:
        sink->origin = (h - 1) * right + (w - 1) * down;
        sink->step_x = -down, sink->step_y = -right;
        break;
    case ORIENTATION_LEFTBOT:
        sink->origin = (w - 1) * down;
        sink->step_x = -down, sink->step_y = right;
        break;
    default:
        sink->step_x = right, sink->step_y = down;
    }
}

// Reads a page through libtiff's RGBA interface: pixels 0xAABBGGRR, in stored order.
static bool read_rendered(struct pel_tiff_file *file, const struct sink *sink) {
    const struct pel_tiff_page *page = sink->page;
    char reason[1024] = "";
    if (!TIFFRGBAImageOK(file->handle, reason))
        return pel_fail(PEL_ERROR_UNSUPPORTED, "photometric interpretation %d: %s",
                        page->photometric, reason);
    size_t count;
    size_t factors[] = {page->width, page->height, sizeof(uint32_t)};
    if (!pel_size_multiply(&count, 3, factors))
        return false;
    uint32_t *raster = pel_allocate_voxels(count);
    if (!raster)
        return false;
    // Asking for the page's own orientation keeps libtiff from flipping.
    bool done = TIFFReadRGBAImageOriented(file->handle, page->width, page->height, raster,
                                          page->orientation, 1);
    for (uint32_t y = 0; done && y < page->height; y++) {
        for (uint32_t x = 0; x < page->width; x++) {
            uint32_t pixel = raster[(size_t)y * page->width + x];
            ptrdiff_t at = sink->origin + (ptrdiff_t)x * sink->step_x + (ptrdiff_t)y * sink->step_y;
            for (int c = 0; c < sink->shape->components; c++)
                sink->out[at * sink->shape->components + c] =
                    (char)(pixel >> 8 * (sink->shape->first_sample + c));
        }
    }
    free(raster);
    return done || pel_tiff_fail(file, "the pixels cannot be read");
}

static uint8_t *make_palette(struct pel_tiff_file *file, const struct pel_tiff_page *page,
                             int components) {
    uint16_t *maps[3];
    if (!TIFFGetField(file->handle, TIFFTAG_COLORMAP, &maps[0], &maps[1], &maps[2])) {
        pel_fail(PEL_ERROR_FORMAT, "the palette is missing");
        return NULL;
    }
    size_t count = (size_t)1 << page->bits;
    uint8_t *palette = pel_allocate(count, (size_t)components);
    // Entries are meant to use 16 bits; writers that got it wrong leave the upper half empty.
    bool wide = false;
    for (size_t i = 0; i < count; i++)
        wide = wide || maps[0][i] > 255 || maps[1][i] > 255 || maps[2][i] > 255;
    for (size_t i = 0; palette && i < count; i++)
        for (int c = 0; c < components; c++)
            palette[i * (size_t)components + (size_t)c] =
                (uint8_t)(wide ? maps[c][i] >> 8 : maps[c][i]);
    return palette;
}

// Divides colours by their alpha.
static void make_straight(uint8_t *rgba, size_t count) {
    for (size_t i = 0; i < count; i++, rgba += 4) {
        for (int c = 0; c < 3 && rgba[3] > 0; c++) {
            int straight = (rgba[c] * 255 + rgba[3] / 2) / rgba[3];
            rgba[c] = (uint8_t)(straight < 255 ? straight : 255);
        }
    }
}

// Reads four inks into a buffer of their own and mixes them.
static bool read_cmyk(struct pel_tiff_file *file, const struct sink *sink) {
    size_t count = (size_t)sink->shape->width * sink->shape->height;
    uint8_t *inks = pel_allocate(count, 4);
    if (!inks)
        return false;
    struct pel_tiff_shape shape = *sink->shape;
    struct sink four = *sink;
    shape.components = 4;
    four.shape = &shape;
    four.out = (char *)inks;
    bool done = read_blocks(file, &four);
    uint8_t *rgb = (uint8_t *)sink->out;
    for (size_t i = 0; done && i < count; i++)
        for (int c = 0; c < 3; c++)
            rgb[3 * i + (size_t)c] =
                (uint8_t)(((255 - inks[4 * i + (size_t)c]) * (255 - inks[4 * i + 3]) + 127) / 255);
    free(inks);
    return done;
}

bool pel_tiff_read_page(struct pel_tiff_file *file, const struct pel_tiff_page *page,
                        const struct pel_tiff_shape *shape, void *out) {
    file->reports = (struct pel_tiff_reports){0};
    if (TIFFCurrentDirOffset(file->handle) != page->offset &&
        !TIFFSetSubDirectory(file->handle, page->offset))
        return pel_tiff_fail(file, "its directory cannot be read");
    // Complaints about tags that did not keep the directory from being read are of no interest.
    file->reports = (struct pel_tiff_reports){0};
    struct sink sink = {.page = page, .shape = shape, .out = out};
    orient(&sink);
    if (shape->rendered)
        return read_rendered(file, &sink);
    if (shape->cmyk)
        return read_cmyk(file, &sink);
    uint8_t *palette = NULL;
    if (page->photometric == PHOTOMETRIC_PALETTE && !shape->indices) {
        palette = make_palette(file, page, shape->components);
        if (!palette)
            return false;
        sink.palette = palette;
    }
    bool done = read_blocks(file, &sink);
    free(palette);
    if (done && shape->components == 4 && page->alpha == EXTRASAMPLE_ASSOCALPHA)
        make_straight(out, (size_t)shape->width * shape->height);
    return done;
}
