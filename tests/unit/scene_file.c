// Tests of scene files: good ones become the structs that follow from their numbers by hand, bad
// ones the sentence a user can act on.
#include "support/test.h"

#include <errno.h>
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

// Scenes are written with ' for ".
static const char *write_scene(const char *leaf, const char *quoted) {
    const char *path = test_temporary_path(leaf);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    for (const char *at = quoted; *at; at++)
        fputc(*at == '\'' ? '"' : *at, stream);
    fclose(stream);
    return path;
}

static struct pel_scene *load(const char *quoted) {
    struct pel_scene *scene = pel_scene_load(write_scene("scene.json", quoted), NULL, 0);
    if (!scene)
        fail_msg("%s\n%s", quoted, pel_error_message());
    return scene;
}

// 2 x 3 x 4 voxels with the values 0..23, beside the scenes.
#define VOLUME "'file': 'a.raw', 'raw': {'dims': [2, 3, 4]}"
#define VOLUMES "'volumes': [{" VOLUME "}]"

static int write_volumes(void **state) {
    (void)state;
    for (int file = 0; file < 2; file++) {
        FILE *stream = fopen(test_temporary_path(file ? "b.raw" : "a.raw"), "wb");
        if (!stream)
            return -1;
        for (int i = 0; i < 24; i++)
            fputc(i, stream);
        fclose(stream);
    }
    return 0;
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
    struct pel_scene *scene = load("{" VOLUMES "}");
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
    assert_int_equal(scene->output.depth, 8);
    assert_string_equal(scene->output.path, "");
    assert_triple(scene->background, 0, 0, 0);
    assert_float_equal(scene->background[3], 1, 0);
    // The fitted camera looks at the middle of the box.
    assert_triple(scene->camera.target, 0.5, 1, 1.5);
    assert_false(scene->camera.orthographic);
    pel_scene_destroy(scene);
}

