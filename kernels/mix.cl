// mix.cl - how volumes that overlap share a sample.
//
// What is visible at one sample is put into a mixture, one part after the other in the order of the
// scene's list, and the mixture then becomes a layer behind the light gathered so far. See
// docs/picture.md, "Mixing".
#ifndef MIX_CL
#define MIX_CL

#include "pixel.cl"
#include "span.cl"

#ifndef MIXING
#define MIXING MIXING_SUM // how volumes that overlap share a sample
#endif

// 1: strengths are optical depths of a step, 0: opacities. With one part there is nothing to add
// up.
#define STRENGTH_DEPTH (MIXING == MIXING_SUM && CAPACITY > 1)

// The parts of one sample: with STRENGTH_DEPTH depths `a`, and colours weighted by them; otherwise
// nothing, as each part is a layer of its own.
struct mixture {
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

INLINE struct mixture mix_begin(void) {
    const real zero = (real)(0.0f);
    const struct mixture mixture = {zero, zero, zero, zero};
    return mixture;
}

// Adds a part's straight colour and strength at the sample; 0 in lanes where it is not visible.
INLINE void mix_add(struct mixture *mixture, struct light *light, real r, real g, real b,
                    real strength) {
#if STRENGTH_DEPTH
    mixture->r += strength * r;
    mixture->g += strength * g;
    mixture->b += strength * b;
    mixture->a += strength;
#else
    light_add(light, r, g, b, strength);
#endif
}

// Puts what the mixture makes of its parts behind what has been gathered.
INLINE void mix_end(const struct mixture *mixture, struct light *light) {
#if STRENGTH_DEPTH
    const real share = 1.0f / fmax(mixture->a, FLT_MIN);
    light_add(light, mixture->r * share, mixture->g * share, mixture->b * share,
              1.0f - exp(-mixture->a));
#endif
}

#endif
