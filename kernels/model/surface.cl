// surface.cl - between one sample and the next: surfaces of one value (`iso`).
//
// A segment needs the sample before; where the ray leapt over that one it is taken after all.
#ifndef SURFACE_CL
#define SURFACE_CL

#include "model/gathered.cl"
#include "shade.cl"

#define BISECTIONS 12 // a surface is found to 2^-12 of a step

#if MODELS
// The sample of the spot's part at a place between samples.
INLINE struct sample sample_between(MEMORY_PARAMETERS, const struct spot *spot, real t) {
    const struct cursor *cursor = spot->cursor;
    return sample_part(MEMORY_ARGUMENTS, spot->part, cursor->ox + t * cursor->dx,
                       cursor->oy + t * cursor->dy, cursor->oz + t * cursor->dz);
}

#if SHADING
// Shades a colour at a place between samples, where the raw value is given, in the lanes that show
// it.
INLINE void shade_between(FRAME_PARAMETERS, MEMORY_PARAMETERS, const struct crossing *crossing,
                          const struct spot *spot, real t, real raw, mask where, real *r, real *g, real *b) {
    const struct cursor *cursor = spot->cursor;
    shade(FRAME_ARGUMENTS, spot->part, MEMORY_ARGUMENTS, &crossing->ray, crossing->t_first,
          SAMPLE_NUMBER(crossing, spot->c, t), cursor->ox + t * cursor->dx, cursor->oy + t * cursor->dy,
          cursor->oz + t * cursor->dz, raw, where, r, g, b);
}
#endif

#if MODELS_SEGMENT
// The lanes in which neither a cut-away box nor a mask has taken the spot's part away at a sample.
INLINE mask is_left(__constant struct world *world, MEMORY_PARAMETERS,
                    const struct crossing *crossing, const struct spot *spot, real t) {
    mask left = (mask)(-1);
#if CLIP
    const real number = SAMPLE_NUMBER(crossing, spot->c, t);
    left &= clip_keeps(world, spot->part, &crossing->ray,
                       crossing->t_first + number * world->step_mm);
#endif
#if MASKED
    const struct cursor *cursor = spot->cursor;
    left &= mask_keeps(world, spot->part, MEMORY_ARGUMENTS, cursor->ox + t * cursor->dx,
                       cursor->oy + t * cursor->dy, cursor->oz + t * cursor->dz);
#endif
    return left;
}

// The raw value one sample before the spot; lanes that have none are cleared in *known.
INLINE real raw_before(__constant struct world *world, MEMORY_PARAMETERS,
                       const struct crossing *crossing, const struct gathered *gathered,
                       const struct spot *spot, mask *known) {
    real before = gathered->raw[spot->c];
    *known = spot->present & MASK(spot->i > spot->cursor->first);
    const mask leapt = *known & MASK(gathered->at[spot->c] != spot->i - 1);
    if (any_lane(leapt)) {
        const real t = TO_REAL(cursor_clamp(spot->cursor, spot->i - 1));
        const struct sample sample = sample_between(MEMORY_ARGUMENTS, spot, t);
        before = CHOOSE(before, sample.raw, leapt);
#if CLIP || MASKED
        *known &= ~leapt | is_left(world, MEMORY_ARGUMENTS, crossing, spot, t);
#endif
    }
#if VOXELS & VOXELS_F32
    *known &= MASK(before == before);
#endif
    return before;
}

// After a segment that shows nothing: a segment leads out of empty space only behind the first
// sample that is not in it.
INLINE void leap_segments(__global const uchar *cells, const struct spot *spot) {
    struct cursor *cursor = spot->cursor;
    cursor->next =
        max(cursor_leap(spot->part, cells, cursor, spot->i, spot->present), spot->i + 1);
}
#endif

#if MODELS & MODELS_ISO
#if SHADING
// Where between the sample before and the spot the value is met, by halving the interval.
INLINE real find_surface(MEMORY_PARAMETERS, const struct spot *spot, real before, real value) {
    const integer at = cursor_clamp(spot->cursor, spot->i);
    real near = TO_REAL(max(at - 1, spot->cursor->first)), far = TO_REAL(at);
    const mask side = MASK(before < value);
    for (int n = 0; n < BISECTIONS; n++) {
        const real middle = 0.5f * (near + far);
        const struct sample sample = sample_between(MEMORY_ARGUMENTS, spot, middle);
        const mask same = ~(MASK(sample.raw < value) ^ side);
        near = CHOOSE(near, middle, same);
        far = CHOOSE(middle, far, same);
    }
    return 0.5f * (near + far);
}
#endif

// The surfaces between the sample before and the spot. True where there is one.
INLINE mask gather_surfaces(FRAME_PARAMETERS, MEMORY_PARAMETERS, struct gathered *gathered, const struct crossing *crossing,
                            const struct spot *spot, real raw) {
    mask known, met = (mask)(0);
    const real before = raw_before(world, MEMORY_ARGUMENTS, crossing, gathered, spot, &known);
    __constant struct part *part = spot->part;
    __constant const float *values = (__constant const float *)&part->surface_values;
    // In the order in which the ray meets them. Back to front each comes before those already
    // there.
    const mask upwards = MASK(raw > before);
    struct light own = no_light();
    for (int n = 0; n < part->surface_count; n++) {
        const int other = part->surface_count - 1 - n;
        const real value = CHOOSE((real)(values[other]), (real)(values[n]), upwards);
        const mask crossed = known & (MASK(before < value) ^ MASK(raw < value));
        if (!any_lane(crossed))
            continue;
        met |= crossed;
        const float4 up = part->surfaces[n], down = part->surfaces[other];
        real r = CHOOSE((real)(down.x), (real)(up.x), upwards);
        real g = CHOOSE((real)(down.y), (real)(up.y), upwards);
        real b = CHOOSE((real)(down.z), (real)(up.z), upwards);
        const real a = CHOOSE((real)(down.w), (real)(up.w), upwards);
#if SHADING
        if (part->shading != SHADING_NONE) {
            const real t = find_surface(MEMORY_ARGUMENTS, spot, before, value);
            shade_between(FRAME_ARGUMENTS, MEMORY_ARGUMENTS, crossing, spot, t, value, crossed, &r,
                          &g, &b);
        }
#endif
        const real shown = CHOOSE((real)(0.0f), a, crossed);
        struct light layer = {shown * r, shown * g, shown * b, shown};
#if MODELS & MODELS_BACKWARD
        light_behind(&layer, &own);
        own = layer;
#else
        light_behind(&own, &layer);
#endif
    }
    light_behind(&gathered->surfaces, &own);
    return met;
}
#endif
#endif

#endif
