// probe.c - one ray that tells what it meets.
//
// The kernel writes what the ray loop sees: numbers of parts, places in memory, raw values. Here
// they become what people speak of: volumes, millimetres, values in the file's own unit.
#include "render/probe.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "shared/probe.h"
#include "world/model.h"

static_assert(PEL_PROBE_SAMPLE_MAX == PROBE_SAMPLE_MAX, "there is room for all samples");

// What the kernel wrote.
struct record {
    struct probe ray;
    struct probe_sample *samples; // owned
    int sample_count;
};

// ---- Spans -------------------------------------------------------------------------------------

static double part_mm(const struct probe_part *part, int sample) {
    return part->first_mm + (double)sample * part->step_mm;
}

// Where, behind `from`, the next part begins or ends; INFINITY behind the last.
static double next_change(const struct probe *ray, double from) {
    double next = INFINITY;
    for (int p = 0; p < ray->part_count; p++) {
        const double ends[2] = {part_mm(&ray->parts[p], ray->parts[p].first),
                                part_mm(&ray->parts[p], ray->parts[p].end)};
        for (int e = 0; e < 2; e++)
            if (ends[e] > from)
                next = fmin(next, ends[e]);
    }
    return next;
}

// Cuts the ray where a part begins or ends. A part adds at most two cuts.
static bool find_spans(struct pel_probe *probe, const struct probe *ray,
                       const struct pel_world *world) {
    probe->spans = pel_allocate(2 * WORLD_PART_MAX, sizeof *probe->spans);
    if (!probe->spans)
        return false;
    double from = next_change(ray, -INFINITY);
    while (isfinite(from)) {
        double to = next_change(ray, from);
        uint32_t instances = 0;
        for (int p = 0; p < ray->part_count; p++) {
            const struct probe_part *part = &ray->parts[p];
            if (part_mm(part, part->first) <= from && from < part_mm(part, part->end))
                instances |= UINT32_C(1) << world->instances[part->part];
        }
        if (instances)
            probe->spans[probe->span_count++] = (struct pel_probe_span){from, to, instances};
        from = to;
    }
    return true;
}

// The ray through the centre of pixel (x, y), as camera_ray in kernels/ray.cl has it.
static void find_ray(struct pel_probe *probe, const struct pel_world *world, int x, int y) {
    const struct camera *camera = &world->bytes.camera;
    double u = (x + 0.5) * 2 / world->bytes.whole_width - 1,
           v = 1 - (y + 0.5) * 2 / world->bytes.whole_height;
    const double origin[3] = {camera->eye.x + u * camera->eye_right.x + v * camera->eye_up.x,
                              camera->eye.y + u * camera->eye_right.y + v * camera->eye_up.y,
                              camera->eye.z + u * camera->eye_right.z + v * camera->eye_up.z};
    const double direction[3] = {camera->forward.x + u * camera->right.x + v * camera->up.x,
                                 camera->forward.y + u * camera->right.y + v * camera->up.y,
                                 camera->forward.z + u * camera->right.z + v * camera->up.z};
    double length = sqrt(pow(direction[0], 2) + pow(direction[1], 2) + pow(direction[2], 2));
    for (int i = 0; i < 3; i++) {
        probe->origin[i] = origin[i] + world->centre[i];
        probe->direction[i] = direction[i] / length;
    }
}

// ---- Samples -----------------------------------------------------------------------------------

static void read_sample(struct pel_probe_sample *out, const struct probe_sample *sample,
                        const struct pel_probe_inputs *inputs, const double origin[3]) {
    const struct pel_world *world = inputs->world;
    const struct part *part = &world->bytes.parts[sample->part];
    int instance = world->instances[sample->part];
    const struct pel_volume *volume =
        inputs->scene->volumes[inputs->scene->instances[instance].volume];
    struct pel_matrix world_from_voxel = pel_matrix_multiply(
        &inputs->scene->instances[instance].transform, &volume->world_from_voxel);
    const float4 *shift = &part->memory_from_voxel;
    const double voxel[3] = {sample->x - shift->x, sample->y - shift->y, sample->z - shift->z};
    pel_matrix_point(out->position, &world_from_voxel, voxel);
    out->instance = instance;
    out->number = sample->number;
    out->steps = sample->steps;
    double squared = 0;
    for (int i = 0; i < 3; i++)
        squared += pow(out->position[i] - origin[i], 2);
    out->distance_mm = sqrt(squared);
    out->value =
        pel_world_value(inputs->scene, instance, inputs->residency->layout.reader, sample->raw);
    out->opacity = world->depth ? -expm1(-(double)sample->strength) : sample->strength;
    out->rgb[0] = sample->r;
    out->rgb[1] = sample->g;
    out->rgb[2] = sample->b;
    out->accumulated = sample->before;
}

