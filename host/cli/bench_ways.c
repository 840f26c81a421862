// bench_ways.c - the ways to skip empty space, and what `--skip` takes of them.
#include <string.h>

#include "cli/bench.h"
#include "cli/nearest.h"
#include "cli/options.h"
#include "cli/report.h"

// Grid and distance go by the same cells; apart, each has to derive them in a turn.
enum pel_skip bench_way(int n) {
    static const enum pel_skip order[BENCH_WAYS] = {
        PEL_SKIP_NONE, PEL_SKIP_GRID,   PEL_SKIP_OCTREE, PEL_SKIP_DISTANCE,
        PEL_SKIP_BVH,  PEL_SKIP_BLOCKS, PEL_SKIP_AUTO,
    };
    return order[n];
}

bool bench_read_skip(const char *text, unsigned *skips) {
    const char *names[BENCH_WAYS];
    bool all = strcmp(text, "all") == 0, found = all;
    for (int n = 0; n < BENCH_WAYS; n++) {
        names[n] = report_skip(bench_way(n));
        bool meant = all || strcmp(text, names[n]) == 0;
        found = found || meant;
        if (meant)
            *skips |= 1U << bench_way(n);
    }
    if (found)
        return true;
    const char *nearest = cli_nearest(text, names, BENCH_WAYS);
    cli_fail(
        PEL_ERROR_ARGUMENT,
        "--skip: '%s' is none of none, grid, distance, octree, bvh, blocks, auto and all%s%s%s",
        text, nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    return false;
}

void bench_set_skip(struct bench_case *one, enum pel_skip skip) {
    one->sets_skip = true;
    one->skip = skip;
    one->bricks = one->scene->render.bricks; // such as a pool that the user's scene asks for
    one->detail = BENCH_SKIPPING;
}

bool bench_wants_skip(const struct bench *bench, enum pel_skip skip, unsigned own) {
    unsigned wanted = bench->options.skips ? bench->options.skips : own;
    return wanted >> skip & 1;
}
