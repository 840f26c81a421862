// resolve.cl - supersampling's two passes over pixels: where more rays are needed, and how rays
// become a picture.
//
// Between them stand launches of render.cl, each of which leaves the light of one ray of every
// pixel.
#ifndef RESOLVE_CL
#define RESOLVE_CL

#include "shared/pattern.h"
#include "shared/world.h"

// Marks the pixels that differ from one of their eight neighbours by more than the threshold, in
// any channel.
__kernel void refine(__constant struct world *world, __global const float4 *light, __global uchar *refined,
                     const uint first) {
    const int pixel = (int)(get_global_id(0) + first);
    const int x = pixel % world->width, row = pixel / world->width;
    const int y = row % world->height, top = row - y; // in the picture of the pixel's eye
    if (top >= world->pictures * world->height)
        return;
    float4 contrast = (float4)(0.0f);
    for (int y_near = max(y - 1, 0); y_near <= min(y + 1, world->height - 1); y_near++)
        for (int x_near = max(x - 1, 0); x_near <= min(x + 1, world->width - 1); x_near++)
            contrast = fmax(contrast, fabs(light[(top + y_near) * world->width + x_near] - light[pixel]));
    refined[pixel] = fmax(fmax(contrast.x, contrast.y), fmax(contrast.z, contrast.w)) > world->contrast;
}

// The weight of a ray this far from a pixel's centre along one axis: a Gaussian of half a pixel,
// lowered so that it ends at one and a half.
static inline float gaussian(float distance) {
    return fmax(exp(-2.0f * distance * distance) - exp(-4.5f), 0.0f);
}

// Adds ray `number` of every pixel to the picture, and with the last divides by the sum of the
// weights.
__kernel void resolve(__constant struct world *world, __global const float4 *light, __global float4 *picture,
                      __global float *weights, const uint number, const uint first) {
    const int pixel = (int)(get_global_id(0) + first);
    const int x = pixel % world->width, row = pixel / world->width;
    const int y = row % world->height, top = row - y; // in the picture of the pixel's eye
    if (top >= world->pictures * world->height)
        return;
    float4 sum = number == 0 ? (float4)(0.0f) : picture[pixel];
    float weight_sum = number == 0 ? 0.0f : weights[pixel];
    if (world->reconstruction == RECONSTRUCTION_BOX) {
        sum += light[pixel];
        weight_sum += 1.0f;
    } else {
        for (int y_near = max(y - 1, 0); y_near <= min(y + 1, world->height - 1); y_near++) {
            for (int x_near = max(x - 1, 0); x_near <= min(x + 1, world->width - 1); x_near++) {
                const uint key = pattern_key(world->seed, world->left + x_near, world->top + y_near);
                const struct pattern_place place =
                    pattern_place(world->pattern, world->rays_n, key, number);
                const float weight =
                    gaussian((float)(x_near - x) + (float)place.x * 0x1p-24f - 0.5f) *
                    gaussian((float)(y_near - y) + (float)place.y * 0x1p-24f - 0.5f);
                sum += weight * light[(top + y_near) * world->width + x_near];
                weight_sum += weight;
            }
        }
    }
    const bool last = number + 1 == (uint)(world->rays_n * world->rays_n);
    picture[pixel] = last ? sum / weight_sum : sum;
    weights[pixel] = weight_sum;
}

#endif
