// strength.c - a transfer function's table as a kernel reads it.
//
// Reading a fine table at its nearest entry costs one look-up where interpolating a coarse one
// costs two and a product. Between two entries it is wrong by half their difference at most, so
// functions without steep ramps get a fine table, and steep ones a kernel that interpolates.
#include "world/strength.h"

#include <math.h>
#include <string.h>

#include "shared/variant.h"

// Half of either difference is the largest error of one sample: in opacity, and in a colour's share
// of it.
static const double gentle_opacity = 1.0 / 512;
static const double gentle_colour = 1.0 / 64;

static const int linear_refinement = 4;

int pel_strength_refinement(const struct pel_table *table, bool linear) {
    int most = (PEL_STRENGTH_ENTRIES - 1) / (table->entry_count - 1);
    if (table->nearest || most < 1)
        return 1;
    return linear && most > linear_refinement ? linear_refinement : most;
}

// The straight colour and opacity at `part` of `parts` between entry j and the next.
static void between(double rgba[4], const struct pel_table *table, int j, int part, int parts) {
    int next = j + 1 < table->entry_count ? j + 1 : j;
    double weight = (double)part / parts;
    for (int c = 0; c < 4; c++)
        rgba[c] = table->rgba[j][c] + weight * ((double)table->rgba[next][c] - table->rgba[j][c]);
}

// Only absorption is a matter of length; emission is dark where the colour is, whatever the
// opacity.
static double strength(const double rgba[4], const struct pel_strength_rule *rule) {
    double opacity = rgba[3];
    switch (rule->model) {
    case MODEL_EMISSION:
        return fmax(rgba[0], fmax(rgba[1], rgba[2])) > 0 ? rule->emission * rule->density : 0;
    case MODEL_MIP:
    case MODEL_MINIP:
    case MODEL_AVERAGE:
        return opacity;
    case MODEL_THESIS:
        return fmin(opacity * rule->density, 1);
    default:
        break;
    }
    double depth =
        -log1p(-fmin(opacity, 1 - 0x1p-24)) / rule->opacity_unit_mm * rule->density * rule->step_mm;
    return rule->depth ? depth : -expm1(-depth);
}

void pel_strength_write(u32 *words, const struct pel_table *table, int refinement,
                        const struct pel_strength_rule *rule) {
    int count = (table->entry_count - 1) * refinement + 1;
    for (int i = 0; i < count; i++) {
        double rgba[4];
        between(rgba, table, i / refinement, i % refinement, refinement);
        float value = (float)strength(rgba, rule);
        memcpy(&words[PEL_STRENGTH_WORDS * i], &value, sizeof value);
        u32 colour = 0;
        for (int c = 0; c < 3; c++)
            colour |= (u32)lrint(fmin(fmax(rgba[c], 0), 1) * 1023) << (10 * c);
        words[PEL_STRENGTH_WORDS * i + 1] = colour;
    }
}

bool pel_strength_is_gentle(const struct pel_table *table, const struct pel_strength_rule *rule) {
    if (table->nearest || rule->model == MODEL_ISO || rule->model == MODEL_PREINTEGRATED)
        return true;
    struct pel_strength_rule opacity_rule = *rule;
    opacity_rule.depth = false;
    int refinement = pel_strength_refinement(table, false);
    double last[4], last_opacity = 0;
    for (int i = 0; i <= (table->entry_count - 1) * refinement; i++) {
        double rgba[4];
        between(rgba, table, i / refinement, i % refinement, refinement);
        double opacity = strength(rgba, &opacity_rule);
        if (i > 0) {
            if (fabs(opacity - last_opacity) > gentle_opacity)
                return false;
            for (int c = 0; c < 3; c++)
                if (fabs(rgba[c] - last[c]) * fmax(opacity, last_opacity) > gentle_colour)
                    return false;
        }
        memcpy(last, rgba, sizeof last);
        last_opacity = opacity;
    }
    return true;
}
