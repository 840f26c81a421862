// slice.c - flat cuts through all volumes.
#include "viewer/slice.h"

#include "viewer/sample.h"
#include "viewer/transfer_edit.h"
#include "viewer/vector.h"

static const char *const names[] = {"axial", "coronal", "sagittal", NULL};

// To the right and down in the picture, and towards the viewer.
static const double axes[][3][3] = {
    [PEL_SLICE_AXIAL] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
    [PEL_SLICE_CORONAL] = {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    [PEL_SLICE_SAGITTAL] = {{0, -1, 0}, {0, 0, -1}, {-1, 0, 0}},
};

const char *const *pel_slice_names(void) {
    return names;
}

void pel_slice_axes(const struct pel_slice *slice, double right[3], double down[3],
                    double towards[3]) {
    vector_set(right, axes[slice->plane][0]);
    vector_set(down, axes[slice->plane][1]);
    vector_set(towards, axes[slice->plane][2]);
}

void pel_slice_fit(struct pel_slice *slice, const struct pel_bounds *bounds) {
    double size[3], right, down;
    for (int i = 0; i < 3; i++) {
        slice->middle[i] = (bounds->low[i] + bounds->high[i]) / 2;
        size[i] = bounds->high[i] - bounds->low[i];
    }
    // The axes are the world's, up to their signs.
    right = fabs(vector_dot(size, axes[slice->plane][0]));
    down = fabs(vector_dot(size, axes[slice->plane][1]));
    slice->mm_per_px = fmax(right / slice->width, down / slice->height) / 0.95;
    if (!(slice->mm_per_px > 0))
        slice->mm_per_px = 1;
}

void pel_slice_world(const struct pel_slice *slice, const double pixel[2], double world[3]) {
    const double(*a)[3] = axes[slice->plane];
    double to_cross[3];
    vector_subtract(to_cross, slice->cross, slice->middle);
    vector_add_scaled(world, slice->middle, (pixel[0] - slice->width / 2.0) * slice->mm_per_px,
                      a[0]);
    vector_add_scaled(world, world, (pixel[1] - slice->height / 2.0) * slice->mm_per_px, a[1]);
    vector_add_scaled(world, world, vector_dot(to_cross, a[2]), a[2]);
}

void pel_slice_pixel(const struct pel_slice *slice, const double world[3], double pixel[2]) {
    const double(*a)[3] = axes[slice->plane];
    double from_middle[3];
    vector_subtract(from_middle, world, slice->middle);
    pixel[0] = slice->width / 2.0 + vector_dot(from_middle, a[0]) / slice->mm_per_px;
    pixel[1] = slice->height / 2.0 + vector_dot(from_middle, a[1]) / slice->mm_per_px;
}

// What of all volumes one place shows.
struct light {
    double rgb[3]; // premultiplied
    double alpha;
};

static struct light look(const struct pel_sampler *samplers, int count, const double world[3],
                         bool windowed) {
    double sum[3] = {0}, total = 0;
    for (int k = 0; k < count; k++) {
        struct pel_sample sample = pel_sampler_take(&samplers[k], world);
        if (!sample.inside || sample.absent)
            continue;
        double weight = -log1p(-fmin(sample.opacity, 1 - 0x1p-24)) * samplers[k].instance->density;
        if (windowed) {
            double low, high;
            pel_transfer_window(samplers[k].instance->transfer, &low, &high);
            double grey = fmin(fmax((sample.value - low) / (high - low), 0), 1);
            vector_set(sample.rgb, (double[3]){grey, grey, grey});
            weight = 1;
        }
        vector_add_scaled(sum, sum, weight, sample.rgb);
        total += weight;
    }
    struct light light = {.alpha = windowed ? total > 0 : -expm1(-total)};
    if (total > 0)
        vector_scale(light.rgb, sum, light.alpha / total);
    return light;
}

static uint8_t byte(double share) {
    return (uint8_t)(fmin(fmax(share, 0), 1) * 255 + 0.5);
}

void pel_slice_render(const struct pel_slice *slice, const struct pel_scene *scene, int instance,
                      uint8_t *rgba) {
    struct pel_sampler samplers[PEL_VOLUME_MAX];
    const double *background = scene->background;
    int count = 0;
    for (int i = 0; i < scene->instance_count; i++) {
        bool shown = instance < 0 ? !scene->instances[i].hidden : i == instance;
        count += shown && pel_sampler_make(&samplers[count], scene, i);
    }
    const int *part = slice->part;
    int right = part[2] > 0 ? part[0] + part[2] : slice->width;
    int bottom = part[3] > 0 ? part[1] + part[3] : slice->height;
    for (int y = part[1]; y < bottom; y++) {
        for (int x = part[0]; x < right; x++, rgba += 4) {
            double world[3];
            pel_slice_world(slice, (double[]){x + 0.5, y + 0.5}, world);
            struct light light = look(samplers, count, world, slice->windowed);
            double through = (1 - light.alpha) * background[3], alpha = light.alpha + through;
            for (int c = 0; c < 3; c++)
                rgba[c] = alpha > 0 ? byte((light.rgb[c] + through * background[c]) / alpha) : 0;
            rgba[3] = byte(alpha);
        }
    }
}
