// worker.c - the viewer's rendering beside its event loop: what it hands back is what the renderer
// makes, on one device or on several at once, and after a failure of any kind it goes on.
#include "viewer/worker.h"

#include <math.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "support/judge.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

enum { WIDTH = 24, HEIGHT = 16 };

static void wake(void) {
}

static struct pel_worker *make_worker(const struct pel_renderer_options *options) {
    struct pel_worker *worker = pel_worker_create(options, NULL, wake);
    assert_non_null(worker);
    return worker;
}

static void submit(struct pel_worker *worker, const struct pel_scene *scene, uint64_t id) {
    struct pel_request request = {.id = id, .view_count = 1, .target_ms = 1000};
    request.scenes[0] = pel_scene_copy(scene);
    assert_non_null(request.scenes[0]);
    pel_worker_submit(worker, &request);
}

// Waits for the picture of full quality, or for a sentence: then NULL.
static struct pel_picture *wait_for(struct pel_worker *worker, uint64_t id, char *sentence) {
    struct pel_picture *picture = NULL;
    struct pel_worker_status status;
    const struct timespec pause = {.tv_nsec = 2000000};
    sentence[0] = '\0';
    for (int i = 0; i < 100000; i++) {
        pel_worker_ask(worker, &status);
        struct pel_picture *newer = pel_worker_take(worker);
        if (newer) {
            pel_picture_destroy(picture);
            picture = newer;
        }
        if (picture && picture->id == id && picture->final)
            return picture;
        // A sentence stays until a picture comes, so that it can be read.
        if (status.sentence[0] && !status.busy) {
            snprintf(sentence, PEL_WORKER_SENTENCE, "%s", status.sentence);
            pel_picture_destroy(picture);
            return NULL;
        }
        nanosleep(&pause, NULL);
    }
    fail_msg("no picture %d", (int)id);
    return NULL;
}

static int byte_of(float value) {
    return value > 0 ? value < 1 ? (int)(value * 255 + 0.5f) : 255 : 0;
}

// The view's pixels are those of the renderer's picture, from column `left` on.
static void assert_shows(const struct pel_pixels *pixels, const struct pel_image *expected,
                         int left) {
    assert_int_equal(pixels->height, expected->height);
    for (int y = 0; y < pixels->height; y++)
        for (int i = 0; i < 4 * pixels->width; i++)
            assert_int_equal(pixels->rgba[4 * y * pixels->width + i],
                             byte_of(expected->rgba[4 * (y * expected->width + left) + i]));
}

static void assert_works(struct pel_worker *worker, const struct pel_scene *scene, uint64_t id,
                         const struct pel_image *expected) {
    char sentence[PEL_WORKER_SENTENCE];
    submit(worker, scene, id);
    struct pel_picture *picture = wait_for(worker, id, sentence);
    if (!picture)
        fail_msg("%s", sentence);
    assert_shows(&picture->views[0], expected, 0);
    pel_picture_destroy(picture);
}

static struct pel_image *render(const struct pel_scene *scene) {
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_image *picture = render_picture(renderer, scene, NULL);
    pel_renderer_destroy(renderer);
    return picture;
}

// Two views of one moment, each on a renderer of its own.
static void test_devices(void **state) {
    (void)state;
    // Oclgrind simulates one kernel at a time.
    if (scene_is_small())
        skip();
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    struct pel_image *expected = render(scene);
    struct pel_renderer_options options = {.device = NULL};
    struct pel_worker *worker = make_worker(&options);
    char sentence[PEL_WORKER_SENTENCE];
    struct pel_request request = {.id = 7, .view_count = 2, .target_ms = 1000};
    for (int i = 0; i < 2; i++) {
        request.scenes[i] = pel_scene_copy(scene);
        memcpy(request.scenes[i]->render.region, (int[]){i ? 9 : 0, 0, i ? 15 : 9, HEIGHT},
               sizeof scene->render.region);
        request.devices[i] = i ? "0" : "";
    }
    pel_worker_submit(worker, &request);
    struct pel_picture *picture = wait_for(worker, 7, sentence);
    if (!picture)
        fail_msg("%s", sentence);
    assert_int_equal(picture->view_count, 2);
    assert_int_equal(picture->views[1].width, 15);
    assert_shows(&picture->views[0], expected, 0);
    assert_shows(&picture->views[1], expected, 9);
    pel_picture_destroy(picture);
    pel_worker_destroy(worker);
    pel_image_destroy(expected);
    pel_scene_destroy(scene);
}

#ifndef __SANITIZE_ADDRESS__
// The address space that this process has.
static rlim_t used_bytes(void) {
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%lu", &pages), 1);
    fclose(file);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}
#endif

// A scene that the device refuses, and one that there is no host memory for.
static void test_failures(void **state) {
    (void)state;
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    struct pel_image *expected = render(scene);
    // With packets the device's own numbers take less than the picture, which is asked for after
    // them.
    struct pel_renderer_options options = {.device = NULL, .lanes = 4};
    struct pel_worker *worker = make_worker(&options);
    char sentence[PEL_WORKER_SENTENCE];
    assert_works(worker, scene, 1, expected);

    scene->render.step = -1;
    submit(worker, scene, 2);
    assert_null(wait_for(worker, 2, sentence));
    assert_non_null(strstr(sentence, "step"));
    scene->render.step = 0.5;
    struct pel_scene *usual = scene_waves(WIDTH, HEIGHT);
    scene->render = usual->render;
    assert_works(worker, scene, 3, expected);

#ifndef __SANITIZE_ADDRESS__
    // Even a quick picture of this size has 64 MiB, and there is half of that.
    struct rlimit before, tight;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    tight = before;
    tight.rlim_cur = used_bytes() + (32 << 20);
    assert_int_equal(setrlimit(RLIMIT_AS, &tight), 0);
    scene->render.width = scene->render.height = 32768;
    submit(worker, scene, 4);
    struct pel_picture *picture = wait_for(worker, 4, sentence);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_null(picture);
    assert_non_null(strstr(sentence, "allocate"));
    scene->render = usual->render;
    assert_works(worker, scene, 5, expected);
#endif
    pel_scene_destroy(usual);
    pel_worker_destroy(worker);
    pel_image_destroy(expected);
    pel_scene_destroy(scene);
}

// Without a device the worker says so as often as it is asked, and ends when it is told to.
static void test_no_device(void **state) {
    (void)state;
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    const struct pel_renderer_options options = {.device = "no such device"};
    struct pel_worker *worker = make_worker(&options);
    char sentence[PEL_WORKER_SENTENCE];
    for (uint64_t id = 1; id <= 2; id++) {
        submit(worker, scene, id);
        assert_null(wait_for(worker, id, sentence));
        assert_non_null(strstr(sentence, "no such device"));
    }
    assert_true(pel_worker_save(worker, pel_scene_copy(scene), "never.png"));
    pel_worker_destroy(worker);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_devices),
        cmocka_unit_test(test_failures),
        cmocka_unit_test(test_no_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
