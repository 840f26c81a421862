// hypertexture.cl - bakes hypertextures into voxels: their recipe at the centre of each.
#include "recipe_run.cl"

// Writes the values of `count` voxels from number `first` on, i fastest.
__kernel void bake(__constant struct recipe *recipe, __global const float *object,
                   __global float *values, const uint first, const uint count) {
    const uint i = get_global_id(0);
    if (i >= count)
        return;
    const ulong voxel = (ulong)first * BAKE_ROUND + i;
    const ulong row = voxel / (ulong)recipe->grid_dims.x;
    const float3 at = (float3)((float)(voxel % (ulong)recipe->grid_dims.x),
                               (float)(row % (ulong)recipe->grid_dims.y),
                               (float)(row / (ulong)recipe->grid_dims.y));
    values[i] = run_recipe(recipe, object, recipe->grid_start.xyz + at * recipe->grid_step.xyz);
}
