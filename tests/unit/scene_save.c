// Tests of saved scenes: loading one gives the same scene, to the last bit, and whatever the schema
// knows is written. (tests/kernel/scenes.c renders them.)
#include "support/file.h"
#include "support/scene_file.h"

#include <glob.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jansson.h>

static struct pel_scene *load(const char *path) {
    struct pel_scene *scene = pel_scene_load(path, NULL, 0);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

static struct pel_scene *save_and_load(const struct pel_scene *scene, const char *path) {
    if (!pel_scene_save(scene, path))
        fail_msg("%s", pel_error_message());
    return load(path);
}

static char *text_of(const struct pel_scene *scene, const char *path) {
    char *text = pel_scene_text(scene, path);
    if (!text)
        fail_msg("%s", pel_error_message());
    return text;
}

// A scene with everything in it that is not as usual. Some keys exclude each other: there are
// two.
static const char *const rich[] = {
    "{'camera': {'eye': [1, 2, 3.25], 'target': [0.1, 0.2, 0.3], 'up': [0, 1, 0], 'fov': 33.3,"
    "   'orthographic': true, 'height': 77, 'shift': [0.25, -0.125]},"
    " 'background': [0.1, 0.2, 0.3, 0.4],"
    " 'clip': [{'box': {'centre': [1, 2, 3], 'size': [4, 5, 6], "
    "'quaternion': [0, 0, 1, 0]}}], 'lights': [{'kind': 'directional', 'direction': [1, 2, 3], "
    "'colour': '#80ff00',"
    "   'intensity': 0.3}, {'kind': 'point', 'position': [4, 5, 6], 'colour': [0.1, 0.2, 0.3]},"
    "   {'kind': 'camera'}, {}],"
    " 'volumes': [{'file': 'a.raw', 'raw': {'dims': [2, 3, 4], 'type': 'int8',"
    "   'spacing': [0.1, 0.2, 0.3], 'origin': [7, 8, 9], 'offset': 0, 'endian': 'big'},"
    "   'name': 'first', 'visible': false, 'spacing': [1, 2, 3],"
    "   'transform': {'rotate': {'axis': [1, 2, 3], 'degrees': 33, 'about': 'centre'},"
    "   'translate': [1, 2, 3]}, 'transfer': {'colours': [[0, '#102030'], [9, 0.1, 0.2, 0.3]],"
    "   'opacities': [[1, 0.25], [2, 0.5], [3, 1]], 'scale': 'percentile',"
    "   'opacity_unit': 3, 'interpolation': 'nearest', 'entries': 77}, 'density': 0.7, 'priority': "
    "2,"
    "   'clip': [{'plane': {'point': [1, 2, 3], 'normal': [0, 1, 0]}, "
    "'keep': 'outside', 'frame': 'world'}], 'mask': {'volume': 1, 'labels': [1, 2.5], "
    "'ranges': [[-3, 4]], 'threshold': 7, 'invert': true}, 'extent': 'point', 'filter': 'nearest', "
    "'step': 0.3, "
    "'preintegration': true,"
    "   'gradient': 'sobel',"
    "   'gradient_opacity': [[2, 0.5], [3, 7]],"
    "   'silhouette': {'base': 0.5, 'strength': 3, 'exponent': 2},"
    "   'shading': {'model': 'phong', 'ambient': 0.2, 'diffuse': 0.3, 'specular': 0.4,"
    "   'shininess': 55, 'two_sided': false}},"
    "   {'generate': {'kind': 'head-pair', 'size': 8, 'spacing': 20, 'type': 'float32',"
    "   'second': true}, 'palette': 'hot', 'opacity_unit': 7, 'step_mm': 0.2, 'model': 'iso', "
    "'iso': [3.5, {'value': 4, 'colour': [0.1, 0.2, 0.3], 'opacity': 0.3}]}],"
    " 'render': {'size': [34, 22], 'region': [3, 4, 30, 1], 'mixing': 'over', 'step': 0.7, "
    "'adaptive_step': 0.07, 'phase': 0.25,"
    "   'termination': 0.8, 'origin': 'bounds', 'skip': 'blocks', 'bricks': {'size': 16, "
    "'cluster': "
    "false, 'walk': false, 'cull': false, 'pool': 'on'}, 'jitter': true, 'debug': 'spans', "
    "'filter': 'catmull-rom', 'gradient': 'analytic', "
    "'model': 'mip', 'order': 'back-to-front', 'emission_scale': 0.3, 'preintegration': true,"
    "   'supersampling': {'n': 2, 'pattern': 'n-rooks', 'filter': 'gaussian', 'seed': 3,"
    "   'adaptive': 0.1}, 'shadows': {'length': 50, 'step': 3, 'strength': 0.7},"
    "   'ambient_occlusion': {'directions': 9, 'radius': 8, 'step': 1.5, 'strength': 0.6}, 'lod': "
    "3},"
    " 'stereo': {'kind': 'matrix', 'separation': 5, 'convergence': 77.5, 'swap': true, "
    "'reproject': true,"
    "   'toe_in': true, 'matrix': [[1, 0, 0, 0, 0, 0.1], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1]]},"
    " 'animation': {'fps': 10, 'frames': 20, 'frame': 5, 'tracks': ["
    "   {'orbit': {'axis': 'up', 'turns': 2}, 'times': [0, 2]}, {'key': 'volumes.1.density', "
    "'frames': [0, 10],"
    "   'values': [0, 1], 'interpolation': 'smooth'}, {'key': "
    "'volumes.first.transfer.opacity_unit', 'values': [1, 2]},"
    "   {'key': 'render.step', 'values': [1, 2]}]},"
    " 'wall': {'regions': [{'place': [0, 0, 0.5, 1], 'monitor': 1, 'device': 'gpu'}]},"
    " 'output': {'file': 'out/picture.png', 'depth': 16, 'alpha': 'premultiplied'}}",
    "{'volumes': [{'file': 'a.raw', 'raw': {'dims': [2, 3, 4], 'offset': 0}, 'time': 0,"
    "   'channel': 0, 'labels': true, 'transfer': {'points': [[0, '#ffffff', 0], [1, '#102030', "
    "0.5]]}, 'shading': "
    "true}, {'hypertexture': {'recipe': {'value': ['*', 'time', 'object']}, 'size': 8, 'type':"
    "   'float32', 'seed': 3, 'time': 0.5, 'live': true, 'object': 'a.raw'}},"
    "   {'hypertexture': {'recipe': 'cloud', 'size': 4, 'wrap': true}}],"
    " 'background': 'none', 'render': {'step_mm': 0.37, 'shadows': true, 'lod': 'auto', "
    "'ambient_occlusion': "
    "true},"
    " 'stereo': {'kind': 'red-blue', 'separation': 0}, 'animation': {'duration': 2}, 'wall': "
    "{'columns': 3, 'rows': 2, 'bezel': [0.04, 0.05]}, 'output': "
    "{'file': '-'}}",
};

// ---- The same scene ----------------------------------------------------------------------------

static void assert_same_transfer(const struct pel_transfer *a, const struct pel_transfer *b) {
    assert_int_equal(a->colour_count, b->colour_count);
    assert_int_equal(a->opacity_count, b->opacity_count);
    assert_memory_equal(a->colours, b->colours, (size_t)a->colour_count * sizeof *a->colours);
    assert_memory_equal(a->opacities, b->opacities,
                        (size_t)a->opacity_count * sizeof *a->opacities);
    assert_int_equal(a->scale, b->scale);
    assert_float_equal(a->opacity_unit_mm, b->opacity_unit_mm, 0);
    assert_int_equal(a->nearest, b->nearest);
    assert_int_equal(a->table_entries, b->table_entries);
}

static void assert_same_volume(const struct pel_volume *a, const struct pel_volume *b) {
    assert_memory_equal(a->dims, b->dims, sizeof a->dims);
    assert_int_equal(a->type, b->type);
    assert_memory_equal(&a->world_from_voxel, &b->world_from_voxel, sizeof a->world_from_voxel);
    if (a->voxels)
        assert_memory_equal(a->voxels, b->voxels, pel_volume_bytes(a));
    else
        assert_null(b->voxels);
}

// Structs without pointers are compared byte by byte: both were zeroed before they were filled.
static void assert_same_scene(const struct pel_scene *a, const struct pel_scene *b) {
    assert_memory_equal(a->camera.eye, b->camera.eye, sizeof a->camera.eye);
    assert_memory_equal(a->camera.target, b->camera.target, sizeof a->camera.target);
    assert_memory_equal(a->camera.up, b->camera.up, sizeof a->camera.up);
    assert_float_equal(a->camera.fov_deg, b->camera.fov_deg, 0);
    assert_float_equal(a->camera.height_mm, b->camera.height_mm, 0);
    assert_int_equal(a->camera.orthographic, b->camera.orthographic);
    assert_memory_equal(a->camera.shift, b->camera.shift, sizeof a->camera.shift);
    assert_memory_equal(a->background, b->background, sizeof a->background);
    assert_int_equal(a->volume_count, b->volume_count);
    assert_int_equal(a->instance_count, b->instance_count);
    for (int i = 0; i < a->volume_count; i++)
        assert_same_volume(a->volumes[i], b->volumes[i]);
    for (int i = 0; i < a->instance_count; i++) {
        struct pel_instance one = a->instances[i], other = b->instances[i];
        assert_same_transfer(one.transfer, other.transfer);
        one.transfer = other.transfer = NULL;
        assert_memory_equal(&one, &other, sizeof one);
    }
    assert_int_equal(a->light_count, b->light_count);
    assert_memory_equal(a->lights, b->lights, sizeof a->lights);
    assert_memory_equal(&a->render, &b->render, sizeof a->render);
    assert_memory_equal(&a->stereo, &b->stereo, sizeof a->stereo);
    assert_memory_equal(&a->wall, &b->wall, sizeof a->wall);
    assert_memory_equal(&a->timeline, &b->timeline, sizeof a->timeline);
    assert_int_equal(a->output.depth, b->output.depth);
    assert_int_equal(a->output.premultiplied, b->output.premultiplied);
}

static void check_round_trip(const char *path) {
    struct pel_scene *scene = load(path);
    struct pel_scene *again = save_and_load(scene, test_temporary_path("saved.json"));
    assert_same_scene(scene, again);
    // Saved once more, nothing is different.
    const char *saved = test_temporary_path("saved.json");
    char *text = text_of(scene, saved), *second = text_of(again, saved);
    assert_string_equal(text, second);
    free(text);
    free(second);
    pel_scene_destroy(again);
    pel_scene_destroy(scene);
}

static void test_round_trip(void **state) {
    (void)state;
    glob_t found;
    assert_int_equal(glob(TEST_SOURCE "/scenes/*.json", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++)
        if (!strstr(found.gl_pathv[i], ".schema.json"))
            check_round_trip(found.gl_pathv[i]);
    globfree(&found);
    for (size_t i = 0; i < sizeof rich / sizeof *rich; i++)
        check_round_trip(test_write_scene("rich.json", rich[i]));
}

// ---- Every key ---------------------------------------------------------------------------------

// Keys that say what other keys say: what they mean is written by those.
static const char *const other_words[] = {"comment",
                                          "$schema",
                                          "camera.view",
                                          "camera.fit",
                                          "volume.palette",
                                          "volume.opacity_unit",
                                          "render.quality",
                                          "render.filter",
                                          "render.gradient",
                                          "transfer.preset",
                                          "transfer.range",
                                          "transfer.colors",
                                          "transfer.scale",
                                          "wall.columns",
                                          "wall.rows",
                                          "wall.bezel",
                                          NULL};

// Objects whose keys are ways to say one thing.
static const char *const other_ways[] = {"transform", NULL};

static bool is_in(const char *const *list, const char *key) {
    for (; *list; list++)
        if (strcmp(*list, key) == 0)
            return true;
    return false;
}

// Collects "object.key" of everything in a saved scene. Elements of a list count as the list's
// singular: volumes.0.name is volume.name. Those of `iso` are surfaces.
static void collect(json_t *found, const char *name, const json_t *value) {
    const char *key;
    json_t *member;
    json_object_foreach((json_t *)value, key, member) {
        char path[256];
        snprintf(path, sizeof path, "%s%s%s", name, *name ? "." : "", key);
        json_object_set_new(found, path, json_true());
        collect(found, strcmp(key, "iso") == 0 ? "surface" : key, member);
    }
    for (size_t i = 0; json_is_array(value) && i < json_array_size(value); i++) {
        char singular[64];
        snprintf(singular, sizeof singular, "%.*s",
                 (int)strlen(name) - (name[0] && name[strlen(name) - 1] == 's'), name);
        collect(found, singular, json_array_get(value, i));
    }
}

static int missing_count;

// Goes over the objects of the schema. A definition's name is the name of its object.
static void check_schema(json_t *found, const json_t *schema, const char *name) {
    const char *key;
    json_t *member;
    size_t index;
    json_object_foreach(json_object_get(schema, "properties"), key, member) {
        char path[256];
        snprintf(path, sizeof path, "%s%s%s", name, *name ? "." : "", key);
        if (is_in(other_words, key) || is_in(other_words, path))
            continue;
        if (!json_object_get(found, path)) {
            print_message("%s is in the schema but is not written\n", path);
            missing_count++;
        }
        check_schema(found, member, key);
    }
    if (is_in(other_ways, name))
        return;
    json_array_foreach(json_object_get(schema, "anyOf"), index, member)
        check_schema(found, member, name);
    json_array_foreach(json_object_get(schema, "oneOf"), index, member)
        check_schema(found, member, name);
}

static void test_every_key(void **state) {
    (void)state;
    json_t *found = json_object();
    for (size_t i = 0; i < sizeof rich / sizeof *rich; i++) {
        struct pel_scene *scene = load(test_write_scene("rich.json", rich[i]));
        // No file of this test has several time points, or bytes to skip.
        scene->sources[0].load.time = 1;
        scene->sources[0].load.raw.offset = 5;
        char *text = text_of(scene, NULL);
        json_t *root = json_loads(text, 0, NULL);
        assert_non_null(root);
        collect(found, "", root);
        json_decref(root);
        free(text);
        pel_scene_destroy(scene);
    }
    json_t *schema = json_load_file(TEST_SOURCE "/scenes/scene.schema.json", 0, NULL);
    assert_non_null(schema);
    check_schema(found, schema, "");
    const char *name;
    json_t *definition;
    json_object_foreach(json_object_get(schema, "$defs"), name,
                        definition) if (!is_in(other_ways, name))
        check_schema(found, definition, name);
    json_decref(schema);
    json_decref(found);
    assert_int_equal(missing_count, 0);
}

// ---- The file ----------------------------------------------------------------------------------

static void test_paths(void **state) {
    (void)state;
    char folder[512], saved[600], *text;
    struct pel_scene *scene = load(test_write_scene("scene.json", "{" TEST_VOLUMES "}"));
    snprintf(folder, sizeof folder, "%s", test_temporary_path("below"));
    assert_int_equal(mkdir(folder, 0777), 0);
    text = text_of(scene, test_temporary_path("any.json"));
    assert_non_null(strstr(text, "\"file\": \"a.raw\""));
    free(text);
    snprintf(saved, sizeof saved, "%s/saved.json", folder);
    text = text_of(scene, saved);
    assert_non_null(strstr(text, "\"file\": \"../a.raw\""));
    free(text);
    struct pel_scene *again = save_and_load(scene, saved);
    assert_same_scene(scene, again);
    pel_scene_destroy(again);
    // Without a place of its own a scene names its files from the root.
    text = text_of(scene, NULL);
    assert_non_null(strstr(text, "\"file\": \"/"));
    assert_null(strchr(text, '\n'));
    free(text);
    assert_false(pel_scene_save(scene, "no/such/folder/a.json"));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    pel_scene_destroy(scene);
    unlink(saved);
    rmdir(folder);
}

// A volume without a name has its file's, as much of it as there is room for: whole characters,
// or the scene could not be written.
static void test_long_file_name(void **state) {
    (void)state;
    char leaf[128] = "", text[512];
    while (strlen(leaf) < 80)
        strcat(leaf, "\xc3\xbc");
    unsigned char voxels[24] = {0};
    for (unsigned char i = 0; i < 24; i++)
        voxels[i] = i;
    test_write(leaf, voxels, sizeof voxels);
    snprintf(text, sizeof text, "{'volumes': [{'file': '%s', 'raw': {'dims': [2, 3, 4]}}]}", leaf);
    struct pel_scene *scene = load(test_write_scene("long.json", text));
    leaf[62] = '\0';
    assert_string_equal(scene->instances[0].name, leaf);
    struct pel_scene *again = save_and_load(scene, test_temporary_path("saved.json"));
    assert_same_scene(scene, again);
    pel_scene_destroy(again);
    pel_scene_destroy(scene);
}

// A file that is changed stays as it was when the scene cannot be saved.
static void test_nameless_volume(void **state) {
    (void)state;
    const int dims[3] = {2, 2, 2};
    struct pel_volume *volume = pel_volume_create("made", dims, PEL_VOXEL_U8);
    memset(volume->voxels, 1, 8);
    struct pel_scene *scene = pel_scene_create();
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), 0);
    pel_volume_destroy(volume);
    assert_false(pel_scene_save(scene, test_temporary_path("made.json")));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_string_equal(pel_error_message(),
                        "volume 'made' came from no file that a scene could name");
    assert_int_not_equal(access(test_temporary_path("made.json"), F_OK), 0);
    pel_scene_destroy(scene);
}

