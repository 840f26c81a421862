// scenes.c - every scene of scenes/ is a picture test: rendered small, it has to agree with the
// reference. The scenes take the ways to skip in turns. Saved, each is the same picture.
#include <dirent.h>

#include "support/judge.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"
#include "support/ways.h"

static int is_scene(const struct dirent *entry) {
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".json") == 0 && !strstr(entry->d_name, ".schema.");
}

// The scene at a size that the reference, and Oclgrind, render in a moment.
static struct pel_scene *load_small(const char *name) {
    char path[1024];
    snprintf(path, sizeof path, "%s/scenes/%s", TEST_SOURCE, name);
    const char *small[] = {"render.size=[16,12]", "render.step=1", "volumes.*.generate.size=12"};
    // Those without generated volumes have smaller hypertextures.
    if (strstr(name, "hypertexture"))
        small[2] = "volumes.*.hypertexture.size=8";
    const char *normal[] = {"render.size=[64,48]"};
    struct pel_scene *scene =
        scene_is_small() ? pel_scene_load(path, small, 3) : pel_scene_load(path, normal, 1);
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

static void test_scenes(void **state) {
    (void)state;
    struct dirent **entries;
    int count = scandir(TEST_SOURCE "/scenes", &entries, is_scene, alphasort);
    assert_true(count > 0);
    struct pel_renderer *buffers = judge_renderer(PEL_READER_BUFFER, 0);
    struct pel_renderer *images = judge_renderer(PEL_READER_IMAGE, 1);
    bool has_images = true;
    for (int i = 0; i < count; i++) {
        struct pel_scene *scene = load_small(entries[i]->d_name);
        struct pel_render_statistics statistics;
        scene->render.skip = way_of((uint64_t)i + 1);
        struct pel_image *picture = judge_render(buffers, scene, &statistics, entries[i]->d_name);
        if (!scene_is_small())
            check_saved(buffers, scene, picture, entries[i]->d_name);
        pel_image_destroy(picture);
        assert_true(statistics.samples > 0);
        has_images = i > 0 ? has_images : judge_has_images(images, scene);
        if (has_images)
            pel_image_destroy(judge_render(images, scene, &statistics, entries[i]->d_name));
        pel_scene_destroy(scene);
        free(entries[i]);
    }
    free(entries);
    pel_renderer_destroy(buffers);
    pel_renderer_destroy(images);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_scenes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
