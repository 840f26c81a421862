// bench_sequential.c - the work of a kernel in plain C: one thread, one ray after the other.
//
// Table 6.1 of Romero 2009 compares his kernels with a sequential program, which did less: no
// interpolation, no transfer function, no opacity. This one does the same as the kernels, for one
// volume of 8-bit voxels: trilinear samples on the same places of each ray, colour and opacity from
// a table, front to back.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/report.h"

enum { ENTRIES = 256 };

struct sequential {
    const struct pel_volume *volume;
    double voxel_from_world[3][4];
    double eye[3], forward[3], right[3], up[3]; // the picture's plane is forward + u right + v up
    double step_mm, termination;
    float table[ENTRIES][4]; // straight colour, and the opacity of a step
    uint64_t samples;
};

static void cross(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale_to(double v[3], double length) {
    double factor = length / sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] *= factor;
}

static void place_camera(struct sequential *work, const struct pel_camera *camera, double aspect) {
    double half = tan(camera->fov_deg * 3.14159265358979323846 / 360);
    for (int i = 0; i < 3; i++) {
        work->eye[i] = camera->eye[i];
        work->forward[i] = camera->target[i] - camera->eye[i];
    }
    scale_to(work->forward, 1);
    cross(work->right, work->forward, camera->up);
    cross(work->up, work->right, work->forward);
    scale_to(work->right, half * aspect);
    scale_to(work->up, half);
}

// The inverse of the volume's placement, by its cofactors.
static void place_volume(struct sequential *work, const struct pel_matrix *world_from_voxel) {
    double columns[3][3], normals[3][3];
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 3; i++)
            columns[c][i] = world_from_voxel->m[i][c];
    for (int c = 0; c < 3; c++)
        cross(normals[c], columns[(c + 1) % 3], columns[(c + 2) % 3]);
    double determinant = dot(columns[0], normals[0]);
    const double origin[3] = {world_from_voxel->m[0][3], world_from_voxel->m[1][3],
                              world_from_voxel->m[2][3]};
    for (int r = 0; r < 3; r++) {
        for (int i = 0; i < 3; i++)
            work->voxel_from_world[r][i] = normals[r][i] / determinant;
        work->voxel_from_world[r][3] = -dot(normals[r], origin) / determinant;
    }
}

static void fill_table(struct sequential *work, const struct pel_instance *instance) {
    const struct pel_volume *volume = work->volume;
    double exponent = instance->density * work->step_mm / instance->transfer->opacity_unit_mm;
    for (int i = 0; i < ENTRIES; i++) {
        double rgba[4];
        pel_transfer_evaluate(instance->transfer, volume->slope * i + volume->intercept, rgba);
        rgba[3] = 1 - pow(1 - rgba[3], exponent);
        for (int c = 0; c < 4; c++)
            work->table[i][c] = (float)rgba[c];
    }
}

static float sample(const struct pel_volume *volume, const float p[3]) {
    size_t stride[3] = {1, (size_t)volume->dims[0],
                        (size_t)volume->dims[0] * (size_t)volume->dims[1]};
    const uint8_t *corner = volume->voxels;
    size_t next[3];
    float weight[3];
    for (int i = 0; i < 3; i++) {
        int cell = (int)p[i];
        weight[i] = p[i] - (float)cell;
        corner += stride[i] * (size_t)cell;
        next[i] = cell + 1 < volume->dims[i] ? stride[i] : 0;
    }
    float rows[4];
    for (int r = 0; r < 4; r++) {
        const uint8_t *row = corner + (r & 1 ? next[1] : 0) + (r & 2 ? next[2] : 0);
        rows[r] = (float)row[0] + weight[0] * (float)(row[next[0]] - row[0]);
    }
    float low = rows[0] + weight[1] * (rows[1] - rows[0]);
    float high = rows[2] + weight[1] * (rows[3] - rows[2]);
    return low + weight[2] * (high - low);
}

// Where the ray is between the outer voxel centres; false when nowhere.
static bool find_span(const struct sequential *work, const double origin[3], const double along[3],
                      double span[2]) {
    span[0] = 0;
    span[1] = INFINITY;
    for (int i = 0; i < 3; i++) {
        double low = -origin[i] / along[i];
        double high = (work->volume->dims[i] - 1 - origin[i]) / along[i];
        span[0] = fmax(span[0], fmin(low, high));
        span[1] = fmin(span[1], fmax(low, high));
    }
    return span[0] < span[1];
}

static void follow_ray(struct sequential *work, const double direction[3], float light[4]) {
    double origin[3], along[3], span[2];
    for (int i = 0; i < 3; i++) {
        origin[i] = dot(work->voxel_from_world[i], work->eye) + work->voxel_from_world[i][3];
        along[i] = dot(work->voxel_from_world[i], direction);
    }
    memset(light, 0, 4 * sizeof *light);
    if (!find_span(work, origin, along, span))
        return;
    for (double t = span[0] + work->step_mm / 2; t < span[1]; t += work->step_mm) {
        float p[3];
        for (int i = 0; i < 3; i++)
            p[i] = (float)fmin(fmax(origin[i] + t * along[i], 0), work->volume->dims[i] - 1);
        const float *entry = work->table[(int)(sample(work->volume, p) + 0.5F)];
        work->samples++;
        float weight = (1 - light[3]) * entry[3];
        for (int c = 0; c < 3; c++)
            light[c] += weight * entry[c];
        light[3] += weight;
        if (light[3] > work->termination)
            return;
    }
}

bool bench_sequential_run(const struct bench_case *one, double *ms, uint64_t *samples) {
    const struct pel_scene *scene = one->scene;
    struct sequential work = {.volume = scene->volumes[0]};
    float *picture = calloc((size_t)one->width * (size_t)one->height, 4 * sizeof *picture);
    if (!picture) {
        cli_fail(PEL_ERROR_MEMORY, "cannot allocate a picture of %d x %d", one->width, one->height);
        return false;
    }
    double spacing_mm[3], begin_ms = pel_clock_ms();
    pel_volume_spacing(work.volume, spacing_mm);
    work.step_mm = scene->render.step * fmin(spacing_mm[0], fmin(spacing_mm[1], spacing_mm[2]));
    work.termination = scene->render.termination < 1 ? scene->render.termination : 2;
    place_camera(&work, &scene->camera, (double)one->width / one->height);
    place_volume(&work, &work.volume->world_from_voxel);
    fill_table(&work, &scene->instances[0]);
    for (int y = 0; y < one->height; y++)
        for (int x = 0; x < one->width; x++) {
            double u = (x + 0.5) * 2 / one->width - 1, v = 1 - (y + 0.5) * 2 / one->height;
            double direction[3];
            for (int i = 0; i < 3; i++)
                direction[i] = work.forward[i] + u * work.right[i] + v * work.up[i];
            scale_to(direction, 1);
            follow_ray(&work, direction,
                       &picture[4 * ((size_t)y * (size_t)one->width + (size_t)x)]);
        }
    *ms = pel_clock_ms() - begin_ms;
    *samples = work.samples;
    free(picture);
    return true;
}
