// Tests of baked hypertextures: every operation against plain formulae in double precision, every
// noise against its reference, and what presets and options promise.
#include "support/test.h"

#include <math.h>

#include "reference/noise.h"
#include "support/judge.h"
#include "support/near.h"
#include "support/scenes.h"
#include "world/recipe.h"

static struct pel_renderer *renderer;

static int start(void **state) {
    (void)state;
    renderer = judge_renderer(PEL_READER_AUTO, 0);
    return 0;
}

static int finish(void **state) {
    (void)state;
    pel_renderer_destroy(renderer);
    return 0;
}

static struct pel_volume *bake(const char *recipe, const struct pel_bake_options *options) {
    struct pel_volume *volume = pel_renderer_bake(renderer, recipe, options);
    if (!volume)
        fail_msg("%s: %s", recipe, pel_error_message());
    return volume;
}

static int grid_size(void) {
    return scene_is_small() ? 4 : 12;
}

// The position of a recipe at voxel `n` of a cube.
static void position(int size, int n, double p[3]) {
    int index[3] = {n % size, n / size % size, n / (size * size)};
    for (int axis = 0; axis < 3; axis++)
        p[axis] = (2.0 * index[axis] + 1) / size - 1;
}

// ---- Operations
// ----------------------------------------------------------------------------------

