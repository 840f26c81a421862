// label_map.c - which files are taken as label maps: by what the file says, by name and values, or
// by choice.
#include "support/file.h"

#include "volume/label_map.h"

// Two boxes of labels in a background, or a pattern in which no two neighbours are the same.
static struct pel_volume *make(bool labels) {
    static const int dims[3] = {12, 6, 4};
    struct pel_volume *volume = pel_volume_create("made", dims, PEL_VOXEL_U8);
    unsigned char *voxels = volume->voxels;
    for (int i = 0; i < 12 * 6 * 4; i++) {
        int x = i % 12;
        voxels[i] = (unsigned char)(labels ? (x < 2 ? 0 : x < 7 ? 3 : 9) : 10 + i % 200);
    }
    return volume;
}

static bool loads_as_labels(const char *leaf, bool labels, enum pel_label_choice choice) {
    struct pel_volume *made = make(labels);
    assert_true(pel_volume_save(made, test_temporary_path(leaf)));
    pel_volume_destroy(made);
    struct pel_volume *loaded =
        pel_volume_load(test_temporary_path(leaf), &(struct pel_load_options){.labels = choice});
    assert_non_null(loaded);
    bool result = loaded->labels;
    pel_volume_destroy(loaded);
    return result;
}

static void test_words_of_names(void **state) {
    (void)state;
    static const char *const labels[] = {"labels.tif", "scan_label.nrrd", "a-seg-2.mhd",
                                         "Segmentation.seg.nrrd", "x/y/T1_Labels_256.tif"};
    static const char *const others[] = {
        "scan.tif", "segment.tif", "labelled.tif", "seg/scan.tif", "unlabel.tif", "", "bseg.tif"};
    for (size_t i = 0; i < sizeof labels / sizeof *labels; i++)
        if (!pel_path_names_labels(labels[i]))
            fail_msg("%s is not taken for labels", labels[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (pel_path_names_labels(others[i]))
            fail_msg("%s is taken for labels", others[i]);
}

static void test_values_decide(void **state) {
    (void)state;
    struct pel_volume *labels = make(true), *picture = make(false);
    assert_true(pel_volume_seems_labels(labels));
    assert_false(pel_volume_seems_labels(picture));
    // In another unit, or as fractions, numbers are measurements.
    labels->slope = 0.5;
    assert_false(pel_volume_seems_labels(labels));
    picture->labels = true;
    assert_true(pel_volume_seems_labels(picture));
    pel_volume_destroy(labels);
    pel_volume_destroy(picture);
}

static void test_name_and_values_agree(void **state) {
    (void)state;
    static const char *const formats[] = {"tif", "nrrd", "mha"};
    for (int i = 0; i < 3; i++) {
        char named[32], plain[32];
        snprintf(named, sizeof named, "a_labels.%s", formats[i]);
        snprintf(plain, sizeof plain, "a.%s", formats[i]);
        assert_true(loads_as_labels(named, true, PEL_LABELS_AUTO));
        assert_false(loads_as_labels(named, false, PEL_LABELS_AUTO));
        assert_false(loads_as_labels(plain, true, PEL_LABELS_AUTO));
        assert_true(loads_as_labels(plain, true, PEL_LABELS_YES));
        assert_false(loads_as_labels(named, true, PEL_LABELS_NO));
    }
}

static void test_colours_are_no_labels(void **state) {
    (void)state;
    static const int dims[3] = {2, 2, 2};
    struct pel_volume *made = pel_volume_create("made", dims, PEL_VOXEL_RGB8);
    memset(made->voxels, 7, 24);
    assert_true(pel_volume_save(made, test_temporary_path("colour.tif")));
    pel_volume_destroy(made);
    int before = test_warning_count();
    struct pel_volume *loaded = pel_volume_load(
        test_temporary_path("colour.tif"), &(struct pel_load_options){.labels = PEL_LABELS_YES});
    assert_non_null(loaded);
    assert_false(loaded->labels);
    assert_int_equal(test_warning_count(), before + 1);
    assert_string_equal(test_warning(), "colour.tif: its voxels are colours, not labels");
    pel_volume_destroy(loaded);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words_of_names),
        cmocka_unit_test(test_values_decide),
        cmocka_unit_test(test_name_and_values_agree),
        cmocka_unit_test_setup(test_colours_are_no_labels, test_watch_warnings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
