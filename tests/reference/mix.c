// mix.c - docs/mixing.md.
//
// Blending is associative: (C, A) behind all samples so far is the same whether the media of `over`
// are put there one by one or put together to a layer first. So every kind of mixing makes a layer.
#include "reference/mix.h"

#include <math.h>

// The media as one medium, whose colour is the mean weighted by extinction.
static struct reference_medium mean(const struct reference_medium *media, int count) {
    struct reference_medium sum = {0};
    for (int k = 0; k < count; k++) {
        sum.extinction += media[k].extinction;
        for (int c = 0; c < 3; c++)
            sum.rgb[c] += media[k].extinction * media[k].rgb[c];
    }
    for (int c = 0; c < 3; c++)
        sum.rgb[c] = sum.extinction > 0 ? sum.rgb[c] / sum.extinction : 0;
    return sum;
}

// The first of those with the greatest extinction, or with the greatest priority among the visible.
static struct reference_medium winner(const struct reference_medium *media, int count,
                                      bool by_priority) {
    struct reference_medium best = {0};
    for (int k = 0; k < count; k++) {
        if (media[k].extinction == 0)
            continue;
        bool better =
            by_priority ? media[k].priority > best.priority : media[k].extinction > best.extinction;
        if (best.extinction == 0 || better)
            best = media[k];
    }
    return best;
}

static struct reference_medium mix_union(const struct reference_medium *media, int count) {
    struct reference_medium whole = mean(media, count);
    whole.extinction = 0;
    for (int k = 0; k < count; k++)
        whole.extinction = fmax(whole.extinction, media[k].extinction);
    return whole;
}

// Of `total` media in the scene, those that are missing have no extinction.
static struct reference_medium intersection(const struct reference_medium *media, int count,
                                            int total) {
    struct reference_medium whole = mean(media, count);
    whole.extinction = count == total ? INFINITY : 0;
    for (int k = 0; k < count; k++)
        whole.extinction = fmin(whole.extinction, media[k].extinction);
    return whole;
}

static struct reference_medium difference(const struct reference_medium *media, int count) {
    struct reference_medium rest = {0};
    for (int k = 0; k < count; k++)
        if (media[k].body == 0)
            rest = media[k];
    for (int k = 0; k < count; k++)
        if (media[k].body != 0)
            rest.extinction = fmax(0, rest.extinction - media[k].extinction);
    return rest;
}

static void mix_over(double layer[4], const struct reference_medium *media, int count) {
    for (int c = 0; c < 4; c++)
        layer[c] = 0;
    for (int k = 0; k < count; k++) {
        double own[4];
        reference_layer(own, &media[k]);
        reference_compose(layer, layer, own);
    }
}

void reference_layer(double layer[4], const struct reference_medium *medium) {
    layer[3] = 1 - exp(-medium->extinction * medium->step_mm);
    for (int c = 0; c < 3; c++)
        layer[c] = layer[3] * medium->rgb[c];
}

void reference_mix(double layer[4], enum pel_mixing mixing, const struct reference_medium *media,
                   int count, int total) {
    struct reference_medium whole = {0};
    switch (mixing) {
    case PEL_MIX_OVER:
    case PEL_MIX_ORDERED:
        mix_over(layer, media, count);
        return;
    case PEL_MIX_SUM:
        whole = mean(media, count);
        break;
    case PEL_MIX_MAX:
    case PEL_MIX_PRIORITY:
        whole = winner(media, count, mixing == PEL_MIX_PRIORITY);
        break;
    case PEL_MIX_UNION:
        whole = mix_union(media, count);
        break;
    case PEL_MIX_INTERSECTION:
        whole = intersection(media, count, total);
        break;
    case PEL_MIX_DIFFERENCE:
        whole = difference(media, count);
        break;
    }
    // All but mixing in order have one step for all.
    whole.step_mm = count > 0 ? media[0].step_mm : 0;
    reference_layer(layer, &whole);
}

void reference_compose(double result[4], const double front[4], const double back[4]) {
    double shines_through = 1 - front[3];
    for (int c = 0; c < 4; c++)
        result[c] = front[c] + shines_through * back[c];
}
