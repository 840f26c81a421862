// properties.c - what must not change the device's picture, and scenes at the edge of sense.
#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "shared/brick.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// Floats, added up in another order, of 255.
static const double ROUNDING = 255e-5;

static int small_or(int small, int otherwise) {
    return scene_is_small() ? small : otherwise;
}

// A volume of waves at the origin with a gentle transfer function.
static struct pel_instance *add_waves(struct pel_scene *scene, int size, enum pel_voxel_type type,
                                      uint64_t seed, double opacity) {
    double range[2];
    scene_raw_range(type, range);
    return scene_add(scene, scene_volume_waves((int[]){size, size, size}, type, seed, 10),
                     scene_transfer_gentle(range, opacity, seed));
}

static struct pel_matrix turned(uint64_t seed, double reach) {
    double xyzw[4], offset[3];
    for (int c = 0; c < 4; c++)
        xyzw[c] = test_random(&seed) - 0.499;
    for (int c = 0; c < 3; c++)
        offset[c] = reach * (2 * test_random(&seed) - 1);
    return pel_matrix_from_quaternion(xyzw, offset);
}

// Four turned volumes of four types. Only the last takes more than one brick along an axis.
static struct pel_scene *scene_of_four(void) {
    static const enum pel_voxel_type types[] = {PEL_VOXEL_U8, PEL_VOXEL_I16, PEL_VOXEL_F32,
                                                PEL_VOXEL_RGBA8};
    struct pel_scene *scene = scene_create(small_or(8, 40), small_or(6, 30));
    for (int k = 0; k < 4; k++)
        add_waves(scene, BRICK_SIDE - 4 + k, types[k], (uint64_t)k + 3, 0.1)->transform =
            turned((uint64_t)k + 1, 5);
    return scene;
}

// ---- What must not change a picture ------------------------------------------------------------

