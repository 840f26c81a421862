// torture_tiff.c - whatever is in a file, it becomes a volume or a sentence: in seconds, without a
// crash, and without memory the file cannot justify. The files are two collections of odd and
// broken TIFFs, and truncations and bit flips of small good ones made here.
#include "support/test.h"

#include <ftw.h>
#include <sys/resource.h>
#include <tiffio.h>
#include <unistd.h>

#include "volume/volume.h"

enum { SECONDS_PER_FILE = 10, FLIPS = 2000, FILE_MAX_BYTES = 1 << 16 };

// Address space of the whole process; sanitizers reserve terabytes and cannot live with a limit.
#if defined(__SANITIZE_ADDRESS__)
enum { LIMIT_MEGABYTES = 0 };
#else
enum { LIMIT_MEGABYTES = 768 };
#endif

static int opened, refused;

static void try_file(const char *path, bool verbose) {
    const struct pel_load_options choices[] = {{0}, {.split_channels = true}};
    for (int i = 0; i < 2; i++) {
        alarm(SECONDS_PER_FILE);
        struct pel_volume *volume = pel_tiff_load(path, &choices[i]);
        alarm(0);
        if (volume) {
            // Every voxel can be read.
            struct pel_statistics statistics;
            pel_volume_measure(volume, &statistics);
            assert_true(statistics.count + statistics.absent_count ==
                        pel_volume_voxel_count(volume));
        } else {
            assert_true(pel_error_code() != PEL_OK && pel_error_message()[0]);
            assert_int_not_equal(pel_error_code(), PEL_ERROR_MEMORY);
            if (verbose && i == 0)
                print_message("refused: %s\n", pel_error_message());
        }
        if (i == 0) {
            opened += volume != NULL;
            refused += volume == NULL;
        }
        pel_volume_destroy(volume);
    }
}

static int visit(const char *path, const struct stat *status, int kind, struct FTW *level) {
    (void)status, (void)level;
    if (kind == FTW_F && strstr(path, ".tif"))
        try_file(path, true);
    return 0;
}

static void try_folder(const char *relative, int least_opened) {
    opened = refused = 0;
    assert_int_equal(nftw(test_data_path(relative), visit, 8, FTW_PHYS), 0);
    print_message("%s: %d opened, %d refused\n", relative, opened, refused);
    assert_true(opened >= least_opened);
}

static void test_pillow(void **state) {
    (void)state;
    try_folder("data/torture_tiff_pillow", 80);
}

static void test_image_tiff(void **state) {
    (void)state;
    try_folder("data/torture_tiff_imagetiff", 120);
}

// ---- Damage ------------------------------------------------------------------------------------

// Small stacks that between them use strips, tiles, separate planes, most codes and both sizes.
static void write_seed(const char *path, int seed) {
    static const int codes[] = {COMPRESSION_NONE,     COMPRESSION_LZW,  COMPRESSION_ADOBE_DEFLATE,
                                COMPRESSION_PACKBITS, COMPRESSION_JPEG, COMPRESSION_CCITTFAX4,
                                COMPRESSION_ZSTD};
    int code = codes[seed];
    bool fax = code == COMPRESSION_CCITTFAX4, jpeg = code == COMPRESSION_JPEG;
    int samples = seed % 3 == 2 ? 3 : 1, bits = fax ? 1 : jpeg ? 8 : seed % 2 ? 16 : 8;
    TIFF *tiff = TIFFOpen(path, seed == 2 ? "w8" : seed == 1 ? "wb" : "w");
    for (int page = 0; page < 2; page++) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 20);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 18);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, code);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                     jpeg && samples == 3 ? PHOTOMETRIC_YCBCR
                     : samples == 3       ? PHOTOMETRIC_RGB
                                          : PHOTOMETRIC_MINISBLACK);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG,
                     samples == 3 && !jpeg ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 8);
        if (page == 0 && seed == 0)
            TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION,
                         "<OME><Image><Pixels SizeZ=\"2\" SizeC=\"1\" SizeT=\"1\" "
                         "DimensionOrder=\"XYZCT\"><TiffData IFD=\"0\" PlaneCount=\"2\"/></Pixels>"
                         "</Image></OME>");
        if (page == 0 && seed == 3)
            TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, "ImageJ=1\nimages=2\nslices=2\nunit=mm\n");
        uint8_t row[256];
        for (int plane = 0; plane < (samples == 3 && !jpeg ? 3 : 1); plane++)
            for (int y = 0; y < 18; y++) {
                for (size_t i = 0; i < sizeof row; i++)
                    row[i] = (uint8_t)(i * i + (size_t)(y * plane));
                TIFFWriteScanline(tiff, row, (uint32_t)y, (uint16_t)plane);
            }
        TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
}

static void write_bytes(const char *path, const uint8_t *bytes, size_t count) {
    FILE *stream = fopen(path, "wb");
    assert_int_equal(fwrite(bytes, 1, count, stream), count);
    fclose(stream);
}

static void test_damage(void **state) {
    (void)state;
    opened = refused = 0;
    uint64_t random = 20;
    for (int seed = 0; seed < 7; seed++) {
        const char *path = test_temporary_path("seed.tif");
        write_seed(path, seed);
        int refused_before = refused;
        try_file(path, true);
        assert_int_equal(refused, refused_before);
        static uint8_t good[FILE_MAX_BYTES], bad[FILE_MAX_BYTES];
        FILE *stream = fopen(path, "rb");
        size_t count = fread(good, 1, sizeof good, stream);
        fclose(stream);
        const char *damaged = test_temporary_path("damaged.tif");
        for (size_t length = 0; length < count; length += 1 + count / 200) {
            write_bytes(damaged, good, length);
            try_file(damaged, false);
        }
        for (int flip = 0; flip < FLIPS / 7; flip++) {
            memcpy(bad, good, count);
            for (int n = 0; n <= flip % 3; n++)
                bad[(size_t)(test_random(&random) * (double)count)] ^=
                    (uint8_t)(1 << (int)(8 * test_random(&random)));
            write_bytes(damaged, bad, count);
            try_file(damaged, false);
        }
    }
    print_message("damaged: %d opened, %d refused\n", opened, refused);
}

int main(void) {
    if (LIMIT_MEGABYTES > 0) {
        rlim_t bytes = (rlim_t)LIMIT_MEGABYTES << 20;
        setrlimit(RLIMIT_AS, &(struct rlimit){bytes, bytes});
    }
    test_need_data("data/torture_tiff_pillow");
    test_need_data("data/torture_tiff_imagetiff");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pillow),
        cmocka_unit_test(test_image_tiff),
        cmocka_unit_test(test_damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