// What is written reads like what people write.
// Tracks go with their volumes.
static void test_animation(void **state) {
    (void)state;
    struct pel_scene *scene = load(test_write_scene("rich.json", rich[0]));
    assert_true(pel_scene_set_frame(scene, 10));
    assert_float_equal(scene->instances[1].density, 1, 0);
    assert_true(pel_scene_move(scene, 1, 0));
    struct pel_scene *again = save_and_load(scene, test_temporary_path("saved.json"));
    assert_float_equal(again->timeline.frame, 10, 0);
    assert_float_equal(again->instances[0].density, 1, 0);
    assert_float_equal(again->instances[1].transfer->opacity_unit_mm,
                       scene->instances[1].transfer->opacity_unit_mm, 0);
    assert_true(pel_scene_set_frame(again, 0));
    assert_float_equal(again->instances[0].density, 0, 0);
    assert_string_equal(again->instances[0].name, "head-pair");
    pel_scene_destroy(again);
    assert_true(pel_scene_remove(scene, 0));
    again = save_and_load(scene, test_temporary_path("saved.json"));
    assert_int_equal(again->timeline.frame_count, 20);
    assert_int_equal(again->instance_count, 1);
    pel_scene_destroy(again);
    pel_scene_destroy(scene);
}

static void test_look(void **state) {
    (void)state;
    struct pel_scene *scene = load(test_write_scene(
        "scene.json", "{'camera': {'eye': [0, 300, 40], 'target': [0, 0, 0.1]}, 'volumes': [{"
                      "'name': 'ball', 'generate': {'kind': 'sphere', 'size': 8}, 'transfer': {"
                      "'points': [[0.1, '#102030', 0], [1, '#ffffff', 0.3]]}}],"
                      "'render': {'size': [32, 24]}}"));
    char *text = text_of(scene, test_temporary_path("any.json"));
    assert_string_equal(
        text,
        "{\n"
        "    \"camera\": {\"eye\": [0, 300, 40], \"target\": [0, 0, 0.1]},\n"
        "    \"volumes\": [\n"
        "        {\n"
        "            \"name\": \"ball\",\n"
        "            \"generate\": {\"kind\": \"sphere\", \"size\": 8},\n"
        "            \"transfer\": {\"points\": [[0.1, \"#102030\", 0], [1, \"#ffffff\", 0.3]]}\n"
        "        }\n"
        "    ],\n"
        "    \"render\": {\"size\": [32, 24]}\n"
        "}");
    free(text);
    pel_scene_destroy(scene);
}

static void test_transfer(void **state) {
    (void)state;
    const char *path = test_temporary_path("transfer.json");
    for (const char *const *name = pel_transfer_presets(); *name; name++) {
        struct pel_transfer *transfer = pel_transfer_preset(*name);
        transfer->table_entries = 123;
        transfer->nearest = !transfer->nearest;
        transfer->opacity_unit_mm = 1.0 / 3;
        assert_true(pel_transfer_save(transfer, path));
        struct pel_transfer *again = pel_transfer_load(path);
        if (!again)
            fail_msg("%s: %s", *name, pel_error_message());
        assert_same_transfer(transfer, again);
        pel_transfer_destroy(transfer);
        pel_transfer_destroy(again);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),     cmocka_unit_test(test_every_key),
        cmocka_unit_test(test_paths),          cmocka_unit_test(test_nameless_volume),
        cmocka_unit_test(test_long_file_name), cmocka_unit_test(test_animation),
        cmocka_unit_test(test_look),           cmocka_unit_test(test_transfer),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
