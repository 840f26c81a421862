// brick_report.c - how the bricks of a volume cluster, for every size of bricks.
//
// Only the smallest bricks are measured voxel by voxel; eight of them make one of the next size. A
// brick is active when its range of values reaches an entry of the table with some opacity.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "camera/camera.h"
#include "transfer/table.h"
#include "world/bricks.h"
#include "world/layout.h"
#include "world/pack.h"
#include "world/world.h"

enum { SMALLEST = 8, RAYS = 64 };

// The ranges of the smallest bricks, as they would be stored, border included.
static bool measure_volume(struct pel_grid *grid, const struct pel_volume *volume) {
    size_t dims[3], bytes;
    for (int c = 0; c < 3; c++)
        dims[c] = (size_t)volume->dims[c] + 2;
    int class_index = pel_voxel_class(volume->type);
    if (!pel_size_multiply(&bytes, 3,
                           (size_t[]){dims[0], dims[1], pel_voxel_class_bytes(class_index)}) ||
        !pel_grid_init(grid, dims, SMALLEST, 0))
        return false;
    void *slice = pel_allocate_voxels(bytes);
    for (size_t z = 0; slice && z < dims[2]; z++) {
        pel_pack_slice(volume, (int)z - 1, slice);
        pel_grid_add_slice(grid, z, slice, class_index, 1);
    }
    free(slice);
    if (!slice)
        pel_grid_finish(grid);
    return slice != NULL;
}

// Joins eight bricks to one, in place: it never writes beyond what it has read.
static void double_bricks(struct pel_grid *grid) {
    size_t cells[3] = {(grid->cells[0] + 1) / 2, (grid->cells[1] + 1) / 2,
                       (grid->cells[2] + 1) / 2};
    for (size_t i = 0; i < cells[0] * cells[1] * cells[2]; i++) {
        size_t first[3] = {i % cells[0] * 2, i / cells[0] % cells[1] * 2,
                           i / cells[0] / cells[1] * 2};
        float low = INFINITY, high = -INFINITY;
        for (int child = 0; child < 8; child++) {
            size_t x = first[0] + (child & 1), y = first[1] + (child >> 1 & 1),
                   z = first[2] + (child >> 2);
            if (x >= grid->cells[0] || y >= grid->cells[1] || z >= grid->cells[2])
                continue;
            const float *range = grid->range[(z * grid->cells[1] + y) * grid->cells[0] + x];
            low = fminf(low, range[0]);
            high = fmaxf(high, range[1]);
        }
        grid->range[i][0] = low;
        grid->range[i][1] = high;
    }
    memcpy(grid->cells, cells, sizeof cells);
    grid->side *= 2;
}

// The number of entries with some opacity before each one, and before the end.
static uint32_t *count_visible(const struct pel_table *table) {
    uint32_t *counts = pel_allocate((size_t)table->entry_count + 1, sizeof *counts);
    for (int j = 0; counts && j < table->entry_count; j++)
        counts[j + 1] = counts[j] + (table->rgba[j][3] > 0);
    return counts;
}

// What is seen of the instance's bricks.
static void find_active(uint8_t *active, const struct pel_grid *grid, const struct pel_scene *scene,
                        int instance, const struct pel_table *table, const uint32_t *counts) {
    double last = table->entry_count - 1, scale = last / (table->high - table->low);
    for (size_t i = 0; i < grid->cells[0] * grid->cells[1] * grid->cells[2]; i++) {
        const float *range = grid->range[i];
        if (range[0] > range[1]) {
            active[i] = 0;
            continue;
        }
        double a = pel_world_value(scene, instance, PEL_READER_BUFFER, range[0]),
               b = pel_world_value(scene, instance, PEL_READER_BUFFER, range[1]);
        double low = fmin(fmax((fmin(a, b) - table->low) * scale, 0), last);
        double high = fmin(fmax((fmax(a, b) - table->low) * scale, 0), last);
        active[i] = counts[(int)ceil(high) + 1] > counts[(int)low];
    }
}

// ---- Rays --------------------------------------------------------------------------------------

struct ray {
    double origin[3], direction[3]; // in voxels of the stored volume
};

static bool meets(const struct bvh_node *node, const struct ray *ray) {
    double near = 0, far = INFINITY;
    for (int c = 0; c < 3; c++) {
        double inverse = 1 / (fabs(ray->direction[c]) < 1e-20 ? 1e-20 : ray->direction[c]);
        double a = ((double)node->low[c] - ray->origin[c]) * inverse,
               b = ((double)node->high[c] - ray->origin[c]) * inverse;
        near = fmax(near, fmin(a, b));
        far = fmin(far, fmax(a, b));
    }
    return near < far;
}

static int count_boxes(const struct bvh_node *nodes, const struct ray *ray) {
    i32 stack[BVH_DEPTH_MAX + 2];
    int depth = 0, count = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        i32 n = stack[--depth];
        if (!meets(&nodes[n], ray))
            continue;
        if (nodes[n].link < 0) {
            count++;
        } else {
            stack[depth++] = nodes[n].link;
            stack[depth++] = n + 1;
        }
    }
    return count;
}

