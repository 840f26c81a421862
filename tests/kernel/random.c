// random.c - random scenes against the reference. PELLUCID_TEST_SEED picks the first seed and
// PELLUCID_TEST_COUNT how many; a failing seed is in the message. Without them most seeds are
// always the same, and a few are of this run, so that in time many are tried.
//
// Nearly every scene needs a kernel of its own, which takes far longer to compile than to run. So
// each is seen by one renderer, which the seed chooses, as it does the way to skip.
#include <time.h>

#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"
#include "support/ways.h"

static uint64_t number_from(const char *variable, uint64_t otherwise) {
    const char *text = getenv(variable);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

enum { RENDERERS = 3 };

static void try_seed(struct pel_renderer *renderers[RENDERERS], uint64_t seed) {
    struct pel_scene *scene = scene_random(seed, scene_is_small());
    scene->render.skip = way_of(seed / RENDERERS);
    char title[64];
    snprintf(title, sizeof title, "seed %llu", (unsigned long long)seed);
    pel_image_destroy(judge_render(renderers[seed % RENDERERS], scene, NULL, title));
    pel_scene_destroy(scene);
}

static void test_seeds(void **state) {
    (void)state;
    bool all = getenv("PELLUCID_TEST_ALL") != NULL;
    bool given = getenv("PELLUCID_TEST_SEED") != NULL;
    uint64_t first = number_from("PELLUCID_TEST_SEED", 1);
    uint64_t count = number_from("PELLUCID_TEST_COUNT", all ? 12 : scene_is_small() ? 6 : 9);
    uint64_t fresh = (uint64_t)time(NULL), fresh_count = given ? 0 : scene_is_small() ? 2 : 3;
    print_message("seeds %llu to %llu, and %llu from %llu on\n", (unsigned long long)first,
                  (unsigned long long)(first + count - 1), (unsigned long long)fresh_count,
                  (unsigned long long)fresh);
    struct pel_renderer *renderers[RENDERERS] = {
        judge_renderer(PEL_READER_BUFFER, 1),
        judge_renderer(PEL_READER_BUFFER, judge_packet_lanes()),
        judge_renderer(PEL_READER_AUTO, 0),
    };
    for (uint64_t n = 0; n < count; n++)
        try_seed(renderers, first + n);
    for (uint64_t n = 0; n < fresh_count; n++)
        try_seed(renderers, fresh + n);
    for (int r = 0; r < RENDERERS; r++)
        pel_renderer_destroy(renderers[r]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_seeds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
