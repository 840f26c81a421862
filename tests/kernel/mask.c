// mask.c - volumes of which another one's values show a part, against the reference and the
// analytic truth.
#include "base/math.h"
#include "shared/brick.h"
#include "support/judge.h"
#include "support/near.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

static const double red[4] = {1, 0.2, 0, 0.1};

static double layer_field(const double p_voxel[3], const void *user) {
    return ((const double *)user)[(int)p_voxel[2]];
}

// Layers of labels, each 4 mm high, from z = -8 mm on. Voxels are as wide as the whole.
static struct pel_volume *volume_of_layers(enum pel_voxel_type type, const double labels[4]) {
    struct pel_volume *volume = scene_volume((int[]){2, 2, 4}, type, layer_field, labels);
    scene_place(volume, (double[]){40, 40, 4}, (double[]){0, 0, 0, 1}, (double[]){0, 0, 0}, false);
    return volume;
}

// A box of one colour, 16 mm wide, seen along z, and a hidden volume that decides about it.
static struct pel_scene *scene_of_box(struct pel_volume *layers) {
    struct pel_scene *scene = scene_create(8, 8);
    scene_view_parallel(scene, 12);
    struct pel_volume *volume = scene_volume_constant((int[]){16, 16, 16}, PEL_VOXEL_U8, 100);
    scene_add(scene, volume, scene_transfer_constant(red));
    scene_add(scene, layers, scene_transfer_constant(red))->hidden = true;
    scene->instances[0].mask = (struct pel_mask){.instance = 1, .range_count = 1};
    scene->render.step = scene_is_small() ? 1 : 0.25;
    return scene;
}

static double opacity_of(double length_mm) {
    return 1 - exp(length_mm * log(1 - red[3]));
}

// The opacity in the middle of the picture has to be that of a length.
static void expect_length(struct pel_renderer *renderer, const struct pel_scene *scene,
                          double length_mm, struct pel_render_statistics *statistics) {
    struct pel_image *picture = judge_render(renderer, scene, statistics, "box");
    assert_near(picture->rgba[4 * (4 * 8 + 4) + 3], opacity_of(length_mm), 1e-5);
    pel_image_destroy(picture);
}

static void set_range(struct pel_scene *scene, double low, double high) {
    scene->instances[0].mask.ranges[0] = (struct pel_value_range){low, high};
}

