// ways.c - the ways to skip empty space.
#include "support/ways.h"

const struct way ways[] = {
    {"none", PEL_SKIP_NONE},     {"grid", PEL_SKIP_GRID}, {"distance", PEL_SKIP_DISTANCE},
    {"octree", PEL_SKIP_OCTREE}, {"bvh", PEL_SKIP_BVH},   {"blocks", PEL_SKIP_BLOCKS},
    {NULL, PEL_SKIP_AUTO},
};

_Static_assert(sizeof ways / sizeof *ways == WAYS + 1, "all ways are counted");

enum pel_skip way_of(uint64_t n) {
    return ways[n % WAYS].skip;
}
