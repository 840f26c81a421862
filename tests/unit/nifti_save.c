// nifti_save.c - what is written as NIfTI is read back, and its qform says what its sform does.
#include "support/file.h"

#include <math.h>

static void test_round_trip(void **state) {
    (void)state;
    static const char *const leaves[] = {"trip.nii", "trip.nii.gz"};
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        for (int i = 0; i < 2; i++) {
            struct pel_volume *volume = test_small_volume((enum pel_voxel_type)type);
            bool colour = type >= PEL_VOXEL_RGB8;
            volume->slope = colour ? 1 : 0.5;
            volume->intercept = colour ? 0 : -1000;
            volume->labels = type == PEL_VOXEL_U16;
            strcpy(volume->space, "sform (mni)");
            if (!pel_volume_save(volume, test_temporary_path(leaves[i])))
                fail_msg("%s", pel_error_message());
            struct pel_volume *again = pel_volume_load(test_temporary_path(leaves[i]), NULL);
            if (!again)
                fail_msg("%s", pel_error_message());
            test_assert_same_volume(again, volume, 0);
            assert_true(again->slope == volume->slope && again->intercept == volume->intercept);
            assert_int_equal(again->labels, volume->labels);
            assert_string_equal(again->space, "sform (mni)");
            pel_volume_destroy(again);
            pel_volume_destroy(volume);
        }
    }
}

static void test_qform_of_saved_files(void **state) {
    (void)state;
    // A rotation by 30 degrees with spacing and a mirror: the quaternion can say all of it.
    struct pel_volume *volume = test_small_volume(PEL_VOXEL_U8);
    double c = cos(0.5235987755982988), s = 0.5;
    const double rows[3][4] = {{2 * c, -3 * s, 0, 1}, {2 * s, 3 * c, 0, 2}, {0, 0, -4, 3}};
    memcpy(volume->world_from_voxel.m, rows, sizeof rows);
    assert_true(pel_volume_save(volume, test_temporary_path("q.nii")));
    pel_volume_destroy(volume);
    struct test_bytes file = test_read(test_temporary_path("q.nii"));
    // sform_code to none, so that the qform is all there is.
    assert_int_equal(file.bytes[254], 1);
    file.bytes[254] = 0;
    volume = pel_volume_load(test_write("q.nii", file.bytes, file.count), NULL);
    assert_non_null(volume);
    assert_string_equal(volume->space, "qform (scanner)");
    test_assert_matrix(volume, rows, 1e-6);
    pel_volume_destroy(volume);
    test_release(&file);
}

static void test_long_axes_take_version_2(void **state) {
    (void)state;
    struct pel_volume *volume = pel_volume_create("long", (const int[]){40000, 1, 1}, PEL_VOXEL_U8);
    memset(volume->voxels, 3, 40000);
    assert_true(pel_volume_save(volume, test_temporary_path("long.nii")));
    struct test_bytes file = test_read(test_temporary_path("long.nii"));
    assert_int_equal(file.count, 544 + 40000);
    test_release(&file);
    struct pel_volume *again = pel_volume_load(test_temporary_path("long.nii"), NULL);
    assert_non_null(again);
    test_assert_same_volume(again, volume, 0);
    pel_volume_destroy(again);
    pel_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_qform_of_saved_files),
        cmocka_unit_test(test_long_axes_take_version_2),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
