// scenes.c - every scene of scenes/ and scenes/thesis/ is a picture test: rendered small, it has to
// agree with the reference. The scenes take the ways to skip in turns. Saved, each is the same
// picture.
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/judge.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"
#include "support/ways.h"

static int is_scene(const struct dirent *entry) {
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".json") == 0 && !strstr(entry->d_name, ".schema.");
}

// Where hypertextures are baked on a grid, its size is a key of the scene's.
static const char *size_of_grids(const char *name, bool small) {
    if (strstr(name, "hypertexture-head"))
        return small ? "volumes.boiling.hypertexture.size=8"
                     : "volumes.boiling.hypertexture.size=16";
    if (strstr(name, "hypertexture"))
        return small ? "volumes.*.hypertexture.size=8" : "volumes.*.hypertexture.size=16";
    return NULL;
}

// The scene at a size that the reference, and Oclgrind, render in a moment. Compiling its kernel
// takes the same for all sizes, but the pictures and grids of some scenes take longer than that. A
// device that has one ray at a time does not optimise its code either (support/on).
static struct pel_scene *load_small(const char *name) {
    char path[1024];
    snprintf(path, sizeof path, "%s/scenes/%s", TEST_SOURCE, name);
    // The reference takes a minute for 32 volumes in one place, and so does an interpreter.
    bool many = strstr(name, "overlapping-32"), is_small = scene_is_small() || many;
    const char *grids = size_of_grids(name, is_small);
    const char *small[] = {many ? "render.size=[8,6]" : "render.size=[10,7]", "render.step=1",
                           grids ? grids : "volumes.*.generate.size=12",
                           "volumes.*.generate.spacing=4"};
    // Volumes with a spacing of their own keep their size in millimetres.
    int small_count = strstr(name, "level-of-detail") ? 4 : 3;
    const char *normal[] = {
        judge_packet_lanes() == 1 ? "render.size=[24,18]" : "render.size=[40,30]", grids};
    if (getenv("PELLUCID_TEST_ALL")) {
        normal[0] = "render.size=[64,48]";
        grids = NULL;
    }
    struct pel_scene *scene = is_small ? pel_scene_load(path, small, small_count)
                                       : pel_scene_load(path, normal, grids ? 2 : 1);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

// A scene that was saved renders to the same bytes.
static void check_saved(struct pel_renderer *renderer, const struct pel_scene *scene,
                        const struct pel_image *expected, const char *title) {
    const char *path = test_temporary_path("saved.json");
    if (!pel_scene_save(scene, path))
        fail_msg("%s: %s", title, pel_error_message());
    struct pel_scene *saved = pel_scene_load(path, NULL, 0);
    struct pel_image *picture = saved ? pel_renderer_render(renderer, saved, NULL, NULL) : NULL;
    if (!picture)
        fail_msg("%s: %s", title, pel_error_message());
    assert_pictures_equal(picture, expected, title);
    pel_image_destroy(picture);
    pel_scene_destroy(saved);
}

// What the reference cannot judge. It works a hypertexture out where it is asked for and has no
// voxels of it; live.c compares baked ones. And a sample within rounding of the face between two
// voxels may take either: the model of the thesis weighs one sample more than the judge allows for.
static bool is_beyond_judging(const struct pel_scene *scene) {
    bool baked = false, nearest = false;
    for (int i = 0; i < scene->volume_count; i++)
        baked |= !scene->volumes[i]->voxels && !scene->sources[i].hypertexture.live;
    for (int k = 0; k < scene->instance_count; k++)
        nearest |= scene->instances[k].filter == PEL_FILTER_NEAREST;
    return baked || (nearest && scene->render.model == PEL_MODEL_THESIS);
}

// One scene by a renderer, and by another one unless that is NULL.
static void check_scene(struct pel_renderer *renderer, struct pel_renderer *other, const char *name,
                        enum pel_skip skip) {
    struct pel_scene *scene = load_small(name);
    struct pel_render_statistics statistics;
    scene->render.skip = skip;
    struct pel_image *picture = is_beyond_judging(scene)
                                    ? pel_renderer_render(renderer, scene, NULL, &statistics)
                                    : judge_render(renderer, scene, &statistics, name);
    if (!picture)
        fail_msg("%s: %s", name, pel_error_message());
    if (!scene_is_small())
        check_saved(renderer, scene, picture, name);
    pel_image_destroy(picture);
    assert_true(statistics.samples > 0);
    if (other && !is_beyond_judging(scene))
        pel_image_destroy(judge_render(other, scene, &statistics, name));
    pel_scene_destroy(scene);
}

// A kernel takes seconds to compile, so implementations take turns: one with packets reads all
// scenes from buffers and a fourth of them from images, the others read each scene in one of both
// ways. PELLUCID_TEST_ALL gives all of them all.
static bool takes(enum pel_reader reader, int scene) {
    bool images = reader == PEL_READER_IMAGE;
    if (getenv("PELLUCID_TEST_ALL"))
        return true;
    if (scene_is_small())
        return images == (scene % 2 == 0);
    if (judge_packet_lanes() == 1)
        return images == (scene % 2 == 1);
    return !images || scene % 4 == 1;
}

static void test_scenes(void **state) {
    (void)state;
    struct dirent **entries;
    int count = scandir(TEST_SOURCE "/scenes", &entries, is_scene, alphasort);
    assert_true(count > 0);
    struct pel_renderer *buffers = judge_renderer(PEL_READER_BUFFER, 0);
    struct pel_renderer *images = judge_renderer(PEL_READER_IMAGE, 1);
    struct pel_scene *first = load_small(entries[0]->d_name);
    bool has_images = judge_has_images(images, first);
    pel_scene_destroy(first);
    for (int i = 0; i < count; i++) {
        // Oclgrind has no word for what its compiler makes of three models in one shaded scene.
        if (!scene_is_small() || strcmp(entries[i]->d_name, "models.json") != 0) {
            struct pel_renderer *other = has_images && takes(PEL_READER_IMAGE, i) ? images : NULL;
            bool both = !other || takes(PEL_READER_BUFFER, i);
            check_scene(both ? buffers : other, both ? other : NULL, entries[i]->d_name,
                        way_of((uint64_t)i + 1));
        }
        free(entries[i]);
    }
    free(entries);
    pel_renderer_destroy(buffers);
    pel_renderer_destroy(images);
}

// The thesis's figures are much alike, so one reader, one way to skip and one implementation do.
static void test_thesis(void **state) {
    (void)state;
    if (scene_is_small() || (judge_packet_lanes() == 1 && !getenv("PELLUCID_TEST_ALL")))
        skip();
    struct dirent **entries;
    int count = scandir(TEST_SOURCE "/scenes/thesis", &entries, is_scene, alphasort);
    assert_true(count > 0);
    struct pel_renderer *buffers = judge_renderer(PEL_READER_BUFFER, 0);
    for (int i = 0; i < count; i++) {
        char name[512];
        snprintf(name, sizeof name, "thesis/%s", entries[i]->d_name);
        check_scene(buffers, NULL, name, PEL_SKIP_DISTANCE);
        free(entries[i]);
    }
    free(entries);
    pel_renderer_destroy(buffers);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_scenes),
                                       cmocka_unit_test(test_thesis)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
