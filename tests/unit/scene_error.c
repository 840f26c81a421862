// Tests of bad scene files: each is refused with the sentence a user can act on.
#include "support/scene_file.h"

// ---- Bad scenes --------------------------------------------------------------------------------

// `message` is what follows the folder of the scene.
static void expect_failure(const char *quoted, const char *const *overrides, int override_count,
                           const char *message) {
    const char *path = test_write_scene("bad.json", quoted);
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
    {"{'colour': 1, " TEST_VOLUMES "}", "bad.json:1:2: colour: unknown key"},
    {"{'comment': 1}", "bad.json:1:2: comment: must be a text, not 1"},
    {"{'$schema': {}}", "bad.json:1:2: $schema: must be a text, not an object"},
    {"{'background': 'pink', " TEST_VOLUMES "}",
     "bad.json:1:2: background: must be black, white, grey, red, green, blue, cyan, yellow, navy, "
     "magenta or none, not \"pink\""},
    {"{'background': '#12', " TEST_VOLUMES "}",
     "bad.json:1:2: background: must be #rrggbb or #rrggbbaa, not \"#12\""},
    {"{'background': [1, 2, 3], " TEST_VOLUMES "}",
     "bad.json:1:20: background.1: must be at least 0 and at most 1, not 2"},
    {"{'background': [1, 1], " TEST_VOLUMES "}",
     "bad.json:1:2: background: must have 3 elements, not 2"},
    {"{'background': 3, " TEST_VOLUMES "}", "bad.json:1:2: background: must be a text, not 3"},
    {"{'render': {'size': [0, 5]}, " TEST_VOLUMES "}",
     "bad.json:1:22: render.size.0: must be at least 1 and at most 32768, not 0"},
    {"{'render': {'size': [1.5, 5]}, " TEST_VOLUMES "}",
     "bad.json:1:13: render.size: must be whole numbers, not 1.5 x 5"},
    {"{'render': {'size': [9, 5], 'region': [5, 0, 5, 5]}, " TEST_VOLUMES "}",
     "bad.json:1:29: render.region: 5, 0, 5, 5 is not inside the picture of 9 x 5"},
    {"{'render': {'mixing': 'most'}, " TEST_VOLUMES "}",
     "bad.json:1:13: render.mixing: must be sum, over, ordered, max, priority, union, "
     "intersection or difference, not \"most\""},
    {"{'render': {'filter': 'cubic'}, " TEST_VOLUMES "}",
     "bad.json:1:13: render.filter: must be linear, nearest, cubic-b-spline or catmull-rom, not "
     "\"cubic\""},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'labels': 1}}]}",
     "bad.json:1:60: volumes.0.mask: needs 'volume', the name or the index of another one"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 'b', 'labels': 1}}]}",
     "bad.json:1:69: volumes.0.mask.volume: no volume is named 'b'"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 0, 'labels': 1}}]}",
     "bad.json:1:69: volumes.0.mask.volume: 'a.raw' is this volume"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 2, 'labels': 1}}]}",
     "bad.json:1:69: volumes.0.mask.volume: must be at least 0 and at most 0, not 2"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': true, 'labels': 1}}]}",
     "bad.json:1:69: volumes.0.mask.volume: must be the name or the index of a volume"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 0}}]}",
     "bad.json:1:60: volumes.0.mask: needs 'labels', 'ranges' or 'threshold'"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 0, 'labels': [1, 'b']}}]}",
     "bad.json:1:96: volumes.0.mask.labels.1: must be a label, a number"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 0, 'ranges': [[2, 1]]}}]}",
     "bad.json:1:93: volumes.0.mask.ranges.0: ends at 1, below its beginning 2"},
    {"{'volumes': [{" TEST_VOLUME ", 'mask': {'volume': 1, 'labels': 1}}, {" TEST_VOLUME
     ", 'name': 'b', 'mask': {'volume': 0, 'labels': 1}}]}",
     "bad.json:1:60: volumes.0.mask: 'b' is masked by this volume in turn"},
    {"{'render': {\n\t'stop': 1}, " TEST_VOLUMES "}",
     "bad.json:2:2: render.stop: unknown key; did you mean 'step'"},
    {"{'render': {'step': 0}, " TEST_VOLUMES "}",
     "bad.json:1:13: render.step: must be at least 0.001 and at most 1000, not 0"},
    {"{'render': {'step': 1, 'step_mm': 1}, " TEST_VOLUMES "}",
     "bad.json:1:24: render.step_mm: stands beside 'step', which says the same in voxels"},
    {"{'render': {'phase': '\u00fc', 'step': 1}, " TEST_VOLUMES "}",
     "bad.json:1:13: render.phase: must be a number, not \"\u00fc\""},
    {"{'render': {'termination': 0}, " TEST_VOLUMES "}",
     "bad.json:1:13: render.termination: must be above 0 and at most 1, not 0"},
    {"{'stereo': {'separation': -1}, " TEST_VOLUMES "}",
     "bad.json:1:13: stereo.separation: must be at least 0 and at most 1e+09, not -1"},
    {"{'stereo': {'convergence': 0}, " TEST_VOLUMES "}",
     "bad.json:1:13: stereo.convergence: must be above 0 and at most 1e+09, not 0"},
    {"{'stereo': {'convergence': 'auto'}, " TEST_VOLUMES "}",
     "bad.json:1:13: stereo.convergence: must be automatic, not \"auto\""},
    {"{'stereo': {'kind': 'dubois'}, " TEST_VOLUMES "}",
     "bad.json:1:13: stereo.kind: must be one of 31 names such as none, true-red-cyan, "
     "true-green-magenta or true-amber-blue, not \"dubois\"; did you mean 'dubois-red-cyan'"},
    {"{'stereo': {'kind': 'matrix'}, " TEST_VOLUMES "}",
     "bad.json:1:2: stereo: kind \"matrix\" needs 'matrix'"},
    {"{'stereo': {'matrix': [[1], [1], [1]]}, " TEST_VOLUMES "}",
     "bad.json:1:24: stereo.matrix.0: must have 6 elements, not 1"},
    {"{'render': {'size': [15, 10]}, 'stereo': {'kind': 'side-by-side-half'}, " TEST_VOLUMES "}",
     "bad.json:1:43: stereo.kind: side-by-side-half needs an even width, not 15"},
    {"{'render': {'supersampling': {'n': 9}}, " TEST_VOLUMES "}",
     "bad.json:1:31: render.supersampling.n: must be at least 1 and at most 8, not 9"},
    {"{'render': {'supersampling': {'patern': 'regular'}}, " TEST_VOLUMES "}",
     "bad.json:1:31: render.supersampling.patern: unknown key; did you mean 'pattern'"},
    {"{'output': {'depth': 12}, " TEST_VOLUMES "}",
     "bad.json:1:13: output.depth: must be 8 or 16, not 12"},
    {"{'output': {'depth': 8.5}, " TEST_VOLUMES "}",
     "bad.json:1:13: output.depth: must be a whole number, not 8.5"},
    {"{'output': {'file': ''}, " TEST_VOLUMES "}", "bad.json:1:13: output.file: is empty"},
    {"{'output': [], " TEST_VOLUMES "}", "bad.json:1:2: output: must be an object, not a list"},
    {"{'camera': {'fov': 180}, " TEST_VOLUMES "}",
     "bad.json:1:13: camera.fov: must be above 0 and below 180, not 180"},
    {"{'camera': {'eye': [1, 2]}, " TEST_VOLUMES "}",
     "bad.json:1:13: camera.eye: must have 3 elements, not 2"},
    {"{'camera': {'view': 'front'}, " TEST_VOLUMES "}",
     "bad.json:1:13: camera.view: must be anterior, posterior, left, right, superior, inferior or "
     "oblique, not \"front\""},
    {"{'camera': {'eye': [1, 2, 3], 'target': [1, 2, 3]}, " TEST_VOLUMES "}",
     "bad.json:1:2: camera: the camera's eye and target are one point, or not finite"},
    {"{'camera': {'eye': [0, 5, 0], 'target': [0, 0, 0], 'up': [0, 2, 0]}, " TEST_VOLUMES "}",
     "bad.json:1:2: camera: the camera looks along its up vector (0, 2, 0), which leaves "
     "its roll open"},
    {"{'camera': {'fit': 'b'}, " TEST_VOLUMES "}",
     "bad.json:1:13: camera.fit: no volume is named 'b'"},
    {"{'volumes': []}", "bad.json:1:2: volumes: must have 1 to 32 elements, not 0"},
    {"{'volumes': [5]}", "bad.json:1:14: volumes.0: must be an object, not 5"},
    {"{'volumes': [{}]}", "bad.json:1:14: volumes.0: needs 'file', 'generate' or 'hypertexture'"},
    {"{'volumes': [{" TEST_VOLUME ", 'generate': {}}]}",
     "bad.json:1:60: volumes.0.generate: there is a 'file' already"},
    {"{'volumes': [{'generate': {'kind': 'box'}, 'time': 1}]}",
     "bad.json:1:44: volumes.0.time: applies to files only"},
    {"{'volumes': [{'generate': {'size': 8}}]}", "bad.json:1:15: volumes.0.generate: needs 'kind'"},
    {"{'volumes': [{'generate': {'kind': 'box', 'size': 1}}]}",
     "bad.json:1:43: volumes.0.generate.size: must be at least 2 and at most 2048, not 1"},
    {"{'volumes': [{" TEST_VOLUME ", 'density': -1}]}",
     "bad.json:1:60: volumes.0.density: must be at least 0 and at most 1e+06, not -1"},
    {"{'volumes': [{" TEST_VOLUME ", 'visible': 1}]}",
     "bad.json:1:60: volumes.0.visible: must be true or false, not 1"},
    {"{'volumes': [{" TEST_VOLUME ", 'spacing': [1, 1, 0]}]}",
     "bad.json:1:78: volumes.0.spacing.2: must be above 0 and at most 1e+09, not 0"},
    {"{'volumes': [{" TEST_VOLUME ", 'transfer': 'hott'}]}",
     "bad.json:1:60: volumes.0.transfer: no preset 'hott'; did you mean 'hot'"},
    {"{'volumes': [{" TEST_VOLUME ", 'transfer': 3}]}",
     "bad.json:1:60: volumes.0.transfer: expected an object or the name of a preset"},
    {"{'volumes': [{" TEST_VOLUME ", 'transfer': {\n'preset': 'hot', 'opacity-unit': 2}}]}",
     "bad.json:2:18: volumes.0.transfer.opacity-unit: unknown key; did you mean 'opacity_unit'"},
    {"{'volumes': [{" TEST_VOLUME ", 'transfer': {'points': [[0, '#000000', 0],\n"
     "[1, '#ffffff', 1.5]]}}]}",
     "bad.json:2:1: volumes.0.transfer.points.1: opacity point 1: opacity 1.5 is outside 0..1"},
    {"{'volumes': [{" TEST_VOLUME ", 'palette': 'purple'}]}",
     "bad.json:1:60: volumes.0.palette: must be grey, hot, viridis, plasma, inferno, cool-warm, "
     "rainbow, ct-bone, ct-soft-tissue, ct-lung, ct-angio, mri, mri-brain, green, magenta, cyan, "
     "red, blue, yellow or labels, not \"purple\""},
    {"{'volumes': [{" TEST_VOLUME ", 'name': ''}]}",
     "bad.json:1:60: volumes.0.name: must have 1 to 63 bytes, not 0"},
    {"{'volumes': [{'file': 'a.raw', 'raw': {'type': 'uint8'}}]}",
     "bad.json:1:32: volumes.0.raw: needs 'dims'"},
    {"{'volumes': [{'file': 'a.raw', 'raw': {'dims': [2, 3, 4], 'type': 'int64'}}]}",
     "bad.json:1:59: volumes.0.raw.type: must be uint8, int8, uint16, int16, float32, rgb8 or "
     "rgba8, not \"int64\""},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': [1]}]}",
     "bad.json:1:60: volumes.0.transform: must have 4 elements, not 1"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}",
     "bad.json:1:60: volumes.0.transform: is not rigid: its rows are off a rotation's by 3"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': [[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}",
     "bad.json:1:60: volumes.0.transform: is not rigid: it mirrors"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]}]}",
     "bad.json:1:60: volumes.0.transform: the last row must be 0 0 0 1, not 0 0 1 1"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {'quaternion': [0, 0, 0, 2]}}]}",
     "bad.json:1:74: volumes.0.transform.quaternion: must have length 1, not 2"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {'rotate': {'axis': 'x'}}}]}",
     "bad.json:1:74: volumes.0.transform.rotate: needs 'degrees'"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {'rotate': {'axis': [0,0,0], 'degrees': 1}}}]}",
     "bad.json:1:85: volumes.0.transform.rotate.axis: has no direction"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {'translate': [0, 1e308, 0]}}]}",
     "bad.json:1:91: volumes.0.transform.translate.1: must be at least -1e+09 and at most 1e+09, "
     "not 1e+308"},
    {"{'volumes': [{" TEST_VOLUME ", 'spacing': [1, 1, 1e9]}]}",
     "bad.json:1:14: volumes.0: its box reaches to 3.5e+09 mm, beyond 1e+09"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {}}]}",
     "bad.json:1:60: volumes.0.transform: needs 'file', 'quaternion', 'rotate' or 'translate'"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {'rotat': 1}}]}",
     "bad.json:1:74: volumes.0.transform.rotat: unknown key; did you mean 'rotate'"},
    {"{'volumes': [{" TEST_VOLUME ", 'transform': {'file': 'm.mat', 'fixed': 'a.raw'}}]}",
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
    const char *path = test_write_scene("bad.json", "{'volumes': [\n    {'file': 'none.nii'}]}");
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
        {"volumes.1.name=b",
         "--set volumes.1.name=b: volumes.1: needs 'file', 'generate' or 'hypertexture'"},
        {"volumes=null", "bad.json:1:1: needs 'volumes'"},
        {"volumes.5.name=b", "--set volumes.5.name=b: no element 5 in a list of 1"},
        {"volumes", "--set volumes: must be KEY=VALUE"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expect_failure("{" TEST_VOLUMES "}", &cases[i][0], 1, cases[i][1]);
        if (strncmp(cases[i][1], "--set", 5) == 0)
            assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    }
}

