// variants.c - every kernel variant against the reference: reader x lanes x voxel type x filter x
// mixing, and extent and sample origin, on small scenes of two overlapping instances.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"

// What a scene of this file is made of.
struct choice {
    enum pel_voxel_type type;
    enum pel_filter filter;
    enum pel_mixing mixing;
    enum pel_extent extent;
    enum pel_sample_origin origin;
};

enum { TYPES = PEL_VOXEL_RGBA8 + 1, CHOICES = TYPES * 16 };

static struct choice choice_number(int n) {
    return (struct choice){
        .type = (enum pel_voxel_type)(n / 16),
        .filter = n & 1 ? PEL_FILTER_NEAREST : PEL_FILTER_LINEAR,
        .mixing = n & 2 ? PEL_MIX_OVER : PEL_MIX_SUM,
        .extent = n & 4 ? PEL_EXTENT_POINT : PEL_EXTENT_CELL,
        .origin = n & 8 ? PEL_ORIGIN_BOUNDS : PEL_ORIGIN_VOLUMES,
    };
}

static struct pel_scene *scene_of(const struct choice *choice) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 16 : 48, small ? 12 : 36);
    scene->render.mixing = choice->mixing;
    scene->render.origin = choice->origin;
    scene->render.step = small ? 1 : 0.5;

    int dims[3] = {small ? 10 : 17, small ? 12 : 22, small ? 8 : 19};
    struct pel_volume *volume = scene_volume_waves(dims, choice->type, 11, small ? 7 : 12);
    double spacing[3] = {17.1 / dims[0], 26.3 / dims[1], 20.9 / dims[2]};
    scene_place(volume, spacing, (double[]){0.31, -0.42, 0.17, 0.83}, (double[]){-1.3, 2.1, 0.7},
                true);
    if (choice->type == PEL_VOXEL_I16) {
        volume->slope = -0.25;
        volume->intercept = 100;
    }

    double raw[2];
    scene_raw_range(choice->type, raw);
    double ends[2] = {volume->slope * raw[0] + volume->intercept,
                      volume->slope * raw[1] + volume->intercept};
    double range[2] = {fmin(ends[0], ends[1]), fmax(ends[0], ends[1])};
    struct pel_instance *first = scene_add(scene, volume, scene_transfer_gentle(range, 0.08, 21));
    struct pel_instance *second = scene_add_again(scene, 0, scene_transfer_gentle(range, 0.15, 22));
    second->transform =
        pel_matrix_from_quaternion((double[]){0.7, 0.2, -0.3, 0.6}, (double[]){3.3, -2.7, 1.9});
    second->density = 0.7;
    first->filter = second->filter = choice->filter;
    first->extent = second->extent = choice->extent;
    return scene;
}

// Every `stride`th scene, through one variant.
static void check_variant(enum pel_reader reader, int lanes, int stride, int start) {
    struct pel_renderer *renderer = judge_renderer(reader, lanes);
    uint64_t samples = 0;
    for (int n = start; n < CHOICES; n += stride) {
        struct choice choice = choice_number(n);
        struct pel_scene *scene = scene_of(&choice);
        char title[128];
        snprintf(title, sizeof title, "%s x %d: %s, %s, %s, %s, %s",
                 reader == PEL_READER_IMAGE ? "image" : "buffer", lanes,
                 pel_voxel_type_name(choice.type), choice.filter ? "nearest" : "linear",
                 choice.mixing ? "over" : "sum", choice.extent ? "point" : "cell",
                 choice.origin ? "bounds" : "volumes");
        struct pel_render_statistics statistics;
        struct pel_image *picture = judge_render(renderer, scene, &statistics, title);
        assert_int_equal(statistics.reader, reader);
        assert_int_equal(statistics.lanes, lanes);
        samples += statistics.samples;
        pel_image_destroy(picture);
        pel_scene_destroy(scene);
    }
    assert_true(samples > 0);
    pel_renderer_destroy(renderer);
}

// Where a device is slow each variant sees one scene of each type, and each another.
static void check_lanes(enum pel_reader reader, int lanes, int number) {
    if (scene_is_small())
        check_variant(reader, lanes, 15, number);
    else
        check_variant(reader, lanes, 1, 0);
}

static void test_buffer_1(void **state) {
    (void)state;
    check_lanes(PEL_READER_BUFFER, 1, 0);
}

static void test_buffer_4(void **state) {
    (void)state;
    check_lanes(PEL_READER_BUFFER, 4, 3);
}

static void test_buffer_8(void **state) {
    (void)state;
    check_lanes(PEL_READER_BUFFER, 8, 6);
}

static void test_buffer_16(void **state) {
    (void)state;
    check_lanes(PEL_READER_BUFFER, 16, 9);
}

// True when the device under test has images.
static bool has_images(void) {
    struct pel_renderer *renderer = judge_renderer(PEL_READER_IMAGE, 1);
    struct choice choice = {.type = PEL_VOXEL_U8};
    struct pel_scene *scene = scene_of(&choice);
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, NULL);
    bool works = picture != NULL;
    if (!works)
        print_message("no images here: %s\n", pel_error_message());
    pel_image_destroy(picture);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
    return works;
}

static void test_image_1(void **state) {
    (void)state;
    if (!has_images())
        skip();
    check_lanes(PEL_READER_IMAGE, 1, 12);
}

static void test_image_16(void **state) {
    (void)state;
    if (!has_images())
        skip();
    check_lanes(PEL_READER_IMAGE, 16, 14);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_buffer_1), cmocka_unit_test(test_buffer_4),
        cmocka_unit_test(test_buffer_8), cmocka_unit_test(test_buffer_16),
        cmocka_unit_test(test_image_1),  cmocka_unit_test(test_image_16),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
