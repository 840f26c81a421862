// supersample.c - docs/picture.md, "Supersampling".
//
// The seeded places come from shared/pattern.h, whose properties tests/unit/pattern.c checks; what
// is done with them is written anew here.
#include "reference/supersample.h"

#include <math.h>
#include <stdlib.h>

#include "reference/path.h"
#include "reference/reference.h"
#include "shared/pattern.h"

// A pixel, and one of its rays: a number, or CENTRE for the one before them.
struct place {
    int x, y, ray;
};

enum { CENTRE = -1 };

static int ray_count(const struct pel_scene *scene) {
    int n = scene->render.supersampling.n;
    return n > 1 ? n * n : 1;
}

// Where the ray goes through its pixel, from the left and top edge.
static void place_in_pixel(double place[2], const struct pel_scene *scene, struct place ray) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    place[0] = place[1] = 0.5;
    if (ray.ray == CENTRE)
        return;
    u32 key = pattern_key(supersampling->seed, (u32)ray.x, (u32)ray.y);
    u32 n = supersampling->n > 1 ? (u32)supersampling->n : 1;
    struct pattern_place fixed = pattern_place(supersampling->pattern, n, key, (u32)ray.ray);
    place[0] = ldexp(fixed.x, -24);
    place[1] = ldexp(fixed.y, -24);
}

static void choose_phase(struct reference *reference, struct place ray) {
    if (!reference->scene->render.jitter)
        return;
    u32 key = pattern_key(reference->scene->render.supersampling.seed, (u32)ray.x, (u32)ray.y);
    u32 draw = pattern_draw(key, DRAW_PHASE + (ray.ray == CENTRE ? 0 : (u32)ray.ray));
    reference->phase = ldexp(draw & 0xffffff, -24);
}

static void cast(struct reference *reference, struct place ray, double rgba[4]) {
    double place[2];
    place_in_pixel(place, reference->scene, ray);
    choose_phase(reference, ray);
    reference_cast(reference, ray.x + place[0] - 0.5, ray.y + place[1] - 0.5, rgba, NULL);
}

static bool is_outside(const struct pel_scene *scene, int x, int y) {
    return x < 0 || y < 0 || x >= scene->render.width || y >= scene->render.height;
}

// How much the first ray differs from those of the pixels around it.
static double contrast_at(struct reference *reference, int x, int y) {
    double own[4], other[4], contrast = 0;
    cast(reference, (struct place){x, y, CENTRE}, own);
    for (int n = 0; n < 9; n++) {
        int x_near = x + n % 3 - 1, y_near = y + n / 3 - 1;
        if (is_outside(reference->scene, x_near, y_near))
            continue;
        cast(reference, (struct place){x_near, y_near, CENTRE}, other);
        for (int c = 0; c < 4; c++)
            contrast = fmax(contrast, fabs(own[c] - other[c]));
    }
    return contrast;
}

// Colours are floats on the device, and so is the threshold.
static bool is_refined(struct reference *reference, int x, int y) {
    double threshold = reference->scene->render.supersampling.adaptive;
    return threshold == 0 || (float)contrast_at(reference, x, y) > (float)threshold;
}

static double gaussian(double distance) {
    const double sigma = 0.5, reach = 1.5;
    return fmax(0, exp(-distance * distance / (2 * sigma * sigma)) -
                       exp(-reach * reach / (2 * sigma * sigma)));
}

// The weight of a ray in pixel (x, y).
static double weight_of(const struct pel_scene *scene, struct place ray, int x, int y) {
    if (scene->render.supersampling.filter == PEL_RECONSTRUCTION_BOX)
        return ray.x == x && ray.y == y;
    double place[2];
    place_in_pixel(place, scene, ray);
    return gaussian(ray.x + place[0] - (x + 0.5)) * gaussian(ray.y + place[1] - (y + 0.5));
}

// The colour of pixel (x, y), from the colours of `ray_count` rays of each pixel.
static void gather(double rgba[4], const struct pel_scene *scene, const double (*colours)[4], int x,
                   int y) {
    int count = ray_count(scene);
    double weight_sum = 0;
    for (int c = 0; c < 4; c++)
        rgba[c] = 0;
    for (int n = 0; n < 9; n++) {
        struct place ray = {x + n % 3 - 1, y + n / 3 - 1, 0};
        if (is_outside(scene, ray.x, ray.y))
            continue;
        for (; ray.ray < count; ray.ray++) {
            const double *colour = colours[(ray.y * scene->render.width + ray.x) * count + ray.ray];
            double weight = weight_of(scene, ray, x, y);
            weight_sum += weight;
            for (int c = 0; c < 4; c++)
                rgba[c] += weight * colour[c];
        }
    }
    for (int c = 0; c < 4; c++)
        rgba[c] /= weight_sum;
}

bool reference_is_simple(const struct pel_scene *scene) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    return supersampling->n <= 1 && supersampling->pattern == PEL_PATTERN_REGULAR &&
           supersampling->filter == PEL_RECONSTRUCTION_BOX && !scene->render.jitter;
}

struct pel_image *reference_supersample(const struct pel_scene *scene) {
    int width = scene->render.width, height = scene->render.height, count = ray_count(scene);
    struct pel_image *image = pel_image_create(width, height);
    double(*colours)[4] = malloc((size_t)(width * height * count) * sizeof *colours);
    if (!image || !colours)
        abort();
    struct reference *reference = reference_create(scene);
    for (int pixel = 0; pixel < width * height; pixel++) {
        bool refined = is_refined(reference, pixel % width, pixel / width);
        for (int s = 0; s < count; s++) {
            struct place ray = {pixel % width, pixel / width, refined ? s : CENTRE};
            cast(reference, ray, colours[pixel * count + s]);
        }
    }
    for (int pixel = 0; pixel < width * height; pixel++) {
        double rgba[4];
        gather(rgba, scene, (const double(*)[4])colours, pixel % width, pixel / width);
        for (int c = 0; c < 4; c++)
            image->rgba[4 * pixel + c] = (float)rgba[c];
    }
    reference_destroy(reference);
    free(colours);
    return image;
}

// The bound of one ray.
static double ray_bound(struct reference *reference, struct place ray,
                        const struct reference_errors *errors) {
    double place[2];
    place_in_pixel(place, reference->scene, ray);
    choose_phase(reference, ray);
    return reference_cast_bound(reference, ray.x + place[0] - 0.5, ray.y + place[1] - 0.5, errors);
}

double reference_pixel_bound(struct reference *reference, int x, int y,
                             const struct reference_errors *errors) {
    const struct pel_scene *scene = reference->scene;
    const double doubt = 2 / 255.0;
    double threshold = scene->render.supersampling.adaptive, sum = 0, weight_sum = 0;
    for (int n = 0; n < 9; n++) {
        int x_near = x + n % 3 - 1, y_near = y + n / 3 - 1;
        if (is_outside(scene, x_near, y_near) ||
            weight_of(scene, (struct place){x_near, y_near, CENTRE}, x, y) == 0)
            continue;
        // Whether such a pixel is refined may be a matter of rounding.
        double contrast = threshold > 0 ? contrast_at(reference, x_near, y_near) : 1;
        if (fabs(contrast - threshold) <= doubt)
            return 1;
        for (int s = 0; s < ray_count(scene); s++) {
            struct place ray = {x_near, y_near, s};
            double weight = weight_of(scene, ray, x, y);
            if (contrast <= threshold || reference_is_simple(scene))
                ray.ray = CENTRE;
            sum += weight * ray_bound(reference, ray, errors);
            weight_sum += weight;
        }
    }
    return sum / weight_sum;
}
