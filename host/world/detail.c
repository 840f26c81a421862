// detail.c - how much detail of a volume a picture needs: docs/picture.md, "Level of detail".
#include "world/detail.h"

#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "camera/camera.h"
#include "world/mask.h"

// Values between labels mean nothing, nor does a voxel between those that are shown as they are.
static bool is_whole(const struct pel_scene *scene, int k) {
    const struct pel_instance *instance = &scene->instances[k];
    const struct pel_volume *volume = scene->volumes[instance->volume];
    if (instance->hidden || instance->filter == PEL_FILTER_NEAREST || volume->labels ||
        !volume->voxels)
        return true;
    for (int n = 0; n < scene->instance_count; n++)
        if (pel_mask_of(&scene->instances[n]) == k)
            return true;
    return false;
}

// The depth of the nearest point of an instance's box along the camera's view, in millimetres.
static double nearest_depth(const struct pel_scene *scene, const struct pel_instance *instance,
                            const struct pel_camera *camera, const double forward[3]) {
    const struct pel_volume *volume = scene->volumes[instance->volume];
    double outer = instance->extent == PEL_EXTENT_CELL ? 0.5 : 0, nearest = INFINITY;
    for (int n = 0; n < 8; n++) {
        double corner[3];
        for (int c = 0; c < 3; c++)
            corner[c] = n >> c & 1 ? volume->dims[c] - 1 + outer : -outer;
        pel_matrix_point(corner, &volume->world_from_voxel, corner);
        pel_matrix_point(corner, &instance->transform, corner);
        for (int c = 0; c < 3; c++)
            corner[c] -= camera->eye[c];
        nearest = fmin(nearest, pel_dot(corner, forward));
    }
    return nearest;
}

// What one ray stands for at the instance's nearest point, in millimetres; not above 0 where the
// camera is beside it or in it, or is none.
static double footprint(const struct pel_scene *scene, const struct pel_instance *instance,
                        const struct pel_camera *camera) {
    double forward[3], right[3], up[3], height_mm = camera->height_mm;
    if (!pel_camera_basis(camera, forward, right, up))
        return 0;
    if (!camera->orthographic)
        height_mm = 2 * tan(camera->fov_deg * PEL_PI / 360) *
                    nearest_depth(scene, instance, camera, forward);
    int n = scene->render.supersampling.n > 1 ? scene->render.supersampling.n : 1;
    return height_mm / ((double)scene->render.height * n);
}

bool pel_detail_check(const struct pel_render_settings *render) {
    if ((unsigned)render->lod > PEL_LOD_LEVEL)
        return pel_fail(PEL_ERROR_ARGUMENT, "level of detail %d", (int)render->lod);
    if (render->lod == PEL_LOD_LEVEL &&
        (render->lod_level < 0 || render->lod_level > PEL_LOD_LEVEL_MAX))
        return pel_fail(PEL_ERROR_ARGUMENT, "level of detail %d, outside 0..%d", render->lod_level,
                        PEL_LOD_LEVEL_MAX);
    return true;
}

int pel_detail_level(const struct pel_scene *scene, const struct pel_camera *second, int instance) {
    const struct pel_render_settings *render = &scene->render;
    if (render->lod == PEL_LOD_OFF || is_whole(scene, instance))
        return 0;
    if (render->lod == PEL_LOD_LEVEL)
        return render->lod_level;
    const struct pel_instance *shown = &scene->instances[instance];
    double spacing[3];
    pel_volume_spacing(scene->volumes[shown->volume], spacing);
    double least = fmin(spacing[0], fmin(spacing[1], spacing[2]));
    double size_mm = footprint(scene, shown, &scene->camera);
    if (second)
        size_mm = fmin(size_mm, footprint(scene, shown, second));
    double level = log2(size_mm / least) + 1e-6;
    return level >= 1 ? (int)fmin(level, PEL_LOD_LEVEL_MAX) : 0; // also where it is NaN
}
