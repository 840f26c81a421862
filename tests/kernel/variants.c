// variants.c - kernel variants against the reference, on small scenes of overlapping instances.
//
// What a variant is made of comes in 6 ways to read (reader x lanes), 5 sets of voxel classes, 5 of
// filters, 2 mixings, 3 ways to skip, and tables read at an entry or between entries: 1800 kernels,
// of a second or more each to compile. A fault that depends on two of these choices shows already
// if every pair of values occurs together in some kernel, and 30 kernels have them all: a covering
// array of strength 2 (Cohen et al. 1997), one row for each pair of the two largest factors. What
// needs no kernel of its own (voxel types of a class, extent, origin) takes turns as well.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"

static const struct way {
    enum pel_reader reader;
    int lanes;
} ways[] = {
    {PEL_READER_BUFFER, 1},  {PEL_READER_BUFFER, 4}, {PEL_READER_BUFFER, 8},
    {PEL_READER_BUFFER, 16}, {PEL_READER_IMAGE, 1},  {PEL_READER_IMAGE, 16},
};

// Sets of voxel classes, by the types their volumes have in turn. The last set has all four.
enum { SETS = 5, ALL_CLASSES = SETS - 1, CLASSES = 4, TURNS = 2 };
static const enum pel_voxel_type types[CLASSES][TURNS] = {
    {PEL_VOXEL_U8, PEL_VOXEL_I8},
    {PEL_VOXEL_U16, PEL_VOXEL_I16},
    {PEL_VOXEL_F32, PEL_VOXEL_F32},
    {PEL_VOXEL_RGBA8, PEL_VOXEL_RGB8},
};

static const char *const set_names[SETS] = {"8 bits", "16 bits", "floats", "colours", "all"};

// By the filters of the two instances.
enum { FILTERS = 5 };
static const enum pel_filter filters[FILTERS][2] = {
    {PEL_FILTER_LINEAR, PEL_FILTER_LINEAR},
    {PEL_FILTER_NEAREST, PEL_FILTER_NEAREST},
    {PEL_FILTER_LINEAR, PEL_FILTER_NEAREST},
    {PEL_FILTER_CUBIC_B_SPLINE, PEL_FILTER_CUBIC_B_SPLINE},
    {PEL_FILTER_CATMULL_ROM, PEL_FILTER_LINEAR},
};

static const enum pel_skip skips[] = {PEL_SKIP_NONE, PEL_SKIP_GRID, PEL_SKIP_DISTANCE};

// One row of the covering array.
struct choice {
    int filters; // a row of the table above
    enum pel_mixing mixing;
    enum pel_skip skip;
    bool cliff; // a table so steep that the kernel interpolates between its entries
    enum pel_extent extent;
    enum pel_sample_origin origin;
};

static struct choice choose(int way, int set, int turn) {
    return (struct choice){
        .filters = (way + set) % FILTERS,
        .mixing = (way / 3 + set) % 2 ? PEL_MIX_OVER : PEL_MIX_SUM,
        .skip = skips[(way + 2 * set) % 3],
        .cliff = (way + set / 2) % 2,
        .extent = (way + turn) % 2 ? PEL_EXTENT_POINT : PEL_EXTENT_CELL,
        .origin = (set + turn) % 2 ? PEL_ORIGIN_BOUNDS : PEL_ORIGIN_VOLUMES,
    };
}

// ---- The scene of a choice ---------------------------------------------------------------------

// A gentle function, with a sudden step in the middle if asked for.
static struct pel_transfer *transfer_of(const struct pel_volume *volume, double opacity,
                                        uint64_t seed, bool cliff) {
    double raw[2];
    scene_raw_range(volume->type, raw);
    double ends[2] = {volume->slope * raw[0] + volume->intercept,
                      volume->slope * raw[1] + volume->intercept};
    double low = fmin(ends[0], ends[1]), high = fmax(ends[0], ends[1]), middle = (low + high) / 2;
    if (!cliff)
        return scene_transfer_gentle((double[]){low, high}, opacity, seed);
    double r = test_random(&seed), g = test_random(&seed), b = test_random(&seed);
    return scene_transfer((const double[][5]){{low, r, g, b, 0},
                                              {middle, g, b, r, opacity / 2},
                                              {middle, b, r, g, opacity},
                                              {high, r, b, g, opacity / 3}},
                          4);
}

// A volume in two poses: the second one is denser in the middle and stands across the first.
static void add_pair(struct pel_scene *scene, enum pel_voxel_type type, const struct choice *choice,
                     uint64_t seed) {
    bool small = scene_is_small();
    int dims[3] = {small ? 10 : 17, small ? 12 : 22, small ? 8 : 19};
    struct pel_volume *volume = scene_volume_waves(dims, type, 11 + seed, small ? 7 : 12);
    double spacing[3] = {17.1 / dims[0], 26.3 / dims[1], 20.9 / dims[2]};
    scene_place(volume, spacing, (double[]){0.31, -0.42, 0.17, 0.83}, (double[]){-1.3, 2.1, 0.7},
                true);
    if (type == PEL_VOXEL_I16) {
        volume->slope = -0.25;
        volume->intercept = 100;
    }
    struct pel_instance *first =
        scene_add(scene, volume, transfer_of(volume, 0.08, 21 + seed, choice->cliff));
    struct pel_instance *second =
        scene_add_again(scene, first->volume, transfer_of(volume, 0.15, 22 + seed, choice->cliff));
    second->transform =
        pel_matrix_from_quaternion((double[]){0.7, 0.2, -0.3, 0.6}, (double[]){3.3, -2.7, 1.9});
    second->density = 0.7;
    first->extent = second->extent = choice->extent;
    first->filter = filters[choice->filters][0];
    second->filter = filters[choice->filters][1];
}

