// shade.cl - light on a sample, from the gradient of the values around it.
//
// Normals and lights are in world space; a gradient (gradient.cl) goes there by the transpose of
// voxel_from_world, so that anisotropic and oblique volumes are shaded right. It is looked for only
// where something is visible. A gradient fades out below SHADE_SOFTNESS of
// the table's range per voxel, where direction is rounding. See docs/picture.md, "Shading". Phong
// 1975; Blinn 1977.
#ifndef SHADE_CL
#define SHADE_CL

#include "gradient.cl"
#include "power.cl"
#include "ray.cl"
#include "sample.cl"

#ifndef SHADING
#define SHADING 0 // 1: some volume is shaded
#endif

#if SHADING
struct vector {
    real x, y, z;
};

INLINE real dot_lanes(const struct vector *a, const struct vector *b) {
    return a->x * b->x + a->y * b->y + a->z * b->z;
}

// Scales a vector to length 1; nothing stays nothing.
INLINE void make_unit(struct vector *v) {
    const real scale = fast_rsqrt(dot_lanes(v, v) + 1e-30f);
    v->x *= scale;
    v->y *= scale;
    v->z *= scale;
}

// The normal at a place in memory coordinates, in world space. It points to lesser values, has
// length 1, and less where the gradient is next to nothing. `*slope` is the gradient's length, in
// ranges of the table per millimetre.
INLINE struct vector find_normal(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                                 real y, real z, real *slope) {
    real difference[3];
    find_differences(MEMORY_ARGUMENTS, part, raw, x, y, z, difference);
    for (int axis = 0; axis < 3; axis++) {
        difference[axis] *= part->normal_scale;
#if VOXELS & VOXELS_F32
        // The squares of what floats can hold could be infinite.
        difference[axis] = clamp(difference[axis], -1e9f, 1e9f);
#endif
    }
    __constant const float4 *rows = part->voxel_from_world;
    struct vector normal;
    normal.x = rows[0].x * difference[0] + rows[1].x * difference[1] + rows[2].x * difference[2];
    normal.y = rows[0].y * difference[0] + rows[1].y * difference[1] + rows[2].y * difference[2];
    normal.z = rows[0].z * difference[0] + rows[1].z * difference[1] + rows[2].z * difference[2];
    const real square = dot_lanes(&normal, &normal);
    *slope = sqrt(square);
    const real scale =
        part->spacing_mm * fast_rsqrt(square * (part->spacing_mm * part->spacing_mm) +
                                      SHADE_SOFTNESS * SHADE_SOFTNESS);
    normal.x *= scale;
    normal.y *= scale;
    normal.z *= scale;
    return normal;
}

// Where a lamp is as seen from a place on a ray.
INLINE struct vector towards_lamp(__constant struct lamp *lamp, const struct ray *ray, real t) {
    struct vector l = {-ray->dx, -ray->dy, -ray->dz};
    if (lamp->kind == LAMP_DIRECTIONAL) {
        l.x = (real)(lamp->place.x);
        l.y = (real)(lamp->place.y);
        l.z = (real)(lamp->place.z);
    } else if (lamp->kind == LAMP_POINT) {
        l.x = lamp->place.x - (ray->ox + t * ray->dx);
        l.y = lamp->place.y - (ray->oy + t * ray->dy);
        l.z = lamp->place.z - (ray->oz + t * ray->dz);
        make_unit(&l);
    }
    return l;
}

// The cosine that the highlight is a power of.
INLINE real highlight_cosine(__constant struct part *part, __constant struct lamp *lamp,
                             const struct vector *normal, const struct vector *l,
                             const struct vector *v) {
    if (part->shading == SHADING_PHONG) // between the mirrored light and the viewer
        return 2.0f * dot_lanes(normal, l) * dot_lanes(normal, v) -
               dot_lanes(normal, normal) * dot_lanes(l, v);
    struct vector half_way = *v;
    if (lamp->kind != LAMP_HEADLIGHT) {
        half_way.x += l->x;
        half_way.y += l->y;
        half_way.z += l->z;
        make_unit(&half_way);
    }
    const real cosine = dot_lanes(normal, &half_way);
    return part->one_sided ? cosine : fabs(cosine);
}

// Shades the straight colour of a sample at t along a ray, where the normal is known.
INLINE void light_up(__constant struct world *world, __constant struct part *part,
                     const struct ray *ray, real t, const struct vector *normal, real *r, real *g,
                     real *b) {
    const float4 material = part->material;
    const struct vector v = {-ray->dx, -ray->dy, -ray->dz};
    const real zero = (real)(0.0f), ambient = (real)(material.x);
    struct vector matt = {ambient, ambient, ambient}, gloss = {zero, zero, zero};
    for (int n = 0; n < world->lamp_count; n++) {
        __constant struct lamp *lamp = &world->lamps[n];
        const struct vector l = towards_lamp(lamp, ray, t);
        const real facing = dot_lanes(normal, &l);
        const real lit = part->one_sided ? AT_LEAST(facing, zero) : fabs(facing);
        const real cosine = highlight_cosine(part, lamp, normal, &l, &v);
        // The cosine's floor makes a power of nothing as good as nothing.
        real shine = power(AT_LEAST(cosine, (real)(1e-30f)), (real)(material.w));
        if (part->one_sided)
            shine = CHOOSE(zero, shine, MASK(facing > 0.0f));
        const real diffuse = material.y * lit, specular = material.z * shine;
        matt.x += lamp->colour.x * diffuse;
        matt.y += lamp->colour.y * diffuse;
        matt.z += lamp->colour.z * diffuse;
        gloss.x += lamp->colour.x * specular;
        gloss.y += lamp->colour.y * specular;
        gloss.z += lamp->colour.z * specular;
    }
    *r = *r * matt.x + gloss.x;
    *g = *g * matt.y + gloss.y;
    *b = *b * matt.z + gloss.z;
}

// Shades the straight colour of sample i of a ray whose sample 0 lies at t_first. `raw` is the
// value there, at (x, y, z) in memory coordinates, and must not be absent.
INLINE void shade(__constant struct world *world, __constant struct part *part, MEMORY_PARAMETERS,
                  const struct ray *ray, real t_first, real i, real x, real y, real z, real raw,
                  real *r, real *g, real *b) {
    real slope;
    const struct vector normal = find_normal(MEMORY_ARGUMENTS, part, raw, x, y, z, &slope);
    light_up(world, part, ray, t_first + i * world->step_mm, &normal, r, g, b);
}
#endif

#endif
