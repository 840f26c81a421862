// Tests of good scene files: they become the structs that follow from their numbers by hand.
#include <math.h>

#include "support/scene_file.h"

static struct pel_scene *load(const char *quoted) {
    struct pel_scene *scene = pel_scene_load(test_write_scene("scene.json", quoted), NULL, 0);
    if (!scene)
        fail_msg("%s\n%s", quoted, pel_error_message());
    return scene;
}

static void assert_triple(const double got[3], double x, double y, double z) {
    const double wanted[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        assert_float_equal(got[i], wanted[i], 1e-9);
}

static void assert_matrix(const struct pel_matrix *got, const double wanted[12]) {
    for (int i = 0; i < 12; i++)
        assert_float_equal(got->m[i / 4][i % 4], wanted[i], 1e-9);
    for (int i = 0; i < 4; i++)
        assert_float_equal(got->m[3][i], i == 3, 0);
}

// ---- Good scenes -------------------------------------------------------------------------------

static void test_defaults(void **state) {
    (void)state;
    struct pel_scene *scene = load("{" TEST_VOLUMES "}");
    assert_int_equal(scene->volume_count, 1);
    assert_int_equal(scene->instance_count, 1);
    assert_int_equal(scene->volumes[0]->dims[2], 4);
    assert_float_equal(scene->statistics[0].max, 23, 0);
    const struct pel_instance *instance = &scene->instances[0];
    assert_string_equal(instance->name, "a.raw");
    assert_false(instance->hidden);
    assert_float_equal(instance->density, 1, 0);
    assert_int_equal(instance->extent, PEL_EXTENT_CELL);
    assert_int_equal(instance->filter, PEL_FILTER_LINEAR);
    assert_non_null(instance->transfer);
    assert_int_equal(instance->transfer->scale, PEL_VALUES_ABSOLUTE);
    assert_matrix(&instance->transform, (double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    assert_int_equal(scene->render.width, 1024);
    assert_int_equal(scene->render.height, 768);
    assert_int_equal(scene->render.mixing, PEL_MIX_SUM);
    assert_float_equal(scene->render.step, 0.5, 0);
    assert_float_equal(scene->render.phase, 0.5, 0);
    assert_float_equal(scene->render.termination, 0.99, 0);
    assert_int_equal(scene->render.origin, PEL_ORIGIN_VOLUMES);
    assert_true(scene->render.supersampling.n <= 1);
    assert_int_equal(scene->render.supersampling.pattern, PEL_PATTERN_REGULAR);
    assert_int_equal(scene->render.supersampling.filter, PEL_RECONSTRUCTION_BOX);
    assert_float_equal(scene->render.supersampling.adaptive, 0, 0);
    assert_false(scene->render.jitter);
    assert_int_equal(scene->output.depth, 8);
    assert_string_equal(scene->output.path, "");
    assert_triple(scene->background, 0, 0, 0);
    assert_float_equal(scene->background[3], 1, 0);
    // The fitted camera looks at the middle of the box.
    assert_triple(scene->camera.target, 0.5, 1, 1.5);
    assert_false(scene->camera.orthographic);
    pel_scene_destroy(scene);
}

static void test_stereo(void **state) {
    (void)state;
    struct pel_scene *scene = load("{" TEST_VOLUMES "}");
    assert_int_equal(scene->stereo.kind, PEL_STEREO_NONE);
    pel_scene_destroy(scene);

    scene = load("{'stereo': {'kind': 'dubois-green-magenta', 'separation': 'automatic', "
                 "'convergence': 300, 'swap': true, 'toe_in': true}, " TEST_VOLUMES "}");
    assert_int_equal(scene->stereo.kind, PEL_STEREO_DUBOIS_GREEN_MAGENTA);
    assert_float_equal(scene->stereo.separation_mm, 0, 0);
    assert_float_equal(scene->stereo.convergence_mm, 300, 0);
    assert_true(scene->stereo.swap && scene->stereo.toe_in && !scene->stereo.flat);
    pel_scene_destroy(scene);

    // A separation of 0 is one, and not the automatic one.
    scene = load("{'stereo': {'kind': 'matrix', 'separation': 0, 'matrix': [[1, 0, 0, 0, 0, 0], "
                 "[0, 0, 0, 0, 1, 0], [0, -0.5, 0, 0, 0, 1.5]]}, " TEST_VOLUMES "}");
    assert_true(scene->stereo.flat);
    assert_float_equal(scene->stereo.matrix[1][4], 1, 0);
    assert_float_equal(scene->stereo.matrix[2][1], -0.5, 0);
    assert_float_equal(scene->stereo.matrix[2][5], 1.5, 0);
    pel_scene_destroy(scene);
}

// Volumes take the scene's filter and gradient unless they have their own.
static void test_usual(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'render': {'filter': 'catmull-rom', 'gradient': 'sobel'}, 'volumes': "
             "[{" TEST_VOLUME "}, {" TEST_VOLUME ", 'filter': 'linear', 'gradient': 'analytic'}, "
             "{'generate': {'kind': 'head-labels', 'size': 4}}]}");
    assert_int_equal(scene->instances[0].filter, PEL_FILTER_CATMULL_ROM);
    assert_int_equal(scene->instances[0].gradient, PEL_GRADIENT_SOBEL);
    assert_int_equal(scene->instances[1].filter, PEL_FILTER_LINEAR);
    assert_int_equal(scene->instances[1].gradient, PEL_GRADIENT_ANALYTIC);
    // Between labels there is nothing.
    assert_int_equal(scene->instances[2].filter, PEL_FILTER_NEAREST);
    assert_int_equal(scene->instances[2].gradient, PEL_GRADIENT_SOBEL);
    pel_scene_destroy(scene);
}

static void test_supersampling(void **state) {
    (void)state;
    static const char *const names[] = {"regular", "jittered", "n-rooks", "multi-jittered",
                                        "hammersley"};
    for (int pattern = PEL_PATTERN_REGULAR; pattern <= PEL_PATTERN_HAMMERSLEY; pattern++) {
        char text[512];
        snprintf(text, sizeof text,
                 "{'render': {'supersampling': {'n': 4, 'pattern': '%s', 'filter': 'gaussian', "
                 "'seed': 2147483647, 'adaptive': 0.125}, 'jitter': true}, " TEST_VOLUMES "}",
                 names[pattern]);
        struct pel_scene *scene = load(text);
        const struct pel_supersampling *supersampling = &scene->render.supersampling;
        assert_int_equal(supersampling->n, 4);
        assert_int_equal(supersampling->pattern, pattern);
        assert_int_equal(supersampling->filter, PEL_RECONSTRUCTION_GAUSSIAN);
        assert_int_equal(supersampling->seed, 2147483647);
        assert_float_equal(supersampling->adaptive, 0.125, 0);
        assert_true(scene->render.jitter);
        pel_scene_destroy(scene);
    }
}

static void test_settings(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'$schema': 'scene.schema.json', 'comment': 'all of it', 'background': '#ff8000', "
             "'render': {'size': [320, 200], 'mixing': 'over', 'step': 0.25, 'phase': 0, "
             "'termination': 1, 'origin': 'bounds'}, "
             "'output': {'file': 'out/p.png', 'depth': 16, 'alpha': 'premultiplied'}, " TEST_VOLUMES
             "}");
    assert_triple(scene->background, 1, 128 / 255.0, 0);
    assert_int_equal(scene->render.width, 320);
    assert_int_equal(scene->render.height, 200);
    assert_int_equal(scene->render.mixing, PEL_MIX_OVER);
    assert_float_equal(scene->render.step, 0.25, 0);
    assert_float_equal(scene->render.phase, 0, 0);
    assert_float_equal(scene->render.termination, 1, 0);
    assert_int_equal(scene->render.origin, PEL_ORIGIN_BOUNDS);
    assert_string_equal(scene->output.path, test_temporary_path("out/p.png"));
    assert_int_equal(scene->output.depth, 16);
    assert_true(scene->output.premultiplied);
    pel_scene_destroy(scene);
}

static void test_backgrounds(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double rgba[4];
    } cases[] = {
        {"'#ffffff'", {1, 1, 1, 1}},
        {"'none'", {0, 0, 0, 0}},
        {"'#00ff0000'", {0, 1, 0, 0}},
        {"[0.25, 0.5, 0.75]", {0.25, 0.5, 0.75, 1}},
        {"[0.25, 0.5, 0.75, 0.5]", {0.25, 0.5, 0.75, 0.5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[256];
        snprintf(text, sizeof text, "{'background': %s, " TEST_VOLUMES "}", cases[i].text);
        struct pel_scene *scene = load(text);
        assert_memory_equal(scene->background, cases[i].rgba, sizeof cases[i].rgba);
        pel_scene_destroy(scene);
    }
}

static void test_camera(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'camera': {'eye': [10, 20, 30], 'target': [1, 2, 3], 'up': [0, 1, 0], 'fov': 45, "
             "'shift': [0.5, -0.25]}, " TEST_VOLUMES "}");
    assert_triple(scene->camera.eye, 10, 20, 30);
    assert_triple(scene->camera.target, 1, 2, 3);
    assert_triple(scene->camera.up, 0, 1, 0);
    assert_float_equal(scene->camera.fov_deg, 45, 0);
    assert_float_equal(scene->camera.shift[0], 0.5, 0);
    assert_float_equal(scene->camera.shift[1], -0.25, 0);
    pel_scene_destroy(scene);

    scene = load("{'camera': {'view': 'anterior', 'orthographic': true, 'height': 7}, " TEST_VOLUMES
                 "}");
    assert_true(scene->camera.orthographic);
    assert_float_equal(scene->camera.height_mm, 7, 0);
    // Seen from the front: along -y through the middle of the box.
    assert_float_equal(scene->camera.eye[0], 0.5, 1e-9);
    assert_float_equal(scene->camera.eye[2], 1.5, 1e-9);
    assert_true(scene->camera.eye[1] > 2.5);
    pel_scene_destroy(scene);

    // Looking straight down without an up: one is found.
    scene = load("{'camera': {'eye': [0, 0, 9], 'target': [0, 0, 0]}, " TEST_VOLUMES "}");
    assert_triple(scene->camera.up, 0, 1, 0);
    pel_scene_destroy(scene);

    // A view of one of two volumes.
    scene = load("{'camera': {'view': 'left', 'fit': 'second'}, 'volumes': [{" TEST_VOLUME "}, {"
                 "'name': 'second', 'transform': {'translate': [100, 0, 0]}, " TEST_VOLUME "}]}");
    assert_triple(scene->camera.target, 100.5, 1, 1.5);
    pel_scene_destroy(scene);
}

// A ball of 24 mm in a box of 64 mm, and a corner of a volume: only what shows fills the picture.
static void test_visible_fit(void **state) {
    (void)state;
    static const char *const views[] = {"superior", "left", "oblique"};
    for (int i = 0; i < 3; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "{'camera': {'view': '%s', 'fit': 'visible', 'orthographic': true},"
                 " 'render': {'size': [100, 100]},"
                 " 'volumes': [{'generate': {'kind': 'sphere', 'size': 33}, 'transfer':"
                 " {'opacities': [[0, 0], [0.001, 1]], 'colours': [[0, '#ffffff']]}}]}",
                 views[i]);
        struct pel_scene *scene = load(text);
        assert_triple(scene->camera.target, 0, 0, 0);
        // A voxel less than the ball, and as much more as an octagon has around a circle.
        double radius = scene->camera.height_mm / 2 * 0.95;
        assert_true(radius > 24 - 2 && radius < 24 / cos(3.14159265358979 / 8) + 0.1);
        pel_scene_destroy(scene);
    }
    // Of the values 0..23 only those from 18 on, which are the last slice; then nothing at all.
    struct pel_scene *scene = load("{'camera': {'fit': 'visible'}, 'volumes': [{" TEST_VOLUME
                                   ", 'transfer': {'opacities': [[17, 0], [18, 1]],"
                                   " 'colours': [[0, '#ffffff']]}}]}");
    assert_triple(scene->camera.target, 0.5, 1, 3);
    pel_scene_destroy(scene);
    scene = load("{'camera': {'fit': 'visible'}, 'volumes': [{" TEST_VOLUME
                 ", 'transfer': {'opacities': [[17, 0]], 'colours': [[0, '#ffffff']]}}]}");
    assert_triple(scene->camera.target, 0.5, 1, 1.5);
    pel_scene_destroy(scene);
}

static void test_transforms(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double matrix[12];
    } cases[] = {
        {"[[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]",
         {0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7}},
        // A half turn about x: w = cos 90 = 0.
        {"{'quaternion': [1, 0, 0, 0], 'translation': [1, 2, 3]}",
         {1, 0, 0, 1, 0, -1, 0, 2, 0, 0, -1, 3}},
        {"{'translate': [4, 5, 6]}", {1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6}},
        // x goes to y, y to -x.
        {"{'rotate': {'axis': 'z', 'degrees': 90}}", {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0}},
        {"{'rotate': {'axis': [0, 0, 2], 'degrees': 90}, 'translate': [1, 0, 0]}",
         {0, -1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0}},
        // (10,0,0) stays: p' = R (p - a) + a, R a = (0,10,0).
        {"{'rotate': {'axis': 'z', 'degrees': 90, 'about': [10, 0, 0]}}",
         {0, -1, 0, 10, 1, 0, 0, -10, 0, 0, 1, 0}},
        // The box's centre (0.5, 1, 1.5) stays: R c = (-1, 0.5, 1.5).
        {"{'rotate': {'axis': 'z', 'degrees': 90, 'about': 'centre'}}",
         {0, -1, 0, 1.5, 1, 0, 0, 0.5, 0, 0, 1, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "{'volumes': [{'transform': %s, " TEST_VOLUME "}]}",
                 cases[i].text);
        struct pel_scene *scene = load(text);
        assert_matrix(&scene->instances[0].transform, cases[i].matrix);
        pel_scene_destroy(scene);
    }
}

static void test_volume_keys(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'volumes': [{'name': 'ct', 'visible': false, 'density': 0.5, 'extent': 'point', "
             "'filter': 'nearest', 'opacity_unit': 3, 'transfer': 'hot', 'spacing': [2, 3, 4], "
             "'file': 'a.raw', 'raw': {'dims': [2, 3, 2], 'type': 'uint16', 'endian': 'big', "
             "'origin': [7, 8, 9]}}]}");
    const struct pel_instance *instance = &scene->instances[0];
    assert_string_equal(instance->name, "ct");
    assert_true(instance->hidden);
    assert_float_equal(instance->density, 0.5, 0);
    assert_int_equal(instance->extent, PEL_EXTENT_POINT);
    assert_int_equal(instance->filter, PEL_FILTER_NEAREST);
    assert_float_equal(instance->transfer->opacity_unit_mm, 3, 0);
    // A relative preset is resolved: the last colour stands at the greatest value, 22 * 256 + 23.
    const struct pel_transfer *transfer = instance->transfer;
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    assert_float_equal(transfer->colours[transfer->colour_count - 1].value, 5655, 1e-9);
    // The new spacing keeps the centre of the first voxel.
    assert_matrix(&scene->volumes[0]->world_from_voxel,
                  (double[]){2, 0, 0, 7, 0, 3, 0, 8, 0, 0, 4, 9});
    pel_scene_destroy(scene);
}

static void test_bounds(void **state) {
    (void)state;
    // Dimensions 2 x 3 x 4, a quarter turn about z: x' = -y, y' = x.
    struct pel_scene *scene = load(
        "{'volumes': [{'transform': {'rotate': {'axis': 'z', 'degrees': 90}}, " TEST_VOLUME "}, "
        "{'extent': 'point', 'transform': {'translate': [10, 0, 0]}, " TEST_VOLUME "}, "
        "{'visible': false, 'transform': {'translate': [0, 0, 99]}, " TEST_VOLUME "}]}");
    struct pel_bounds bounds;
    pel_instance_bounds(scene, 0, &bounds);
    assert_triple(bounds.low, -2.5, -0.5, -0.5);
    assert_triple(bounds.high, 0.5, 1.5, 3.5);
    pel_instance_bounds(scene, 1, &bounds);
    assert_triple(bounds.low, 10, 0, 0);
    assert_triple(bounds.high, 11, 2, 3);
    assert_true(pel_scene_bounds(scene, &bounds));
    assert_triple(bounds.low, -2.5, -0.5, -0.5);
    assert_triple(bounds.high, 11, 2, 3.5);
    for (int i = 0; i < 3; i++)
        scene->instances[i].hidden = true;
    assert_false(pel_scene_bounds(scene, &bounds));
    pel_scene_destroy(scene);
}

static void test_sharing(void **state) {
    (void)state;
    struct pel_scene *scene = load(
        "{'volumes': [{" TEST_VOLUME "}, {" TEST_VOLUME ", 'density': 2}, "
        "{'file': './a.raw', 'raw': {'dims': [2, 3, 4], 'type': 'uint8'}}, "
        "{'file': 'a.raw', 'raw': {'dims': [2, 3, 3]}}, {" TEST_VOLUME ", 'spacing': [2, 2, 2]}, "
        "{'file': 'b.raw', 'raw': {'dims': [2, 3, 4]}}]}");
    assert_int_equal(scene->instance_count, 6);
    assert_int_equal(scene->volume_count, 4);
    const int wanted[] = {0, 0, 0, 1, 2, 3};
    for (int i = 0; i < 6; i++)
        assert_int_equal(scene->instances[i].volume, wanted[i]);
    // Each has a transfer function of its own all the same.
    assert_ptr_not_equal(scene->instances[0].transfer, scene->instances[1].transfer);
    pel_scene_destroy(scene);
}

static void test_overrides(void **state) {
    (void)state;
    const char *overrides[] = {"volumes.0.density=0.25", "render.size=[64,48]", "output.file=o.png",
                               "volumes.*.filter=nearest"};
    const char *path =
        test_write_scene("scene.json", "{'output': {'file': 'p.png'}, " TEST_VOLUMES "}");
    struct pel_scene *scene = pel_scene_load(path, overrides, 4);
    assert_non_null(scene);
    assert_float_equal(scene->instances[0].density, 0.25, 0);
    assert_int_equal(scene->instances[0].filter, PEL_FILTER_NEAREST);
    assert_int_equal(scene->render.width, 64);
    // A path given beside the file is relative to the working directory.
    assert_string_equal(scene->output.path, "o.png");
    assert_string_equal(scene->text,
                        "{\"output\":{\"file\":\"o.png\"},\"volumes\":[{\"file\":\"a.raw\",\"raw\":"
                        "{\"dims\":[2,3,4]},\"density\":0.25,\"filter\":\"nearest\"}],\"render\":"
                        "{\"size\":[64,48]}}");
    pel_scene_destroy(scene);
}

static void test_generated(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'volumes': [{'generate': {'kind': 'sphere', 'size': 8, 'type': 'float32'}}, "
             "{'generate': {'kind': 'sphere', 'size': 8, 'type': 'float32'}}, "
             "{'generate': {'kind': 'sphere', 'size': 9}}]}");
    assert_int_equal(scene->volume_count, 2);
    assert_int_equal(scene->volumes[0]->type, PEL_VOXEL_F32);
    assert_int_equal(scene->volumes[1]->dims[0], 9);
    assert_string_equal(scene->instances[0].name, "sphere");
    pel_scene_destroy(scene);
}

static void test_other_files(void **state) {
    (void)state;
    // Transfer functions and transforms in files are found beside the scene.
    FILE *stream = fopen(test_temporary_path("move.txt"), "w");
    fputs("0 -1 0 5\n1 0 0 6\n0 0 1 7\n0 0 0 1\n", stream);
    fclose(stream);
    test_write_scene("ramp.json", "{'points': [[0, '#000000', 0], [20, '#ff0000', 0.5]]}");
    struct pel_scene *scene = load(
        "{'volumes': [{'transform': {'file': 'move.txt'}, 'transfer': 'ramp.json', " TEST_VOLUME
        "}]}");
    assert_matrix(&scene->instances[0].transform, (double[]){0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7});
    pel_scene_destroy(scene);
}

static void test_fsl(void **state) {
    (void)state;
    // FSL counts x backwards where the voxels' frame is right-handed, so +5 there is -5 here.
    FILE *stream = fopen(test_temporary_path("five.mat"), "w");
    fputs("1 0 0 5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", stream);
    fclose(stream);
    struct pel_scene *scene =
        load("{'volumes': [{'transform': {'file': 'five.mat', 'fixed': 'still'}, " TEST_VOLUME "}, "
             "{'name': 'still', " TEST_VOLUME "}]}");
    assert_matrix(&scene->instances[0].transform, (double[]){1, 0, 0, -5, 0, 1, 0, 0, 0, 0, 1, 0});
    pel_scene_destroy(scene);
}

// ---- Volume files in place of a scene ----------------------------------------------------------

static void write_sidecar(const char *leaf) {
    test_write_scene(leaf, "{'dims': [2, 3, 4], 'type': 'uint8'}");
}

static void test_files(void **state) {
    (void)state;
    write_sidecar("a.raw.json");
    write_sidecar("b.raw.json");
    char a[1024], b[1024];
    snprintf(a, sizeof a, "%s", test_temporary_path("a.raw"));
    snprintf(b, sizeof b, "%s", test_temporary_path("b.raw"));
    struct pel_scene *scene = pel_scene_from_files((const char *[]){a, b}, 2, NULL, 0);
    if (!scene)
        fail_msg("%s", pel_error_message());
    assert_int_equal(scene->instance_count, 2);
    assert_int_equal(scene->volume_count, 2);
    // The lowest slice of values shows nothing, and is left out of the view.
    assert_true(scene->camera.target[2] > 1.75);
    // The first is grey, the second is not.
    const struct pel_transfer *first = scene->instances[0].transfer;
    const struct pel_transfer *second = scene->instances[1].transfer;
    double grey[4], hot[4];
    pel_transfer_evaluate(first, 12, grey);
    pel_transfer_evaluate(second, 12, hot);
    assert_float_equal(grey[0], grey[2], 1e-9);
    assert_true(hot[0] > hot[2] + 0.1);
    // The values are 0..23: the least are transparent, the greatest are not.
    pel_transfer_evaluate(first, 0, grey);
    assert_float_equal(grey[3], 0, 0);
    pel_transfer_evaluate(first, 23, grey);
    assert_true(grey[3] > 0.5);
    pel_scene_destroy(scene);

    const char *overrides[] = {"volumes.0.transfer=viridis", "camera.fov=40"};
    scene = pel_scene_load(a, overrides, 2);
    assert_non_null(scene);
    assert_float_equal(scene->camera.fov_deg, 40, 0);
    assert_true(scene->instances[0].transfer->colour_count > 2);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),    cmocka_unit_test(test_settings),
        cmocka_unit_test(test_usual),       cmocka_unit_test(test_supersampling),
        cmocka_unit_test(test_stereo),      cmocka_unit_test(test_backgrounds),
        cmocka_unit_test(test_camera),      cmocka_unit_test(test_transforms),
        cmocka_unit_test(test_volume_keys), cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_sharing),     cmocka_unit_test(test_overrides),
        cmocka_unit_test(test_generated),   cmocka_unit_test(test_other_files),
        cmocka_unit_test(test_fsl),         cmocka_unit_test(test_files),
        cmocka_unit_test(test_visible_fit),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
