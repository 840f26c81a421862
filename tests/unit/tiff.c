// tiff.c - TIFF stacks written here with libtiff, or byte by byte, and read back: every way pixels
// can lie in a file gives the same numbers.
#include "support/test.h"

#include <math.h>
#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

#include "volume/volume.h"

static int warning_count;

static void on_warning(const char *message, void *user) {
    (void)message, (void)user;
    warning_count++;
}

// How a test file is stored; zero members take the defaults of write_stack.
struct recipe {
    const char *mode;        // "w"
    int width, height;       // 7 x 5
    int pages;               // 1
    int bits, samples;       // 8, 1
    int format, photometric; // UINT, MINISBLACK or RGB
    int planar, compression; // CONTIG, NONE
    int tile;                // side of tiles; 0 = strips of 2 rows
    int orientation;         // TOPLEFT
    int extra;               // EXTRASAMPLE_... + 1 of the last sample; 0 = tag not written
    int unit;                // RESUNIT_...; 0 = no resolution
    double per_unit[2];      //
    const char *description;
};

// The value stored for sample s of pixel (x, y) of a page.
static int value_at(int x, int y, int page, int s) {
    return x + 10 * y + 50 * page + 3 * s;
}

static void put(uint8_t *row, size_t index, int bits, int format, int value) {
    if (format == SAMPLEFORMAT_IEEEFP && bits == 32)
        ((float *)row)[index] = (float)value / 4;
    else if (format == SAMPLEFORMAT_IEEEFP)
        ((double *)row)[index] = (double)value / 4;
    else if (bits == 8)
        row[index] = (uint8_t)value;
    else if (bits == 16)
        ((uint16_t *)row)[index] = (uint16_t)value;
    else if (bits == 32)
        ((uint32_t *)row)[index] = (uint32_t)value;
    else
        for (int b = 0; b < bits; b++)
            row[(index * (size_t)bits + (size_t)b) / 8] |=
                (uint8_t)((value >> (bits - 1 - b) & 1)
                          << (7 - (index * (size_t)bits + (size_t)b) % 8));
}

static void set_tags(TIFF *tiff, const struct recipe *r) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, r->width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, r->height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, r->bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, r->samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, r->format);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, r->photometric);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, r->planar);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, r->compression);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, r->orientation);
    if (r->extra)
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, (uint16_t[]){(uint16_t)(r->extra - 1)});
    if (r->unit) {
        TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, r->unit);
        TIFFSetField(tiff, TIFFTAG_XRESOLUTION, r->per_unit[0]);
        TIFFSetField(tiff, TIFFTAG_YRESOLUTION, r->per_unit[1]);
    }
    if (r->tile) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, r->tile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, r->tile);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
    }
}

static void write_page(TIFF *tiff, const struct recipe *r, int page) {
    bool separate = r->planar == PLANARCONFIG_SEPARATE;
    int planes = separate ? r->samples : 1, step = r->tile ? r->tile : r->height;
    for (int plane = 0; plane < planes; plane++)
        for (int top = 0; top < r->height; top += step)
            for (int left = 0; left < r->width; left += r->tile ? r->tile : r->width) {
                int samples = separate ? 1 : r->samples, width = r->tile ? r->tile : r->width;
                size_t row_bytes = ((size_t)(width * samples * r->bits) + 7) / 8;
                uint8_t *block = calloc((size_t)step, row_bytes);
                for (int y = 0; y < step && top + y < r->height; y++) {
                    uint8_t *row = block + (size_t)y * row_bytes;
                    for (int x = 0; x < width && left + x < r->width; x++)
                        for (int s = 0; s < samples; s++)
                            put(row, (size_t)(x * samples + s), r->bits, r->format,
                                value_at(left + x, top + y, page, separate ? plane : s));
                    if (!r->tile)
                        assert_int_equal(
                            TIFFWriteScanline(tiff, row, (uint32_t)(top + y), (uint16_t)plane), 1);
                }
                if (r->tile)
                    assert_true(TIFFWriteTile(tiff, block, (uint32_t)left, (uint32_t)top, 0,
                                              (uint16_t)plane) > 0);
                free(block);
            }
}

