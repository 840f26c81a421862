// cluster.c - greedy clustering of bricks (Ganter & Manzke 2019, section 4 and algorithm 1).
//
// From the largest cube down to one brick, every place is tried in turn. A cube is taken when all
// its bricks are active, which a summed-area table in three dimensions (Crow 1984) tells from eight
// of its entries, and none is in a cluster already. For that its corners are enough: a cluster that
// is there is no smaller, so one that overlaps the cube holds one of its corners.
#include "accel/cluster.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

struct search {
    size_t dims[3];
    size_t row, slice;         // of bricks
    size_t sum_row, sum_slice; // of the table
    uint8_t *taken;            // owned; bricks in a cluster, and those that are not active
    uint32_t *sums; // owned; active bricks before (x, y, z), with a border of zeros before
    struct pel_clusters *clusters;
    size_t capacity;
};

static void fill_sums(struct search *search, const uint8_t *active) {
    uint32_t *sums = search->sums;
    for (size_t z = 0; z < search->dims[2]; z++)
        for (size_t y = 0; y < search->dims[1]; y++) {
            const uint8_t *bricks = active + z * search->slice + y * search->row;
            size_t before = z * search->sum_slice + y * search->sum_row;
            uint32_t *out = sums + before + search->sum_slice + search->sum_row + 1;
            const uint32_t *below = out - search->sum_row, *behind = out - search->sum_slice;
            const uint32_t *both = sums + before + 1;
            uint32_t in_row = 0;
            for (size_t x = 0; x < search->dims[0]; x++) {
                in_row += bricks[x] != 0;
                out[x] = in_row + below[x] + behind[x] - both[x];
            }
        }
}

// The number of active bricks in the cube of `size` bricks whose first one is at `sums`.
static uint32_t sum_cube(const struct search *search, const uint32_t *sums, size_t size) {
    size_t y = size * search->sum_row, z = size * search->sum_slice;
    return sums[size + y + z] - sums[y + z] - sums[size + z] - sums[size + y] + sums[size] +
           sums[y] + sums[z] - sums[0];
}

static bool corners_free(const struct search *search, const uint8_t *taken, size_t size) {
    size_t x = size - 1, y = x * search->row, z = x * search->slice;
    return !(taken[0] | taken[x] | taken[y] | taken[x + y] | taken[z] | taken[x + z] |
             taken[y + z] | taken[x + y + z]);
}

static bool take(struct search *search, const size_t low[3], size_t size) {
    struct pel_clusters *clusters = search->clusters;
    if (clusters->count == search->capacity) {
        size_t capacity = 2 * search->capacity + 64;
        struct pel_cluster *list = realloc(clusters->list, capacity * sizeof *list);
        if (!list)
            return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu clusters", capacity);
        clusters->list = list;
        search->capacity = capacity;
    }
    clusters->list[clusters->count++] = (struct pel_cluster){
        {(uint32_t)low[0], (uint32_t)low[1], (uint32_t)low[2]}, (uint32_t)size};
    for (size_t z = low[2]; z < low[2] + size; z++)
        for (size_t y = low[1]; y < low[1] + size; y++)
            memset(search->taken + z * search->slice + y * search->row + low[0], 1, size);
    return true;
}

// Takes every cube of one size that can be.
static bool take_cubes(struct search *search, size_t size) {
    size_t volume = size * size * size, low[3];
    for (low[2] = 0; low[2] + size <= search->dims[2]; low[2]++)
        for (low[1] = 0; low[1] + size <= search->dims[1]; low[1]++) {
            const uint8_t *taken = search->taken + low[2] * search->slice + low[1] * search->row;
            const uint32_t *sums =
                search->sums + low[2] * search->sum_slice + low[1] * search->sum_row;
            for (low[0] = 0; low[0] + size <= search->dims[0]; low[0]++)
                if (!taken[low[0]] && corners_free(search, taken + low[0], size) &&
                    sum_cube(search, sums + low[0], size) == volume && !take(search, low, size))
                    return false;
        }
    return true;
}

bool pel_clusters_find(struct pel_clusters *clusters, const uint8_t *active, const size_t dims[3],
                       uint32_t largest) {
    *clusters = (struct pel_clusters){NULL, 0};
    struct search search = {.dims = {dims[0], dims[1], dims[2]},
                            .row = dims[0],
                            .slice = dims[0] * dims[1],
                            .sum_row = dims[0] + 1,
                            .sum_slice = (dims[0] + 1) * (dims[1] + 1),
                            .clusters = clusters};
    size_t count = search.slice * dims[2];
    search.taken = pel_allocate(count, 1);
    search.sums = pel_allocate(search.sum_slice * (dims[2] + 1), sizeof *search.sums);
    bool good = search.taken && search.sums;
    if (good) {
        for (size_t i = 0; i < count; i++)
            search.taken[i] = !active[i];
        fill_sums(&search, active);
    }
    for (size_t size = largest; good && size > 0; size--)
        good = take_cubes(&search, size);
    free(search.taken);
    free(search.sums);
    if (!good)
        pel_clusters_finish(clusters);
    return good;
}

void pel_clusters_finish(struct pel_clusters *clusters) {
    free(clusters->list);
    *clusters = (struct pel_clusters){NULL, 0};
}