static void test_permutation(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_of_four();
    struct pel_image *before = render_picture(renderer, scene, NULL);
    scene_permute(scene, (int[]){2, 0, 3, 1});
    struct pel_image *after = render_picture(renderer, scene, NULL);
    assert_pictures_within(after, before, ROUNDING, 0, "permuted");
    pel_image_destroy(before);
    pel_image_destroy(after);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_same_bytes_twice(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_four();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_renderer *other = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_render_statistics statistics;
    struct pel_image *first = render_picture(renderer, scene, &statistics);
    assert_true(statistics.uploaded_bytes > 0);
    struct pel_image *second = render_picture(renderer, scene, &statistics);
    assert_int_equal(statistics.uploaded_bytes, 0);
    struct pel_image *third = render_picture(other, scene, NULL);
    assert_pictures_equal(second, first, "second frame");
    assert_pictures_equal(third, first, "another renderer");

    // A camera that moves takes a camera's bytes to the device, and back again the same picture.
    scene->camera.eye[0] += 10;
    pel_image_destroy(second);
    second = render_picture(renderer, scene, &statistics);
    assert_in_range(statistics.uploaded_bytes, 1, 4096);
    assert_true(picture_compare(second, first, 1).beyond_count > 0);
    scene->camera.eye[0] -= 10;
    pel_image_destroy(second);
    second = render_picture(renderer, scene, NULL);
    assert_pictures_equal(second, first, "back again");

    pel_image_destroy(first);
    pel_image_destroy(second);
    pel_image_destroy(third);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
    pel_renderer_destroy(other);
}

// Four pictures of quarters of the view, through a camera of half the height that is shifted.
static void test_quarters_are_the_whole(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    for (int parallel = 0; parallel < 2; parallel++) {
        struct pel_scene *scene = scene_of_four();
        if (parallel)
            scene_view_parallel(scene, 40);
        struct pel_image *whole = render_picture(renderer, scene, NULL);
        int width = whole->width / 2, height = whole->height / 2;
        struct pel_image *quarter_of_whole = pel_image_create(width, height);

        double tangent = tan(scene->camera.fov_deg * PEL_PI / 360);
        scene->camera.fov_deg = 2 * atan(tangent / 2) * 180 / PEL_PI;
        scene->camera.height_mm /= 2;
        scene->render.width = width;
        scene->render.height = height;
        for (int n = 0; n < 4; n++) {
            int left = n & 1 ? width : 0, top = n & 2 ? height : 0;
            scene->camera.shift[0] = (n & 1 ? 0.5 : -0.5) * width / height;
            scene->camera.shift[1] = n & 2 ? -0.5 : 0.5;
            for (int y = 0; y < height; y++)
                memcpy(quarter_of_whole->rgba + 4 * y * width,
                       whole->rgba + 4 * ((top + y) * 2 * width + left),
                       4 * (size_t)width * sizeof(float));
            struct pel_image *quarter = render_picture(renderer, scene, NULL);
            // Rays are the same but for rounding, which may move a sample out of a span.
            assert_pictures_within(quarter, quarter_of_whole, 0.1, 2, "quarter");
            pel_image_destroy(quarter);
        }
        pel_image_destroy(quarter_of_whole);
        pel_image_destroy(whole);
        pel_scene_destroy(scene);
    }
    pel_renderer_destroy(renderer);
}

// Renders the scene in as few allocations as possible, and with a limit on their size.
static void render_limited(const struct pel_scene *scene, uint64_t limit_bytes,
                           struct pel_image *pictures[2]) {
    for (int n = 0; n < 2; n++) {
        struct pel_renderer_options options = {.reader = PEL_READER_BUFFER,
                                               .max_allocation_bytes = n ? limit_bytes : 0};
        struct pel_renderer *renderer = pel_renderer_create(&options);
        if (!renderer)
            fail_msg("%s", pel_error_message());
        pictures[n] = render_picture(renderer, scene, NULL);
        pel_renderer_destroy(renderer);
    }
}

// What a volume of 32-bit voxels takes on the device, with its border.
static uint64_t stored_bytes(const struct pel_volume *volume) {
    uint64_t bricks = 1;
    for (int i = 0; i < 3; i++)
        bricks *= ((uint64_t)volume->dims[i] + 2 + BRICK_SIDE - 1) / BRICK_SIDE;
    return bricks * BRICK_VOXELS * 4;
}

// Whole volumes in several allocations: no bit of the picture may show that.
static void test_split_allocations(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_four();
    struct pel_image *pictures[2];
    // The last volume, the largest, fills one by itself.
    render_limited(scene, stored_bytes(scene->volumes[3]), pictures);
    assert_pictures_equal(pictures[1], pictures[0], "in several allocations");
    pel_image_destroy(pictures[0]);
    pel_image_destroy(pictures[1]);
    pel_scene_destroy(scene);
}

// Volumes larger than one allocation are cut into pieces, with boxes and origins of their own: the
// picture is the same but for rounding.
static void test_split_volumes(void **state) {
    (void)state;
    for (int four = 0; four < 2; four++) {
        struct pel_scene *scene = four ? scene_of_four() : scene_create(48, 36);
        if (!four)
            add_waves(scene, small_or(16, 24), PEL_VOXEL_F32, 4, 0.1)->transform = turned(5, 2);
        // The last volume, the largest, takes more than this.
        uint64_t limit_bytes = stored_bytes(scene->volumes[four ? 3 : 0]) - 1;
        struct pel_image *pictures[2];
        render_limited(scene, limit_bytes, pictures);
        assert_pictures_within(pictures[1], pictures[0], 0.1, 2, "in pieces");
        pel_image_destroy(pictures[0]);
        pel_image_destroy(pictures[1]);
        pel_scene_destroy(scene);
    }
}

static void test_lanes_take_the_same_samples(void **state) {
    (void)state;
    const int packet = judge_packet_lanes() == 1 ? 4 : judge_packet_lanes();
    struct pel_scene *scene = scene_of_four();
    struct pel_image *pictures[2];
    uint64_t samples[2];
    for (int n = 0; n < 2; n++) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, n ? packet : 1);
        struct pel_render_statistics statistics;
        pictures[n] = render_picture(renderer, scene, &statistics);
        samples[n] = statistics.samples;
        assert_int_equal(statistics.rays, pictures[n]->width * pictures[n]->height);
        assert_true(statistics.device_bytes > 0);
        pel_renderer_destroy(renderer);
    }
    assert_true(samples[0] > 0);
    // One sample in ten thousand may be taken or left by rounding.
    assert_true(fabs((double)samples[0] - (double)samples[1]) <= 1e-4 * (double)samples[0] + 2);
    assert_pictures_within(pictures[1], pictures[0], 1, 0, "a packet");
    pel_image_destroy(pictures[0]);
    pel_image_destroy(pictures[1]);
    pel_scene_destroy(scene);
}

// ---- Many volumes ------------------------------------------------------------------------------