static const char *write_stack(const char *leaf, struct recipe r) {
    const char *path = test_temporary_path(leaf);
    r.width = r.width ? r.width : 7, r.height = r.height ? r.height : 5;
    r.pages = r.pages ? r.pages : 1, r.bits = r.bits ? r.bits : 8;
    r.samples = r.samples ? r.samples : 1, r.format = r.format ? r.format : SAMPLEFORMAT_UINT;
    r.photometric = r.samples == 3 && !r.photometric ? PHOTOMETRIC_RGB
                    : r.photometric < 0              ? PHOTOMETRIC_MINISWHITE
                    : r.photometric                  ? r.photometric
                                                     : PHOTOMETRIC_MINISBLACK;
    r.planar = r.planar ? r.planar : PLANARCONFIG_CONTIG;
    r.compression = r.compression ? r.compression : COMPRESSION_NONE;
    r.orientation = r.orientation ? r.orientation : ORIENTATION_TOPLEFT;
    TIFF *tiff = TIFFOpen(path, r.mode ? r.mode : "w");
    assert_non_null(tiff);
    for (int page = 0; page < r.pages; page++) {
        set_tags(tiff, &r);
        if (page == 0 && r.description)
            TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, r.description);
        write_page(tiff, &r, page);
        assert_int_equal(TIFFWriteDirectory(tiff), 1);
    }
    TIFFClose(tiff);
    return path;
}

static struct pel_volume *load(const char *path) {
    struct pel_volume *volume = pel_tiff_load(path, NULL);
    if (!volume)
        print_message("%s\n", pel_error_message());
    assert_non_null(volume);
    return volume;
}

static void assert_spacing(const struct pel_volume *volume, double x, double y, double z) {
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    assert_float_equal(spacing[0] / x, 1, 1e-6);
    assert_float_equal(spacing[1] / y, 1, 1e-6);
    assert_float_equal(spacing[2] / z, 1, 1e-6);
}

// ---- Number types and layouts ------------------------------------------------------------------

static void test_greys(void **state) {
    (void)state;
    const int u = SAMPLEFORMAT_UINT, i = SAMPLEFORMAT_INT, f = SAMPLEFORMAT_IEEEFP;
    const struct {
        struct recipe recipe;
        enum pel_voxel_type type;
        double scale;
    } cases[] = {
        {{.bits = 8}, PEL_VOXEL_U8, 1},
        {{.bits = 8, .format = i, .pages = 1}, PEL_VOXEL_I8, 1},
        {{.bits = 16, .pages = 3}, PEL_VOXEL_U16, 1},
        {{.bits = 16, .format = i, .pages = 3}, PEL_VOXEL_I16, 1},
        {{.bits = 16, .mode = "wb", .pages = 2}, PEL_VOXEL_U16, 1},
        {{.bits = 16, .mode = "w8", .pages = 2}, PEL_VOXEL_U16, 1},
        {{.bits = 16, .tile = 16, .width = 35, .height = 19}, PEL_VOXEL_U16, 1},
        {{.bits = 32, .format = f, .pages = 2}, PEL_VOXEL_F32, 0.25},
        {{.bits = 32, .format = f, .mode = "wb", .compression = COMPRESSION_LZW},
         PEL_VOXEL_F32,
         0.25},
        {{.bits = 64, .format = f, .pages = 2}, PEL_VOXEL_F32, 0.25},
        {{.bits = 12, .pages = 2}, PEL_VOXEL_U16, 1},
        {{.bits = 32, .format = u, .pages = 2}, PEL_VOXEL_I16, 1},
        {{.bits = 8, .compression = COMPRESSION_ADOBE_DEFLATE}, PEL_VOXEL_U8, 1},
        {{.bits = 8, .compression = COMPRESSION_PACKBITS, .pages = 2}, PEL_VOXEL_U8, 1},
        {{.bits = 16, .compression = COMPRESSION_ZSTD, .tile = 16}, PEL_VOXEL_U16, 1},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct pel_volume *volume = load(write_stack("grey.tif", cases[c].recipe));
        assert_int_equal(volume->type, cases[c].type);
        assert_int_equal(volume->dims[2], cases[c].recipe.pages ? cases[c].recipe.pages : 1);
        for (int k = 0; k < volume->dims[2]; k++)
            for (int y = 0; y < volume->dims[1]; y++)
                for (int x = 0; x < volume->dims[0]; x++)
                    assert_float_equal(pel_volume_value(volume, x, y, k),
                                       cases[c].scale * value_at(x, y, k, 0), 0);
        pel_volume_destroy(volume);
    }
}

