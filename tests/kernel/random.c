// random.c - random scenes against the reference. PELLUCID_TEST_SEED picks the first seed and
// PELLUCID_TEST_COUNT how many; a failing seed is in the message.
#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"

static uint64_t number_from(const char *variable, uint64_t otherwise) {
    const char *text = getenv(variable);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

static void check_seeds(enum pel_reader reader, int lanes) {
    uint64_t first = number_from("PELLUCID_TEST_SEED", 1);
    uint64_t count = number_from("PELLUCID_TEST_COUNT", scene_is_small() ? 6 : 40);
    print_message("seeds %llu to %llu\n", (unsigned long long)first,
                  (unsigned long long)(first + count - 1));
    struct pel_renderer *renderer = judge_renderer(reader, lanes);
    for (uint64_t seed = first; seed < first + count; seed++) {
        struct pel_scene *scene = scene_random(seed, scene_is_small());
        char title[64];
        snprintf(title, sizeof title, "seed %llu, %d lanes", (unsigned long long)seed, lanes);
        pel_image_destroy(judge_render(renderer, scene, NULL, title));
        pel_scene_destroy(scene);
    }
    pel_renderer_destroy(renderer);
}

static void test_one_ray(void **state) {
    (void)state;
    check_seeds(PEL_READER_BUFFER, 1);
}

static void test_packet(void **state) {
    (void)state;
    check_seeds(PEL_READER_BUFFER, 16);
}

static void test_own_choice(void **state) {
    (void)state;
    check_seeds(PEL_READER_AUTO, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_ray),
        cmocka_unit_test(test_packet),
        cmocka_unit_test(test_own_choice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
