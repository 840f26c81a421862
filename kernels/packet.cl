// packet.cl - one packet of rays, and what is counted of it.
//
// Included by render.cl.
#ifndef PACKET_CL
#define PACKET_CL

// The light that a packet's rays meet. Adds the samples they take to the packet's numbers.
INLINE struct light packet_light(__constant struct world *world, TABLE_SPACE const uint *table,
                                 __global const uchar *cells STRIDE_PARAMETER, MEMORY_PARAMETERS,
                                 const struct ray *ray, int left, int top, __global float4 *picture,
                                 __global uint *counts) {
    struct crossing crossing;
    find_crossing(world, cells, ray, &crossing);
    BEGIN_STRIDES(crossing);
    integer samples = (integer)(0);
    struct light light = {(real)(0.0f), (real)(0.0f), (real)(0.0f), (real)(0.0f)};
#if MODELS & MODELS_EMISSION
    light = follow_exactly(world, table, MEMORY_ARGUMENTS, ray, &samples);
    crossing.possible = samples;
#else
    if (HAS_SAMPLES(&crossing))
        light = follow_rays(world, table, cells, MEMORY_ARGUMENTS, &crossing, &samples);
#endif

    STORE_DEPTH(world, picture, left, top, ray, &crossing, &light);
    counts[SAMPLES_TAKEN] += (uint)sum_lanes(samples);
    counts[SAMPLES_POSSIBLE] += (uint)sum_lanes(crossing.possible);
    counts[SAMPLES_BEHIND] += (uint)sum_lanes(crossing.behind);
    counts[SAMPLES_SPARED] += SPARED(crossing);
    counts[PARTS_ENTERED] += (uint)crossing.count;
#if DEBUG
    light.r = debug_number(world, cells, &crossing, samples);
#endif
    return light;
}

// Puts the background behind what rays have met.
INLINE void add_background(struct light *light, __constant struct world *world) {
    const float4 behind = world->background;
    const real clear = 1.0f - light->a;
    light->r += clear * behind.x;
    light->g += clear * behind.y;
    light->b += clear * behind.z;
    light->a += clear * behind.w;
}

#endif