static void test_few_bits(void **state) {
    (void)state;
    // Value x + 10 y of a 4-bit page is stored modulo 16 and expanded by 17; white is 0 inverted.
    struct pel_volume *volume = load(write_stack("four.tif", (struct recipe){.bits = 4}));
    assert_true(volume->type == PEL_VOXEL_U8 && pel_volume_value(volume, 3, 1, 0) == 13 * 17);
    pel_volume_destroy(volume);
    volume = load(write_stack("one.tif", (struct recipe){.bits = 1}));
    assert_true(pel_volume_value(volume, 3, 0, 0) == 255 && pel_volume_value(volume, 4, 0, 0) == 0);
    pel_volume_destroy(volume);
    volume = load(write_stack("white.tif", (struct recipe){.photometric = -1}));
    assert_true(pel_volume_value(volume, 3, 1, 0) == 255 - 13);
    pel_volume_destroy(volume);
    volume = load(write_stack("white16.tif", (struct recipe){.photometric = -1, .bits = 16}));
    assert_true(pel_volume_value(volume, 3, 1, 0) == 65535 - 13);
    pel_volume_destroy(volume);
}

static void test_colours(void **state) {
    (void)state;
    const struct recipe recipes[] = {
        {.samples = 3},
        {.samples = 3, .planar = PLANARCONFIG_SEPARATE},
        {.samples = 3, .planar = PLANARCONFIG_SEPARATE, .tile = 16, .width = 20},
        {.samples = 3, .tile = 16, .compression = COMPRESSION_LZW},
    };
    for (size_t r = 0; r < sizeof recipes / sizeof *recipes; r++) {
        struct pel_volume *volume = load(write_stack("rgb.tif", recipes[r]));
        assert_int_equal(volume->type, PEL_VOXEL_RGB8);
        const uint8_t *rgb = (uint8_t *)volume->voxels + 3 * (2 * volume->dims[0] + 5);
        assert_memory_equal(rgb, ((uint8_t[]){25, 28, 31}), 3);
        pel_volume_destroy(volume);
    }
    // 16-bit colours are scaled by 255/65535; one channel of them stays what it is.
    const char *path = write_stack("rgb16.tif", (struct recipe){.samples = 3, .bits = 16});
    struct pel_volume *volume =
        pel_tiff_load(path, &(struct pel_load_options){.split_channels = true, .channel = 2});
    assert_true(volume->type == PEL_VOXEL_U16 && pel_volume_value(volume, 1, 2, 0) == 27);
    pel_volume_destroy(volume);
    assert_null(pel_tiff_load(path, &(struct pel_load_options){.channel = 1}));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
}

static void test_alpha(void **state) {
    (void)state;
    struct recipe recipe = {
        .samples = 4, .photometric = PHOTOMETRIC_RGB, .extra = EXTRASAMPLE_UNASSALPHA + 1};
    struct pel_volume *volume = load(write_stack("rgba.tif", recipe));
    const uint8_t *rgba = (uint8_t *)volume->voxels + 4 * (2 * 7 + 5);
    assert_int_equal(volume->type, PEL_VOXEL_RGBA8);
    assert_memory_equal(rgba, ((uint8_t[]){25, 28, 31, 34}), 4);
    pel_volume_destroy(volume);
    // Premultiplied: 25 * 255 / 34 = 187.5, 28 * 255 / 34 = 210, 31 * 255 / 34 = 232.5.
    recipe.extra = EXTRASAMPLE_ASSOCALPHA + 1;
    volume = load(write_stack("premultiplied.tif", recipe));
    rgba = (uint8_t *)volume->voxels + 4 * (2 * 7 + 5);
    assert_memory_equal(rgba, ((uint8_t[]){188, 210, 233, 34}), 4);
    pel_volume_destroy(volume);
    recipe.extra = EXTRASAMPLE_UNSPECIFIED + 1;
    volume = load(write_stack("rgbx.tif", recipe));
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    pel_volume_destroy(volume);
}

