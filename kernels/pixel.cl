// pixel.cl - the rays of a packet's pixels, and where their light goes.
//
// As a rule a pixel has one ray, through its centre. With supersampling each launch follows one ray
// of every pixel, ray `number` of its pattern, and resolve.cl adds the launches up. When only
// contrast is refined, pixels without it keep the light of the ray through their centre, which the
// first launch left there.
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

// The index of the first pixel of an eye's picture, and pixels from one of its rows to the next.
// With supersampling pictures lie above each other.
#if EYES == EYES_BOTH
#define FIRST_PIXEL(world, eye) ((eye) * (world)->eye_px)
#define ROW_PX(world) (world)->row_px
#else
#define FIRST_PIXEL(world, eye) (EYES == EYES_DEPTH ? (eye) * (world)->width * (world)->height : 0)
#define ROW_PX(world) (world)->width
#endif

// Premultiplied colour and opacity of each lane, accumulated front to back.
struct light {
    real r, g, b, a;
};

// Rays through places x and y of the picture of an eye, or of both, whose packet's first pixel is
// (left, top).
INLINE struct ray eye_rays(__constant struct world *world, int eye, int left, int top, real x, real y) {
#if EYES == EYES_WOVEN
    const integer sum = (world->left + left + LANE_X) * world->weave_x +
                        (world->top + top + LANE_Y) * world->weave_y;
    return camera_ray(world, MASK((sum & 1) != 0), x, y);
#elif EYES == EYES_BOTH || EYES == EYES_MERGED
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
        const int pixel = inside ? FIRST_PIXEL(world, eye) + y_px * ROW_PX(world) + x_px : 0;
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

#if LANES >= 8 && !SUPERSAMPLING
// Stores one row of a packet, four pixels.
INLINE void store_row(__global float4 *picture, float4 r, float4 g, float4 b, float4 a) {
    const float8 left = (float8)(r.x, g.x, b.x, a.x, r.y, g.y, b.y, a.y);
    const float8 right = (float8)(r.z, g.z, b.z, a.z, r.w, g.w, b.w, a.w);
    vstore16((float16)(left, right), 0, (__global float *)picture);
}
#endif

// Stores in an eye's picture the light of the lanes that run and lie in the picture.
INLINE void store_pixels(__constant struct world *world, __global float4 *picture, int eye, int left,
                         int top, const struct ray *ray, const struct light *light) {
    picture += FIRST_PIXEL(world, eye);
#if LANES == 1
    picture[top * ROW_PX(world) + left] = (float4)(light->r, light->g, light->b, light->a);
#else
#if LANES >= 8 && !SUPERSAMPLING
    // Most packets lie in the picture as a whole.
    if (left + PACKET_W <= world->width && top + PACKET_H <= world->height) {
        __global float4 *row = &picture[top * ROW_PX(world) + left];
        const int pitch = ROW_PX(world);
#if LANES == 8
        store_row(row, light->r.lo, light->g.lo, light->b.lo, light->a.lo);
        store_row(row + pitch, light->r.hi, light->g.hi, light->b.hi, light->a.hi);
#else
        store_row(row, light->r.lo.lo, light->g.lo.lo, light->b.lo.lo, light->a.lo.lo);
        store_row(row + pitch, light->r.lo.hi, light->g.lo.hi, light->b.lo.hi, light->a.lo.hi);
        store_row(row + 2 * pitch, light->r.hi.lo, light->g.hi.lo, light->b.hi.lo, light->a.hi.lo);
        store_row(row + 3 * pitch, light->r.hi.hi, light->g.hi.hi, light->b.hi.hi, light->a.hi.hi);
#endif
        return;
    }
#endif
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
            picture[y * ROW_PX(world) + x] = (float4)(r[lane], g[lane], b[lane], a[lane]);
    }
#endif
}

#endif