static void test_chords(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_volume *layers = volume_of_layers(PEL_VOXEL_I8, (double[]){0, 5, -7, 5});
    struct pel_scene *scene = scene_of_box(layers);
    struct pel_mask *mask = &scene->instances[0].mask;
    struct pel_render_statistics first, moved;
    scene->render.skip = PEL_SKIP_NONE;
    set_range(scene, 5, 5);
    expect_length(renderer, scene, 8, &first);
    set_range(scene, -7, 0);
    expect_length(renderer, scene, 8, NULL);
    set_range(scene, -7.9, -6.1);
    expect_length(renderer, scene, 4, NULL);
    mask->inverted = true;
    expect_length(renderer, scene, 12, NULL);
    // Another label; and values as the file means them, here turned round.
    mask->range_count = 2;
    mask->ranges[1] = (struct pel_value_range){0, 0};
    expect_length(renderer, scene, 8, NULL);
    layers->slope = -0.1;
    layers->intercept = 0.3;
    set_range(scene, 0.3 - 0.1 * 5, 0.3 - 0.1 * 5);
    mask->ranges[1] = (struct pel_value_range){0.5, INFINITY};
    mask->inverted = false;
    expect_length(renderer, scene, 12, NULL);
    // Outside the mask's box nothing is selected. A move sends the world alone.
    scene->instances[1].transform.m[2][3] = 6;
    expect_length(renderer, scene, 6, &moved);
    assert_true(first.uploaded_bytes > 0 && moved.uploaded_bytes <= 8192);
    mask->inverted = true;
    expect_length(renderer, scene, 10, NULL);
    // A box that ends at the voxels' centres is half a voxel smaller all round.
    scene->instances[1].extent = PEL_EXTENT_POINT;
    scene->instances[1].transform.m[2][3] = 0;
    expect_length(renderer, scene, 6, NULL);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// An absent value is not selected, and what is not selected is shown inverted.
static void test_absent(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene =
        scene_of_box(volume_of_layers(PEL_VOXEL_F32, (double[]){1, NAN, 0.25, 0.5}));
    set_range(scene, 0.25, 0.5);
    expect_length(renderer, scene, 8, NULL);
    set_range(scene, -INFINITY, INFINITY);
    expect_length(renderer, scene, 12, NULL);
    scene->instances[0].mask.inverted = true;
    expect_length(renderer, scene, 4, NULL);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A recipe decides at every place anew: here a ball of 30 mm, however coarse its grid.
static void test_recipe(void **state) {
    (void)state;
    const double thin[4] = {1, 0.2, 0, 0.02};
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_create(8, 8);
    scene_view_parallel(scene, 40);
    struct pel_volume *volume = scene_volume_constant((int[]){16, 16, 16}, PEL_VOXEL_U8, 100);
    scene_place(volume, (double[]){6, 6, 6}, (double[]){0, 0, 0, 1}, (double[]){0, 0, 0}, false);
    scene_add(scene, volume, scene_transfer_constant(thin));
    struct pel_bake_options options = {.size = 4, .type = PEL_VOXEL_F32};
    struct pel_volume *recipe = pel_volume_hypertexture("{\"value\": \"radius\"}", &options, true);
    if (!recipe)
        fail_msg("%s", pel_error_message());
    scene->volumes[scene->volume_count++] = recipe;
    scene->statistics[1] = (struct pel_statistics){.max = 1};
    scene_add_again(scene, 1, scene_transfer_constant(thin))->hidden = true;
    // The recipe's cube of 100 mm reaches from -1 to 1.
    scene->instances[0].mask =
        (struct pel_mask){.instance = 1, .range_count = 1, .ranges = {{0, 0.6}}};
    scene->render.step = 1.0 / 12;
    struct pel_image *picture = judge_render(renderer, scene, NULL, "recipe");
    for (int x = 0; x < 8; x++) {
        double across = 5 * (x - 3.5), half = sqrt(900 - across * across - 2.5 * 2.5);
        assert_near(picture->rgba[4 * (4 * 8 + x) + 3], 1 - pow(1 - thin[3], 2 * half), 0.02);
    }
    pel_image_destroy(picture);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Labels 0 to 3 in blocks of a few voxels.
static double block_field(const double p_voxel[3], const void *user) {
    double size = *(const double *)user;
    int block =
        (int)(p_voxel[0] / size) + 2 * (int)(p_voxel[1] / size) + 3 * (int)(p_voxel[2] / size);
    return block % 4;
}

// Waves, and other waves that labels show a part of, all in poses of their own.
static struct pel_scene *scene_of_waves(double voxels_mm) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 9 : 32, small ? 6 : 24);
    scene_add_crossing(scene);
    int side = (int)(16 / voxels_mm);
    double size = fmax(1, 4 / voxels_mm);
    struct pel_volume *blocks =
        scene_volume((int[]){side, side, side + 1}, PEL_VOXEL_U8, block_field, &size);
    scene_place(blocks, (double[]){voxels_mm, voxels_mm, 1.1 * voxels_mm},
                (double[]){-0.3, 0.2, 0.4, 1}, (double[]){1, 0.5, -1}, true);
    scene_add(scene, blocks, scene_transfer_constant(red))->hidden = true;
    scene->instances[1].mask = (struct pel_mask){
        .instance = 2, .range_count = 2, .ranges = {{1, 1}, {3, INFINITY}}, .inverted = true};
    scene->render.step = small ? 1 : 0.6;
    scene->background[3] = 1;
    return scene;
}

// Whatever is skipped, the picture is the same.
static void check_skips(struct pel_renderer *renderer, struct pel_scene *scene, const char *title) {
    static const enum pel_skip skips[2] = {PEL_SKIP_NONE, PEL_SKIP_DISTANCE};
    struct pel_image *pictures[2];
    for (int n = 0; n < 2; n++) {
        scene->render.skip = skips[n];
        pictures[n] = judge_render(renderer, scene, NULL, title);
    }
    assert_pictures_equal(pictures[1], pictures[0], title);
    for (int n = 0; n < 2; n++)
        pel_image_destroy(pictures[n]);
}

static void test_against_reference(void **state) {
    (void)state;
    struct pel_renderer *rays = judge_renderer(PEL_READER_BUFFER, 1),
                        *packets = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes()),
                        *images = judge_renderer(PEL_READER_IMAGE, 1);
    struct pel_scene *scene = scene_of_waves(1);
    scene->render.mixing = PEL_MIX_ORDERED;
    pel_image_destroy(judge_render(rays, scene, NULL, "rays, ordered"));
    // A mask may be seen, too.
    scene->render.mixing = PEL_MIX_MAX;
    scene->instances[2].hidden = false;
    if (judge_has_images(images, scene))
        pel_image_destroy(judge_render(images, scene, NULL, "images, max"));
    scene->render.mixing = PEL_MIX_INTERSECTION;
    scene->instances[2].hidden = true;
    scene->instances[1].material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    scene->clips[0] = (struct pel_clip){.normal = {1, 0.4, -0.2}, .point = {-1, 0, 0}};
    scene->clip_count = 1;
    check_skips(packets, scene, "packets, intersection");
    pel_scene_destroy(scene);
    pel_renderer_destroy(rays);
    pel_renderer_destroy(packets);
    pel_renderer_destroy(images);
}

