// Tests of scenes made and changed by a program, of snapshots of them, and of undo.
#include "support/scene_file.h"
#include "viewer/history.h"

static struct pel_volume *make_volume(const char *name) {
    const int dims[3] = {4, 4, 4};
    struct pel_volume *volume = pel_volume_create(name, dims, PEL_VOXEL_U8);
    assert_non_null(volume);
    for (int i = 0; i < 64; i++)
        ((uint8_t *)volume->voxels)[i] = (uint8_t)(4 * i);
    return volume;
}

static struct pel_scene *make_scene(int volume_count) {
    struct pel_scene *scene = pel_scene_create();
    assert_non_null(scene);
    for (int i = 0; i < volume_count; i++) {
        char name[] = "a";
        name[0] += (char)i;
        struct pel_volume *volume = make_volume(name);
        assert_int_equal(pel_scene_add_volume(scene, volume, NULL), i);
        pel_volume_destroy(volume);
    }
    return scene;
}

// "abc": the names of the instances in their order, each checked to show the volume of that name.
static const char *names(const struct pel_scene *scene) {
    static char text[PEL_VOLUME_MAX + 1];
    for (int i = 0; i < scene->instance_count; i++) {
        const struct pel_instance *instance = &scene->instances[i];
        text[i] = instance->name[0];
        assert_string_equal(scene->volumes[instance->volume]->name, instance->name);
    }
    text[scene->instance_count] = '\0';
    return text;
}

static void test_add(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(1);
    assert_int_equal(scene->volume_count, 1);
    assert_non_null(scene->instances[0].transfer);
    assert_float_equal(scene->statistics[0].max, 252, 0);
    // The first volume brings a view, the second leaves it alone.
    struct pel_camera expected = {.fov_deg = scene->camera.fov_deg};
    struct pel_bounds bounds;
    assert_true(pel_scene_bounds(scene, &bounds));
    assert_true(pel_camera_fit(&expected, "oblique", &bounds, 1024.0 / 768));
    assert_memory_equal(scene->camera.eye, expected.eye, sizeof expected.eye);
    struct pel_volume *far = make_volume("far");
    far->world_from_voxel.m[0][3] = 1000;
    assert_int_equal(pel_scene_add_volume(scene, far, NULL), 1);
    pel_volume_destroy(far);
    assert_memory_equal(scene->camera.eye, expected.eye, sizeof expected.eye);
    pel_scene_destroy(scene);
}

static void test_add_file(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(0);
    const char *path = test_temporary_path("a.raw");
    struct pel_load_options options = {.raw = {.dims = {2, 3, 4}}};
    assert_int_equal(pel_scene_add_file(scene, path, &options), 0);
    assert_string_equal(scene->instances[0].name, "a.raw");
    assert_string_equal(scene->sources[0].file, path);
    assert_int_equal(pel_scene_add_file(scene, "nowhere.nii", NULL), -1);
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    assert_int_equal(scene->instance_count, 1);
    // What is read again is another volume for the renderer.
    uint64_t serial = scene->volumes[0]->serial;
    assert_true(pel_scene_reload(scene, 0));
    assert_true(scene->volumes[0]->serial > serial);
    assert_false(pel_scene_reload(scene, 1));
    pel_scene_destroy(scene);
    scene = make_scene(1);
    assert_false(pel_scene_reload(scene, 0));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_scene_destroy(scene);
}

static void test_full(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(1);
    for (int i = 1; i < PEL_VOLUME_MAX; i++)
        assert_int_equal(pel_scene_add_copy(scene, 0), i);
    assert_int_equal(pel_scene_add_copy(scene, 0), -1);
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_int_equal(scene->volume_count, 1);
    assert_ptr_not_equal(scene->instances[0].transfer, scene->instances[1].transfer);
    struct pel_volume *volume = make_volume("more");
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), -1);
    pel_volume_destroy(volume);
    pel_scene_destroy(scene);
}

static void test_remove_and_move(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(4);
    assert_true(pel_scene_move(scene, 0, 2));
    assert_string_equal(names(scene), "bcad");
    assert_true(pel_scene_move(scene, 3, 0));
    assert_string_equal(names(scene), "dbca");
    assert_true(pel_scene_remove(scene, 1));
    assert_string_equal(names(scene), "dca");
    assert_int_equal(scene->volume_count, 3);
    // A volume shown twice stays.
    assert_int_equal(pel_scene_add_copy(scene, 1), 3);
    assert_true(pel_scene_remove(scene, 1));
    assert_string_equal(names(scene), "dac");
    assert_int_equal(scene->volume_count, 3);
    assert_false(pel_scene_remove(scene, 3));
    assert_false(pel_scene_move(scene, 0, 3));
    assert_false(pel_scene_move(scene, -1, 0));
    assert_true(pel_scene_remove(scene, 0));
    assert_true(pel_scene_remove(scene, 0));
    assert_string_equal(names(scene), "c");
    assert_int_equal(scene->volume_count, 1);
    assert_false(pel_scene_remove(scene, 0));
    assert_string_equal(pel_error_message(), "the last volume cannot be removed");
    pel_scene_destroy(scene);
}

