// supersample.c - supersampling and jitter on the device: against the reference, and against an
// edge whose pixels are known in closed form.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// Few variants of the kernel, because building one takes longer than rendering all these pictures.
static int packet(void) {
    return judge_lanes(4);
}

enum { WIDTH = 20, HEIGHT = 6, EDGE_COLUMN = 12, PATTERNS = PEL_PATTERN_HAMMERSLEY + 1 };

// A white opaque box that fills the picture from the left up to `covered` of EDGE_COLUMN.
static struct pel_scene *scene_of_edge(double covered) {
    struct pel_scene *scene = scene_create(WIDTH, HEIGHT);
    scene_view_parallel(scene, HEIGHT);
    struct pel_volume *volume = scene_volume_constant((int[]){20, 20, 4}, PEL_VOXEL_U8, 200);
    struct pel_instance *instance =
        scene_add(scene, volume, scene_transfer_constant((double[]){1, 1, 1, 1}));
    instance->transform.m[0][3] = EDGE_COLUMN - WIDTH / 2 + covered - 10;
    return scene;
}

// Two overlapping volumes of waves, with edges inside the picture.
static struct pel_scene *scene_of_two(void) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 8 : 20, small ? 6 : 15);
    scene->render.step = small ? 2 : 1;
    double range[2];
    scene_raw_range(PEL_VOXEL_U8, range);
    for (int k = 0; k < 2; k++) {
        int size = (small ? 8 : 18) + 3 * k;
        struct pel_instance *instance = scene_add(
            scene, scene_volume_waves((int[]){size, size, size}, PEL_VOXEL_U8, (uint64_t)k, 9),
            scene_transfer_gentle(range, 0.2, (uint64_t)k + 5));
        instance->transform = pel_matrix_from_quaternion((double[]){0.3, 0.2 * k, 0.4, 0.8},
                                                         (double[]){3.0 * k, 2, 0});
    }
    scene->background[0] = scene->background[3] = 1;
    return scene;
}

static float alpha_at(const struct pel_image *picture, int x, int y) {
    return picture->rgba[4 * (y * picture->width + x) + 3];
}

// ---- Against the reference ---------------------------------------------------------------------

static void test_every_pattern_is_the_reference(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    scene->render.supersampling.seed = 5;
    for (int lanes = 1; lanes <= packet(); lanes *= 4) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes);
        for (int n = 0; n < PATTERNS * 2; n++) {
            scene->render.supersampling.pattern = (enum pel_pattern)(n / 2);
            scene->render.supersampling.filter = (enum pel_reconstruction)(n & 1);
            scene->render.supersampling.n = scene_is_small() ? 2 : 1 + n % 3;
            scene->render.jitter = lanes == packet() && n % 4 == 3;
            char title[64];
            snprintf(title, sizeof title, "pattern %d, filter %d, %d lanes", n / 2, n & 1, lanes);
            pel_image_destroy(judge_render(renderer, scene, NULL, title));
        }
        pel_renderer_destroy(renderer);
    }
    pel_scene_destroy(scene);
}

static void test_adaptive_is_the_reference(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    scene->render.supersampling = (struct pel_supersampling){
        .n = 2, .pattern = PEL_PATTERN_MULTI_JITTERED, .seed = 3, .adaptive = 0.15};
    for (int lanes = 1; lanes <= packet(); lanes *= 4) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes);
        for (int filter = 0; filter < 2; filter++) {
            scene->render.supersampling.filter = (enum pel_reconstruction)filter;
            struct pel_render_statistics statistics;
            pel_image_destroy(judge_render(renderer, scene, &statistics, "adaptive"));
            assert_true(statistics.refined > 0.05 && statistics.refined < 0.95);
        }
        pel_renderer_destroy(renderer);
    }
    pel_scene_destroy(scene);
}

static void test_jitter_is_the_reference(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    scene->render.jitter = true;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_IMAGE, 1);
    if (!judge_has_images(renderer, scene)) {
        pel_renderer_destroy(renderer);
        renderer = judge_renderer(PEL_READER_BUFFER, 1);
    }
    pel_image_destroy(judge_render(renderer, scene, NULL, "jitter"));
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// ---- Against analytic truth --------------------------------------------------------------------