// A mask in slabs, one in bricks from a pool.
static void test_slabs_and_pool(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_waves(0.5);
    const struct pel_renderer_options options = {
        .reader = PEL_READER_BUFFER, .lanes = 1, .max_allocation_bytes = 36 * BRICK_VOXELS};
    struct pel_renderer *slabs = pel_renderer_create(&options),
                        *whole = judge_renderer(PEL_READER_BUFFER, 1);
    scene->instances[0].hidden = true;
    scene->instances[1].mask.inverted = false;
    scene->instances[1].mask.range_count = 1;
    scene->render.bricks.pool = PEL_POOL_ON;
    pel_image_destroy(judge_render(whole, scene, NULL, "pool"));
    scene->render.bricks.pool = PEL_POOL_OFF;
    pel_image_destroy(judge_render(slabs, scene, NULL, "slabs"));
    // The exact integrator goes through the mask's slabs one by one.
    scene->render.model = PEL_MODEL_EMISSION;
    for (int inverted = 0; inverted < 2; inverted++) {
        scene->instances[1].mask.inverted = inverted;
        pel_image_destroy(judge_render(slabs, scene, NULL, "emission, slabs"));
    }
    pel_renderer_destroy(slabs);
    pel_renderer_destroy(whole);
    pel_scene_destroy(scene);
}

// What lies between two samples is only known where both are left.
static void test_segments(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of_waves(1);
    scene->instances[1].model = PEL_MODEL_ISO;
    scene->instances[1].surface_count = 1;
    scene->instances[1].surfaces[0] = (struct pel_surface){.value = 130, .opacity = 0.4};
    scene->instances[0].clips[0] = (struct pel_clip){
        .kind = PEL_CLIP_BOX, .outside = true, .point = {1, 2, 3}, .size = {9, 8, 7}};
    scene->instances[0].clip_count = 1;
    scene->instances[0].preintegration = true;
    scene->render.skip = PEL_SKIP_DISTANCE;
    pel_image_destroy(judge_render(renderer, scene, NULL, "iso and preintegration"));
    scene->instances[1].clips[0] = scene->instances[0].clips[0];
    scene->instances[1].clip_count = 1;
    pel_image_destroy(judge_render(renderer, scene, NULL, "clipped besides"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_box(volume_of_layers(PEL_VOXEL_U8, (double[]){0, 1, 2, 3}));
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_mask *mask = &scene->instances[0].mask;
    set_range(scene, 2, 1);
    render_refused(renderer, scene, "volume 'instance 0': a mask's range of values from 2 to 1");
    set_range(scene, 1, 2);
    mask->range_count = 33;
    render_refused(renderer, scene,
                   "volume 'instance 0': a mask of 33 ranges of values, outside 0..32");
    mask->range_count = 1;
    mask->instance = 2;
    render_refused(renderer, scene, "volume 'instance 0': its mask is volume 2 of 2");
    mask->instance = 0;
    render_refused(renderer, scene, "volume 'instance 0': it is its own mask");
    mask->instance = 1;
    scene->instances[1].mask = (struct pel_mask){.range_count = 1};
    render_refused(renderer, scene,
                   "volume 'instance 0': its mask 'instance 1' is masked by it in turn");
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_chords),         cmocka_unit_test(test_absent),
        cmocka_unit_test(test_recipe),         cmocka_unit_test(test_against_reference),
        cmocka_unit_test(test_slabs_and_pool), cmocka_unit_test(test_segments),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
