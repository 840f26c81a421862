// world_eyes.c - the cameras that a world is seen by, and how the pictures of two eyes lie.
//
// A kernel's camera is the four vectors of docs/picture.md, "Rays", relative to the world's centre.
#include <math.h>
#include <string.h>

#include "base/math.h"
#include "camera/camera.h"
#include "world/narrow.h"
#include "world/world.h"

// a * x + b * y + c * z, for the camera's plane.
static void combine(double out[3], const double x[3], double a, const double y[3], double b,
                    const double z[3], double c) {
    for (int i = 0; i < 3; i++)
        out[i] = a * x[i] + b * y[i] + c * z[i];
}

// docs/picture.md, "Rays", with the window's shift folded into `forward` or `eye`.
static bool fill_camera(struct camera *out, const struct pel_camera *camera,
                        const struct pel_render_settings *settings, const double centre[3]) {
    double forward[3], right[3], up[3];
    if (!pel_camera_basis(camera, forward, right, up))
        return false;
    double aspect = (double)settings->width / settings->height;
    double half =
        camera->orthographic ? camera->height_mm / 2 : tan(camera->fov_deg * PEL_PI / 360);
    const double zero[3] = {0};
    double eye[3], across[3], upward[3], window[3];
    combine(eye, camera->eye, 1, centre, -1, zero, 0);
    combine(across, right, half * aspect, zero, 0, zero, 0);
    combine(upward, up, half, zero, 0, zero, 0);
    combine(window, camera->orthographic ? eye : forward, 1, right, 2 * half * camera->shift[0], up,
            2 * half * camera->shift[1]);

    *out = (struct camera){0};
    if (camera->orthographic) {
        out->eye = pel_narrow(window, 1);
        out->eye_right = pel_narrow(across, 0);
        out->eye_up = pel_narrow(upward, 0);
        out->forward = pel_narrow(forward, 0);
    } else {
        out->eye = pel_narrow(eye, 1);
        out->forward = pel_narrow(window, 0);
        out->right = pel_narrow(across, 0);
        out->up = pel_narrow(upward, 0);
    }
    return true;
}

bool pel_world_set_eye(struct pel_world *world, const struct pel_scene *scene) {
    return fill_camera(&world->bytes.camera, &scene->camera, &scene->render, world->centre);
}

bool pel_world_add_eye(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_camera *second, int eyes, const int weave[2]) {
    world->eyes = eyes;
    world->bytes.pictures = pel_world_pictures(world);
    world->bytes.row_px = world->bytes.width;
    world->bytes.eye_px = world->bytes.width * world->bytes.height;
    world->bytes.weave_x = weave[0];
    world->bytes.weave_y = weave[1];
    return fill_camera(&world->bytes.second, second, &scene->render, world->centre);
}

void pel_world_merge_eyes(struct pel_world *world, const double matrix[3][6], bool linear,
                          const float background[4]) {
    memcpy(&world->bytes.merged_background, background, sizeof world->bytes.merged_background);
    world->bytes.merge_linear = linear;
    for (int n = 0; n < 6; n++) {
        const double column[3] = {matrix[0][n], matrix[1][n], matrix[2][n]};
        world->bytes.merge[n] = pel_narrow(column, 0);
    }
}

void pel_world_lay_beside(struct pel_world *world) {
    world->bytes.eye_px = world->bytes.width;
    world->bytes.row_px = 2 * world->bytes.width;
}

int pel_world_eyes(const struct pel_world *world) {
    return world->eyes == EYES_BOTH || world->eyes == EYES_MERGED ? 2 : 1;
}

int pel_world_pictures(const struct pel_world *world) {
    return world->eyes == EYES_BOTH ? 2 : 1;
}

size_t pel_world_pixels(const struct pel_world *world) {
    return (size_t)world->bytes.width * (size_t)world->bytes.height *
           (size_t)pel_world_pictures(world);
}

int pel_world_across(const struct pel_world *world) {
    return world->eyes == EYES_BOTH && world->bytes.row_px > world->bytes.width ? 2 : 1;
}

int pel_world_planes(const struct pel_world *world) {
    bool two = world->eyes == EYES_BOTH || world->eyes == EYES_DEPTH;
    return two ? 2 / pel_world_across(world) : 1;
}
