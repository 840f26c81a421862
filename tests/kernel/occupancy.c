// occupancy.c - the passes over cells: what is empty, how far it is from what is not, the nodes of
// an octree and bricks, each compared with what the definitions say, cell by cell.
#include <math.h>

#include "device/device.h"
#include "render/variant.h"
#include "shared/grid.h"
#include "shared/world.h"
#include "support/judge.h"
#include "support/test.h"

enum {
    ENTRIES = 64,
    BEFORE = 5, // cells of something else around the part's
    BEHIND = 21,
    MOST = 80 * 7 * 5 + BEFORE + BEHIND,
    UNTOUCHED = 222,
    GROUP = 16,
};

// A grid of cells with the truth about it.
struct sample {
    int dims[3], count;
    bool seen[MOST], entries[ENTRIES];
    float ranges[MOST][2];
};

static const float endless = 1e30F;

// The world up to its second part, which is the one that is looked at.
static const size_t world_bytes = offsetof(struct world, parts) + 2 * sizeof(struct part);

// Ranges end between entries, so that rounding cannot matter. `density` is the share of the cells
// with values up to the last entry.
static void fill(struct sample *sample, const int dims[3], double density, uint64_t seed) {
    sample->count = dims[0] * dims[1] * dims[2];
    memcpy(sample->dims, dims, sizeof sample->dims);
    for (int e = 0; e < ENTRIES; e++)
        sample->entries[e] = (e >= 20 && e < 24) || e > 50;
    for (int i = 0; i < sample->count; i++) {
        bool dense = test_random(&seed) < density;
        double low = floor(test_random(&seed) * 12) + 0.25;
        double high = low + floor(test_random(&seed) * (dense ? 45 : 6)) + 0.5;
        bool none = test_random(&seed) < 0.1;
        sample->ranges[i][0] = none ? endless : (float)low;
        sample->ranges[i][1] = none ? -endless : (float)high;
        sample->seen[i] = false;
        for (int e = (int)low; !none && e <= (int)high + 1; e++)
            sample->seen[i] = sample->seen[i] || sample->entries[e];
    }
}

// ---- What the definitions say ------------------------------------------------------------------

static int true_distance(const struct sample *sample, int i) {
    const int *dims = sample->dims;
    int place[3] = {i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]};
    int least = CELL_DISTANCE_MAX;
    for (int j = 0; j < sample->count; j++) {
        int other[3] = {j % dims[0], j / dims[0] % dims[1], j / dims[0] / dims[1]}, far = 0;
        for (int c = 0; c < 3; c++)
            far = abs(place[c] - other[c]) > far ? abs(place[c] - other[c]) : far;
        least = sample->seen[j] && far < least ? far : least;
    }
    return least;
}

// Whether something is seen in the box of 2^bits cells along a side that cell i lies in.
static bool box_seen(const struct sample *sample, int i, int bits) {
    const int *dims = sample->dims;
    int place[3] = {i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]};
    for (int j = 0; j < sample->count; j++) {
        int other[3] = {j % dims[0], j / dims[0] % dims[1], j / dims[0] / dims[1]};
        if (sample->seen[j] && place[0] >> bits == other[0] >> bits &&
            place[1] >> bits == other[1] >> bits && place[2] >> bits == other[2] >> bits)
            return true;
    }
    return false;
}

static int levels(const struct sample *sample) {
    int level = 0;
    while (1 << level < sample->dims[0] || 1 << level < sample->dims[1] ||
           1 << level < sample->dims[2])
        level++;
    return level;
}

static int true_node(const struct sample *sample, int i) {
    int number = 0;
    while (number <= levels(sample) && !box_seen(sample, i, number))
        number++;
    return number;
}

// ---- The device --------------------------------------------------------------------------------

struct bench {
    struct pel_device *device;
    struct pel_kernel *kernel;
    struct pel_buffer *world, *ranges, *visible, *in, *out;
    const struct sample *sample;
};