static void test_channels(void **state) {
    (void)state;
    const char *path = write_stack(
        "five.tif",
        (struct recipe){.samples = 5, .bits = 16, .photometric = PHOTOMETRIC_MINISBLACK});
    for (int channel = 0; channel < 5; channel++) {
        struct pel_volume *volume =
            pel_tiff_load(path, &(struct pel_load_options){.channel = channel});
        assert_non_null(volume);
        assert_true(pel_volume_value(volume, 6, 4, 0) == value_at(6, 4, 0, channel));
        pel_volume_destroy(volume);
    }
    assert_null(pel_tiff_load(path, &(struct pel_load_options){.channel = 5}));
}

static void write_palette(const char *path, bool grey, const char *description) {
    uint16_t maps[3][256];
    for (int i = 0; i < 256; i++) {
        maps[0][i] = (uint16_t)((255 - i) * 257);
        maps[1][i] = (uint16_t)(grey ? (255 - i) * 257 : i * 257);
        maps[2][i] = (uint16_t)(grey ? (255 - i) * 257 : 0);
    }
    TIFF *tiff = TIFFOpen(path, "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 4);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_PALETTE);
    TIFFSetField(tiff, TIFFTAG_COLORMAP, maps[0], maps[1], maps[2]);
    if (description)
        TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, description);
    TIFFWriteScanline(tiff, (uint8_t[]){0, 1, 200, 255}, 0, 0);
    TIFFClose(tiff);
}

static void test_palettes(void **state) {
    (void)state;
    const char *path = test_temporary_path("palette.tif");
    write_palette(path, true, NULL);
    struct pel_volume *volume = load(path);
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_memory_equal(volume->voxels, ((uint8_t[]){255, 254, 55, 0}), 4);
    pel_volume_destroy(volume);
    write_palette(path, false, NULL);
    volume = load(path);
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    assert_memory_equal(volume->voxels, ((uint8_t[]){255, 0, 0, 254, 1, 0, 55, 200, 0, 0, 255, 0}),
                        12);
    pel_volume_destroy(volume);
    write_palette(path, false, "ImageJ=1.53c\n");
    volume = load(path);
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_memory_equal(volume->voxels, ((uint8_t[]){0, 1, 200, 255}), 4);
    pel_volume_destroy(volume);
}

static void test_orientations(void **state) {
    (void)state;
    // Where the stored pixel x = 6, y = 1 of 7 x 5 is to be seen.
    const int at[9][2] = {{0, 0}, {6, 1}, {0, 1}, {0, 3}, {6, 3}, {1, 6}, {3, 6}, {3, 0}, {1, 0}};
    for (int orientation = 1; orientation <= 8; orientation++) {
        struct pel_volume *volume =
            load(write_stack("turned.tif", (struct recipe){.orientation = orientation}));
        assert_int_equal(volume->dims[0], orientation < 5 ? 7 : 5);
        assert_true(pel_volume_value(volume, at[orientation][0], at[orientation][1], 0) == 16);
        pel_volume_destroy(volume);
    }
}

// ---- Stacks and metadata -----------------------------------------------------------------------