static void check_many(bool one_volume, enum pel_mixing mixing) {
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_create(small_or(8, 40), small_or(6, 30));
    scene->render.mixing = mixing;
    scene->render.step = 1;
    for (int k = 0; k < PEL_VOLUME_MAX; k++) {
        uint64_t seed = (uint64_t)k + 1;
        double range[2];
        scene_raw_range(PEL_VOXEL_U8, range);
        if (one_volume && k > 0)
            scene_add_again(scene, 0, scene_transfer_gentle(range, 0.05, seed));
        else
            add_waves(scene, one_volume ? 9 : 4 + k % 7,
                      one_volume ? PEL_VOXEL_U8 : (enum pel_voxel_type)(k % 7), seed, 0.05);
        scene->instances[k].transform = turned(seed, 12);
    }
    char title[64];
    snprintf(title, sizeof title, "%d %s, %s", PEL_VOLUME_MAX, one_volume ? "instances" : "volumes",
             mixing == PEL_MIX_SUM ? "sum" : "over");
    pel_image_destroy(judge_render(renderer, scene, NULL, title));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Where a device or its compiler is slow, instances and volumes have one mixing each.
static bool mixes_both(void) {
    return getenv("PELLUCID_TEST_ALL") || (judge_packet_lanes() > 1 && !scene_is_small());
}

static void test_32_instances(void **state) {
    (void)state;
    check_many(true, PEL_MIX_SUM);
    if (mixes_both())
        check_many(true, PEL_MIX_OVER);
}

static void test_32_volumes(void **state) {
    (void)state;
    if (mixes_both())
        check_many(false, PEL_MIX_SUM);
    check_many(false, PEL_MIX_OVER);
}

// ---- Places ------------------------------------------------------------------------------------

// The renderers of judge_everywhere, made once: a new one would compile its kernels again.
enum { PLACES = 3 };
static struct pel_renderer *everywhere[PLACES];

static int open_everywhere(void **state) {
    (void)state;
    everywhere[0] = judge_renderer(PEL_READER_BUFFER, 1);
    if (judge_packet_lanes() > 1)
        everywhere[1] = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes());
    everywhere[2] = judge_renderer(PEL_READER_IMAGE, 1);
    struct pel_scene *scene = scene_of_four();
    if (!judge_has_images(everywhere[2], scene)) {
        pel_renderer_destroy(everywhere[2]);
        everywhere[2] = NULL;
    }
    pel_scene_destroy(scene);
    return 0;
}

static int close_everywhere(void **state) {
    (void)state;
    for (int i = 0; i < PLACES; i++)
        pel_renderer_destroy(everywhere[i]);
    return 0;
}

// Renders the scene through buffers with one and many lanes, through images where there are any,
// and takes the scene. Where a device is slow they take turns.
static void judge_everywhere(struct pel_scene *scene, const char *title) {
    static int turn;
    struct judge *judge = judge_create(scene);
    turn++;
    for (int i = 0; i < PLACES; i++) {
        if (!everywhere[i] || (scene_is_small() && i != turn % PLACES))
            continue;
        struct pel_render_statistics statistics;
        struct pel_image *picture = pel_renderer_render(everywhere[i], scene, NULL, &statistics);
        judge_check(judge, picture, &statistics, title);
        pel_image_destroy(picture);
    }
    judge_destroy(judge);
    pel_scene_destroy(scene);
}

// A scene of one volume and a background.
static struct pel_scene *scene_of_one(void) {
    struct pel_scene *scene = scene_create(16, 12);
    add_waves(scene, 12, PEL_VOXEL_U8, 9, 0.1);
    memcpy(scene->background, (double[]){0.2, 0.4, 0.6, 0.5}, sizeof scene->background);
    return scene;
}

static void test_camera_inside(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    memcpy(scene->camera.eye, (double[]){1.1, -0.7, 0.3}, sizeof scene->camera.eye);
    memcpy(scene->camera.target, (double[]){2, 3, -4}, sizeof scene->camera.target);
    scene->camera.fov_deg = 120;
    judge_everywhere(scene, "camera inside");
}

static void test_volume_behind(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    scene->camera.target[2] = 200;
    judge_everywhere(scene, "volume behind");
}

static void test_rays_that_miss(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    memcpy(scene->camera.target, (double[]){200, 0, 0}, sizeof scene->camera.target);
    judge_everywhere(scene, "nothing met");
}

// Parallel rays along each axis in both directions. The view is as high as 9.7 voxels, so that no
// ray runs along a face.
static void test_axis_parallel(void **state) {
    (void)state;
    for (int n = 0; n < 6; n++) {
        struct pel_scene *scene = scene_of_one();
        scene_view_parallel(scene, 9.7);
        int axis = n % 3;
        for (int c = 0; c < 3; c++) {
            scene->camera.eye[c] = c == axis ? (n < 3 ? 50.3 : -50.3) : 0.1;
            scene->camera.target[c] = c == axis ? 0 : 0.1;
            scene->camera.up[c] = c == (axis + 1) % 3;
        }
        judge_everywhere(scene, "along an axis");
    }
}

static void check_spacing(double spacing) {
    struct pel_scene *scene = scene_of_one();
    struct pel_volume *volume = scene->volumes[0];
    scene_place(volume, (double[]){spacing, spacing, 1.5 * spacing}, (double[]){0.3, 0.2, 0.4, 0.9},
                (double[]){0, 0, 0}, false);
    scene->instances[0].transfer->opacity_unit_mm = spacing;
    for (int c = 0; c < 3; c++)
        scene->camera.eye[c] *= spacing;
    judge_everywhere(scene, spacing < 1 ? "tiny voxels" : "huge voxels");
}