static void test_too_many(void **state) {
    (void)state;
    char text[4096] = "{'volumes': [{" TEST_VOLUME "}";
    for (int i = 0; i < 32; i++)
        strcat(text, ", {" TEST_VOLUME "}");
    strcat(text, "]}");
    expect_failure(text, NULL, 0, "bad.json:1:2: volumes: must have 1 to 32 elements, not 33");
}

// Every beginning of a scene is refused with a sentence and leaks nothing.
static void test_truncated(void **state) {
    (void)state;
    const char *whole =
        "{'camera': {'view': 'left'}, 'render': {'size': [1, 1]}, " TEST_VOLUMES "}";
    char text[256];
    for (size_t length = 0; length < strlen(whole); length++) {
        snprintf(text, sizeof text, "%.*s", (int)length, whole);
        assert_null(pel_scene_load(test_write_scene("bad.json", text), NULL, 0));
        assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
        assert_non_null(strstr(pel_error_message(), "bad.json:1:"));
    }
}

static void test_bad_files(void **state) {
    (void)state;
    assert_null(pel_scene_from_files((const char *[]){"none.nii"}, 1, NULL, 0));
    assert_memory_equal(pel_error_message(), "none.nii: ", 10);
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    assert_null(pel_scene_from_files((const char *[]){"a.json", "b.nii"}, 2, NULL, 0));
    assert_string_equal(pel_error_message(),
                        "a.json: a scene cannot be combined with other files like 'b.nii'");
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
        cmocka_unit_test(test_bad_scenes),      cmocka_unit_test(test_bad_overrides),
        cmocka_unit_test(test_bad_volume_file), cmocka_unit_test(test_too_many),
        cmocka_unit_test(test_truncated),       cmocka_unit_test(test_bad_files),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