// With n x n cells the share of rays on the covered side is off by 1 / n at most, with n^2 columns
// by 1 / n^2; in the columns beside the edge nothing is mixed.
static void test_an_edge_is_its_coverage(void **state) {
    (void)state;
    const double covered = 0.3;
    struct pel_scene *scene = scene_of_edge(covered);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    for (int n = 2; n <= (scene_is_small() ? 2 : 8); n++) {
        for (int pattern = 0; pattern < PATTERNS; pattern++) {
            scene->render.supersampling.n = n;
            scene->render.supersampling.pattern = (enum pel_pattern)pattern;
            struct pel_image *picture = render_picture(renderer, scene, NULL);
            double most = pattern >= PEL_PATTERN_ROOKS ? 1.0 / (n * n) : 1.0 / n;
            for (int y = 0; y < HEIGHT; y++) {
                assert_float_equal(alpha_at(picture, EDGE_COLUMN - 1, y), 1, 1e-5);
                assert_float_equal(alpha_at(picture, EDGE_COLUMN, y), covered, most + 1e-5);
                assert_float_equal(alpha_at(picture, EDGE_COLUMN + 1, y), 0, 1e-5);
            }
            pel_image_destroy(picture);
        }
    }
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// The Gaussian's integral over the covered side, pixel by pixel from the edge.
static void test_an_edge_is_its_gaussian(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_edge(0.5);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    scene->render.supersampling = (struct pel_supersampling){.n = scene_is_small() ? 4 : 8,
                                                             .pattern = PEL_PATTERN_HAMMERSLEY,
                                                             .filter = PEL_RECONSTRUCTION_GAUSSIAN};
    struct pel_image *picture = render_picture(renderer, scene, NULL);
    for (int x = EDGE_COLUMN - 3; x <= EDGE_COLUMN + 3; x++) {
        double inside = 0, all = 0;
        for (double d = -1.5 + 0.0005; d < 1.5; d += 0.001) {
            double weight = exp(-2 * d * d) - exp(-4.5);
            all += weight;
            inside += x + d < EDGE_COLUMN ? weight : 0;
        }
        assert_float_equal(alpha_at(picture, x, HEIGHT / 2), inside / all, 0.02);
    }
    pel_image_destroy(picture);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// The more rays, the nearer to a picture of many.
static void test_more_rays_converge(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    struct pel_supersampling *supersampling = &scene->render.supersampling;
    *supersampling = (struct pel_supersampling){.n = 8, .pattern = PEL_PATTERN_HAMMERSLEY};
    struct pel_image *truth = render_picture(renderer, scene, NULL);
    for (int pattern = 0; pattern < PATTERNS - 1; pattern++) {
        double psnr_db = 0;
        supersampling->pattern = (enum pel_pattern)pattern;
        for (supersampling->n = 1; supersampling->n <= 4; supersampling->n *= 2) {
            struct pel_image *picture = render_picture(renderer, scene, NULL);
            double now_db = picture_compare(picture, truth, 1).psnr_db;
            // Four times the rays halve the error of independent ones, and do better here.
            assert_true(now_db > psnr_db + (supersampling->n > 1 ? 3 : 0));
            psnr_db = now_db;
            pel_image_destroy(picture);
        }
        assert_true(psnr_db > 30);
    }
    pel_image_destroy(truth);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// ---- Seeds, adaptive counts, bad settings ------------------------------------------------------

static void test_seeds(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    for (int pattern = 0; pattern <= PATTERNS; pattern++) {
        bool jitter = pattern == PATTERNS;
        bool fixed = pattern == PEL_PATTERN_REGULAR || pattern == PEL_PATTERN_HAMMERSLEY;
        scene->render.supersampling = (struct pel_supersampling){
            .n = 2, .pattern = jitter ? PEL_PATTERN_REGULAR : (enum pel_pattern)pattern};
        scene->render.jitter = jitter;
        struct pel_image *first = render_picture(renderer, scene, NULL);
        struct pel_image *again = render_picture(renderer, scene, NULL);
        scene->render.supersampling.seed = 1;
        struct pel_image *other = render_picture(renderer, scene, NULL);
        assert_pictures_equal(again, first, "the same seed");
        assert_int_equal(picture_compare(other, first, 0).beyond_count == 0, fixed && !jitter);
        pel_image_destroy(first);
        pel_image_destroy(again);
        pel_image_destroy(other);
    }
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// The edge lies between two columns' centres, and no other pixels differ.
static void test_adaptive_counts(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_edge(0.3);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    struct pel_supersampling *supersampling = &scene->render.supersampling;
    struct pel_render_statistics statistics;
    uint64_t pixels = WIDTH * HEIGHT;
    *supersampling = (struct pel_supersampling){0};
    struct pel_image *plain = render_picture(renderer, scene, &statistics);
    assert_int_equal(statistics.rays, pixels);
    assert_float_equal(statistics.refined, 1, 0);
    uint64_t per_ray = statistics.samples / (EDGE_COLUMN * HEIGHT);
    assert_int_equal(statistics.samples, per_ray * EDGE_COLUMN * HEIGHT);

    supersampling->n = 4;
    struct pel_image *full = render_picture(renderer, scene, &statistics);
    assert_int_equal(statistics.rays, 16 * pixels);
    // Of four columns of rays in the edge's pixels, one is covered: 1/8, but not 3/8.
    assert_int_equal(statistics.samples, per_ray * (16 * EDGE_COLUMN + 4) * HEIGHT);

    supersampling->adaptive = 0.5;
    struct pel_image *some = render_picture(renderer, scene, &statistics);
    assert_float_equal(statistics.refined, 2.0 / WIDTH, 1e-12);
    assert_int_equal(statistics.rays, pixels + 16 * 2 * HEIGHT);
    assert_int_equal(statistics.samples, per_ray * (EDGE_COLUMN + 16 + 4) * HEIGHT);
    assert_pictures_equal(some, full, "refined at the edge");

    supersampling->adaptive = 1;
    struct pel_image *none = render_picture(renderer, scene, &statistics);
    assert_float_equal(statistics.refined, 0, 0);
    assert_int_equal(statistics.rays, pixels);
    assert_pictures_equal(none, plain, "nothing refined");
    pel_image_destroy(plain);
    pel_image_destroy(full);
    pel_image_destroy(some);
    pel_image_destroy(none);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// Beyond a ray through the centre, one ray is what its pattern says.
static void test_one_centred_ray_is_plain(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    struct pel_image *plain = render_picture(renderer, scene, NULL);
    scene->render.supersampling.n = 1;
    for (int pattern = 0; pattern < PATTERNS; pattern++) {
        scene->render.supersampling.pattern = (enum pel_pattern)pattern;
        struct pel_image *one = render_picture(renderer, scene, NULL);
        bool centred = pattern == PEL_PATTERN_REGULAR || pattern == PEL_PATTERN_HAMMERSLEY;
        assert_int_equal(picture_compare(one, plain, 0).beyond_count == 0, centred);
        pel_image_destroy(one);
    }
    pel_image_destroy(plain);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

static void test_bad_settings(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_edge(0.5);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, packet());
    static const struct pel_supersampling bad[] = {{.n = 9},
                                                   {.n = -1},
                                                   {.adaptive = -1},
                                                   {.adaptive = NAN},
                                                   {.pattern = (enum pel_pattern)PATTERNS},
                                                   {.filter = (enum pel_reconstruction)2}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        scene->render.supersampling = bad[i];
        assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
        assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    }
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_pattern_is_the_reference),
        cmocka_unit_test(test_adaptive_is_the_reference),
        cmocka_unit_test(test_jitter_is_the_reference),
        cmocka_unit_test(test_an_edge_is_its_coverage),
        cmocka_unit_test(test_an_edge_is_its_gaussian),
        cmocka_unit_test(test_more_rays_converge),
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_adaptive_counts),
        cmocka_unit_test(test_one_centred_ray_is_plain),
        cmocka_unit_test(test_bad_settings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
