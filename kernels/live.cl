// live.cl - volumes without voxels: a hypertexture's recipe is worked out at every sample.
//
// A position in memory coordinates is one of the recipe, so a live volume and the same one baked to
// a grid of any size lie in one place. Each lane runs the interpreter by itself.
// Included by sample.cl.
#ifndef LIVE_CL
#define LIVE_CL

#include "recipe_run.cl"

INLINE struct sample sample_live(MEMORY_PARAMETERS, __constant struct part *part, real x, real y,
                                 real z) {
    __constant struct recipe *recipe = &recipes[part->recipe - 1];
    __global const float *object = objects + recipe->object_offset;
    float raw[LANES], xs[LANES], ys[LANES], zs[LANES];
#if LANES == 1
    xs[0] = x;
    ys[0] = y;
    zs[0] = z;
#else
    STORE_LANES(x, xs);
    STORE_LANES(y, ys);
    STORE_LANES(z, zs);
#endif
    for (int lane = 0; lane < LANES; lane++) {
        const float3 voxel = (float3)(xs[lane], ys[lane], zs[lane]) - part->memory_from_voxel.xyz;
        const float density = run_recipe(
            recipe, object, recipe->grid_start.xyz + voxel * recipe->grid_step.xyz);
        // What is infinite is absent, as it is once baked.
        raw[lane] = isfinite(density) ? density : NAN;
    }
#define LIVE_LANE(lane) raw[lane]
    struct sample sample;
    sample.raw = ALL_LANES(LIVE_LANE);
#undef LIVE_LANE
#if VOXELS & VOXELS_RGBA
    sample.r = sample.g = sample.b = (real)(1.0f);
#endif
    return sample;
}

#endif
