// blend.cl - one layer behind another.
#ifndef BLEND_CL
#define BLEND_CL

#include "lanes.h"

// Premultiplied colour and opacity of each lane, accumulated front to back.
struct light {
    real r, g, b, a;
};

// Puts a layer of straight colour and opacity a behind what has been gathered.
INLINE void light_add(struct light *light, real r, real g, real b, real a) {
    const real weight = (1.0f - light->a) * a;
    light->r += weight * r;
    light->g += weight * g;
    light->b += weight * b;
    light->a += weight;
}

// Puts the premultiplied background behind everything.
INLINE void light_end(struct light *light, float4 behind) {
    const real clear = 1.0f - light->a;
    light->r += clear * behind.x;
    light->g += clear * behind.y;
    light->b += clear * behind.z;
    light->a += clear * behind.w;
}

#endif
