// Tests of two pictures in one, and of slices: every pixel against what it should be.
#include "support/test.h"

#include <math.h>

#include "viewer/compare.h"
#include "viewer/slice.h"

enum { WIDTH = 8, HEIGHT = 6 };

static uint8_t white[WIDTH * HEIGHT * 4], black[WIDTH * HEIGHT * 4], out[WIDTH * HEIGHT * 4];

static int fill(void **state) {
    (void)state;
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        white[i] = 255;
        black[i] = i % 4 == 3 ? 255 : 0;
    }
    return 0;
}

// How bright the pixel of white (a) against black (b) is.
static int at(int x, int y) {
    return out[4 * (y * WIDTH + x)];
}

static void compose(const struct pel_compare *compare, double seconds) {
    pel_compare_pixels(compare, WIDTH, HEIGHT, white, black, seconds, out);
}

static void test_modes(void **state) {
    (void)state;
    compose(&(struct pel_compare){.mode = PEL_COMPARE_NONE}, 0);
    assert_memory_equal(out, white, sizeof out);
    compose(&(struct pel_compare){.mode = PEL_COMPARE_BLEND, .share = 0.2}, 0);
    assert_int_equal(at(3, 3), 204);
    compose(&(struct pel_compare){.mode = PEL_COMPARE_CHECKERBOARD, .cell_px = 2}, 0);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_int_equal(at(x, y), (x / 2 + y / 2) % 2 ? 0 : 255);
    compose(&(struct pel_compare){.mode = PEL_COMPARE_SPLIT, .split = 0.5}, 0);
    assert_true(at(3, 0) == 255 && at(4, 0) == 0);
    compose(&(struct pel_compare){.mode = PEL_COMPARE_SPLIT, .split = 0.5, .across = true}, 0);
    assert_true(at(0, 2) == 255 && at(0, 3) == 0 && at(7, 2) == 255);
    const struct pel_compare flicker = {.mode = PEL_COMPARE_FLICKER, .period_s = 0.4};
    compose(&flicker, 10.1);
    assert_int_equal(at(0, 0), 255);
    compose(&flicker, 10.3);
    assert_int_equal(at(0, 0), 0);
}

// Equal is grey; only in a cyan, only in b magenta.
static void test_difference(void **state) {
    (void)state;
    const struct pel_compare compare = {.mode = PEL_COMPARE_DIFFERENCE};
    compose(&compare, 0);
    assert_memory_equal(out, ((uint8_t[]){0, 255, 255, 255}), 4);
    pel_compare_pixels(&compare, WIDTH, HEIGHT, black, white, 0, out);
    assert_memory_equal(out, ((uint8_t[]){255, 0, 255, 255}), 4);
    pel_compare_pixels(&compare, WIDTH, HEIGHT, white, white, 0, out);
    assert_memory_equal(out, white, sizeof out);
}

static void test_images(void **state) {
    (void)state;
    struct pel_image *a = pel_image_create(4, 2), *b = pel_image_create(4, 2);
    for (int i = 0; i < 32; i++) {
        a->rgba[i] = (float)i;
        b->rgba[i] = (float)(100 + i);
    }
    const struct pel_compare split = {.mode = PEL_COMPARE_SPLIT, .split = 0.25};
    struct pel_image *image = pel_compare_images(&split, a, b, 0);
    assert_float_equal(image->rgba[0], 0, 0);
    assert_float_equal(image->rgba[4], 104, 0);
    pel_image_destroy(image);
    pel_image_destroy(b);
    b = pel_image_create(4, 3);
    assert_null(pel_compare_images(&split, a, b, 0));
    pel_image_destroy(a);
    pel_image_destroy(b);
}

// ---- Slices ------------------------------------------------------------------------------------

// A volume whose value is 10 i + 100 j + k at (i, j, k) mm, opaque and red where it is seen.
static struct pel_scene *make_scene(void) {
    const int dims[3] = {5, 6, 7};
    struct pel_volume *volume = pel_volume_create("numbers", dims, PEL_VOXEL_F32);
    for (int i = 0; i < 5 * 6 * 7; i++)
        ((float *)volume->voxels)[i] = (float)(10 * (i % 5) + 100 * (i / 5 % 6) + i / 30);
    struct pel_scene *scene = pel_scene_create();
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), 0);
    pel_volume_destroy(volume);
    struct pel_transfer *transfer = scene->instances[0].transfer;
    transfer->colour_count = transfer->opacity_count = 2;
    transfer->colours[0] = (struct pel_colour_point){0, {1, 0, 0}};
    transfer->colours[1] = (struct pel_colour_point){1000, {1, 0, 0}};
    transfer->opacities[0] = (struct pel_opacity_point){0, 0.5};
    transfer->opacities[1] = (struct pel_opacity_point){1000, 0.5};
    return scene;
}