static void write_world(struct bench *bench) {
    const struct sample *sample = bench->sample;
    struct world *world = calloc(1, sizeof *world);
    struct part *part = &world->parts[1];
    part->filter = FILTERS_LINEAR;
    part->model = MODEL_ABSORPTION;
    part->table_scale = 1;
    part->table_last = ENTRIES - 1;
    part->cells = part->ranges = BEFORE;
    part->cell_row = sample->dims[0];
    part->cell_slice = sample->dims[0] * sample->dims[1];
    uint32_t next[ENTRIES + 1] = {[ENTRIES] = ENTRIES};
    for (uint32_t e = ENTRIES; e-- > 0;)
        next[e] = sample->entries[e] ? e : next[e + 1];
    uint8_t cells[MOST];
    memset(cells, UNTOUCHED, sizeof cells);
    assert_true(pel_buffer_write(bench->world, 0, world_bytes, world) &&
                pel_buffer_write(bench->ranges, BEFORE * 2 * sizeof(float),
                                 (size_t)sample->count * sizeof *sample->ranges, sample->ranges) &&
                pel_buffer_write(bench->visible, 0, sizeof next, next) &&
                pel_buffer_write(bench->in, 0, sizeof cells, cells) &&
                pel_buffer_write(bench->out, 0, sizeof cells, cells));
    free(world);
}

static void run(struct bench *bench, struct pel_buffer *in, struct pel_buffer *out, int items,
                uint32_t pass, uint32_t empty) {
    struct pel_kernel *kernel = bench->kernel;
    bool good = pel_kernel_set_buffer(kernel, 0, bench->world) &&
                pel_kernel_set_buffer(kernel, 1, bench->ranges) &&
                pel_kernel_set_buffer(kernel, 2, bench->visible) &&
                pel_kernel_set_buffer(kernel, 3, in) && pel_kernel_set_buffer(kernel, 4, out) &&
                pel_kernel_set_u32(kernel, 5, 1) &&
                pel_kernel_set_u32(kernel, 6, (uint32_t)bench->sample->count) &&
                pel_kernel_set_u32(kernel, 7, 1) && pel_kernel_set_u32(kernel, 8, pass) &&
                pel_kernel_set_u32(kernel, 9, empty) &&
                pel_kernel_launch(kernel, (size_t)(items + GROUP - 1) / GROUP * GROUP, GROUP);
    if (!good)
        fail_msg("%s", pel_error_message());
}

// Expects `count` cells to hold what `truth` says, and those around the part's to be untouched.
static void expect(struct bench *bench, struct pel_buffer *buffer, int count,
                   int (*truth)(const struct sample *, int), const char *title) {
    const struct sample *sample = bench->sample;
    uint8_t cells[MOST];
    assert_true(pel_buffer_read(buffer, 0, sizeof cells, cells));
    for (int i = 0; i < MOST; i++) {
        bool own = i >= BEFORE && i < BEFORE + count;
        int expected = own ? truth(sample, i - BEFORE) : UNTOUCHED;
        if ((own || i < BEFORE || i >= BEFORE + sample->count) && cells[i] != expected)
            fail_msg("%s of %d x %d x %d cells: %d in place of %d at %d", title, sample->dims[0],
                     sample->dims[1], sample->dims[2], cells[i], expected, i - BEFORE);
    }
}

static int true_emptiness(const struct sample *sample, int i) {
    return !sample->seen[i];
}

// Of the i-th brick of 2^3 cells.
static int true_brick(const struct sample *sample, int i) {
    const int *dims = sample->dims;
    int columns = (dims[0] + 1) / 2, rows = (dims[1] + 1) / 2;
    int x = 2 * (i % columns), y = 2 * (i / columns % rows), z = 2 * (i / columns / rows);
    return box_seen(sample, (z * dims[1] + y) * dims[0] + x, 1);
}