static double radius(const double p[3]) {
    return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

static double clamped(double a) {
    return fmin(fmax(a, 0), 1);
}

// Perlin & Hoffert 1989, section 3.2, as they write it.
static double bias(double b, double t) {
    return pow(t, log(b) / log(0.5));
}

static double gain(double g, double t) {
    return t < 0.5 ? bias(1 - g, 2 * t) / 2 : 1 - bias(1 - g, 2 - 2 * t) / 2;
}

// A number in 0..1 that the operations of one variable are tried on.
#define T "[\"+\", 0.5, [\"*\", 0.5, \"x\"]]"
static double t_of(const double p[3]) {
    return 0.5 + 0.5 * p[0];
}

#define CASE(name, formula)                                                                        \
    static double name(const double p[3]) {                                                        \
        double x = p[0], y = p[1], z = p[2], r = radius(p), t = t_of(p);                           \
        (void)x, (void)y, (void)z, (void)r, (void)t;                                               \
        return formula;                                                                            \
    }
CASE(f_arithmetic, (x + y * z - 2) / (3 + x))
CASE(f_zero, 0)
CASE(f_time, 2.5 * x)
CASE(f_min_max, fmin(fmax(x, y), z))
CASE(f_unary, sin(3 * x) * cos(2 * y) + sqrt(fabs(z)) - exp(x))
CASE(f_fract, floor(3.1 * x) + (2.3 * y - floor(2.3 * y)))
CASE(f_pow, pow(r, 1.7))
CASE(f_t, t)
CASE(f_bias, bias(0.3, t))
CASE(f_gain, gain(0.8, t))
CASE(f_clamp, fmin(fmax(x, -0.2), 0.4))
CASE(f_mix, x + z * (y - x))
CASE(f_smooth,
     clamped((x + 0.5) / 0.8) * clamped((x + 0.5) / 0.8) * (3 - 2 * clamped((x + 0.5) / 0.8)))
CASE(f_sphere, clamped(0.5 - (r - 0.6) / 0.25))
CASE(f_torus, clamped(0.5 - (hypot(hypot(x, y) - 0.6, z) - 0.25) / 0.5))
// Within the box, where the nearest face decides, and beyond a corner.
CASE(f_box,
     clamped(0.5 - (fabs(x) <= 0.5 && fabs(y) <= 0.6 && fabs(z) <= 0.7
                        ? fmax(fmax(fabs(x) - 0.5, fabs(y) - 0.6), fabs(z) - 0.7)
                        : sqrt(pow(fmax(fabs(x) - 0.5, 0), 2) + pow(fmax(fabs(y) - 0.6, 0), 2) +
                               pow(fmax(fabs(z) - 0.7, 0), 2)))))
CASE(f_define, (x + 1) * (x + 1) + y)
CASE(f_at, 2 * y + (-x) * 100 + (2 * y + 1 + z) + z * 10)

static void test_operations(void **state) {
    (void)state;
    static const struct {
        const char *value;
        double (*truth)(const double p[3]);
    } cases[] = {
        {"[\"/\", [\"-\", [\"+\", \"x\", [\"*\", \"y\", \"z\"]], 2], [\"+\", 3, \"x\"]]",
         f_arithmetic},
        {"[\"/\", \"x\", 0]", f_zero},
        {"[\"pow\", -1, 2]", f_zero},
        {"[\"sqrt\", -1]", f_zero},
        {"\"object\"", NULL},
        {"[\"*\", \"time\", \"x\"]", f_time},
        {"[\"min\", [\"max\", \"x\", \"y\"], \"z\"]", f_min_max},
        {"[\"-\", [\"+\", [\"*\", [\"sin\", [\"*\", 3, \"x\"]], [\"cos\", [\"*\", 2, \"y\"]]], "
         "[\"sqrt\", [\"abs\", \"z\"]]], [\"exp\", \"x\"]]",
         f_unary},
        {"[\"+\", [\"floor\", [\"*\", 3.1, \"x\"]], [\"fract\", [\"*\", 2.3, \"y\"]]]", f_fract},
        {"[\"pow\", \"radius\", 1.7]", f_pow},
        {"[\"bias\", 0.5, " T "]", f_t},
        {"[\"gain\", 0.5, " T "]", f_t},
        {"[\"bias\", 0.3, " T "]", f_bias},
        {"[\"gain\", 0.8, " T "]", f_gain},
        // A gain is symmetric about the middle.
        {"[\"-\", 1, [\"gain\", 0.8, [\"-\", 1, " T "]]]", f_gain},
        {"[\"clamp\", \"x\", -0.2, 0.4]", f_clamp},
        {"[\"mix\", \"x\", \"y\", \"z\"]", f_mix},
        {"[\"smoothstep\", -0.5, 0.3, \"x\"]", f_smooth},
        {"[\"sphere\", 0.6, 0.25]", f_sphere},
        {"[\"torus\", 0.6, 0.25, 0.5]", f_torus},
        {"[\"box\", 0.5, 0.6, 0.7, 1]", f_box},
        {"[\"at\", [[\"*\", 2, \"y\"], [\"-\", \"x\"], \"z\"], [\"+\", \"x\", [\"*\", 100, \"y\"], "
         "[\"at\", [[\"+\", \"x\", 1], 0, \"z\"], [\"+\", \"x\", \"z\"]], [\"*\", 10, \"z\"]]]",
         f_at},
    };
    int size = grid_size(), voxels = size * size * size;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char recipe[1024];
        snprintf(recipe, sizeof recipe, "{\"value\": %s}", cases[c].value);
        struct pel_bake_options options = {.size = size, .type = PEL_VOXEL_F32, .time = 2.5};
        if (!cases[c].truth) {
            assert_null(pel_renderer_bake(renderer, recipe, &options));
            assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
            assert_non_null(strstr(pel_error_message(), "grows on a volume"));
            continue;
        }
        struct pel_volume *volume = bake(recipe, &options);
        for (int n = 0; n < voxels; n++) {
            double p[3], value = ((float *)volume->voxels)[n];
            position(size, n, p);
            double truth = cases[c].truth(p);
            if (!(fabs(value - truth) <= 2e-5 * fmax(1, fabs(truth))))
                fail_msg("%s at %g %g %g is %g, not %g", cases[c].value, p[0], p[1], p[2], value,
                         truth);
        }
        pel_volume_destroy(volume);
    }
    struct pel_bake_options options = {.size = 3, .type = PEL_VOXEL_F32};
    struct pel_volume *volume =
        bake("{\"define\": {\"a\": [\"+\", \"x\", 1], \"b\": [\"*\", \"a\", \"a\"]}, \"value\": "
             "[\"at\", [9, \"y\", 9], [\"+\", \"b\", \"y\"]]}",
             &options);
    for (int n = 0; n < 27; n++) {
        double p[3];
        position(3, n, p);
        assert_near(((float *)volume->voxels)[n], f_define(p), 1e-6);
    }
    pel_volume_destroy(volume);
}

