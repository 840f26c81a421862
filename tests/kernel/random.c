// random.c - random scenes against the reference. PELLUCID_TEST_SEED picks the first seed and
// PELLUCID_TEST_COUNT how many; a failing seed is in the message.
//
// Nearly every scene needs a kernel of its own, which takes far longer to compile than to run. So
// each is seen by one renderer, which the seed chooses.
#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"

static uint64_t number_from(const char *variable, uint64_t otherwise) {
    const char *text = getenv(variable);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

static void test_seeds(void **state) {
    (void)state;
    uint64_t first = number_from("PELLUCID_TEST_SEED", 1);
    uint64_t count = number_from("PELLUCID_TEST_COUNT", scene_is_small() ? 12 : 24);
    print_message("seeds %llu to %llu\n", (unsigned long long)first,
                  (unsigned long long)(first + count - 1));
    enum { RENDERERS = 3 };
    struct pel_renderer *renderers[RENDERERS] = {
        judge_renderer(PEL_READER_BUFFER, 1),
        judge_renderer(PEL_READER_BUFFER, judge_packet_lanes()),
        judge_renderer(PEL_READER_AUTO, 0),
    };
    for (uint64_t seed = first; seed < first + count; seed++) {
        struct pel_scene *scene = scene_random(seed, scene_is_small());
        char title[64];
        snprintf(title, sizeof title, "seed %llu", (unsigned long long)seed);
        pel_image_destroy(judge_render(renderers[seed % RENDERERS], scene, NULL, title));
        pel_scene_destroy(scene);
    }
    for (int r = 0; r < RENDERERS; r++)
        pel_renderer_destroy(renderers[r]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_seeds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
