// mixing.c - every way to mix against the reference, by rays and by packets, whole and in slabs,
// and however empty space is skipped.
#include "base/math.h"
#include "shared/brick.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// Three fields of waves across each other, each with empty and with dense places. The third one is
// the first one's voxels in another pose. A tall volume is two bricks high.
static struct pel_scene *scene_of_waves(bool tall) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 12 : 32, small ? 8 : 24);
    const double colours[3][3] = {{1, 0.3, 0.1}, {0.2, 0.9, 0.3}, {0.2, 0.4, 1}};
    for (int k = 0; k < 3; k++) {
        int dims[3] = {small ? 9 : 17, small ? 8 : 16, tall ? 20 : small ? 10 : 20};
        if (tall)
            dims[0] = 9, dims[1] = 8;
        const double *c = colours[k];
        struct pel_transfer *transfer =
            scene_transfer((const double[][5]){{0, c[0], c[1], c[2], 0},
                                               {110, c[0], c[1], c[2], 0},
                                               {255, c[1], c[2], c[0], 0.3 + 0.1 * k}},
                           3);
        struct pel_instance *instance;
        if (k < 2) {
            struct pel_volume *volume =
                scene_volume_waves(dims, PEL_VOXEL_U8, (uint64_t)(7 + k), small ? 7 : 13);
            double spacing[3] = {(16.0 + k) / dims[0], 16.0 / dims[1], 16.0 / dims[2]};
            scene_place(volume, spacing, (double[]){0.1 * k, 0.2, -0.1, 1}, (double[]){k, -k, 0},
                        false);
            instance = scene_add(scene, volume, transfer);
        } else {
            instance = scene_add_again(scene, 0, transfer);
        }
        instance->transform = pel_matrix_from_quaternion((double[]){0.2 - 0.3 * k, 0.1, 0.3 * k, 1},
                                                         (double[]){-2 + 2 * k, 1 - k, 0.5 * k});
        instance->priority = 1 - k % 2; // the first and the last one tie
        instance->step = k == 1 ? 1.7 : 0;
    }
    scene->render.step = small ? 1 : 0.6;
    scene->background[3] = 1;
    return scene;
}

static const enum pel_mixing mixings[] = {PEL_MIX_ORDERED,      PEL_MIX_MAX,
                                          PEL_MIX_PRIORITY,     PEL_MIX_UNION,
                                          PEL_MIX_INTERSECTION, PEL_MIX_DIFFERENCE};
enum { MIXINGS = sizeof mixings / sizeof *mixings };

// A kernel takes long to compile, so rays, packets and images take turns.
static void test_against_reference(void **state) {
    (void)state;
    enum { WAYS = 3 };
    struct pel_renderer *ways[WAYS] = {
        judge_renderer(PEL_READER_BUFFER, 1),
        judge_renderer(PEL_READER_BUFFER, judge_packet_lanes()),
        judge_renderer(PEL_READER_AUTO, 0),
    };
    struct pel_scene *scene = scene_of_waves(false);
    for (int m = 0; m < MIXINGS; m++) {
        scene->render.mixing = mixings[m];
        scene->render.origin = m % 2 ? PEL_ORIGIN_BOUNDS : PEL_ORIGIN_VOLUMES;
        scene->render.termination = m % 2 ? 0.9 : 1;
        for (int w = 0; w < (mixings[m] == PEL_MIX_ORDERED ? 2 : 1); w++)
            pel_image_destroy(
                judge_render(ways[(m + w) % WAYS], scene, NULL, pel_mixing_names()[mixings[m]]));
    }
    pel_scene_destroy(scene);
    for (int w = 0; w < WAYS; w++)
        pel_renderer_destroy(ways[w]);
}

// What counts is the volume, into however many slabs it is cut; and what is skipped does not count.
static void test_slabs_and_skips(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_waves(true);
    struct pel_renderer *slabs = render_in_slabs(1);
    scene->render.mixing = PEL_MIX_ORDERED;
    pel_image_destroy(judge_render(slabs, scene, NULL, "ordered, slabs"));
    scene->render.mixing = PEL_MIX_INTERSECTION;
    scene->render.skip = PEL_SKIP_NONE;
    struct pel_render_statistics all, some;
    struct pel_image *every = judge_render(slabs, scene, &all, "intersection, slabs, none skipped");
    scene->render.skip = PEL_SKIP_DISTANCE;
    struct pel_image *skipped = judge_render(slabs, scene, &some, "intersection, slabs");
    assert_pictures_within(skipped, every, 0.01, 0, "skipped");
    assert_true(scene_is_small() || some.samples < all.samples);
    pel_image_destroy(every);
    pel_image_destroy(skipped);
    pel_renderer_destroy(slabs);
    pel_scene_destroy(scene);
}

// A volume so long that it is cut whatever the device takes, seen where its slabs meet: places
// there are the largest that kernels work out in floats.
static void test_long_volume(void **state) {
    (void)state;
    const int length = BRICK_SLICES_MAX + 200, seen = BRICK_SLICES_MAX - 5;
    struct pel_scene *scene = scene_create(16, 12);
    struct pel_volume *volume = scene_volume_waves((int[]){6, 7, length}, PEL_VOXEL_U8, 5, 40);
    scene_place(volume, (double[]){1, 1, 1}, (double[]){0, 0.5, 0, 0.5},
                (double[]){0.5 * length - seen, 0, 0}, false);
    scene_add(scene, volume, scene_transfer_gentle((double[]){0, 255}, 0.3, 7));
    scene->render.skip = PEL_SKIP_NONE;
    scene->background[3] = 1;
    for (int packets = 0; packets < 2; packets++) {
        struct pel_renderer *renderer =
            judge_renderer(PEL_READER_BUFFER, packets ? judge_packet_lanes() : 1);
        pel_image_destroy(judge_render(renderer, scene, NULL, "long"));
        pel_renderer_destroy(renderer);
    }
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_reference),
        cmocka_unit_test(test_slabs_and_skips),
        cmocka_unit_test(test_long_volume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