// ---- Noises
// --------------------------------------------------------------------------------------

static double one_octave(const struct recipe *tables, const double p[3], int octaves) {
    (void)octaves;
    return reference_noise_2002(tables, p);
}

static double one_octave_1985(const struct recipe *tables, const double p[3], int octaves) {
    (void)octaves;
    return reference_noise_1985(tables, p);
}

static void test_noises(void **state) {
    (void)state;
    static const struct {
        const char *format;
        double (*truth)(const struct recipe *tables, const double p[3], int number);
        int number;
    } cases[] = {
        {"[\"noise\", %g]", one_octave, 1},
        {"[\"noise-1985\", %g]", one_octave_1985, 1},
        {"[\"fbm\", %g, 4]", reference_fbm, 4},
        {"[\"turbulence\", %g, 3]", reference_turbulence, 3},
        {"[\"ridged\", %g, 5]", reference_ridged, 5},
        {"[\"worley\", %g, 1]", reference_worley, 1},
        {"[\"worley\", %g, 2]", reference_worley, 2},
        {"[\"worley\", %g, 3]", reference_worley, 3},
        {"[\"worley\", %g, 4]", reference_worley, 4},
    };
    static const uint32_t seeds[] = {0, 7, 4000000000u};
    static const double frequencies[] = {3.7, 1, 270};
    int size = grid_size(), voxels = size * size * size;
    for (size_t c = 0; c < 3 * sizeof cases / sizeof *cases; c++) {
        int number = cases[c / 3].number;
        double frequency = frequencies[c % 3];
        char value[64], recipe[128];
        snprintf(value, sizeof value, cases[c / 3].format, frequency);
        snprintf(recipe, sizeof recipe, "{\"value\": %s}", value);
        struct pel_bake_options options = {
            .size = size, .type = PEL_VOXEL_F32, .seed = seeds[c % 3]};
        struct pel_volume *volume = bake(recipe, &options);
        struct recipe tables;
        pel_recipe_seed(&tables, options.seed);
        // A position is off by half a unit in the last place, and the noise by up to its slope
        // times that; octaves keep the height times the frequency.
        double bound = 1e-5 + 4 * number * frequency * 0x1p-23;
        for (int n = 0; n < voxels; n++) {
            double p[3];
            position(size, n, p);
            for (int axis = 0; axis < 3; axis++)
                p[axis] *= frequency;
            double truth = cases[c / 3].truth(&tables, p, number);
            double got = ((float *)volume->voxels)[n];
            if (!(fabs(got - truth) <= bound))
                fail_msg("%s, seed %u, voxel %d: %.9g, not %.9g", value, options.seed, n, got,
                         truth);
        }
        pel_volume_destroy(volume);
    }
}

// Perlin's own number, and zeros at the lattice's points, the same through the whole path.
static void test_published(void **state) {
    (void)state;
    struct pel_bake_options options = {.size = 2, .type = PEL_VOXEL_F32};
    struct pel_volume *volume =
        bake("{\"value\": [\"at\", [3.14, 42, 7], [\"noise\", 1]]}", &options);
    assert_near(((float *)volume->voxels)[0], 0.13691995878400012, 1e-5);
    pel_volume_destroy(volume);
    // Voxels of a grid of two are at -0.5 and 0.5.
    volume = bake("{\"value\": [\"noise\", 6]}", &options);
    for (int n = 0; n < 8; n++)
        assert_true(((float *)volume->voxels)[n] == 0);
    pel_volume_destroy(volume);
}

// ---- Options
// -------------------------------------------------------------------------------------

