// blocks.c - two-level sparse blocks over the sub-blocks of a part (Derin et al. 2021, sections
// 2.1 to 2.3).
//
// All blocks are visited once to count what is stored, and once to store it. A grid with the number
// of each block then tells every block which lie beside it, and is thrown away: on the device only
// those are kept that are there.
#include "accel/blocks.h"

#include <stdlib.h>
#include <string.h>

#include "accel/bvh.h"
#include "base/error.h"
#include "base/memory.h"

struct build {
    struct pel_blocks *blocks;
    const uint8_t *bins;
    size_t dims[3];      // sub-blocks
    size_t all[3];       // blocks, stored or not
    int32_t *numbers;    // owned; of each of these: its number, or -1
    struct pel_box *box; // owned; of each stored one, in voxels
};

// Calls that follow want the same order: sub-blocks of one block, x fastest.
struct extent {
    size_t low[3], high[3];
};

static struct extent block_extent(const struct build *build, size_t index) {
    size_t at[3] = {index % build->all[0], index / build->all[0] % build->all[1],
                    index / build->all[0] / build->all[1]};
    struct extent extent;
    for (int c = 0; c < 3; c++) {
        extent.low[c] = at[c] * BLOCK_SIDE;
        size_t high = extent.low[c] + BLOCK_SIDE;
        extent.high[c] = high < build->dims[c] ? high : build->dims[c];
    }
    return extent;
}

static size_t sub_block_at(const struct build *build, size_t x, size_t y, size_t z) {
    return (z * build->dims[1] + y) * build->dims[0] + x;
}

static size_t count_stored(const struct build *build, const struct extent *extent) {
    size_t count = 0;
    for (size_t z = extent->low[2]; z < extent->high[2]; z++)
        for (size_t y = extent->low[1]; y < extent->high[1]; y++)
            for (size_t x = extent->low[0]; x < extent->high[0]; x++)
                count += build->bins[sub_block_at(build, x, y, z)] != 0;
    return count;
}

// Numbers the blocks in which something is stored. The caller owns the numbers.
static int32_t *number_blocks(struct build *build) {
    struct pel_blocks *blocks = build->blocks;
    size_t count = 1;
    for (int c = 0; c < 3; c++) {
        build->all[c] = (build->dims[c] + BLOCK_SIDE - 1) / BLOCK_SIDE;
        if (build->all[c] > (size_t)1 << BLOCK_PLACE_BITS) {
            pel_fail(PEL_ERROR_ARGUMENT, "%zu blocks along an axis, at most %d", build->all[c],
                     1 << BLOCK_PLACE_BITS);
            return NULL;
        }
        count *= build->all[c];
    }
    int32_t *numbers = pel_allocate(count, sizeof *numbers);
    for (size_t i = 0; numbers && i < count; i++) {
        struct extent extent = block_extent(build, i);
        size_t stored = count_stored(build, &extent);
        numbers[i] = stored > 0 ? (int32_t)blocks->count++ : -1;
        blocks->stored += stored;
    }
    return numbers;
}

// Writes one block and what is stored of it, from sub-block `first` on; returns how many are.
static size_t store(struct build *build, struct block *block, const struct extent *extent,
                    size_t first) {
    uint8_t numbers[BLOCK_PLACES];
    memset(numbers, BLOCK_ABSENT, sizeof numbers);
    size_t count = 0;
    for (size_t z = extent->low[2]; z < extent->high[2]; z++)
        for (size_t y = extent->low[1]; y < extent->high[1]; y++)
            for (size_t x = extent->low[0]; x < extent->high[0]; x++) {
                size_t from = sub_block_at(build, x, y, z);
                if (build->bins[from] == 0)
                    continue;
                size_t inside =
                    ((z - extent->low[2]) * BLOCK_SIDE + (y - extent->low[1])) * BLOCK_SIDE +
                    (x - extent->low[0]);
                build->blocks->places[first + count] = (uint32_t)from;
                build->blocks->bins[first + count] = build->bins[from];
                block->bins |= build->bins[from];
                numbers[inside] = (uint8_t)count++;
            }
    block->first = (u32)first;
    memcpy(block->numbers, numbers, sizeof numbers);
    return count;
}

