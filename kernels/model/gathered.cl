// gathered.cl - what a ray remembers of the parts it crosses, and how layers of light are put together.
#ifndef GATHERED_CL
#define GATHERED_CL

#include "classify.cl"
#include "pixel.cl"
#include "span.cl"

#define MODELS_SEGMENT (MODELS & (MODELS_ISO | MODELS_PREINTEGRATED))

#if MODELS

// A part's projection so far.
struct projection {
    real raw;           // its extremum, or the sum of its values
    real count;         // of a sum
    integer at;         // the sample at which it stands; -1: nowhere yet
    struct light front; // the light gathered before that
#if VOXELS & VOXELS_RGBA
    real r, g, b;
#endif
};

// What a ray remembers of each part it crosses.
struct gathered {
#if MODELS_SEGMENT
    real raw[CAPACITY]; // of the last sample, and its number
    integer at[CAPACITY];
#endif
#if MODELS & MODELS_PROJECTION
    struct projection projections[CAPACITY];
#endif
    int met;               // parts that are remembered
    struct light surfaces; // of the present sample, in the order of the list; they come first
    struct light media;    // and everything else
};

// A sample of a part on its way into the picture.
struct spot {
    __constant struct part *part;
    struct cursor *cursor;
    int c;     // index of both in the crossing
    integer i; // the sample's number
    mask present;
};

INLINE struct light no_light(void) {
    const real zero = (real)(0.0f);
    const struct light light = {zero, zero, zero, zero};
    return light;
}

// Puts a layer behind what has been gathered.
INLINE void light_behind(struct light *light, const struct light *layer) {
    const real clear = 1.0f - light->a;
    light->r += clear * layer->r;
    light->g += clear * layer->g;
    light->b += clear * layer->b;
    light->a += clear * layer->a;
}

// Remembers the parts that the packet has come to since it was asked last.
INLINE void gathered_meet(struct gathered *gathered, const struct crossing *crossing) {
    for (int c = gathered->met; c < COUNTED(crossing->count); c++) {
#if MODELS_SEGMENT
        gathered->raw[c] = (real)(0.0f);
        gathered->at[c] = (integer)(-2);
#endif
#if MODELS & MODELS_PROJECTION
        struct projection *projection = &gathered->projections[c];
        projection->raw = projection->count = (real)(0.0f);
        projection->at = (integer)(-1);
        projection->front = no_light();
#if VOXELS & VOXELS_RGBA
        projection->r = projection->g = projection->b = (real)(0.0f);
#endif
#endif
    }
    gathered->met = COUNTED(crossing->count);
}

INLINE void gathered_begin(struct gathered *gathered, const struct crossing *crossing) {
    gathered->met = 0;
    gathered_meet(gathered, crossing);
    gathered->surfaces = gathered->media = no_light();
}

// Joins what the sample shows to the light of the ray.
INLINE void gathered_join(struct gathered *gathered, struct light *light) {
#if MODELS & MODELS_BACKWARD
    light_behind(&gathered->surfaces, light);
    light_behind(&gathered->media, &gathered->surfaces);
    *light = gathered->media;
#else
    light_behind(light, &gathered->surfaces);
    light_behind(light, &gathered->media);
#endif
    gathered->surfaces = gathered->media = no_light();
}
#endif

#endif