static void test_seeds(void **state) {
    (void)state;
    struct pel_bake_options options = {.size = scene_is_small() ? 4 : 12, .seed = 5};
    static const char *const kinds[] = {"[\"fbm\", 3, 2]", "[\"noise-1985\", 3]",
                                        "[\"worley\", 3, 1]"};
    for (int i = 0; i < 3; i++) {
        char recipe[128];
        snprintf(recipe, sizeof recipe,
                 "{\"value\": [\"at\", [\"x\", \"y\", [\"+\", \"z\", \"time\"]], %s]}", kinds[i]);
        struct pel_bake_options other = options, later = options;
        other.seed = 6;
        later.time = 0.1;
        struct pel_volume *a = bake(recipe, &options), *b = bake(recipe, &options);
        struct pel_volume *c = bake(recipe, &other), *d = bake(recipe, &later);
        assert_memory_equal(a->voxels, b->voxels, pel_volume_bytes(a));
        assert_memory_not_equal(a->voxels, c->voxels, pel_volume_bytes(a));
        assert_memory_not_equal(a->voxels, d->voxels, pel_volume_bytes(a));
        pel_volume_destroy(a);
        pel_volume_destroy(b);
        pel_volume_destroy(c);
        pel_volume_destroy(d);
    }
}

static uint32_t first_voxel(double value, enum pel_voxel_type type, bool wrap) {
    char recipe[64];
    snprintf(recipe, sizeof recipe, "{\"value\": %g}", value);
    struct pel_bake_options options = {.size = 1, .type = type, .wrap = wrap};
    struct pel_volume *volume = bake(recipe, &options);
    uint32_t raw = type == PEL_VOXEL_U8 ? *(uint8_t *)volume->voxels : *(uint16_t *)volume->voxels;
    assert_near(pel_volume_value(volume, 0, 0, 0), raw, 0);
    pel_volume_destroy(volume);
    return raw;
}

// As a negative number is when its byte is taken for an unsigned one: -51 is 205.
static void test_wrap(void **state) {
    (void)state;
    assert_int_equal(first_voxel(0.2, PEL_VOXEL_U8, false), 51);
    assert_int_equal(first_voxel(0.2, PEL_VOXEL_U8, true), 51);
    assert_int_equal(first_voxel(-0.2, PEL_VOXEL_U8, false), 0);
    assert_int_equal(first_voxel(-0.2, PEL_VOXEL_U8, true), (uint8_t)-51);
    assert_int_equal(first_voxel(1.2, PEL_VOXEL_U8, false), 255);
    assert_int_equal(first_voxel(1.2, PEL_VOXEL_U8, true), 306 - 256);
    assert_int_equal(first_voxel(-0.2, PEL_VOXEL_U16, true), (uint16_t)-13107);
    assert_int_equal(first_voxel(2, PEL_VOXEL_U16, false), 65535);
}

static void test_refusals(void **state) {
    (void)state;
    const struct {
        struct pel_bake_options options;
        const char *message;
    } cases[] = {
        {{.size = -1}, "size -1"},
        {{.size = 65537}, "size 65537"},
        {{.time = NAN}, "time nan"},
        {{.type = PEL_VOXEL_RGB8}, "uint8, uint16 or float32 only"},
        {{.type = PEL_VOXEL_F32, .wrap = true}, "only integers wrap around"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_null(pel_renderer_bake(renderer, "wood", &cases[i].options));
        assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
        assert_non_null(strstr(pel_error_message(), cases[i].message));
    }
}

static bool count_calls(double finished, void *user) {
    ++*(int *)user;
    return finished <= 1;
}

// A volume of several batches, the last one not full, has every voxel in its place.
static void test_batches(void **state) {
    (void)state;
    int size = scene_is_small() ? 17 : 31, calls = 0;
    struct pel_bake_options options = {
        .size = size, .type = PEL_VOXEL_F32, .progress = count_calls, .user = &calls};
    struct pel_volume *volume =
        bake("{\"value\": [\"+\", \"x\", [\"*\", 10, \"y\"], [\"*\", 100, \"z\"]]}", &options);
    assert_true(calls > 1);
    for (int n = 0; n < size * size * size; n++) {
        double p[3];
        position(size, n, p);
        assert_near(((float *)volume->voxels)[n], p[0] + 10 * p[1] + 100 * p[2], 1e-4);
    }
    pel_volume_destroy(volume);
}

static bool abandon(double finished, void *user) {
    (void)finished;
    ++*(int *)user;
    return false;
}

static void test_progress(void **state) {
    (void)state;
    int calls = 0;
    struct pel_bake_options options = {.size = 4, .progress = abandon, .user = &calls};
    assert_null(pel_renderer_bake(renderer, "{\"value\": 1}", &options));
    assert_int_equal(calls, 1);
}

// ---- Objects
// -------------------------------------------------------------------------------------

// An oblique box of 10 x 6 x 8 mm with a value of its own in each voxel.
static struct pel_volume *make_object(void) {
    struct pel_volume *object = pel_volume_create("object", (const int[]){10, 3, 4}, PEL_VOXEL_F32);
    for (int n = 0; n < 120; n++)
        ((float *)object->voxels)[n] = (float)(n * 37 % 101) - 30;
    const double axes[3][3] = {{0.6, -1.6, 0}, {0.8, 1.2, 0}, {0, 0, 2}};
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            object->world_from_voxel.m[row][column] = axes[row][column];
        object->world_from_voxel.m[row][3] = 5 * row - 3;
    }
    return object;
}