static void test_resolution(void **state) {
    (void)state;
    struct pel_volume *volume = load(write_stack(
        "cm.tif", (struct recipe){.pages = 2, .unit = RESUNIT_CENTIMETER, .per_unit = {20, 40}}));
    assert_spacing(volume, 0.5, 0.25, 0.5);
    // x to the right is -x of RAS, y down is -y.
    assert_true(volume->world_from_voxel.m[0][0] < 0 && volume->world_from_voxel.m[1][1] < 0);
    assert_true(volume->world_from_voxel.m[2][2] > 0 && volume->world_from_voxel.m[0][3] == 0);
    pel_volume_destroy(volume);
    volume = load(
        write_stack("inch.tif", (struct recipe){.unit = RESUNIT_INCH, .per_unit = {254, 254}}));
    assert_spacing(volume, 0.1, 0.1, 0.1);
    pel_volume_destroy(volume);
    volume = load(
        write_stack("screen.tif", (struct recipe){.unit = RESUNIT_INCH, .per_unit = {72, 72}}));
    assert_spacing(volume, 1, 1, 1);
    pel_volume_destroy(volume);
    volume =
        load(write_stack("none.tif", (struct recipe){.unit = RESUNIT_NONE, .per_unit = {3, 3}}));
    assert_spacing(volume, 1, 1, 1);
    pel_volume_destroy(volume);
}

// Checks that plane z of a volume is page pages[z].
static void assert_pages(const char *path, struct pel_load_options options, int count,
                         const int pages[]) {
    struct pel_volume *volume = pel_tiff_load(path, &options);
    if (!volume)
        print_message("%s\n", pel_error_message());
    assert_non_null(volume);
    assert_int_equal(volume->dims[2], count);
    for (int z = 0; z < count; z++)
        assert_true(pel_volume_value(volume, 2, 1, z) == value_at(2, 1, pages[z], 0));
    pel_volume_destroy(volume);
}

static void test_imagej(void **state) {
    (void)state;
    const char *path = write_stack(
        "hyperstack.tif",
        (struct recipe){.bits = 16,
                        .pages = 12,
                        .unit = RESUNIT_NONE,
                        .per_unit = {4, 5},
                        .description = "ImageJ=1.53c\nimages=12\nchannels=2\nslices=3\nframes=2\n"
                                       "hyperstack=true\nunit=micron\nspacing=2.5\n"
                                       "cf=0\nc0=-32768\nc1=0.5\nvunit=HU\n"});
    struct pel_load_options options = {.split_channels = true, .channel = 1, .time = 1};
    struct pel_volume *volume = pel_tiff_load(path, &options);
    assert_non_null(volume);
    assert_int_equal(volume->dims[2], 3);
    assert_spacing(volume, 0.25e-3, 0.2e-3, 2.5e-3);
    assert_string_equal(volume->unit, "HU");
    // Channel fastest: the pages of channel 1 at time 1 are 7, 9, 11.
    for (int z = 0; z < 3; z++)
        assert_true(pel_volume_value(volume, 1, 1, z) ==
                    0.5 * value_at(1, 1, 7 + 2 * z, 0) - 32768);
    pel_volume_destroy(volume);
    options.time = 2;
    assert_null(pel_tiff_load(path, &options));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
}