static void check_sample(struct bench *bench, const struct sample *sample, int skip) {
    bench->sample = sample;
    const int *dims = sample->dims;
    int rows = dims[1] * dims[2], chunks = (sample->count + CELL_CHUNK - 1) / CELL_CHUNK;
    int bricks = ((dims[0] + 1) / 2) * ((dims[1] + 1) / 2) * ((dims[2] + 1) / 2);
    write_world(bench);
    if (skip != SKIP_DISTANCE) {
        run(bench, bench->out, bench->in, chunks, PASS_OCCUPY, 1);
        expect(bench, bench->in, sample->count, true_emptiness, "what is empty");
    }
    if (skip == SKIP_BVH) {
        run(bench, bench->in, bench->out, bricks, PASS_BRICK + 1, 0);
        expect(bench, bench->out, bricks, true_brick, "bricks");
    } else if (skip == SKIP_OCTREE) {
        for (int level = 1; level <= levels(sample); level++) {
            int size = 1 << level, half_rows = (dims[1] + size - 1) / size;
            run(bench, bench->in, bench->in, half_rows * ((dims[2] + size - 1) / size),
                PASS_MERGE + (uint32_t)level, 0);
        }
        run(bench, bench->in, bench->out, rows, PASS_NAME, 0);
        expect(bench, bench->out, sample->count, true_node, "nodes");
    } else {
        run(bench, bench->out, bench->in, chunks, PASS_OCCUPY, CELL_DISTANCE_MAX);
        run(bench, bench->in, bench->out, rows, PASS_ROW, 0);
        run(bench, bench->out, bench->in, rows, PASS_COLUMN, 0);
        run(bench, bench->in, bench->out, rows, PASS_SLICE, 0);
        expect(bench, bench->out, sample->count, true_distance, "distances");
    }
}

static void check(int lanes, int skip) {
    struct bench bench = {.device = pel_device_open(NULL, 0, &(struct pel_gl){0})};
    if (!bench.device)
        fail_msg("%s", pel_error_message());
    char definitions[PEL_VARIANT_BYTES];
    pel_variant_write(&(struct pel_variant){.lanes = lanes,
                                            .group_rows = 1,
                                            .reader = READER_BUFFER,
                                            .voxels = VOXELS_U8,
                                            .filters = FILTERS_LINEAR,
                                            .skip = skip,
                                            .capacity = 1,
                                            .table_linear = true},
                      definitions);
    bench.kernel = pel_kernel_build(bench.device, "render.cl", "occupancy", definitions);
    if (!bench.kernel)
        fail_msg("%s", pel_error_message());
    bench.world = pel_buffer_create(bench.device, world_bytes, "the scene");
    bench.ranges = pel_buffer_create(bench.device, MOST * 2 * sizeof(float), "ranges");
    bench.visible = pel_buffer_create(bench.device, (ENTRIES + 1) * sizeof(uint32_t), "entries");
    bench.in = pel_buffer_create(bench.device, MOST, "cells");
    bench.out = pel_buffer_create(bench.device, MOST, "cells");
    static const struct {
        int dims[3];
        double density;
    } cases[] = {{{1, 1, 1}, 0},  {{1, 1, 1}, 1},      {{3, 2, 5}, 0.1},    {{16, 3, 4}, 0.02},
                 {{17, 9, 5}, 0}, {{33, 6, 7}, 0.004}, {{80, 7, 5}, 0.0007}};
    static struct sample sample;
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        fill(&sample, cases[n].dims, cases[n].density, 7 + n);
        check_sample(&bench, &sample, skip);
    }
    pel_buffer_destroy(bench.world);
    pel_buffer_destroy(bench.ranges);
    pel_buffer_destroy(bench.visible);
    pel_buffer_destroy(bench.in);
    pel_buffer_destroy(bench.out);
    pel_kernel_destroy(bench.kernel);
    pel_device_close(bench.device);
}

static void test_one_lane(void **state) {
    (void)state;
    check(1, SKIP_DISTANCE);
    check(1, SKIP_OCTREE);
}

static void test_packets(void **state) {
    (void)state;
    int lanes = judge_packet_lanes() > 1 ? judge_packet_lanes() : 4;
    check(lanes, SKIP_DISTANCE);
    check(lanes, SKIP_BVH);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_one_lane),
                                       cmocka_unit_test(test_packets)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