static void test_tiny_and_huge_spacing(void **state) {
    (void)state;
    check_spacing(0.0001);
    check_spacing(1000);
}

// Far from the origin, as scanner coordinates may be.
static void test_far_away(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    struct pel_matrix away = pel_matrix_translation((double[]){3000, -2000, 1500});
    scene_move(scene, &away);
    judge_everywhere(scene, "far away");
}

static void test_one_voxel_thick(void **state) {
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        for (int extent = 0; extent < 2; extent++) {
            struct pel_scene *scene = scene_create(16, 12);
            int dims[3] = {11, 11, 11};
            double raw[2];
            scene_raw_range(PEL_VOXEL_U16, raw);
            dims[axis] = 1;
            struct pel_instance *instance =
                scene_add(scene, scene_volume_waves(dims, PEL_VOXEL_U16, 7, 8),
                          scene_transfer_gentle(raw, 0.3, 6));
            instance->transform = turned(13, 1);
            instance->extent = extent ? PEL_EXTENT_POINT : PEL_EXTENT_CELL;
            judge_everywhere(scene, extent ? "a layer without thickness" : "one layer");
        }
    }
}

static void test_hidden_and_empty(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    add_waves(scene, 9, PEL_VOXEL_F32, 3, 0.2)->hidden = true;
    judge_everywhere(scene, "one hidden");

    scene = scene_of_one();
    scene->instances[0].hidden = true;
    judge_everywhere(scene, "all hidden");

    scene = scene_create(16, 12);
    scene->background[1] = scene->background[3] = 1;
    judge_everywhere(scene, "no volumes");
}

static void test_absent_voxels(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(16, 12);
    add_waves(scene, 12, PEL_VOXEL_F32, 9, 0.2)->transform = turned(3, 1);
    float *voxels = scene->volumes[0]->voxels;
    for (int i = 0; i < 12 * 12 * 12; i += 37)
        voxels[i] = NAN;
    judge_everywhere(scene, "absent voxels");
}

// A table with a cliff, and opacities of one.
static void test_opaque(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    scene_add_again(scene, 0,
                    scene_transfer((const double[][5]){{0, 1, 0, 0, 0}, {255, 1, 1, 0, 1}}, 2))
        ->transform = turned(4, 3);
    scene->render.termination = 0.95;
    judge_everywhere(scene, "opaque");
}

// ---- Refusals ----------------------------------------------------------------------------------

static void test_refuses_what_fits_nowhere(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    struct pel_renderer_options options = {.max_allocation_bytes = 64};
    struct pel_renderer *renderer = pel_renderer_create(&options);
    assert_non_null(renderer);
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_DEVICE);
    print_message("refused: %s\n", pel_error_message());
    // What there is, and that it is about bytes.
    assert_non_null(strstr(pel_error_message(), "bytes"));
    assert_non_null(strstr(pel_error_message(), "64"));
    pel_renderer_destroy(renderer);

    renderer = judge_renderer(PEL_READER_AUTO, 0);
    scene->render.step = 0;
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

static bool stop_at_once(double finished, void *user) {
    *(double *)user = finished;
    return false;
}

static void test_abandoned_frame(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_one();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    double finished = -1;
    struct pel_render_options options = {.progress = stop_at_once, .user = &finished};
    assert_null(pel_renderer_render(renderer, scene, &options, NULL));
    assert_true(finished >= 0 && finished <= 1);
    pel_image_destroy(judge_render(renderer, scene, NULL, "after an abandoned frame"));
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_permutation),
        cmocka_unit_test(test_same_bytes_twice),
        cmocka_unit_test(test_quarters_are_the_whole),
        cmocka_unit_test(test_split_allocations),
        cmocka_unit_test(test_split_volumes),
        cmocka_unit_test(test_lanes_take_the_same_samples),
        cmocka_unit_test(test_32_instances),
        cmocka_unit_test(test_32_volumes),
        cmocka_unit_test(test_camera_inside),
        cmocka_unit_test(test_volume_behind),
        cmocka_unit_test(test_rays_that_miss),
        cmocka_unit_test(test_axis_parallel),
        cmocka_unit_test(test_tiny_and_huge_spacing),
        cmocka_unit_test(test_far_away),
        cmocka_unit_test(test_one_voxel_thick),
        cmocka_unit_test(test_hidden_and_empty),
        cmocka_unit_test(test_absent_voxels),
        cmocka_unit_test(test_opaque),
        cmocka_unit_test(test_refuses_what_fits_nowhere),
        cmocka_unit_test(test_abandoned_frame),
    };
    return cmocka_run_group_tests(tests, open_everywhere, close_everywhere);
}