// Ten pixels a millimetre, and the middle in the middle.
static struct pel_slice make_slice(enum pel_slice_plane plane) {
    return (struct pel_slice){.plane = plane,
                              .cross = {2, 3, 4},
                              .middle = {2, 2, 2},
                              .mm_per_px = 0.1,
                              .width = 20,
                              .height = 16};
}

static void assert_there_and_back(const struct pel_slice *slice, double x, double y,
                                  const double expected[3]) {
    double world[3], pixel[2];
    pel_slice_world(slice, (double[]){x, y}, world);
    for (int i = 0; i < 3; i++)
        assert_float_equal(world[i], expected[i], 1e-12);
    pel_slice_pixel(slice, world, pixel);
    assert_float_equal(pixel[0], x, 1e-9);
    assert_float_equal(pixel[1], y, 1e-9);
}

// Five pixels to the right and three down of the middle.
static void test_places(void **state) {
    (void)state;
    struct pel_slice slice = make_slice(PEL_SLICE_AXIAL);
    assert_there_and_back(&slice, 15, 11, (double[]){1.5, 1.7, 4});
    slice = make_slice(PEL_SLICE_CORONAL);
    assert_there_and_back(&slice, 15, 11, (double[]){1.5, 3, 1.7});
    slice = make_slice(PEL_SLICE_SAGITTAL);
    assert_there_and_back(&slice, 15, 11, (double[]){2, 1.5, 1.7});
    // Right-handed: right x down leads away from the viewer.
    for (int plane = 0; plane < 3; plane++) {
        double r[3], d[3], t[3];
        slice = make_slice((enum pel_slice_plane)plane);
        pel_slice_axes(&slice, r, d, t);
        assert_float_equal(r[1] * d[2] - r[2] * d[1], -t[0], 0);
        assert_float_equal(r[2] * d[0] - r[0] * d[2], -t[1], 0);
        assert_float_equal(r[0] * d[1] - r[1] * d[0], -t[2], 0);
    }
    const struct pel_bounds bounds = {{-10, -20, -30}, {10, 20, 30}};
    slice = make_slice(PEL_SLICE_CORONAL);
    pel_slice_fit(&slice, &bounds);
    assert_float_equal(slice.mm_per_px, 60 / 16.0 / 0.95, 1e-12);
}

static void test_render(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    struct pel_slice slice = make_slice(PEL_SLICE_AXIAL);
    static uint8_t rgba[20 * 16 * 4];
    // Half of red over black, and over nothing.
    pel_slice_render(&slice, scene, -1, rgba);
    assert_memory_equal(rgba, ((uint8_t[]){128, 0, 0, 255}), 4);
    memset(scene->background, 0, sizeof scene->background);
    pel_slice_render(&slice, scene, -1, rgba);
    assert_memory_equal(rgba, ((uint8_t[]){255, 0, 0, 128}), 4);
    // Two of them are half of what one leaves.
    assert_int_equal(pel_scene_add_copy(scene, 0), 1);
    pel_slice_render(&slice, scene, -1, rgba);
    assert_int_equal(rgba[3], 191);
    pel_slice_render(&slice, scene, 1, rgba);
    assert_int_equal(rgba[3], 128);
    scene->instances[0].hidden = scene->instances[1].hidden = true;
    pel_slice_render(&slice, scene, -1, rgba);
    assert_int_equal(rgba[3], 0);
    // Windowed, the value at (15.5, 11.5), which is (1.45, 1.65, 4), is 183.5 of 0..1000.
    slice.windowed = true;
    pel_slice_render(&slice, scene, 0, rgba);
    const uint8_t *pixel = rgba + 4 * (11 * 20 + 15);
    assert_int_equal(pixel[0], (int)(0.1835 * 255 + 0.5));
    assert_int_equal(pixel[1], pixel[0]);
    assert_int_equal(pixel[3], 255);
    pel_scene_destroy(scene);
}

static void test_side(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    assert_int_equal(pel_scene_add_copy(scene, 0), 1);
    struct pel_scene *side = pel_compare_side(scene, 1);
    assert_true(side->instances[0].hidden && !side->instances[1].hidden);
    assert_false(scene->instances[0].hidden);
    pel_scene_destroy(side);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_modes),  cmocka_unit_test(test_difference),
        cmocka_unit_test(test_images), cmocka_unit_test(test_places),
        cmocka_unit_test(test_render), cmocka_unit_test(test_side),
    };
    return cmocka_run_group_tests(tests, fill, NULL);
}
