// tiff.c - TIFF stacks from other programs open with the dimensions, type and spacing they have
// there.
#include "support/test.h"

#include <math.h>

#include "volume/volume.h"

static const struct {
    const char *path;
    struct pel_load_options options;
    int dims[3];
    enum pel_voxel_type type;
    double spacing_mm;
    double least, greatest; // of the values; NaN where nobody told
} cases[] = {
    // SOURCE.txt: "psf 150x150x41 float32"; all of its numbers are NaN.
    {"data/tiff_microscopy/psf.tif", {0}, {150, 150, 41}, PEL_VOXEL_F32, 1, 0, 0},
    // int32 labels, which all fit int16.
    {"data/tiff_microscopy/Platynereis_labels_256x256x103.tif",
     {0},
     {256, 256, 103},
     PEL_VOXEL_I16,
     1,
     NAN,
     NAN},
    // An ImageJ composite of three channels, 19.4201 pixels per micrometre.
    {"data/tiff_microscopy/hela-cells.tif",
     {0},
     {672, 512, 1},
     PEL_VOXEL_U16,
     1e-3 / 19.42008,
     NAN,
     NAN},
    {"data/tiff_microscopy/hela-cells.tif",
     {.split_channels = true, .channel = 2},
     {672, 512, 1},
     PEL_VOXEL_U16,
     1e-3 / 19.42008,
     NAN,
     NAN},
    {"data/tiff_timeseries/4D-series.ome.tif", {0}, {439, 167, 5}, PEL_VOXEL_I8, 1, NAN, NAN},
    {"data/tiff_timeseries/4D-series.ome.tif",
     {.time = 6},
     {439, 167, 5},
     PEL_VOXEL_I8,
     1,
     NAN,
     NAN},
    {"data/tiff_timeseries/z-series.ome.tif", {0}, {439, 167, 5}, PEL_VOXEL_I8, 1, NAN, NAN},
    {"data/tiff_timeseries/multi-channel-z-series.ome.tif",
     {.channel = 2},
     {439, 167, 5},
     PEL_VOXEL_I8,
     1,
     NAN,
     NAN},
    {"data/tiff_timeseries/multi-channel-time-series.ome.tif",
     {.channel = 2, .time = 6},
     {439, 167, 1},
     PEL_VOXEL_I8,
     1,
     NAN,
     NAN},
    // 72 pixels per inch, a palette of greys that spans 0..255.
    {"data/tiff_timeseries/mri.tif", {0}, {128, 128, 27}, PEL_VOXEL_U8, 1, 0, 255},
    {"data/tiff_timeseries/shapes_hyper.tif",
     {.channel = 6},
     {128, 72, 1},
     PEL_VOXEL_F32,
     1,
     0.5,
     0.5},
};

static void test_volumes(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct pel_volume *volume = pel_tiff_load(test_data_path(cases[c].path), &cases[c].options);
        if (!volume)
            print_message("%s\n", pel_error_message());
        assert_non_null(volume);
        assert_memory_equal(volume->dims, cases[c].dims, sizeof cases[c].dims);
        assert_int_equal(volume->type, cases[c].type);
        double spacing[3];
        pel_volume_spacing(volume, spacing);
        for (int axis = 0; axis < 3; axis++)
            assert_float_equal(spacing[axis] / cases[c].spacing_mm, 1, 1e-5);
        struct pel_statistics statistics;
        pel_volume_measure(volume, &statistics);
        if (!isnan(cases[c].least))
            assert_true(statistics.min == cases[c].least && statistics.max == cases[c].greatest);
        else
            assert_true(statistics.max > statistics.min);
        pel_volume_destroy(volume);
    }
}

// A label image keeps its labels.
static void test_labels(void **state) {
    (void)state;
    struct pel_volume *volume = pel_tiff_load(
        test_data_path("data/tiff_microscopy/Platynereis_labels_256x256x103.tif"), NULL);
    struct pel_statistics statistics;
    pel_volume_measure(volume, &statistics);
    assert_true(statistics.min == 0 && statistics.max == 37);
    pel_volume_destroy(volume);
}

// Other choices of what is in a file are refused with what there is.
static void test_choices(void **state) {
    (void)state;
    const char *path = test_data_path("data/tiff_timeseries/multi-channel-time-series.ome.tif");
    assert_null(pel_tiff_load(path, &(struct pel_load_options){.time = 7}));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_non_null(strstr(pel_error_message(), "no time step 7, the file has 7"));
    assert_null(pel_tiff_load(path, &(struct pel_load_options){.channel = 3}));
    assert_non_null(strstr(pel_error_message(), "no channel 3, the file has 3"));
}

int main(void) {
    test_need_data("data/tiff_microscopy/psf.tif");
    test_need_data("data/tiff_timeseries/mri.tif");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volumes),
        cmocka_unit_test(test_labels),
        cmocka_unit_test(test_choices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
