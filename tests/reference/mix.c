// mix.c - docs/picture.md, "Mixing".
//
// Blending is associative: (C, A) behind all samples so far is the same whether the media of `over`
// are put there one by one or put together to a layer first. So both kinds of mixing make a layer.
#include "reference/mix.h"

#include <math.h>

static void mix_sum(double layer[4], const struct reference_medium *media, int count,
                    double step_mm) {
    double extinction = 0, weighted[3] = {0};
    for (int k = 0; k < count; k++) {
        extinction += media[k].extinction;
        for (int c = 0; c < 3; c++)
            weighted[c] += media[k].extinction * media[k].rgb[c];
    }
    layer[3] = 1 - exp(-extinction * step_mm);
    for (int c = 0; c < 3; c++)
        layer[c] = extinction > 0 ? layer[3] * weighted[c] / extinction : 0;
}

static void mix_over(double layer[4], const struct reference_medium *media, int count,
                     double step_mm) {
    for (int c = 0; c < 4; c++)
        layer[c] = 0;
    for (int k = 0; k < count; k++) {
        double alpha = 1 - exp(-media[k].extinction * step_mm);
        double own[4] = {alpha * media[k].rgb[0], alpha * media[k].rgb[1], alpha * media[k].rgb[2],
                         alpha};
        reference_compose(layer, layer, own);
    }
}

void reference_mix(double layer[4], enum pel_mixing mixing, const struct reference_medium *media,
                   int count, double step_mm) {
    if (mixing == PEL_MIX_SUM)
        mix_sum(layer, media, count, step_mm);
    else
        mix_over(layer, media, count, step_mm);
}

void reference_compose(double result[4], const double front[4], const double back[4]) {
    double shines_through = 1 - front[3];
    for (int c = 0; c < 4; c++)
        result[c] = front[c] + shines_through * back[c];
}
