// shade.cl - light on a sample, from the gradient of the values around it.
//
// Normals are looked for only where something is visible. With shadows or ambient occlusion less
// light arrives, which dimming.cl finds out. See docs/picture.md, "Shading". Phong 1975; Blinn
// 1977.
#ifndef SHADE_CL
#define SHADE_CL

#include "gradient_opacity.cl"
#include "normal.cl"

#ifndef SECONDARY
#define SECONDARY 0 // which rays go on from samples, SECONDARY_*: to lamps (shadows), around the normal
#endif

// What shading needs of the frame: rays that go on from a sample meet everything there is.
#if SECONDARY
#include "dimming.cl"
#define FRAME_PARAMETERS                                                                           \
    __constant struct world *world, TABLE_SPACE const uint *table, __global const uchar *cells
#define FRAME_ARGUMENTS world, table, cells
#else
#define FRAME_PARAMETERS __constant struct world *world
#define FRAME_ARGUMENTS world
#endif

#if SHADING
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

// Shades the straight colour of a sample at t along a ray, where the normal is known. `where` are
// the lanes that are visible.
INLINE void light_up(FRAME_PARAMETERS, __constant struct part *part, MEMORY_PARAMETERS,
                     const struct ray *ray, real t, const struct vector *normal, mask where, real *r,
                     real *g, real *b) {
    const float4 material = part->material;
    const struct vector v = {-ray->dx, -ray->dy, -ray->dz};
    const real zero = (real)(0.0f), ambient = (real)(material.x);
    struct vector matt = {ambient, ambient, ambient}, gloss = {zero, zero, zero};
#if SECONDARY
    struct dimming dimming;
    find_dimming(FRAME_ARGUMENTS, part, MEMORY_ARGUMENTS, ray, t, normal, where, &dimming);
#endif
    for (int n = 0; n < world->lamp_count; n++) {
        __constant struct lamp *lamp = &world->lamps[n];
        const struct vector l = towards_lamp(lamp, ray, t);
        const real facing = dot_lanes(normal, &l);
        const real lit = part->one_sided ? AT_LEAST(facing, zero) : fabs(facing);
        const real cosine = highlight_cosine(part, lamp, normal, &l, &v);
        real shine = power_of_all(cosine, material.w);
        if (part->one_sided)
            shine = CHOOSE(zero, shine, MASK(facing > 0.0f));
        real diffuse = material.y * lit, specular = material.z * shine;
#if SECONDARY & SECONDARY_SHADOWS
        diffuse *= dimming.lamps[n];
        specular *= dimming.lamps[n];
#endif
        matt.x += lamp->colour.x * diffuse;
        matt.y += lamp->colour.y * diffuse;
        matt.z += lamp->colour.z * diffuse;
        gloss.x += lamp->colour.x * specular;
        gloss.y += lamp->colour.y * specular;
        gloss.z += lamp->colour.z * specular;
    }
#if SECONDARY & SECONDARY_OCCLUSION
    matt.x *= dimming.around;
    matt.y *= dimming.around;
    matt.z *= dimming.around;
#endif
    *r = *r * matt.x + gloss.x;
    *g = *g * matt.y + gloss.y;
    *b = *b * matt.z + gloss.z;
}

// Shades the straight colour of sample i of a ray whose sample 0 lies at t_first. `raw` is the
// value there, at (x, y, z) in memory coordinates, and must not be absent.
INLINE void shade(FRAME_PARAMETERS, __constant struct part *part, MEMORY_PARAMETERS,
                  const struct ray *ray, real t_first, real i, real x, real y, real z, real raw,
                  mask where, real *r, real *g, real *b) {
    real slope;
    const struct vector normal = find_normal(MEMORY_ARGUMENTS, part, raw, x, y, z, &slope);
    light_up(FRAME_ARGUMENTS, part, MEMORY_ARGUMENTS, ray, t_first + i * world->step_mm, &normal,
             where, r, g, b);
}
#endif

#endif
