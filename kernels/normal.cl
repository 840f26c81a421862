// normal.cl - directions at a sample: its normal, and where lamps are.
//
// Normals and lights are in world space; a gradient (gradient.cl) goes there by the transpose of
// voxel_from_world, so that anisotropic and oblique volumes are shaded right. A gradient fades out
// below SHADE_SOFTNESS of the table's range per voxel, where direction is rounding. See
// docs/picture.md, "Shading".
#ifndef NORMAL_CL
#define NORMAL_CL

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

// The normal in world space where values change by `difference` over two voxels. It points to lesser
// values, has length 1, and less where the gradient is next to nothing. `*slope` is the gradient's
// length, in ranges of the table per millimetre.
INLINE struct vector make_normal(__constant struct part *part, real difference[3], real *slope) {
#pragma unroll
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

// The normal at a place in memory coordinates, where the value is `raw`.
INLINE struct vector find_normal(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                                 real y, real z, real *slope) {
    real difference[3];
    find_differences(MEMORY_ARGUMENTS, part, raw, x, y, z, difference);
    return make_normal(part, difference, slope);
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
#endif

#endif
