// dimming.cl - how much of the light on a sample is left, by shadows and ambient occlusion.
//
// One loop sends all rays of a sample on their way, so that the program has a secondary ray only
// once. Directions around a sample are the same everywhere in the world, turned to the side of its
// normal, and weigh by their cosine: where the normal turns, light changes evenly. See
// docs/picture.md, "Shadows and ambient occlusion".
// Included by shade.cl.
#ifndef DIMMING_CL
#define DIMMING_CL

#include "secondary.cl"

#if SECONDARY
#define SECONDARY_TURN 0x1p-10f // how far the axis leans to the viewer

// The shares of light that are left: of each lamp's, and of all that is not shiny.
struct dimming {
    real lamps[LAMP_MAX];
    real around;
};

// The secondary rays of a place: where they begin, and the axis around which they lie.
struct origin {
    struct ray ray;
    struct vector axis;
};

// The origin at t along a ray lies one voxel off, on the side of the surface that the viewer sees,
// so that a surface does not darken itself.
INLINE void find_origin(struct origin *origin, __constant struct part *part, const struct ray *ray,
                        real t, const struct vector *normal, mask asks) {
    const real along = normal->x * ray->dx + normal->y * ray->dy + normal->z * ray->dz;
    const real side = CHOOSE((real)(1.0f), (real)(-1.0f), MASK(along > 0.0f));
    struct vector *axis = &origin->axis;
    axis->x = side * normal->x - SECONDARY_TURN * ray->dx;
    axis->y = side * normal->y - SECONDARY_TURN * ray->dy;
    axis->z = side * normal->z - SECONDARY_TURN * ray->dz;
    make_unit(axis);
    origin->ray = *ray;
    origin->ray.ox += t * ray->dx + part->spacing_mm * axis->x;
    origin->ray.oy += t * ray->dy + part->spacing_mm * axis->y;
    origin->ray.oz += t * ray->dz + part->spacing_mm * axis->z;
#if SUPERSAMPLING
    origin->ray.runs = asks;
#endif
}

// Points the ray of a place at t along a ray to a lamp, and returns how long it is.
INLINE real aim_at_lamp(__constant struct world *world, __constant struct lamp *lamp,
                        const struct ray *ray, real t, struct ray *aimed) {
    const struct vector l = towards_lamp(lamp, ray, t);
    aimed->dx = l.x;
    aimed->dy = l.y;
    aimed->dz = l.z;
    real away = (real)(FLT_MAX);
    if (lamp->kind == LAMP_HEADLIGHT)
        away = t;
    if (lamp->kind == LAMP_POINT) {
        const real x = lamp->place.x - (ray->ox + t * ray->dx),
                   y = lamp->place.y - (ray->oy + t * ray->dy),
                   z = lamp->place.z - (ray->oz + t * ray->dz);
        away = sqrt(x * x + y * y + z * z);
    }
    return fmin(away, world->shadow_length_mm);
}

// What is left of the light on a sample at t along a ray, in the lanes that ask.
INLINE void find_dimming(__constant struct world *world, TABLE_SPACE const uint *table,
                         __global const uchar *cells, __constant struct part *part,
                         MEMORY_PARAMETERS, const struct ray *ray, real t,
                         const struct vector *normal, mask asks, struct dimming *dimming) {
    struct origin origin;
    find_origin(&origin, part, ray, t, normal, asks);
    const int lamp_count = SECONDARY & SECONDARY_SHADOWS ? world->lamp_count : 0;
    const int count = lamp_count + (SECONDARY & SECONDARY_OCCLUSION ? world->occlusion_count : 0);
    real light = (real)(0.0f), weights = (real)(FLT_MIN), weight = (real)(0.0f);
    for (int n = 0; n < count; n++) {
        const bool shadow = n < lamp_count;
        real end = (real)(world->occlusion_radius_mm);
        if (shadow) {
            end = aim_at_lamp(world, &world->lamps[n], ray, t, &origin.ray);
        } else {
            const float4 d = world->cuts[world->directions + n - lamp_count];
            const real cosine = d.x * origin.axis.x + d.y * origin.axis.y + d.z * origin.axis.z;
            const real side = CHOOSE((real)(1.0f), (real)(-1.0f), MASK(cosine < 0.0f));
            origin.ray.dx = side * d.x;
            origin.ray.dy = side * d.y;
            origin.ray.dz = side * d.z;
            weight = fabs(cosine);
        }
        const float step_mm = shadow ? world->shadow_step_mm : world->occlusion_step_mm;
        const real through = light_through(world, table, cells, MEMORY_ARGUMENTS, &origin.ray, end,
                                           step_mm, asks);
        if (shadow) {
            dimming->lamps[n] = 1.0f - world->shadow_strength * (1.0f - through);
        } else {
            light += weight * through;
            weights += weight;
        }
    }
    dimming->around = 1.0f - world->occlusion_strength * (1.0f - light / weights);
}
#endif

#endif
