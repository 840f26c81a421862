// scene_light.c - the `lights` of a scene and the `shading` of its volumes.
#include "support/near.h"
#include "support/scene_file.h"

static struct pel_scene *load(const char *quoted, const char *const *overrides, int count) {
    struct pel_scene *scene =
        pel_scene_load(test_write_scene("light.json", quoted), overrides, count);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

static void test_defaults(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'volumes': [{" TEST_VOLUME "}, {" TEST_VOLUME ", 'shading': false}, {" TEST_VOLUME
             ", 'shading': true}, {" TEST_VOLUME ", 'shading': {}}]}",
             NULL, 0);
    assert_int_equal(scene->light_count, 0);
    assert_int_equal(scene->instances[0].material.shading, PEL_SHADING_NONE);
    assert_int_equal(scene->instances[1].material.shading, PEL_SHADING_NONE);
    for (int k = 2; k < 4; k++) {
        const struct pel_material *material = &scene->instances[k].material;
        assert_int_equal(material->shading, PEL_SHADING_BLINN_PHONG);
        assert_near(material->ambient, 0.1, 0);
        assert_near(material->diffuse, 0.7, 0);
        assert_near(material->specular, 0.2, 0);
        assert_near(material->shininess, 10, 0);
        assert_false(material->one_sided);
    }
    pel_scene_destroy(scene);
}

static void test_material(void **state) {
    (void)state;
    const char *overrides[] = {"volumes.0.shading.ambient=0.4"};
    struct pel_scene *scene = load("{'volumes': [{" TEST_VOLUME
                                   ", 'shading': {'model': 'phong', 'diffuse': 0, 'specular': 2, "
                                   "'shininess': 99, 'two_sided': false, 'comment': 'x'}}]}",
                                   overrides, 1);
    const struct pel_material *material = &scene->instances[0].material;
    assert_int_equal(material->shading, PEL_SHADING_PHONG);
    assert_near(material->ambient, 0.4, 0);
    assert_near(material->diffuse, 0, 0);
    assert_near(material->specular, 2, 0);
    assert_near(material->shininess, 99, 0);
    assert_true(material->one_sided);
    pel_scene_destroy(scene);
}

static void test_lights(void **state) {
    (void)state;
    struct pel_scene *scene = load(
        "{'lights': [{}, {'kind': 'camera', 'colour': '#ff0080', 'intensity': 0.5},"
        "{'kind': 'directional', 'direction': [1, 0, -2]},"
        "{'kind': 'point', 'position': [3, 4, 5], 'colour': [0.1, 0.2, 0.3]}]," TEST_VOLUMES "}",
        NULL, 0);
    assert_int_equal(scene->light_count, 4);
    const struct pel_light *lights = scene->lights;
    for (int n = 0; n < 4; n++)
        assert_int_equal(lights[n].kind, n);
    assert_near(lights[0].colour[1], 1, 0);
    assert_near(lights[0].intensity, 1, 0);
    assert_near(lights[1].colour[0], 1, 0);
    assert_near(lights[1].colour[2], 128 / 255.0, 1e-12);
    assert_near(lights[1].intensity, 0.5, 0);
    assert_near(lights[2].direction[2], -2, 0);
    assert_near(lights[3].position[1], 4, 0);
    assert_near(lights[3].colour[2], 0.3, 0);
    pel_scene_destroy(scene);
}

static const struct {
    const char *members, *message;
} bad[] = {
    {"'lights': []", "lights: must have 1 to 8 elements, not 0"},
    {"'lights': [{'kind': 'sun'}]",
     "lights.0.kind: must be headlight, camera, directional or point, not \"sun\""},
    {"'lights': [{'kind': 'directional'}]", "lights.0: needs 'direction'"},
    {"'lights': [{}, {'kind': 'point'}]", "lights.1: needs 'position'"},
    {"'lights': [{'position': [1, 2, 3]}]",
     "lights.0.position: is of no use to this kind of light"},
    {"'lights': [{'kind': 'directional', 'direction': [0, 0, 0]}]",
     "lights.0.direction: has no length"},
    {"'lights': [{'intensity': -1}]",
     "lights.0.intensity: must be at least 0 and at most 1000, not -1"},
    {"'lights': [{'color': 'red'}]", "lights.0.color: unknown key; did you mean 'colour'"},
    {"'volumes': [{" TEST_VOLUME ", 'shading': 'on'}]",
     "volumes.0.shading: must be true, false or an object"},
    {"'volumes': [{" TEST_VOLUME ", 'shading': {'shininess': 0}}]",
     "volumes.0.shading.shininess: must be at least 1 and at most 1000, not 0"},
    {"'volumes': [{" TEST_VOLUME ", 'shading': {'model': 'gouraud'}}]",
     "volumes.0.shading.model: must be blinn-phong or phong, not \"gouraud\""},
    {"'render': {'shadows': 1}", "render.shadows: must be true, false or an object"},
    {"'render': {'shadows': {'length': 0}}",
     "render.shadows.length: must be above 0 and at most 1e+09, not 0"},
    {"'render': {'shadows': {'step': 0.1}}",
     "render.shadows.step: must be at least 0.25 and at most 64, not 0.1"},
    {"'render': {'ambient_occlusion': {'directions': 65}}",
     "render.ambient_occlusion.directions: must be at least 1 and at most 64, not 65"},
    {"'render': {'ambient_occlusion': {'strength': 0}}",
     "render.ambient_occlusion.strength: must be above 0 and at most 1, not 0"},
    {"'render': {'lod': 16}", "render.lod: must be at least 0 and at most 15, not 16"},
    {"'render': {'lod': 'far'}", "render.lod: must be off or auto, not \"far\""},
    {"'render': {'ambient_occlusion': {'radios': 3}}",
     "render.ambient_occlusion.radios: unknown key; did you mean 'radius'"},
};

// True is all defaults, which in memory are zeros; an object says the rest, and false nothing.
static void test_secondary(void **state) {
    (void)state;
    struct pel_scene *scene = load(
        "{'render': {'shadows': true, 'ambient_occlusion': false}, " TEST_VOLUMES "}", NULL, 0);
    assert_true(scene->render.shadows.on);
    assert_true(scene->render.shadows.step == 0 && scene->render.shadows.length_mm == 0);
    assert_false(scene->render.ambient_occlusion.on);
    pel_scene_destroy(scene);
    const char *overrides[] = {"render.ambient_occlusion.radius=5"};
    scene = load("{'render': {'ambient_occlusion': {'directions': 7, 'step': 3, 'strength': "
                 "0.5}}, " TEST_VOLUMES "}",
                 overrides, 1);
    const struct pel_ambient_occlusion *occlusion = &scene->render.ambient_occlusion;
    assert_true(occlusion->on && occlusion->directions == 7 && occlusion->radius_mm == 5);
    assert_true(occlusion->step == 3 && occlusion->strength == 0.5);
    assert_false(scene->render.shadows.on);
    pel_scene_destroy(scene);
}

static void test_refusals(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof bad / sizeof *bad; n++) {
        char text[512];
        bool own_volumes = strstr(bad[n].members, "volumes") != NULL;
        snprintf(text, sizeof text, "{%s%s}", bad[n].members, own_volumes ? "" : ", " TEST_VOLUMES);
        assert_null(pel_scene_load(test_write_scene("bad.json", text), NULL, 0));
        const char *got = strstr(pel_error_message(), ": ");
        if (!got || strcmp(got + 2, bad[n].message) != 0)
            fail_msg("%s\n  gives  %s\n  not    %s", text, pel_error_message(), bad[n].message);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults), cmocka_unit_test(test_material),
        cmocka_unit_test(test_lights),   cmocka_unit_test(test_secondary),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
