// frame.c - how a volume lies in the body, in words: every voxel axis gets the letter of the world
// axis it is closest to, each world axis being used once.
#include "cli/frame.h"

#include <math.h>
#include <string.h>

// cosines[axis][w]: between voxel axis and world axis. Returns which world axis each voxel axis is
// named after: of the six ways to pair them the one with the largest sum of |cosine|.
static const int *pair_axes(double cosines[3][3]) {
    static const int ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                   {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    int best = 0;
    double best_sum = -1;
    for (int way = 0; way < 6; way++) {
        double sum = 0;
        for (int axis = 0; axis < 3; axis++)
            sum += fabs(cosines[axis][ways[way][axis]]);
        // A tie, at exactly 45 degrees, goes to the way that comes first, whatever the rounding.
        if (sum > best_sum + 1e-9) {
            best_sum = sum;
            best = way;
        }
    }
    return ways[best];
}

void frame_describe(struct frame *frame, const struct pel_volume *volume) {
    static const char letters[3][2] = {{'L', 'R'}, {'P', 'A'}, {'I', 'S'}};
    memset(frame, 0, sizeof *frame);
    double spacing_mm[3], cosines[3][3];
    pel_volume_spacing(volume, spacing_mm);
    for (int axis = 0; axis < 3; axis++) {
        frame->origin[axis] = volume->world_from_voxel.m[axis][3];
        frame->size_mm[axis] = volume->dims[axis] * spacing_mm[axis];
        for (int w = 0; w < 3; w++)
            cosines[axis][w] = volume->world_from_voxel.m[w][axis] / spacing_mm[axis];
    }
    const int *world = pair_axes(cosines);
    for (int axis = 0; axis < 3; axis++) {
        double cosine = cosines[axis][world[axis]];
        frame->axes[axis] = letters[world[axis]][cosine > 0];
        double angle_deg = acos(fmin(1, fabs(cosine))) * 57.29577951308232;
        // Below this it is the rounding of a float in the header.
        if (angle_deg > 0.001)
            frame->oblique_deg = fmax(frame->oblique_deg, angle_deg);
    }
}
