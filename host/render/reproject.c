// reproject.c - what a second eye sees, from the first one's picture.
//
// With parallel cameras of perspective, and with orthographic ones that are turned around their
// upward direction, a point stays in its row, so rows are worked on one by one (Adelson & Hodges
// 1993). Neighbouring pixels that stay neighbours are one surface: what is between them is
// between their colours. Where the surface tears, or folds over itself, is an edge, and the pixels
// around it are rays to be cast, as are those that nothing came to. The nearer wins.
#include "render/reproject.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "base/memory.h"
#include "camera/camera.h"

// Neighbours are at most and at least so far apart in the second picture to be one surface.
static const double apart_most = 1.5, apart_least = 0.5;

// Farther than anything.
static const double behind_mm = 1e30;

// One row on its way.
struct row {
    int width;
    const float *from; // colours of the first picture
    float *to;         // and of the second
    uint8_t *holes;    // of the second
    double *place;     // of the first picture's pixels in the second, in pixels from its left edge
    double *near;      // how near they are there: inverse depths, or negative ones
    double *nearest;   // likewise of what the second picture's pixels show; -INFINITY: nothing
};

// The least pixel whose middle is at or right of place a, and the greatest at or left of it, in a
// row of that width, or one beyond its ends.
static int pixel_from(double a, int width) {
    double clamped = a < 0.5 ? 0.5 : a > width + 1 ? width + 1 : a;
    int k = (int)(clamped - 0.5);
    return k + (k < clamped - 0.5);
}

static int pixel_up_to(double a, int width) {
    return a < 0.5 ? -1 : a >= width ? width - 1 : (int)(a - 0.5);
}

static double half_height(const struct pel_camera *camera) {
    return tan(camera->fov_deg * PEL_PI / 360);
}

// Both cameras look through windows of one size, at places that differ by what their directions do.
static struct pel_parallax find_parallel(const struct pel_camera cameras[2],
                                         const struct pel_render_settings *settings) {
    double forward[2][3], right[2][3], up[3], between[3], to_target[3];
    for (int n = 0; n < 2; n++)
        if (!pel_camera_basis(&cameras[n], forward[n], right[n], up))
            return (struct pel_parallax){0};
    for (int i = 0; i < 3; i++) {
        between[i] = cameras[0].eye[i] - cameras[1].eye[i];
        to_target[i] = cameras[0].target[i] - cameras[0].eye[i];
    }
    double px_per_mm = settings->height / cameras[0].height_mm;
    double middle = settings->width / 2.0, left = settings->region[0];
    double shift_mm = cameras[0].height_mm * cameras[0].shift[0];
    double scale = pel_dot(right[0], right[1]);
    double moved_mm = pel_dot(between, right[1]) + (scale - 1) * shift_mm;
    return (struct pel_parallax){
        .orthographic = true,
        .scale = scale,
        .shift_px = (1 - scale) * (middle - left) + px_per_mm * moved_mm,
        .slope_px_mm = px_per_mm * pel_dot(forward[0], right[1]),
        .lean_mm_px = pel_dot(right[0], forward[1]) / px_per_mm,
        .fall = pel_dot(forward[0], forward[1]),
        .empty_mm = pel_dot(to_target, forward[0]),
    };
}

struct pel_parallax pel_parallax_between(const struct pel_camera cameras[2],
                                         const struct pel_render_settings *settings) {
    if (cameras[0].orthographic)
        return find_parallel(cameras, settings);
    int width = settings->width;
    double forward[3], right[3], up[3], apart = 0, aspect = (double)width / settings->height;
    if (pel_camera_basis(&cameras[0], forward, right, up))
        for (int i = 0; i < 3; i++)
            apart += (cameras[1].eye[i] - cameras[0].eye[i]) * right[i];
    return (struct pel_parallax){
        .shift_px = width * (cameras[0].shift[0] - cameras[1].shift[0]) / aspect,
        .reach_mm_px = width * apart / (2 * half_height(&cameras[0]) * aspect)};
}