static void fill_blocks(struct build *build, int side) {
    size_t next = 0, count = build->all[0] * build->all[1] * build->all[2];
    for (size_t i = 0; i < count; i++) {
        if (build->numbers[i] < 0)
            continue;
        struct extent extent = block_extent(build, i);
        struct block *block = &build->blocks->list[build->numbers[i]];
        struct pel_box *box = &build->box[build->numbers[i]];
        for (int c = 0; c < 3; c++) {
            block->place |= (u32)(extent.low[c] / BLOCK_SIDE) << c * BLOCK_PLACE_BITS;
            box->low[c] = (float)(extent.low[c] * (size_t)side);
            box->high[c] = (float)(extent.high[c] * (size_t)side);
        }
        next += store(build, block, &extent, next);
    }
}

// Tells each block which ones lie around it.
static void join_blocks(struct build *build, bool walk) {
    for (size_t b = 0; b < build->blocks->count; b++) {
        struct block *block = &build->blocks->list[b];
        for (int n = 0; n < 27; n++) {
            size_t index = 0, low = (1 << BLOCK_PLACE_BITS) - 1;
            bool there = walk || n == 13;
            int offset[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            for (int c = 2; c >= 0; c--) {
                // Before the first one, this wraps round to more than there are.
                size_t at = (block->place >> c * BLOCK_PLACE_BITS & low) + (size_t)offset[c];
                there = there && at < build->all[c];
                index = index * build->all[c] + at;
            }
            block->beside[n] = there ? build->numbers[index] : -1;
        }
    }
}

// A node's bins are those below it. Children follow their parents, so the last node comes first.
static void mark_nodes(const struct pel_blocks *blocks) {
    for (size_t n = 2 * blocks->count - 1; n-- > 0;) {
        struct bvh_node *node = &blocks->nodes[n];
        u32 bins = node->link < 0 ? blocks->list[-1 - node->link].bins
                                  : (u32)(node[1].axis >> BLOCK_AXIS_BITS |
                                          blocks->nodes[node->link].axis >> BLOCK_AXIS_BITS);
        node->axis |= (i32)(bins << BLOCK_AXIS_BITS);
    }
}

bool pel_blocks_build(struct pel_blocks *blocks, const uint8_t *bins, const size_t dims[3],
                      int side, bool walk) {
    *blocks = (struct pel_blocks){.count = 0};
    struct build build = {.blocks = blocks, .bins = bins, .dims = {dims[0], dims[1], dims[2]}};
    build.numbers = number_blocks(&build);
    bool good = build.numbers != NULL;
    if (good && blocks->count > 0) {
        blocks->list = pel_allocate(blocks->count, sizeof *blocks->list);
        blocks->nodes = pel_allocate(2 * blocks->count - 1, sizeof *blocks->nodes);
        blocks->places = pel_allocate(blocks->stored, sizeof *blocks->places);
        blocks->bins = pel_allocate(blocks->stored, 1);
        build.box = pel_allocate(blocks->count, sizeof *build.box);
        good = blocks->list && blocks->nodes && blocks->places && blocks->bins && build.box;
        if (good) {
            fill_blocks(&build, side);
            join_blocks(&build, walk);
            good = pel_bvh_build(blocks->nodes, build.box, blocks->count);
        }
        if (good)
            mark_nodes(blocks);
    }
    free(build.numbers);
    free(build.box);
    if (!good)
        pel_blocks_finish(blocks);
    return good;
}

void pel_blocks_finish(struct pel_blocks *blocks) {
    free(blocks->list);
    free(blocks->nodes);
    free(blocks->places);
    free(blocks->bins);
    *blocks = (struct pel_blocks){.count = 0};
}