// A copy owns everything but the voxels, which live until the last of both is gone.
static void test_copy(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(2);
    struct pel_scene *copy = pel_scene_copy(scene);
    assert_non_null(copy);
    assert_ptr_equal(copy->volumes[1], scene->volumes[1]);
    copy->instances[0].transfer->opacities[0].opacity = 0.625;
    assert_true(scene->instances[0].transfer->opacities[0].opacity != 0.625);
    assert_true(pel_scene_remove(copy, 0));
    assert_string_equal(names(copy), "b");
    assert_string_equal(names(scene), "ab");
    pel_scene_destroy(scene);
    assert_int_equal(((uint8_t *)copy->volumes[0]->voxels)[63], 252);
    pel_scene_destroy(copy);
}

// ---- Keyframes
// -----------------------------------------------------------------------------------

static void test_keyframes(void **state) {
    (void)state;
    struct pel_scene *scene = pel_scene_load(
        test_write_scene("keyframes.json", "{" TEST_VOLUMES ", 'render': {'size': [32, 24]}}"),
        NULL, 0);
    assert_non_null(scene);
    struct pel_keyframe keyframes[3];
    for (int i = 0; i < 3; i++) {
        keyframes[i] = (struct pel_keyframe){.time_s = i, .camera = scene->camera};
        memcpy(keyframes[i].camera.eye, ((double[]){0, 100 + 100 * i, 0}), 3 * sizeof(double));
        memset(keyframes[i].camera.target, 0, 3 * sizeof(double));
        memcpy(keyframes[i].camera.up, ((double[]){0, 0, 1}), 3 * sizeof(double));
    }
    // What was changed before is what moves.
    scene->instances[0].density = 0.25;
    uint64_t serial = scene->volumes[0]->serial;
    assert_true(pel_scene_set_keyframes(scene, keyframes, 3, 10));
    assert_int_equal(scene->timeline.frame_count, 21);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 3; i++) {
            if (!pel_scene_set_frame(scene, 10 * i))
                fail_msg("%s", pel_error_message());
            assert_float_equal(scene->camera.eye[1], 100 + 100 * i, 1e-9);
        }
        assert_float_equal(scene->instances[0].density, 0.25, 0);
        // They can be read back, as they were put there and as they were saved.
        struct pel_keyframe read[2];
        assert_int_equal(pel_scene_keyframes(scene, read, 2), 3);
        for (int i = 0; i < 2; i++) {
            assert_float_equal(read[i].time_s, keyframes[i].time_s, 1e-12);
            assert_float_equal(read[i].camera.eye[1], keyframes[i].camera.eye[1], 1e-9);
            assert_float_equal(read[i].camera.fov_deg, keyframes[i].camera.fov_deg, 1e-9);
        }
        if (pass > 0)
            break;
        // Nothing is loaded anew; and saved, it is the same.
        assert_true(scene->volumes[0]->serial == serial);
        const char *path = test_temporary_path("recorded.json");
        assert_true(pel_scene_save(scene, path));
        pel_scene_destroy(scene);
        scene = pel_scene_load(path, NULL, 0);
        assert_non_null(scene);
    }
    // A change is lost with the next frame, unless the animation is made to act upon it.
    scene->instances[0].density = 0.5;
    assert_true(pel_scene_set_frame(scene, 3));
    assert_float_equal(scene->instances[0].density, 0.25, 0);
    scene->instances[0].density = 0.5;
    assert_true(pel_scene_rebase(scene));
    assert_true(pel_scene_set_frame(scene, 10));
    assert_float_equal(scene->instances[0].density, 0.5, 0);
    assert_float_equal(scene->camera.eye[1], 200, 1e-9);
    keyframes[2].time_s = 1;
    assert_false(pel_scene_set_keyframes(scene, keyframes, 3, 10));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_false(pel_scene_set_keyframes(scene, keyframes, 2, 0));
    assert_int_equal(scene->timeline.frame_count, 21);
    assert_true(pel_scene_set_keyframes(scene, NULL, 0, 10));
    assert_int_equal(scene->timeline.frame_count, 0);
    assert_int_equal(pel_scene_keyframes(scene, NULL, 0), 0);
    assert_false(pel_scene_set_frame(scene, 0));
    pel_scene_destroy(scene);
}