// The mean number of clusters on the rays that cross any; 0 when none does.
static bool mean_depth(double *mean, const struct pel_scene *scene, int instance,
                       const struct bvh_node *nodes) {
    const struct pel_camera *camera = &scene->camera;
    const struct pel_instance *shown = &scene->instances[instance];
    struct pel_matrix world_from_voxel = pel_matrix_multiply(
                          &shown->transform, &scene->volumes[shown->volume]->world_from_voxel),
                      voxel_from_world;
    double forward[3], right[3], up[3];
    if (!pel_camera_basis(camera, forward, right, up) ||
        !pel_matrix_invert(&voxel_from_world, &world_from_voxel))
        return false;
    double half =
        camera->orthographic ? camera->height_mm / 2 : tan(camera->fov_deg * PEL_PI / 360);
    double aspect = (double)scene->render.width / scene->render.height;
    double sum = 0;
    int hits = 0;
    for (int i = 0; i < RAYS * RAYS; i++) {
        double u = ((i % RAYS * 2 + 1.0) / RAYS - 1) * aspect + 2 * camera->shift[0],
               v = 1 - (i / RAYS * 2 + 1.0) / RAYS + 2 * camera->shift[1];
        double origin[3], direction[3];
        for (int c = 0; c < 3; c++) {
            double window = half * (u * right[c] + v * up[c]);
            origin[c] = camera->eye[c] + (camera->orthographic ? window : 0);
            direction[c] = forward[c] + (camera->orthographic ? 0 : window);
        }
        struct ray ray;
        pel_matrix_point(ray.origin, &voxel_from_world, origin);
        pel_matrix_direction(ray.direction, &voxel_from_world, direction);
        for (int c = 0; c < 3; c++)
            ray.origin[c] += 1; // of the border
        int count = count_boxes(nodes, &ray);
        sum += count;
        hits += count > 0;
    }
    *mean = hits > 0 ? sum / hits : 0;
    return true;
}

// ---- One size of bricks ------------------------------------------------------------------------

// Clusters active bricks and looks at them. `bricks` takes the numbers, unless it is NULL.
static bool look(double *depth, struct pel_brick_statistics *bricks, const struct pel_scene *scene,
                 int instance, const struct pel_grid *grid, const uint8_t *active,
                 uint32_t largest) {
    struct pel_clusters clusters;
    double start = pel_clock_ms();
    *depth = 0;
    if (!pel_clusters_find(&clusters, active, grid->cells, largest))
        return false;
    double clustered = pel_clock_ms();
    bool good = true;
    if (clusters.count > 0) {
        struct bvh_node *nodes = pel_allocate(2 * clusters.count - 1, sizeof *nodes);
        good = nodes && pel_bricks_build(nodes, &clusters, (int)grid->side);
        if (bricks)
            bricks->tree_ms = pel_clock_ms() - clustered;
        good = good && mean_depth(depth, scene, instance, nodes);
        free(nodes);
    }
    if (bricks) {
        bricks->clusters = clusters.count;
        bricks->cluster_ms = clustered - start;
    }
    pel_clusters_finish(&clusters);
    return good;
}

bool pel_scene_measure_bricks(const struct pel_scene *scene, int instance,
                              struct pel_brick_report reports[PEL_BRICK_SIZES]) {
    if (instance < 0 || instance >= scene->instance_count)
        return pel_fail(PEL_ERROR_ARGUMENT, "volume %d of %d", instance, scene->instance_count);
    const struct pel_instance *shown = &scene->instances[instance];
    const struct pel_volume *volume = scene->volumes[shown->volume];
    if (!volume->voxels)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "volume '%s' is a hypertexture, of whose bricks nobody knows before it is "
                        "baked",
                        shown->name);
    struct pel_table table = {0};
    struct pel_grid grid = {.range = NULL};
    uint8_t *active = NULL;
    uint32_t *counts = NULL;
    bool good = pel_table_build(&table, shown->transfer, volume) &&
                (counts = count_visible(&table)) != NULL && measure_volume(&grid, volume) &&
                (active = pel_allocate(grid.cells[0] * grid.cells[1] * grid.cells[2], 1)) != NULL;
    for (int size = 0; good && size < PEL_BRICK_SIZES; size++) {
        struct pel_brick_report *report = &reports[size];
        if (size > 0)
            double_bricks(&grid);
        size_t total = grid.cells[0] * grid.cells[1] * grid.cells[2];
        *report = (struct pel_brick_report){.bricks = {.size = (int)grid.side, .total = total}};
        double start = pel_clock_ms();
        find_active(active, &grid, scene, instance, &table, counts);
        report->bricks.activity_ms = pel_clock_ms() - start;
        for (size_t i = 0; i < total; i++)
            report->bricks.active += active[i];
        good = look(&report->depth, &report->bricks, scene, instance, &grid, active,
                    PEL_CLUSTER_LARGEST) &&
               look(&report->depth_apart, NULL, scene, instance, &grid, active, 1);
    }
    pel_grid_finish(&grid);
    pel_table_finish(&table);
    free(active);
    free(counts);
    return good || pel_fail_in("volume '%s'", shown->name);
}
