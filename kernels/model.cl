// model.cl - how light is gathered where a volume does not simply emit and absorb.
//
// What a sample shows is put together to a layer, which then joins the light of the ray: behind it,
// or before it where rays are followed back to front. See docs/picture.md, "Optical models".
// Sources: Max 1995; Romero 2009.
#ifndef MODEL_CL
#define MODEL_CL

#include "model/gathered.cl"
#include "model/projection.cl"
#include "model/segment.cl"
#include "model/surface.cl"

#if MODELS
#if MODELS & MODELS_THESIS
// Romero's compositing: the colour of a sample times the density, whatever length it stands for.
// Wrong by design: front to back, opacity does not weigh the colour.
INLINE mask gather_thesis(struct gathered *gathered, const struct spot *spot, real r, real g, real b,
                          real strength) {
    const real zero = (real)(0.0f);
#if MODELS & MODELS_BACKWARD
    const real weight = strength;
    const mask visible = spot->present & MASK(strength > 0.0f);
#else
    const real weight = (real)(spot->part->density);
    const mask visible = spot->present & (MASK(strength > 0.0f) | MASK(weight * (r + g + b) > 0.0f));
#endif
    const struct light layer = {CHOOSE(zero, weight * r, visible), CHOOSE(zero, weight * g, visible),
                                CHOOSE(zero, weight * b, visible), CHOOSE(zero, strength, visible)};
    light_behind(&gathered->media, &layer);
    return visible;
}
#endif

// Gathers a sample of a part that is not one of plain absorption. True where the ray has to go on
// step by step.
INLINE mask gather(__constant struct world *world, TABLE_SPACE const uint *table,
                   __global const uchar *cells, MEMORY_PARAMETERS, struct gathered *gathered,
                   const struct crossing *crossing, const struct light *light,
                   struct mixture *mixture, const struct sample *sample, struct spot spot) {
#if VOXELS & VOXELS_F32
    spot.present &= MASK(sample->raw == sample->raw);
#endif
    mask seen = (mask)(0);
#if MODELS & MODELS_ISO
    if (spot.part->model == MODEL_ISO) {
        seen = gather_surfaces(FRAME_ARGUMENTS, MEMORY_ARGUMENTS, gathered, crossing, &spot, sample->raw);
        gathered->raw[spot.c] = CHOOSE(gathered->raw[spot.c], sample->raw, spot.present);
        gathered->at[spot.c] = CHOOSE(gathered->at[spot.c], spot.i, spot.present);
        leap_segments(cells, &spot);
        return seen;
    }
#endif
#if MODELS & MODELS_PREINTEGRATED
    if (spot.part->model == MODEL_PREINTEGRATED) {
        real strength, r, g, b;
        seen = gather_segment(world, table, MEMORY_ARGUMENTS, crossing, gathered, &spot, sample->raw,
                              &strength, &r, &g, &b);
        gathered->raw[spot.c] = CHOOSE(gathered->raw[spot.c], sample->raw, spot.present);
        gathered->at[spot.c] = CHOOSE(gathered->at[spot.c], spot.i, spot.present);
        if (!any_lane(seen)) {
            leap_segments(cells, &spot);
            return seen;
        }
#if SHADING
        if (spot.part->shading != SHADING_NONE) {
            const real t = TO_REAL(cursor_clamp(spot.cursor, spot.i));
            shade_between(FRAME_ARGUMENTS, MEMORY_ARGUMENTS, crossing, &spot, t,
                          CHOOSE((real)(0.0f), sample->raw, spot.present), seen, &r, &g, &b);
        }
#endif
        mix_add(mixture, &gathered->media, spot.part, r, g, b, strength);
        return seen;
    }
#endif
#if MODELS & (MODELS_THESIS | MODELS_PROJECTION)
    mask present = spot.present;
    const struct entry entry = find_entry(table, spot.part, sample->raw, &present);
#if MODELS & MODELS_THESIS
    if (spot.part->model == MODEL_THESIS) {
        real r, g, b;
        entry_colour(&entry, &r, &g, &b);
#if VOXELS & VOXELS_RGBA
        if (IS_CLASS(spot.part, VOXELS_RGBA)) {
            r = sample->r;
            g = sample->g;
            b = sample->b;
        }
#endif
        seen = gather_thesis(gathered, &spot, r, g, b, entry.strength);
    }
#endif
#if MODELS & MODELS_PROJECTION
    if (IS_PROJECTION(spot.part)) {
        gather_projection(gathered, light, &spot, sample);
        seen = present & MASK(entry.strength > 0.0f);
    }
#endif
    if (!any_lane(seen))
        spot.cursor->next = cursor_leap(spot.part, cells, spot.cursor, spot.i + 1, present);
#endif
    return seen;
}
#endif

#endif