// ---- Undo
// ----------------------------------------------------------------------------------------

static double density(struct pel_history *history, struct pel_scene *(*go)(struct pel_history *)) {
    struct pel_scene *scene = go(history);
    if (!scene)
        return -1;
    double value = scene->instances[0].density;
    pel_scene_destroy(scene);
    return value;
}

static void record(struct pel_history *history, struct pel_scene *scene, double value,
                   uint64_t merge) {
    char what[32];
    snprintf(what, sizeof what, "density %g", value);
    scene->instances[0].density = value;
    assert_true(pel_history_record(history, scene, what, merge));
}

static void test_undo(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(1);
    struct pel_history *history = pel_history_create(scene, 100);
    assert_non_null(history);
    assert_null(pel_history_undo_name(history));
    assert_true(pel_history_is_saved(history));
    record(history, scene, 2, 0);
    record(history, scene, 3, 0);
    assert_false(pel_history_is_saved(history));
    assert_string_equal(pel_history_undo_name(history), "density 3");
    assert_float_equal(density(history, pel_history_undo), 2, 0);
    assert_string_equal(pel_history_redo_name(history), "density 3");
    assert_float_equal(density(history, pel_history_undo), 1, 0);
    assert_true(pel_history_is_saved(history));
    assert_float_equal(density(history, pel_history_undo), -1, 0);
    assert_float_equal(density(history, pel_history_redo), 2, 0);
    // A change forgets what was undone.
    record(history, scene, 7, 0);
    assert_null(pel_history_redo_name(history));
    assert_float_equal(density(history, pel_history_redo), -1, 0);
    assert_float_equal(density(history, pel_history_undo), 2, 0);
    pel_history_destroy(history);
    pel_scene_destroy(scene);
}

static void test_merging(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(1);
    struct pel_history *history = pel_history_create(scene, 100);
    // A drag is one step, a second one of the same thing another.
    for (int i = 0; i < 5; i++)
        record(history, scene, 2 + i, 9);
    pel_history_settle(history);
    for (int i = 0; i < 5; i++)
        record(history, scene, 20 + i, 9);
    record(history, scene, 30, 8);
    assert_float_equal(density(history, pel_history_undo), 24, 0);
    assert_float_equal(density(history, pel_history_undo), 6, 0);
    // Going back and forth ends a drag, too.
    record(history, scene, 50, 9);
    assert_float_equal(density(history, pel_history_undo), 6, 0);
    assert_float_equal(density(history, pel_history_undo), 1, 0);
    // What was saved in the middle of a drag is not what comes after it.
    record(history, scene, 2, 5);
    pel_history_mark_saved(history);
    record(history, scene, 3, 5);
    assert_false(pel_history_is_saved(history));
    assert_float_equal(density(history, pel_history_undo), 2, 0);
    assert_true(pel_history_is_saved(history));
    pel_history_destroy(history);
    pel_scene_destroy(scene);
}

static void test_bounded(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene(1);
    struct pel_history *history = pel_history_create(scene, 3);
    for (int i = 2; i < 20; i++)
        record(history, scene, i, 0);
    assert_float_equal(density(history, pel_history_undo), 18, 0);
    assert_float_equal(density(history, pel_history_undo), 17, 0);
    assert_float_equal(density(history, pel_history_undo), 16, 0);
    assert_float_equal(density(history, pel_history_undo), -1, 0);
    assert_false(pel_history_is_saved(history));
    // A removed volume can be brought back although nothing else holds it.
    struct pel_volume *volume = make_volume("z");
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), 1);
    pel_volume_destroy(volume);
    assert_true(pel_history_record(history, scene, "add z", 0));
    assert_true(pel_scene_remove(scene, 1));
    assert_true(pel_history_record(history, scene, "remove z", 0));
    struct pel_scene *back = pel_history_undo(history);
    assert_string_equal(names(back), "az");
    assert_int_equal(((uint8_t *)back->volumes[1]->voxels)[63], 252);
    pel_scene_destroy(back);
    pel_history_destroy(history);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_add),     cmocka_unit_test(test_add_file),
        cmocka_unit_test(test_full),    cmocka_unit_test(test_remove_and_move),
        cmocka_unit_test(test_copy),    cmocka_unit_test(test_keyframes),
        cmocka_unit_test(test_undo),    cmocka_unit_test(test_merging),
        cmocka_unit_test(test_bounded),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