void pel_depth_from_distance(float *depth, const struct pel_camera *camera,
                             const struct pel_render_settings *settings) {
    int width = settings->width, height = settings->height;
    int left = settings->region[0], right_end = left + settings->region[2];
    int top = settings->region[1], bottom = top + settings->region[3];
    if (settings->region[2] == 0)
        right_end = width, bottom = height;
    double half = half_height(camera), aspect = (double)width / height;
    for (int y = top; y < bottom; y++) {
        double up = half * (1 - 2 * (y + 0.5) / height + 2 * camera->shift[1]);
        for (int x = left; x < right_end; x++, depth++) {
            double right = half * (aspect * (2 * (x + 0.5) / width - 1) + 2 * camera->shift[0]);
            double slant = camera->orthographic ? 1 : sqrt(1 + right * right + up * up);
            *depth = *depth == FLT_MAX ? INFINITY : (float)(*depth / slant);
        }
    }
}

// Sets the pixels between i and the next one.
static void fill_between(struct row *row, int i) {
    double a = row->place[i], b = row->place[i + 1];
    int first = pixel_from(a, row->width), last = pixel_up_to(b, row->width);
    for (int k = first; k <= last; k++) {
        double weight = (k + 0.5 - a) / (b - a);
        double near = row->near[i] + weight * (row->near[i + 1] - row->near[i]);
        if (near <= row->nearest[k])
            continue;
        row->nearest[k] = near;
        row->holes[k] = 0;
        for (int c = 0; c < 4; c++)
            row->to[4 * k + c] =
                (float)(row->from[4 * i + c] +
                        weight * ((double)row->from[4 * (i + 1) + c] - row->from[4 * i + c]));
    }
}

// Has the rays around pixel i cast, unless something nearer is there.
static void cast_around(struct row *row, int i) {
    int first = pixel_from(row->place[i] - 1, row->width);
    int last = pixel_up_to(row->place[i] + 1, row->width);
    for (int k = first; k <= last; k++)
        if (row->near[i] >= row->nearest[k]) {
            row->nearest[k] = row->near[i];
            row->holes[k] = 1;
        }
}

static bool is_surface(const struct row *row, int i) {
    double apart = row->place[i + 1] - row->place[i];
    return apart >= apart_least && apart <= apart_most;
}

// Finds where the pixels of a row go. False where that is not known of all of them.
static bool find_places(struct row *row, const float *depth, const struct pel_parallax *parallax) {
    for (int i = 0; i < row->width; i++) {
        if (!(depth[i] > 0))
            return false;
        row->near[i] = 1 / (double)depth[i];
        row->place[i] = i + 0.5 + parallax->shift_px - parallax->reach_mm_px * row->near[i];
        if (!parallax->orthographic)
            continue;
        bool empty = isinf(depth[i]);
        double x = i + 0.5, z = empty ? parallax->empty_mm : (double)depth[i];
        row->near[i] = empty ? -behind_mm : -parallax->lean_mm_px * x - parallax->fall * z;
        row->place[i] = parallax->scale * x + parallax->shift_px + parallax->slope_px_mm * z;
    }
    return true;
}

static void reproject_row(struct row *row, const float *depth,
                          const struct pel_parallax *parallax) {
    memset(row->holes, 1, (size_t)row->width);
    if (!find_places(row, depth, parallax))
        return;
    for (int k = 0; k < row->width; k++)
        row->nearest[k] = -INFINITY;
    for (int i = 0; i + 1 < row->width; i++)
        if (is_surface(row, i))
            fill_between(row, i);
    for (int i = 0; i + 1 < row->width; i++)
        if (!is_surface(row, i)) {
            cast_around(row, i);
            cast_around(row, i + 1);
        }
}

bool pel_reproject(struct pel_image *second, uint8_t *holes, const struct pel_image *first,
                   const float *depth, const struct pel_parallax *parallax) {
    size_t width = (size_t)first->width;
    double *rooms = pel_allocate(3 * width, sizeof *rooms);
    if (!rooms)
        return false;
    for (size_t y = 0; y < (size_t)first->height; y++) {
        struct row row = {.width = first->width,
                          .from = first->rgba + 4 * y * width,
                          .to = second->rgba + 4 * y * width,
                          .holes = holes + y * width,
                          .place = rooms,
                          .near = rooms + width,
                          .nearest = rooms + 2 * width};
        reproject_row(&row, depth + y * width, parallax);
    }
    free(rooms);
    return true;
}
