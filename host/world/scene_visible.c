// scene_visible.c - where in its box a volume has something to show.
//
// Scans hold more air than patient, and a box around a head has empty corners. So each slice gets
// the least octagon around its visible voxels: their extents along i, j and the two diagonals, for
// which only the first and the last visible voxel of each row must be known. The octagons' corners
// span a hull that a camera can be fitted to.
#include "world/scene.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"

// Fainter than this, per opacity unit, is no reason to move the camera away.
static const double faintest = 0.05;

enum { CORNERS = 8 };

// Extents of a slice's visible voxels along i, j, i + j and i - j.
enum { ALONG_I, ALONG_J, ALONG_SUM, ALONG_DIFFERENCE, EXTENTS };

struct octagon {
    int low[EXTENTS], high[EXTENTS];
};

static bool is_visible(const struct pel_volume *volume, const struct pel_transfer *transfer, int i,
                       int j, int k) {
    double rgba[4], value = pel_volume_value(volume, i, j, k);
    if (isnan(value))
        return false;
    pel_transfer_evaluate(transfer, value, rgba);
    return rgba[3] > faintest;
}

static void include(struct octagon *octagon, int i, int j) {
    const int at[EXTENTS] = {i, j, i + j, i - j};
    for (int e = 0; e < EXTENTS; e++) {
        octagon->low[e] = at[e] < octagon->low[e] ? at[e] : octagon->low[e];
        octagon->high[e] = at[e] > octagon->high[e] ? at[e] : octagon->high[e];
    }
}

// False where slice k shows nothing.
static bool find_octagon(struct octagon *octagon, const struct pel_volume *volume,
                         const struct pel_transfer *transfer, int k) {
    for (int e = 0; e < EXTENTS; e++)
        octagon->low[e] = INT_MAX, octagon->high[e] = INT_MIN;
    for (int j = 0; j < volume->dims[1]; j++) {
        int first = 0, last = volume->dims[0] - 1;
        while (first <= last && !is_visible(volume, transfer, first, j, k))
            first++;
        if (first > last)
            continue;
        while (!is_visible(volume, transfer, last, j, k))
            last--;
        include(octagon, first, j);
        include(octagon, last, j);
    }
    return octagon->low[ALONG_I] <= octagon->high[ALONG_I];
}

// Where the lines i = `low` and i = `high` enter and leave the octagon, and likewise for j.
static void find_corners(const struct octagon *o, double corners[CORNERS][2]) {
    for (int c = 0; c < CORNERS; c++) {
        bool far = c & 1, upper = c & 2, along_j = c & 4;
        int edge = along_j ? ALONG_J : ALONG_I, other = along_j ? ALONG_I : ALONG_J;
        double at = far ? o->high[edge] : o->low[edge];
        // i - j bounds j from the other side than it bounds i.
        double most = along_j ? at + o->high[ALONG_DIFFERENCE] : at - o->low[ALONG_DIFFERENCE];
        double least = along_j ? at + o->low[ALONG_DIFFERENCE] : at - o->high[ALONG_DIFFERENCE];
        most = fmin(fmin(o->high[other], o->high[ALONG_SUM] - at), most);
        least = fmax(fmax(o->low[other], o->low[ALONG_SUM] - at), least);
        corners[c][edge] = at;
        corners[c][other] = upper ? most : least;
    }
}

static bool reserve(struct pel_points *points, size_t more) {
    double(*at)[3] = realloc(points->at, (points->count + more) * sizeof *at);
    if (!at)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu points", points->count + more);
    points->at = at;
    return true;
}

static bool add_box(const struct pel_scene *scene, int instance, struct pel_points *points) {
    struct pel_bounds bounds;
    pel_instance_bounds(scene, instance, &bounds);
    if (!reserve(points, CORNERS))
        return false;
    for (int corner = 0; corner < CORNERS; corner++, points->count++)
        for (int axis = 0; axis < 3; axis++)
            points->at[points->count][axis] =
                corner >> axis & 1 ? bounds.high[axis] : bounds.low[axis];
    return true;
}

bool pel_instance_visible_hull(const struct pel_scene *scene, int instance,
                               struct pel_points *points) {
    const struct pel_instance *shown = &scene->instances[instance];
    const struct pel_volume *volume = scene->volumes[shown->volume];
    if (!volume->voxels || !shown->transfer)
        return add_box(scene, instance, points);
    struct pel_matrix world_from_voxel =
        pel_matrix_multiply(&shown->transform, &volume->world_from_voxel);
    size_t before = points->count;
    for (int k = 0; k < volume->dims[2]; k++) {
        struct octagon octagon;
        double corners[CORNERS][2];
        if (!find_octagon(&octagon, volume, shown->transfer, k))
            continue;
        if (!reserve(points, CORNERS))
            return false;
        find_corners(&octagon, corners);
        for (int c = 0; c < CORNERS; c++) {
            const double voxel[3] = {corners[c][0], corners[c][1], k};
            pel_matrix_point(points->at[points->count++], &world_from_voxel, voxel);
        }
    }
    return points->count > before || add_box(scene, instance, points);
}