static bool read_record(struct pel_probe *probe, const struct record *record,
                        const struct pel_probe_inputs *inputs) {
    const float4 *light = &record->ray.light;
    const double rgba[4] = {light->x, light->y, light->z, light->w};
    memcpy(probe->rgba, rgba, sizeof rgba);
    if (!find_spans(probe, &record->ray, inputs->world))
        return false;
    probe->cut = record->ray.sample_count > record->sample_count;
    probe->samples = pel_allocate((size_t)record->sample_count + 1, sizeof *probe->samples);
    if (!probe->samples)
        return false;
    for (int s = 0; s < record->sample_count; s++)
        read_sample(&probe->samples[s], &record->samples[s], inputs, probe->origin);
    probe->sample_count = record->sample_count;
    return true;
}

// ---- The kernel --------------------------------------------------------------------------------

static bool set_arguments(struct pel_kernel *kernel, const struct pel_probe_inputs *inputs, int x,
                          int y, const struct pel_buffer *ray, const struct pel_buffer *samples) {
    int index = 0;
    bool good =
        pel_kernel_set_buffer(kernel, index++, inputs->world_buffer) &&
        pel_kernel_set_buffer(kernel, index++, inputs->tables) &&
        pel_kernel_set_buffer(kernel, index++, inputs->cells) &&
        pel_kernel_set_u32(kernel, index++, (uint32_t)x) &&
        pel_kernel_set_u32(kernel, index++, (uint32_t)y) &&
        pel_kernel_set_buffer(kernel, index++, ray) &&
        pel_kernel_set_buffer(kernel, index++, samples) &&
        (!inputs->world->adaptive || pel_kernel_set_buffer(kernel, index++, inputs->strides));
    return good && pel_residency_bind(inputs->residency, kernel, index, inputs->world->voxels);
}

static bool run_kernel(struct record *record, const struct pel_probe_inputs *inputs, int x, int y) {
    struct pel_kernel *kernel = pel_kernel_sibling(inputs->render, "probe");
    struct pel_buffer *ray =
        pel_buffer_create(inputs->device, sizeof record->ray, "what a ray meets");
    struct pel_buffer *samples =
        pel_buffer_create(inputs->device, PROBE_SAMPLE_MAX * sizeof *record->samples, "samples");
    bool good = kernel && ray && samples && set_arguments(kernel, inputs, x, y, ray, samples) &&
                pel_kernel_launch(kernel, 1, 1) && pel_device_finish(inputs->device) &&
                pel_buffer_read(ray, 0, sizeof record->ray, &record->ray);
    if (good) {
        int count = record->ray.sample_count;
        record->sample_count = count < PROBE_SAMPLE_MAX ? count : PROBE_SAMPLE_MAX;
        size_t bytes = (size_t)record->sample_count * sizeof *record->samples;
        record->samples = pel_allocate((size_t)record->sample_count + 1, sizeof *record->samples);
        good =
            record->samples && (bytes == 0 || pel_buffer_read(samples, 0, bytes, record->samples));
    }
    pel_buffer_destroy(samples);
    pel_buffer_destroy(ray);
    pel_kernel_destroy(kernel);
    return good;
}

bool pel_probe_check(const struct pel_scene *scene, int x, int y) {
    if (x < 0 || y < 0 || x >= scene->render.width || y >= scene->render.height)
        return pel_fail(PEL_ERROR_ARGUMENT, "pixel %d,%d is outside the picture of %d x %d", x, y,
                        scene->render.width, scene->render.height);
    return pel_model_kernel(scene) != MODELS_EMISSION ||
           pel_fail(PEL_ERROR_UNSUPPORTED,
                    "model emission is integrated exactly and takes no samples to tell of");
}

bool pel_probe_run(const struct pel_probe_inputs *inputs, int x, int y, struct pel_probe *probe) {
    struct record record = {.samples = NULL};
    if (!inputs->render) // the background alone
        record.ray.light = inputs->world->bytes.background;
    find_ray(probe, inputs->world, x, y);
    bool good = (!inputs->render || run_kernel(&record, inputs, x, y)) &&
                read_record(probe, &record, inputs);
    free(record.samples);
    if (!good)
        pel_probe_finish(probe);
    return good;
}

void pel_probe_finish(struct pel_probe *probe) {
    free(probe->spans);
    free(probe->samples);
    *probe = (struct pel_probe){0};
}