static void test_imagej_one_page(void **state) {
    (void)state;
    const char *path = test_temporary_path("large.tif");
    // Header and directory by hand, big endian: 8 bytes, 9 entries, planes.
    FILE *stream = fopen(path, "wb");
    const char description[] = "ImageJ=1.53c\nimages=3\nslices=3\nspacing=2\nunit=mm\n";
    const uint32_t entries[9][4] = {
        {256, 4, 1, 7},       {257, 4, 1, 5},       {258, 3, 1, 16 << 16},
        {259, 3, 1, 1 << 16}, {262, 3, 1, 1 << 16}, {270, 2, sizeof description, 200},
        {273, 4, 1, 300},     {277, 3, 1, 1 << 16}, {279, 4, 1, 70}};
    uint8_t head[300] = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 9};
    for (int e = 0; e < 9; e++) {
        uint8_t *at = head + 10 + 12 * e;
        at[0] = (uint8_t)(entries[e][0] >> 8), at[1] = (uint8_t)entries[e][0];
        at[3] = (uint8_t)entries[e][1];
        for (int b = 0; b < 4; b++) {
            at[4 + b] = (uint8_t)(entries[e][2] >> (24 - 8 * b));
            at[8 + b] = (uint8_t)(entries[e][3] >> (24 - 8 * b));
        }
    }
    memcpy(head + 200, description, sizeof description);
    fwrite(head, 1, sizeof head, stream);
    for (int k = 0; k < 3; k++)
        for (int y = 0; y < 5; y++)
            for (int x = 0; x < 7; x++)
                fwrite((uint8_t[]){1, (uint8_t)value_at(x, y, k, 0)}, 1, 2, stream);
    fclose(stream);
    struct pel_volume *volume = load(path);
    assert_int_equal(volume->dims[2], 3);
    assert_spacing(volume, 1, 1, 2);
    for (int k = 0; k < 3; k++)
        assert_true(pel_volume_value(volume, 6, 4, k) == 256 + value_at(6, 4, k, 0));
    pel_volume_destroy(volume);
    // Cut short by a byte it is refused.
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(truncate(path, status.st_size - 1), 0);
    assert_null(pel_tiff_load(path, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
}

static const char *write_ome(const char *leaf, const char *pixels, const char *children) {
    static char xml[2048];
    snprintf(
        xml, sizeof xml,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><OME xmlns=\"x\" UUID=\"urn:uuid:1\"><Image "
        "ID=\"Image:0\"><Pixels ID=\"P\" SizeX=\"7\" SizeY=\"5\" Type=\"uint16\" %s>%s</Pixels>"
        "</Image><Image><Pixels SizeZ=\"99\" SizeC=\"1\" SizeT=\"1\"/></Image></OME>",
        pixels, children);
    return write_stack(leaf, (struct recipe){.bits = 16, .pages = 12, .description = xml});
}

static void test_ome_orders(void **state) {
    (void)state;
    const struct pel_load_options one = {.split_channels = true, .channel = 1, .time = 1};
    const char *sizes = "SizeZ=\"3\" SizeC=\"2\" SizeT=\"2\" DimensionOrder=\"%s\"";
    const struct {
        const char *order;
        int pages[3];
    } orders[] = {{"XYZCT", {9, 10, 11}}, {"XYZTC", {9, 10, 11}}, {"XYCZT", {7, 9, 11}},
                  {"XYTZC", {7, 9, 11}},  {"XYCTZ", {3, 7, 11}},  {"XYTCZ", {3, 7, 11}}};
    for (int i = 0; i < 6; i++) {
        char pixels[256];
        snprintf(pixels, sizeof pixels, sizes, orders[i].order);
        assert_pages(write_ome("order.ome.tif", pixels, "<TiffData/>"), one, 3, orders[i].pages);
        assert_pages(write_ome("order.ome.tif", pixels, ""), one, 3, orders[i].pages);
    }
    // XYCZT and XYTZC differ where channel and time do.
    char pixels[256];
    snprintf(pixels, sizeof pixels, sizes, "XYTZC");
    assert_pages(write_ome("order.ome.tif", pixels, ""),
                 (struct pel_load_options){.split_channels = true, .channel = 1}, 3,
                 (int[]){6, 8, 10});
}

static void test_ome_planes(void **state) {
    (void)state;
    const char *pixels = "SizeZ=\"2\" SizeC=\"1\" SizeT=\"1\" DimensionOrder=\"XYZCT\"";
    assert_pages(
        write_ome("planes.ome.tif", pixels,
                  "<TiffData IFD=\"7\" FirstZ=\"1\" PlaneCount=\"1\"/><TiffData IFD=\"3\"/>"),
        (struct pel_load_options){0}, 2, (int[]){3, 7});
    assert_pages(write_ome("planes.ome.tif", pixels, "<TiffData IFD=\"4\" PlaneCount=\"2\"/>"),
                 (struct pel_load_options){0}, 2, (int[]){4, 5});
    assert_null(pel_tiff_load(write_ome("planes.ome.tif", pixels, "<TiffData IFD=\"4\"/>"), NULL));
    assert_non_null(strstr(pel_error_message(), "no page holds slice 1"));
    assert_null(pel_tiff_load(
        write_ome(
            "planes.ome.tif", pixels,
            "<TiffData PlaneCount=\"2\"><UUID FileName=\"b.tif\">urn:uuid:2</UUID></TiffData>"),
        NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_UNSUPPORTED);
}

static void test_ome_spacing(void **state) {
    (void)state;
    struct pel_volume *volume = load(write_ome(
        "spacing.ome.tif",
        "SizeZ=\"2\" SizeC=\"1\" SizeT=\"1\" DimensionOrder=\"XYZCT\" PhysicalSizeX=\"0.5\" "
        "PhysicalSizeY=\"250\" PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"2\" "
        "PhysicalSizeZUnit=\"\302\265m\"",
        "<TiffData PlaneCount=\"2\" IFD=\"0\"/>"));
    assert_spacing(volume, 0.5e-3, 0.25e-3, 2e-3);
    pel_volume_destroy(volume);
}

static void test_folder(void **state) {
    (void)state;
    const char *folder = test_temporary_path("slices");
    assert_int_equal(mkdir(folder, 0700), 0);
    const char *names[] = {"slices/slice1.tif", "slices/slice2.tif", "slices/slice10.TIF",
                           "slices/slice011.tif"};
    for (int i = 0; i < 4; i++)
        write_stack(names[i],
                    (struct recipe){.width = 4, .height = 1, .orientation = i == 2 ? 2 : 1});
    fclose(fopen(test_temporary_path("slices/._slice1.tif"), "w"));
    fclose(fopen(test_temporary_path("slices/notes.txt"), "w"));
    for (int way = 0; way < 2; way++) {
        struct pel_volume *volume = load(test_temporary_path(way ? "slices/slice*" : "slices"));
        assert_int_equal(volume->dims[2], 4);
        // Only slice10 is mirrored, and it is the third.
        for (int z = 0; z < 4; z++)
            assert_true(pel_volume_value(volume, 0, 0, z) == (z == 2 ? 3 : 0));
        pel_volume_destroy(volume);
    }
    write_stack("slices/slice3.tif", (struct recipe){.width = 5, .height = 1});
    assert_null(pel_tiff_load(test_temporary_path("slices"), NULL));
    assert_non_null(strstr(pel_error_message(), "slice3.tif"));
    assert_null(pel_tiff_load(test_temporary_path("slices/none*.tif"), NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

// ---- Broken files ------------------------------------------------------------------------------

static void add_page(TIFF *tiff, int width, int subfile) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, subfile);
    TIFFWriteScanline(tiff, (uint8_t[16]){0}, 0, 0);
    TIFFWriteDirectory(tiff);
}

static void test_unlike_pages(void **state) {
    (void)state;
    const char *path = test_temporary_path("unlike.tif");
    TIFF *tiff = TIFFOpen(path, "w");
    add_page(tiff, 8, 0);
    add_page(tiff, 4, FILETYPE_REDUCEDIMAGE);
    add_page(tiff, 8, 0);
    TIFFClose(tiff);
    struct pel_volume *volume = load(path);
    assert_int_equal(volume->dims[2], 2);
    pel_volume_destroy(volume);
    tiff = TIFFOpen(path, "a");
    add_page(tiff, 9, 0);
    TIFFClose(tiff);
    assert_null(pel_tiff_load(path, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    assert_non_null(strstr(pel_error_message(), "page 2: 9 x 1 pixels, the first page has 8 x 1"));
}

// A directory that claims 60000 x 60000 pixels, and one whose next directory is itself.
static void test_lies(void **state) {
    (void)state;
    const char *path = test_temporary_path("lie.tif");
    for (int loop = 0; loop < 2; loop++) {
        uint8_t side = loop ? 2 : 0;
        uint8_t file[] = {'I', 'I', 42,   0,
                          8,   0,   0,    0,
                          7,   0,   0,    1,
                          3,   0,   1,    0,
                          0,   0,   side, loop ? 0 : 0xea,
                          0,   0,   1,    1,
                          3,   0,   1,    0,
                          0,   0,   side, loop ? 0 : 0xea,
                          0,   0,   2,    1,
                          3,   0,   1,    0,
                          0,   0,   8,    0,
                          0,   0,   3,    1,
                          3,   0,   1,    0,
                          0,   0,   1,    0,
                          0,   0,   6,    1,
                          3,   0,   1,    0,
                          0,   0,   1,    0,
                          0,   0,   17,   1,
                          4,   0,   1,    0,
                          0,   0,   8,    0,
                          0,   0,   23,   1,
                          4,   0,   1,    0,
                          0,   0,   4,    0,
                          0,   0,   8,    0,
                          0,   0};
        if (!loop)
            memset(file + sizeof file - 4, 0, 4);
        FILE *stream = fopen(path, "wb");
        fwrite(file, 1, sizeof file, stream);
        fclose(stream);
        warning_count = 0;
        struct pel_volume *volume = pel_tiff_load(path, NULL);
        if (loop) {
            assert_non_null(volume);
            assert_int_equal(volume->dims[2], 1);
            assert_int_equal(warning_count, 1);
            pel_volume_destroy(volume);
        } else {
            assert_null(volume);
            assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
        }
    }
    assert_null(pel_tiff_load(test_temporary_path("missing.tif"), NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

// ---- Saving ------------------------------------------------------------------------------------

static void test_save(void **state) {
    (void)state;
    const char *path = test_temporary_path("saved.tif");
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        struct pel_volume *volume =
            pel_volume_create("saved", (int[]){33, 17, 5}, (enum pel_voxel_type)type);
        size_t bytes = pel_volume_bytes(volume);
        uint64_t seed = (uint64_t)type;
        for (size_t i = 0; i < bytes; i++)
            ((uint8_t *)volume->voxels)[i] = (uint8_t)(256 * test_random(&seed));
        if (type == PEL_VOXEL_F32)
            for (size_t i = 0; i < bytes / 4; i++)
                ((float *)volume->voxels)[i] = i % 7 ? (float)test_random(&seed) : NAN;
        volume->slope = 0.5, volume->intercept = -1024;
        strcpy(volume->unit, "HU");
        const double spacing[3] = {-0.7, -0.3, 1.3};
        for (int axis = 0; axis < 3; axis++)
            volume->world_from_voxel.m[axis][axis] = spacing[axis];
        warning_count = 0;
        assert_true(pel_tiff_save(volume, path));
        struct pel_volume *again = load(path);
        assert_int_equal(warning_count, 0);
        assert_int_equal(again->type, type);
        assert_memory_equal(again->voxels, volume->voxels, bytes);
        assert_spacing(again, 0.7, 0.3, 1.3);
        assert_true(again->slope == 0.5 && again->intercept == -1024);
        assert_string_equal(again->unit, "HU");
        pel_volume_destroy(again);
        pel_volume_destroy(volume);
    }
    struct pel_volume *volume = pel_volume_create("saved", (int[]){1, 1, 1}, PEL_VOXEL_U8);
    assert_false(pel_tiff_save(volume, test_temporary_path("no/such/folder.tif")));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    pel_volume_destroy(volume);
}

int main(void) {
    pel_on_warning(on_warning, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_greys),        cmocka_unit_test(test_few_bits),
        cmocka_unit_test(test_colours),      cmocka_unit_test(test_alpha),
        cmocka_unit_test(test_channels),     cmocka_unit_test(test_palettes),
        cmocka_unit_test(test_orientations), cmocka_unit_test(test_resolution),
        cmocka_unit_test(test_imagej),       cmocka_unit_test(test_imagej_one_page),
        cmocka_unit_test(test_ome_orders),   cmocka_unit_test(test_ome_planes),
        cmocka_unit_test(test_ome_spacing),  cmocka_unit_test(test_folder),
        cmocka_unit_test(test_unlike_pages), cmocka_unit_test(test_lies),
        cmocka_unit_test(test_save),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