static struct pel_scene *scene_of(const struct choice *choice, int set, int turn) {
    bool small = scene_is_small();
    // A device that has one ray at a time is slow, too, as its code is not optimised (support/on).
    bool slow = judge_packet_lanes() == 1;
    struct pel_scene *scene = scene_create(small ? 8 : slow ? 20 : 40, small ? 6 : slow ? 15 : 30);
    scene->render.mixing = choice->mixing;
    scene->render.origin = choice->origin;
    scene->render.skip = choice->skip;
    scene->render.step = small ? 1 : 0.5;
    if (set < ALL_CLASSES)
        add_pair(scene, types[set][turn], choice, 0);
    for (int class = 0; set == ALL_CLASSES && class < CLASSES; class ++)
        add_pair(scene, types[class][turn], choice, (uint64_t) class);
    return scene;
}

// ---- Rows --------------------------------------------------------------------------------------

static void check_row(struct pel_renderer *renderer, const struct way *way, int w, int set) {
    // Where a device is slow one turn has to do, each in every second kernel.
    int first = scene_is_small() ? (w + set) % TURNS : 0;
    int end = scene_is_small() ? first + 1 : TURNS;
    for (int turn = first; turn < end; turn++) {
        struct choice choice = choose(w, set, turn);
        struct pel_scene *scene = scene_of(&choice, set, turn);
        char title[160];
        snprintf(title, sizeof title, "%s x %d: %s, filters %d, %s, skip %d%s, %s, %s",
                 way->reader == PEL_READER_IMAGE ? "image" : "buffer", way->lanes, set_names[set],
                 choice.filters, choice.mixing ? "over" : "sum", choice.skip,
                 choice.cliff ? ", cliff" : "", choice.extent ? "point" : "cell",
                 choice.origin ? "bounds" : "volumes");
        struct pel_render_statistics statistics;
        pel_image_destroy(judge_render(renderer, scene, &statistics, title));
        assert_int_equal(statistics.reader, way->reader);
        assert_int_equal(statistics.lanes, way->lanes);
        assert_int_equal(statistics.skip, choice.skip);
        assert_true(statistics.samples > 0);
        pel_scene_destroy(scene);
    }
}

// A compiler to which wide packets are a burden sees one row of narrow ones, and of the others
// where everything is asked for.
static int rows_of(const struct way *way) {
    if (way->lanes <= judge_packet_lanes())
        return SETS;
    return way->lanes <= 4 || getenv("PELLUCID_TEST_ALL") ? 1 : 0;
}

static void test_way(void **state) {
    const struct way *way = *state;
    int w = (int)(way - ways), rows = rows_of(way);
    if (rows == 0) {
        print_message(
            "skipped: %d lanes take this compiler minutes; PELLUCID_TEST_ALL=1 has them\n",
            way->lanes);
        skip();
    }
    struct pel_renderer *renderer = judge_renderer(way->reader, way->lanes);
    if (way->reader == PEL_READER_IMAGE) {
        struct choice choice = choose(w, 0, 0);
        struct pel_scene *scene = scene_of(&choice, 0, 0);
        bool has_images = judge_has_images(renderer, scene);
        pel_scene_destroy(scene);
        if (!has_images) {
            pel_renderer_destroy(renderer);
            skip();
        }
    }
    for (int set = 0; set < rows; set++)
        check_row(renderer, way, w, set);
    pel_renderer_destroy(renderer);
}

// That the rows hold every pair of values is arithmetic; here it is counted.
static void test_pairs_are_covered(void **state) {
    (void)state;
    enum { WAYS = sizeof ways / sizeof *ways, FACTORS = 6, VALUES = 6 };
    static const int value_counts[FACTORS] = {WAYS, SETS, FILTERS, 2, 3, 2};
    bool seen[FACTORS][VALUES][FACTORS][VALUES] = {0};
    for (int w = 0; w < WAYS; w++) {
        for (int set = 0; set < SETS; set++) {
            struct choice choice = choose(w, set, 0);
            int values[FACTORS] = {
                w, set, choice.filters, choice.mixing, choice.skip - PEL_SKIP_NONE, choice.cliff};
            for (int a = 0; a < FACTORS; a++)
                for (int b = 0; b < FACTORS; b++)
                    seen[a][values[a]][b][values[b]] = true;
        }
    }
    for (int a = 0; a < FACTORS; a++)
        for (int b = a + 1; b < FACTORS; b++)
            for (int i = 0; i < value_counts[a]; i++)
                for (int j = 0; j < value_counts[b]; j++)
                    if (!seen[a][i][b][j])
                        fail_msg("no kernel with value %d of factor %d and %d of %d", i, a, j, b);
}

int main(void) {
    struct CMUnitTest tests[8] = {cmocka_unit_test(test_pairs_are_covered)};
    static const char *const names[] = {"buffer x 1",  "buffer x 4", "buffer x 8",
                                        "buffer x 16", "image x 1",  "image x 16"};
    size_t count = 1;
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
        tests[count++] = (struct CMUnitTest){
            .name = names[w], .test_func = test_way, .initial_state = (void *)&ways[w]};
    return _cmocka_run_group_tests("variants", tests, count, NULL, NULL);
}
