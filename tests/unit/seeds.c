// seeds.c - what tests/fuzz/make_corpus.py wrote, read back: its writers and our readers know
// nothing of each other.
#include "support/test.h"

#include "support/near.h"

static struct pel_volume *load_seed(const char *seed) {
    char path[512];
    snprintf(path, sizeof path, "%s/tests/fuzz/corpus/%s", TEST_SOURCE, seed);
    struct pel_volume *volume = pel_volume_load(path, NULL);
    if (!volume)
        fail_msg("%s", pel_error_message());
    return volume;
}

// The bytes 0 to 23 as 2 x 3 x 4 voxels, however they are wrapped.
static void test_bytes(void **state) {
    (void)state;
    static const char *const seeds[] = {
        "nrrd/raw",        "nrrd/raw_end",
        "nrrd/gzip",       "nrrd/gzip_skip",
        "nrrd/gzip_end",   "nrrd/gzip_lines",
        "nrrd/bzip2",      "nrrd/bzip2_end",
        "nifti/u8",        "nifti/version2",
        "nifti/extension", "metaimage/u8",
        "metaimage/zlib",  "metaimage/header_size",
        "pvm/one",         "pvm/comment",
        "pvm/three",       "pvm/dds",
    };
    for (size_t s = 0; s < sizeof seeds / sizeof *seeds; s++) {
        struct pel_volume *volume = load_seed(seeds[s]);
        assert_int_equal(volume->type, PEL_VOXEL_U8);
        assert_int_equal(volume->dims[0], 2);
        assert_int_equal(volume->dims[1], 3);
        assert_int_equal(volume->dims[2], 4);
        for (int i = 0; i < 24; i++)
            if (((uint8_t *)volume->voxels)[i] != i)
                fail_msg("%s: voxel %d is %d", seeds[s], i, ((uint8_t *)volume->voxels)[i]);
        pel_volume_destroy(volume);
    }
}

// Two-byte voxels of PVM: the file's bytes are -100, -50 ... little endian, PVM's are big.
static void test_shorts(void **state) {
    (void)state;
    static const char *const seeds[] = {"pvm/two", "pvm/dds_skip", "pvm/dds_block"};
    for (size_t s = 0; s < sizeof seeds / sizeof *seeds; s++) {
        struct pel_volume *volume = load_seed(seeds[s]);
        assert_int_equal(volume->type, PEL_VOXEL_U16);
        for (int i = 0; i < 24; i++) {
            uint16_t value = (uint16_t)(-100 + 50 * i);
            assert_int_equal(((uint16_t *)volume->voxels)[i], (uint16_t)(value << 8 | value >> 8));
        }
        double spacing[3];
        pel_volume_spacing(volume, spacing);
        assert_near(spacing[1], 1.5, 1e-9);
        pel_volume_destroy(volume);
    }
}

// What libraries cannot be trusted with is refused in words.
static void test_refusals(void **state) {
    (void)state;
    static const char *const seeds[][2] = {
        {"nrrd/regress_kinds_first", "'kinds: domain' stands before the dimension"},
        {"nrrd/regress_quote", "a quote without end in 'labels: \"a\" \"b\" \"c'"},
        {"nrrd/regress_space_units", "4 space units for 3 dimensions of space"},
        {"nrrd/regress_kind_size", "axis 0 has 6 elements, its kind RGB-color needs 3"},
        {"nrrd/regress_magic", "its first line is none of NRRD0001 to NRRD0005"},
        {"nrrd/regress_return", "a carriage return within a header line"},
        {"nrrd/regress_zero", "a zero byte in its header"},
        {"nrrd/regress_bzip2", "compressed data is damaged after 24 bytes"},
    };
    for (size_t s = 0; s < sizeof seeds / sizeof *seeds; s++) {
        char path[512];
        snprintf(path, sizeof path, "%s/tests/fuzz/corpus/%s", TEST_SOURCE, seeds[s][0]);
        assert_null(pel_volume_load(path, NULL));
        assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
        assert_string_equal(pel_error_message() + strlen(path) + 2, seeds[s][1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_shorts),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
