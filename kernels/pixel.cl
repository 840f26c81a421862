// pixel.cl - the rays of a packet's pixels, and where their light goes.
//
// As a rule a pixel has one ray, through its centre. With supersampling each launch follows one ray of
// every pixel, ray `number` of its pattern, and resolve.cl adds the launches up. When only contrast is refined, pixels
// without it keep the light of the ray through their centre, which the first launch left there.
#ifndef PIXEL_CL
#define PIXEL_CL

#include "ray.cl"
#include "shared/pattern.h"

#if SUPERSAMPLING
#define RAY_PARAMETERS , const uint number, __global const uchar *refined
#define RAY_ARGUMENTS , number, refined
#else
#define RAY_PARAMETERS
#define RAY_ARGUMENTS
#endif

// The index of the first pixel of an eye's picture.
#if EYES == EYES_BOTH || EYES == EYES_DEPTH
#define FIRST_PIXEL(world, eye) ((eye) * (world)->width * (world)->height)
#else
#define FIRST_PIXEL(world, eye) 0
#endif

// Premultiplied colour and opacity of each lane, accumulated front to back.
struct light {
    real r, g, b, a;
};

// Rays through places x and y of the picture of an eye, or of both, whose packet's first pixel is (left, top).
INLINE struct ray eye_rays(__constant struct world *world, int eye, int left, int top, real x, real y) {
#if EYES == EYES_WOVEN
    const struct ray first = camera_ray(world, &world->camera, x, y);
    const struct ray second = camera_ray(world, &world->second, x, y);
    const integer sum = (world->left + left + LANE_X) * world->weave_x +
                        (world->top + top + LANE_Y) * world->weave_y;
    return choose_rays(&first, &second, MASK((sum & 1) != 0));
#elif EYES == EYES_BOTH
    return camera_ray(world, eye ? &world->second : &world->camera, x, y);
#else
    return camera_ray(world, &world->camera, x, y);
#endif
}

// The rays of the packet whose first pixel is (left, top).
INLINE struct ray pixel_rays(__constant struct world *world, int eye, int left, int top RAY_PARAMETERS) {
    const real x = TO_REAL(world->left + left + LANE_X), y = TO_REAL(world->top + top + LANE_Y);
#if SUPERSAMPLING || JITTER
    float xs[LANES], ys[LANES], phases[LANES], runs[LANES];
#if SUPERSAMPLING
    const bool all = number == RAY_CENTRE || !(world->contrast > 0.0f);
#endif
    for (int lane = 0; lane < LANES; lane++) {
        const int x_px = left + lane % PACKET_W, y_px = top + lane / PACKET_W;
        phases[lane] = 0.0f;
        xs[lane] = ys[lane] = 0.5f;
#if SUPERSAMPLING
        const bool inside = x_px < world->width && y_px < world->height;
        const int pixel = inside ? FIRST_PIXEL(world, eye) + y_px * world->width + x_px : 0;
        runs[lane] = inside && (all || refined[pixel]) ? 1.0f : 0.0f;
        if (runs[lane] == 0.0f)
            continue;
#endif
        const uint key = pattern_key(world->seed, world->left + x_px, world->top + y_px);
#if SUPERSAMPLING
        const uint s = number == RAY_CENTRE ? 0 : number;
#else
        const uint s = 0;
#endif
        phases[lane] = (float)(pattern_draw(key, DRAW_PHASE + s) & 0xffffffu) * 0x1p-24f;
#if SUPERSAMPLING
        const struct pattern_place place = pattern_place(world->pattern, world->rays_n, key, s);
        xs[lane] = number == RAY_CENTRE ? 0.5f : (float)place.x * 0x1p-24f;
        ys[lane] = number == RAY_CENTRE ? 0.5f : (float)place.y * 0x1p-24f;
#endif
    }
#define X_IN_PIXEL(lane) xs[lane]
#define Y_IN_PIXEL(lane) ys[lane]
#define PHASE(lane) phases[lane]
#define RUNS(lane) runs[lane]
    struct ray ray =
        eye_rays(world, eye, left, top, x + ALL_LANES(X_IN_PIXEL), y + ALL_LANES(Y_IN_PIXEL));
#if JITTER
    ray.phase = ALL_LANES(PHASE);
#endif
#if SUPERSAMPLING
    ray.runs = MASK(ALL_LANES(RUNS) > 0.0f);
#endif
    return ray;
#else
    return eye_rays(world, eye, left, top, x + 0.5f, y + 0.5f);
#endif
}

// The samples of a packet that launches before this one have counted.
INLINE uint earlier_samples(__constant struct world *world, uint counted RAY_PARAMETERS) {
#if SUPERSAMPLING
    const bool first = number == RAY_CENTRE || (number == 0 && !(world->contrast > 0.0f));
    return first ? 0 : counted;
#else
    return 0;
#endif
}

// Stores in an eye's picture the light of the lanes that run and lie in the picture.
INLINE void store_pixels(__constant struct world *world, __global float4 *picture, int eye, int left,
                         int top, const struct ray *ray, const struct light *light) {
    picture += FIRST_PIXEL(world, eye);
#if LANES == 1
    picture[top * world->width + left] = (float4)(light->r, light->g, light->b, light->a);
#else
    float r[LANES], g[LANES], b[LANES], a[LANES];
    STORE_LANES(light->r, r);
    STORE_LANES(light->g, g);
    STORE_LANES(light->b, b);
    STORE_LANES(light->a, a);
#if SUPERSAMPLING
    float runs[LANES];
    STORE_LANES(AS_REAL(ray->runs), runs);
#endif
    for (int lane = 0; lane < LANES; lane++) {
        const int x = left + lane % PACKET_W, y = top + lane / PACKET_W;
#if SUPERSAMPLING
        if (as_int(runs[lane]) == 0)
            continue;
#endif
        if (x < world->width && y < world->height)
            picture[y * world->width + x] = (float4)(r[lane], g[lane], b[lane], a[lane]);
    }
#endif
}

#endif
