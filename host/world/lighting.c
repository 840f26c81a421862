// lighting.c - a scene's lights and materials as kernels read them: docs/picture.md, "Shading".
#include "world/lighting.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "camera/camera.h"
#include "world/narrow.h"

static bool is_amount(double value) {
    return value >= 0 && value <= PEL_LIGHT_AMOUNT_MAX;
}

// Turns the way light goes into where it comes from.
static bool fill_direction(struct lamp *lamp, const double along[3]) {
    double towards[3] = {-along[0], -along[1], -along[2]};
    if (!pel_normalize(towards))
        return pel_fail(PEL_ERROR_ARGUMENT, "the direction %g %g %g has no length", along[0],
                        along[1], along[2]);
    lamp->kind = LAMP_DIRECTIONAL;
    lamp->place = pel_narrow(towards, 0);
    return true;
}

static bool fill_place(struct lamp *lamp, const struct pel_light *light,
                       const struct pel_camera *camera, const double centre[3]) {
    double forward[3], right[3], up[3], place[3];
    switch (light->kind) {
    case PEL_LIGHT_HEADLIGHT:
        lamp->kind = LAMP_HEADLIGHT;
        return true;
    case PEL_LIGHT_CAMERA:
        return pel_camera_basis(camera, forward, right, up) && fill_direction(lamp, forward);
    case PEL_LIGHT_DIRECTIONAL:
        return fill_direction(lamp, light->direction);
    case PEL_LIGHT_POINT:
        break;
    }
    for (int i = 0; i < 3; i++) {
        place[i] = light->position[i] - centre[i];
        if (!isfinite(place[i]))
            return pel_fail(PEL_ERROR_ARGUMENT, "a position is not finite");
    }
    lamp->kind = LAMP_POINT;
    lamp->place = pel_narrow(place, 0);
    return true;
}

static bool fill_lamp(struct lamp *lamp, const struct pel_light *light,
                      const struct pel_camera *camera, const double centre[3]) {
    memset(lamp, 0, sizeof *lamp);
    double colour[3];
    for (int i = 0; i < 3; i++) {
        colour[i] = light->colour[i] * light->intensity;
        if (!is_amount(colour[i]))
            return pel_fail(PEL_ERROR_ARGUMENT, "colour times intensity is %g, outside 0..%g",
                            colour[i], PEL_LIGHT_AMOUNT_MAX);
    }
    lamp->colour = pel_narrow(colour, 0);
    return fill_place(lamp, light, camera, centre);
}

bool pel_lighting_fill_lamps(struct world *world, const struct pel_scene *scene,
                             const double centre[3]) {
    _Static_assert(LAMP_MAX == PEL_LIGHT_MAX, "as many lamps as lights");
    static const struct pel_light white_headlight = {.colour = {1, 1, 1}, .intensity = 1};
    if (scene->light_count < 0 || scene->light_count > PEL_LIGHT_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "%d lights, outside 0..%d", scene->light_count,
                        PEL_LIGHT_MAX);
    world->lamp_count = scene->light_count > 0 ? scene->light_count : 1;
    if (scene->light_count == 0)
        return fill_lamp(&world->lamps[0], &white_headlight, &scene->camera, centre);
    for (int n = 0; n < scene->light_count; n++)
        if (!fill_lamp(&world->lamps[n], &scene->lights[n], &scene->camera, centre))
            return pel_fail_in("light %d", n);
    return true;
}

bool pel_lighting_fill_part(struct part *part, const struct pel_instance *instance,
                            const struct pel_volume *volume) {
    struct pel_material material = instance->material;
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    part->spacing_mm = (float)fmin(spacing[0], fmin(spacing[1], spacing[2]));
    part->normal_scale = part->table_last > 0 ? -part->table_scale / part->table_last / 2 : 0;
    if (material.shading == PEL_SHADING_NONE)
        return true;
    if (material.ambient == 0 && material.diffuse == 0 && material.specular == 0 &&
        material.shininess == 0) {
        struct pel_material usual = pel_material_default(material.shading);
        usual.one_sided = material.one_sided;
        material = usual;
    }
    if (!is_amount(material.ambient) || !is_amount(material.diffuse) ||
        !is_amount(material.specular))
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "a material of ambient %g, diffuse %g and specular %g, outside 0..%g",
                        material.ambient, material.diffuse, material.specular,
                        PEL_LIGHT_AMOUNT_MAX);
    if (!(material.shininess >= 1 && material.shininess <= PEL_SHININESS_MAX))
        return pel_fail(PEL_ERROR_ARGUMENT, "shininess %g, outside 1..%g", material.shininess,
                        PEL_SHININESS_MAX);
    part->shading = material.shading == PEL_SHADING_PHONG ? SHADING_PHONG : SHADING_BLINN_PHONG;
    part->one_sided = material.one_sided;
    part->material = (float4){(float)material.ambient, (float)material.diffuse,
                              (float)material.specular, (float)material.shininess};
    return true;
}

struct pel_material pel_material_default(enum pel_shading shading) {
    return (struct pel_material){
        .shading = shading, .ambient = 0.1, .diffuse = 0.7, .specular = 0.2, .shininess = 10};
}