static void test_settings(void **state) {
    (void)state;
    struct pel_scene *scene = load(
        "{'$schema': 'scene.schema.json', 'comment': 'all of it', 'background': '#ff8000', "
        "'render': {'size': [320, 200], 'mixing': 'over', 'step': 0.25, 'phase': 0, "
        "'termination': 1, 'origin': 'bounds'}, "
        "'output': {'file': 'out/p.png', 'depth': 16, 'alpha': 'premultiplied'}, " VOLUMES "}");
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
        {"'white'", {1, 1, 1, 1}},
        {"'none'", {0, 0, 0, 0}},
        {"'#00ff0000'", {0, 1, 0, 0}},
        {"[0.25, 0.5, 0.75]", {0.25, 0.5, 0.75, 1}},
        {"[0.25, 0.5, 0.75, 0.5]", {0.25, 0.5, 0.75, 0.5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[256];
        snprintf(text, sizeof text, "{'background': %s, " VOLUMES "}", cases[i].text);
        struct pel_scene *scene = load(text);
        assert_memory_equal(scene->background, cases[i].rgba, sizeof cases[i].rgba);
        pel_scene_destroy(scene);
    }
}

static void test_camera(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'camera': {'eye': [10, 20, 30], 'target': [1, 2, 3], 'up': [0, 1, 0], 'fov': 45, "
             "'shift': [0.5, -0.25]}, " VOLUMES "}");
    assert_triple(scene->camera.eye, 10, 20, 30);
    assert_triple(scene->camera.target, 1, 2, 3);
    assert_triple(scene->camera.up, 0, 1, 0);
    assert_float_equal(scene->camera.fov_deg, 45, 0);
    assert_float_equal(scene->camera.shift[0], 0.5, 0);
    assert_float_equal(scene->camera.shift[1], -0.25, 0);
    pel_scene_destroy(scene);

    scene =
        load("{'camera': {'view': 'anterior', 'orthographic': true, 'height': 7}, " VOLUMES "}");
    assert_true(scene->camera.orthographic);
    assert_float_equal(scene->camera.height_mm, 7, 0);
    // Seen from the front: along -y through the middle of the box.
    assert_float_equal(scene->camera.eye[0], 0.5, 1e-9);
    assert_float_equal(scene->camera.eye[2], 1.5, 1e-9);
    assert_true(scene->camera.eye[1] > 2.5);
    pel_scene_destroy(scene);

    // Looking straight down without an up: one is found.
    scene = load("{'camera': {'eye': [0, 0, 9], 'target': [0, 0, 0]}, " VOLUMES "}");
    assert_triple(scene->camera.up, 0, 1, 0);
    pel_scene_destroy(scene);

    // A view of one of two volumes.
    scene = load("{'camera': {'view': 'left', 'fit': 'second'}, 'volumes': [{" VOLUME "}, {"
                 "'name': 'second', 'transform': {'translate': [100, 0, 0]}, " VOLUME "}]}");
    assert_triple(scene->camera.target, 100.5, 1, 1.5);
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
        snprintf(text, sizeof text, "{'volumes': [{'transform': %s, " VOLUME "}]}", cases[i].text);
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
    struct pel_scene *scene =
        load("{'volumes': [{'transform': {'rotate': {'axis': 'z', 'degrees': 90}}, " VOLUME "}, "
             "{'extent': 'point', 'transform': {'translate': [10, 0, 0]}, " VOLUME "}, "
             "{'visible': false, 'transform': {'translate': [0, 0, 99]}, " VOLUME "}]}");
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
    struct pel_scene *scene =
        load("{'volumes': [{" VOLUME "}, {" VOLUME ", 'density': 2}, "
             "{'file': './a.raw', 'raw': {'dims': [2, 3, 4], 'type': 'uint8'}}, "
             "{'file': 'a.raw', 'raw': {'dims': [2, 3, 3]}}, {" VOLUME ", 'spacing': [2, 2, 2]}, "
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
    const char *path = write_scene("scene.json", "{'output': {'file': 'p.png'}, " VOLUMES "}");
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
    write_scene("ramp.json", "{'points': [[0, '#000000', 0], [20, '#ff0000', 0.5]]}");
    struct pel_scene *scene = load(
        "{'volumes': [{'transform': {'file': 'move.txt'}, 'transfer': 'ramp.json', " VOLUME "}]}");
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
        load("{'volumes': [{'transform': {'file': 'five.mat', 'fixed': 'still'}, " VOLUME "}, "
             "{'name': 'still', " VOLUME "}]}");
    assert_matrix(&scene->instances[0].transform, (double[]){1, 0, 0, -5, 0, 1, 0, 0, 0, 0, 1, 0});
    pel_scene_destroy(scene);
}

// ---- Bad scenes --------------------------------------------------------------------------------

// `message` is what follows the folder of the scene.
static void expect_failure(const char *quoted, const char *const *overrides, int override_count,
                           const char *message) {
    const char *path = write_scene("bad.json", quoted);
    struct pel_scene *scene = pel_scene_load(path, overrides, override_count);
    assert_null(scene);
    const char *got = pel_error_message();
    size_t folder = strlen(path) - strlen("bad.json");
    if (strncmp(got, path, folder) == 0)
        got += folder;
    if (strcmp(got, message) != 0)
        fail_msg("%s\n  gives  %s\n  not    %s", quoted, got, message);
}

static const struct {
    const char *scene, *message;
} bad_scenes[] = {
    {"", "bad.json:1:0: '[' or '{' expected near end of file"},
    {"{\n 'camera': {,}\n}", "bad.json:2:13: string or '}' expected near ','"},
    {"{'volumes': [],\n 'volumes': []}", "bad.json:2:10: duplicate object key near '\"volumes\"'"},
    {"[]", "bad.json:1:1: must be an object, not a list"},
    {"{}", "bad.json:1:1: needs 'volumes'"},
    {"{\n  'volume': []}", "bad.json:2:3: volume: unknown key; did you mean 'volumes'"},
    {"{'colour': 1, " VOLUMES "}", "bad.json:1:2: colour: unknown key"},
    {"{'comment': 1}", "bad.json:1:2: comment: must be a text, not 1"},
    {"{'$schema': {}}", "bad.json:1:2: $schema: must be a text, not an object"},
    {"{'background': 'pink', " VOLUMES "}",
     "bad.json:1:2: background: must be black, white, grey, red, green, blue, cyan, yellow, navy, "
     "magenta or none, not \"pink\""},
    {"{'background': '#12', " VOLUMES "}",
     "bad.json:1:2: background: must be #rrggbb or #rrggbbaa, not \"#12\""},
    {"{'background': [1, 2, 3], " VOLUMES "}",
     "bad.json:1:20: background.1: must be at least 0 and at most 1, not 2"},
    {"{'background': [1, 1], " VOLUMES "}",
     "bad.json:1:2: background: must have 3 elements, not 2"},
    {"{'background': 3, " VOLUMES "}", "bad.json:1:2: background: must be a text, not 3"},
    {"{'render': {'size': [0, 5]}, " VOLUMES "}",
     "bad.json:1:22: render.size.0: must be at least 1 and at most 32768, not 0"},
    {"{'render': {'size': [1.5, 5]}, " VOLUMES "}",
     "bad.json:1:13: render.size: must be whole numbers, not 1.5 x 5"},
    {"{'render': {'mixing': 'max'}, " VOLUMES "}",
     "bad.json:1:13: render.mixing: must be sum or over, not \"max\""},
    {"{'render': {\n\t'stop': 1}, " VOLUMES "}",
     "bad.json:2:2: render.stop: unknown key; did you mean 'step'"},
    {"{'render': {'step': 0}, " VOLUMES "}",
     "bad.json:1:13: render.step: must be at least 0.001 and at most 1000, not 0"},
    {"{'render': {'phase': '\u00fc', 'step': 1}, " VOLUMES "}",
     "bad.json:1:13: render.phase: must be a number, not \"\u00fc\""},
    {"{'render': {'termination': 0}, " VOLUMES "}",
     "bad.json:1:13: render.termination: must be above 0 and at most 1, not 0"},
    {"{'output': {'depth': 12}, " VOLUMES "}",
     "bad.json:1:13: output.depth: must be 8 or 16, not 12"},
    {"{'output': {'depth': 8.5}, " VOLUMES "}",
     "bad.json:1:13: output.depth: must be a whole number, not 8.5"},
    {"{'output': {'file': ''}, " VOLUMES "}", "bad.json:1:13: output.file: is empty"},
    {"{'output': [], " VOLUMES "}", "bad.json:1:2: output: must be an object, not a list"},
    {"{'camera': {'fov': 180}, " VOLUMES "}",
     "bad.json:1:13: camera.fov: must be above 0 and below 180, not 180"},
    {"{'camera': {'eye': [1, 2]}, " VOLUMES "}",
     "bad.json:1:13: camera.eye: must have 3 elements, not 2"},
    {"{'camera': {'view': 'front'}, " VOLUMES "}",
     "bad.json:1:13: camera.view: must be anterior, posterior, left, right, superior, inferior or "
     "oblique, not \"front\""},
    {"{'camera': {'eye': [1, 2, 3], 'target': [1, 2, 3]}, " VOLUMES "}",
     "bad.json:1:2: camera: the camera's eye and target are one point, or not finite"},
    {"{'camera': {'eye': [0, 5, 0], 'target': [0, 0, 0], 'up': [0, 2, 0]}, " VOLUMES "}",
     "bad.json:1:2: camera: the camera looks along its up vector (0, 2, 0), which leaves "
     "its roll open"},
    {"{'camera': {'fit': 'b'}, " VOLUMES "}", "bad.json:1:13: camera.fit: no volume is named 'b'"},
    {"{'volumes': []}", "bad.json:1:2: volumes: must have 1 to 32 elements, not 0"},
    {"{'volumes': [5]}", "bad.json:1:14: volumes.0: must be an object, not 5"},
    {"{'volumes': [{}]}", "bad.json:1:14: volumes.0: needs 'file' or 'generate'"},
    {"{'volumes': [{" VOLUME ", 'generate': {}}]}",
     "bad.json:1:60: volumes.0.generate: there is a 'file' already"},
    {"{'volumes': [{'generate': {'kind': 'box'}, 'time': 1}]}",
     "bad.json:1:44: volumes.0.time: applies to files only"},
    {"{'volumes': [{'generate': {'size': 8}}]}", "bad.json:1:15: volumes.0.generate: needs 'kind'"},
    {"{'volumes': [{'generate': {'kind': 'box', 'size': 1}}]}",
     "bad.json:1:43: volumes.0.generate.size: must be at least 2 and at most 2048, not 1"},
    {"{'volumes': [{" VOLUME ", 'density': -1}]}",
     "bad.json:1:60: volumes.0.density: must be at least 0 and at most 1e+06, not -1"},
    {"{'volumes': [{" VOLUME ", 'visible': 1}]}",
     "bad.json:1:60: volumes.0.visible: must be true or false, not 1"},
    {"{'volumes': [{" VOLUME ", 'spacing': [1, 1, 0]}]}",
     "bad.json:1:78: volumes.0.spacing.2: must be above 0, not 0"},
    {"{'volumes': [{" VOLUME ", 'transfer': 'hott'}]}",
     "bad.json:1:60: volumes.0.transfer: no preset 'hott'; did you mean 'hot'"},
    {"{'volumes': [{" VOLUME ", 'transfer': 3}]}",
     "bad.json:1:60: volumes.0.transfer: expected an object or the name of a preset"},
    {"{'volumes': [{" VOLUME ", 'transfer': {\n'preset': 'hot', 'opacity-unit': 2}}]}",
     "bad.json:2:18: volumes.0.transfer.opacity-unit: unknown key; did you mean 'opacity_unit'"},
    {"{'volumes': [{" VOLUME ", 'transfer': {'points': [[0, '#000000', 0],\n"
     "[1, '#ffffff', 1.5]]}}]}",
     "bad.json:2:1: volumes.0.transfer.points.1: opacity point 1: opacity 1.5 is outside 0..1"},
    {"{'volumes': [{" VOLUME ", 'palette': 'purple'}]}",
     "bad.json:1:60: volumes.0.palette: must be grey, hot, viridis, plasma, inferno, cool-warm, "
     "rainbow, ct-bone, ct-soft-tissue, ct-lung, ct-angio, mri, mri-brain, green, magenta, cyan, "
     "red, blue, yellow or labels, not \"purple\""},
    {"{'volumes': [{" VOLUME ", 'name': ''}]}",
     "bad.json:1:60: volumes.0.name: must have 1 to 63 bytes, not 0"},
    {"{'volumes': [{'file': 'a.raw', 'raw': {'type': 'uint8'}}]}",
     "bad.json:1:32: volumes.0.raw: needs 'dims'"},
    {"{'volumes': [{'file': 'a.raw', 'raw': {'dims': [2, 3, 4], 'type': 'int64'}}]}",
     "bad.json:1:59: volumes.0.raw.type: must be uint8, int8, uint16, int16, float32, rgb8 or "
     "rgba8, not \"int64\""},
    {"{'volumes': [{" VOLUME ", 'transform': [1]}]}",
     "bad.json:1:60: volumes.0.transform: must have 4 elements, not 1"},
    {"{'volumes': [{" VOLUME ", 'transform': [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}",
     "bad.json:1:60: volumes.0.transform: is not rigid: its rows are off a rotation's by 3"},
    {"{'volumes': [{" VOLUME ", 'transform': [[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}",
     "bad.json:1:60: volumes.0.transform: is not rigid: it mirrors"},
    {"{'volumes': [{" VOLUME ", 'transform': [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]}]}",
     "bad.json:1:60: volumes.0.transform: the last row must be 0 0 0 1, not 0 0 1 1"},
    {"{'volumes': [{" VOLUME ", 'transform': {'quaternion': [0, 0, 0, 2]}}]}",
     "bad.json:1:74: volumes.0.transform.quaternion: must have length 1, not 2"},
    {"{'volumes': [{" VOLUME ", 'transform': {'rotate': {'axis': 'x'}}}]}",
     "bad.json:1:74: volumes.0.transform.rotate: needs 'degrees'"},
    {"{'volumes': [{" VOLUME ", 'transform': {'rotate': {'axis': [0,0,0], 'degrees': 1}}}]}",
     "bad.json:1:85: volumes.0.transform.rotate.axis: has no direction"},
    {"{'volumes': [{" VOLUME ", 'transform': {}}]}",
     "bad.json:1:60: volumes.0.transform: needs 'file', 'quaternion', 'rotate' or 'translate'"},
    {"{'volumes': [{" VOLUME ", 'transform': {'rotat': 1}}]}",
     "bad.json:1:74: volumes.0.transform.rotat: unknown key; did you mean 'rotate'"},
    {"{'volumes': [{" VOLUME ", 'transform': {'file': 'm.mat', 'fixed': 'a.raw'}}]}",
     "bad.json:1:91: volumes.0.transform.fixed: 'a.raw' is this volume"},
};

static void test_bad_scenes(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof bad_scenes / sizeof *bad_scenes; i++) {
        expect_failure(bad_scenes[i].scene, NULL, 0, bad_scenes[i].message);
        assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    }
}

static void test_bad_volume_file(void **state) {
    (void)state;
    const char *path = write_scene("bad.json", "{'volumes': [\n    {'file': 'none.nii'}]}");
    assert_null(pel_scene_load(path, NULL, 0));
    char wanted[2048];
    snprintf(wanted, sizeof wanted, "%s:2:5: volumes.0: %s", path, test_temporary_path("none.nii"));
    assert_memory_equal(pel_error_message(), wanted, strlen(wanted));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

static void test_bad_overrides(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"volumes.0.density=x", "--set volumes.0.density=x: must be a number, not \"x\""},
        {"volumes.*.density=x",
         "--set volumes.*.density=x: volumes.0.density: must be a number, not \"x\""},
        {"render.size=[0,1]",
         "--set render.size=[0,1]: render.size.0: must be at least 1 and at most 32768, not 0"},
        {"camera.fvo=3", "--set camera.fvo=3: unknown key; did you mean 'fov'"},
        {"volumes.1.name=b", "--set volumes.1.name=b: volumes.1: needs 'file' or 'generate'"},
        {"volumes=null", "bad.json:1:1: needs 'volumes'"},
        {"volumes.5.name=b", "--set volumes.5.name=b: no element 5 in a list of 1"},
        {"volumes", "--set volumes: must be KEY=VALUE"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expect_failure("{" VOLUMES "}", &cases[i][0], 1, cases[i][1]);
        if (strncmp(cases[i][1], "--set", 5) == 0)
            assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    }
}

static void test_too_many(void **state) {
    (void)state;
    char text[4096] = "{'volumes': [{" VOLUME "}";
    for (int i = 0; i < 32; i++)
        strcat(text, ", {" VOLUME "}");
    strcat(text, "]}");
    expect_failure(text, NULL, 0, "bad.json:1:2: volumes: must have 1 to 32 elements, not 33");
}

// Every beginning of a scene is refused with a sentence and leaks nothing.
static void test_truncated(void **state) {
    (void)state;
    const char *whole = "{'camera': {'view': 'left'}, 'render': {'size': [1, 1]}, " VOLUMES "}";
    char text[256];
    for (size_t length = 0; length < strlen(whole); length++) {
        snprintf(text, sizeof text, "%.*s", (int)length, whole);
        assert_null(pel_scene_load(write_scene("bad.json", text), NULL, 0));
        assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
        assert_non_null(strstr(pel_error_message(), "bad.json:1:"));
    }
}

// ---- Volume files in place of a scene ----------------------------------------------------------

static void write_sidecar(const char *leaf) {
    write_scene(leaf, "{'dims': [2, 3, 4], 'type': 'uint8'}");
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
    assert_triple(scene->camera.target, 0.5, 1, 1.5);
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

static void test_bad_files(void **state) {
    (void)state;
    assert_null(pel_scene_from_files((const char *[]){"none.nii"}, 1, NULL, 0));
    assert_memory_equal(pel_error_message(), "none.nii: ", 10);
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    assert_null(pel_scene_from_files((const char *[]){"a.json", "b.nii"}, 2, NULL, 0));
    assert_string_equal(pel_error_message(), "a.json: a scene cannot be combined with other files");
    assert_null(pel_scene_from_files(NULL, 0, NULL, 0));
    assert_string_equal(pel_error_message(), "0 files, outside 1..32");
    assert_null(pel_scene_from_files((const char *[]){"\xff.nii"}, 1, NULL, 0));
    assert_string_equal(pel_error_message(), "\xff.nii: the name is not valid UTF-8");
    const char *overrides[] = {"camera.fov=400"};
    assert_null(pel_scene_from_files((const char *[]){"none.nii"}, 1, overrides, 1));
    assert_string_equal(pel_error_message(),
                        "--set camera.fov=400: must be above 0 and below 180, not 400");
    assert_null(pel_scene_load("none.json", NULL, 0));
    assert_string_equal(pel_error_message(), "none.json: No such file or directory");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),        cmocka_unit_test(test_settings),
        cmocka_unit_test(test_backgrounds),     cmocka_unit_test(test_camera),
        cmocka_unit_test(test_transforms),      cmocka_unit_test(test_volume_keys),
        cmocka_unit_test(test_bounds),          cmocka_unit_test(test_sharing),
        cmocka_unit_test(test_overrides),       cmocka_unit_test(test_generated),
        cmocka_unit_test(test_other_files),     cmocka_unit_test(test_fsl),
        cmocka_unit_test(test_bad_scenes),      cmocka_unit_test(test_bad_overrides),
        cmocka_unit_test(test_bad_volume_file), cmocka_unit_test(test_too_many),
        cmocka_unit_test(test_truncated),       cmocka_unit_test(test_files),
        cmocka_unit_test(test_bad_files),
    };
    return cmocka_run_group_tests(tests, write_volumes, NULL);
}