// A recipe that is its object makes what resampling makes, in the same place.
static void test_object(void **state) {
    (void)state;
    struct pel_volume *object = make_object();
    for (int size = 10; size <= 20; size += 10) {
        struct pel_bake_options options = {.size = size, .type = PEL_VOXEL_F32, .object = object};
        struct pel_volume *baked = bake("{\"value\": \"object_value\"}", &options);
        struct pel_volume *share = bake("{\"value\": \"object\"}", &options);
        struct pel_volume *truth =
            pel_volume_resample(object, (const int[]){size, size * 6 / 10, size * 8 / 10});
        assert_memory_equal(baked->dims, truth->dims, sizeof baked->dims);
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 4; column++)
                assert_near(baked->world_from_voxel.m[row][column],
                            truth->world_from_voxel.m[row][column], 1e-12);
        for (size_t n = 0; n < pel_volume_voxel_count(truth); n++) {
            double value = ((float *)truth->voxels)[n];
            assert_near(((float *)baked->voxels)[n], value, 1e-3);
            // The values are -30..70.
            assert_near(((float *)share->voxels)[n], (value + 30) / 100, 1e-5);
        }
        pel_volume_destroy(baked);
        pel_volume_destroy(share);
        pel_volume_destroy(truth);
    }
    pel_volume_destroy(object);
}

// ---- Presets
// -------------------------------------------------------------------------------------

// How much of each there is: the share of voxels above a tenth, and of the whole as a mean.
static void test_presets(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double low, high;
    } shares[] = {
        {"noisy-sphere", 0.1, 0.35}, {"fireball", 0.05, 0.4},   {"marble", 0.3, 0.5},
        {"tribble", 0.05, 0.35},     {"eroded-cube", 0.2, 0.6}, {"cloud", 0.03, 0.3},
        {"wood", 0.3, 0.5},          {"smoke", 0.02, 0.3},
    };
    int size = scene_is_small() ? 5 : 24, voxels = size * size * size;
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        assert_string_equal(shares[i].name, pel_recipe_presets()[i]);
        for (uint32_t seed = 0; seed < (scene_is_small() ? 1 : 2); seed++) {
            struct pel_bake_options options = {.size = size, .seed = seed};
            struct pel_volume *volume = bake(shares[i].name, &options);
            const uint8_t *bytes = volume->voxels;
            int there = 0, most = 0, border = 0;
            for (int n = 0; n < voxels; n++) {
                double p[3];
                position(size, n, p);
                there += bytes[n] > 25;
                most = bytes[n] > most ? bytes[n] : most;
                border += bytes[n] > 25 &&
                          fmax(fmax(fabs(p[0]), fabs(p[1])), fabs(p[2])) > 1 - 1.5 / size;
            }
            double share = (double)there / voxels;
            print_message("%s, seed %u: %.3f above a tenth, most %d, %d at the border\n",
                          shares[i].name, seed, share, most, border);
            if (!scene_is_small()) {
                assert_true(share > shares[i].low && share < shares[i].high);
                assert_true(border < voxels / 100);
                assert_true(most > 150);
            }
            pel_volume_destroy(volume);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_operations), cmocka_unit_test(test_noises),
        cmocka_unit_test(test_published),  cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_wrap),       cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_progress),   cmocka_unit_test(test_batches),
        cmocka_unit_test(test_object),     cmocka_unit_test(test_presets),
    };
    return cmocka_run_group_tests(tests, start, finish);
}
