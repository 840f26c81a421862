// pace.c - how good a picture may be to be ready in time.
#include "viewer/pace.h"

#include <math.h>

// From the scene's own quality down. Each costs about half of the one before.
static const struct pel_quality ladder[] = {
    {1, 1, 1}, {1, 1.5, 1}, {1, 2, 1}, {2, 1, 1}, {2, 1.5, 1}, {2, 2, 1},  {3, 2, 1},
    {4, 2, 1}, {6, 2, 1},   {6, 3, 1}, {8, 3, 1}, {8, 4, 1},   {12, 4, 1}, {16, 4, 1},
};
enum { RUNGS = sizeof ladder / sizeof *ladder, FIRST_RUNG = 7 };

// A stage of refinement is worth showing when the next one takes longer than this.
static const double noticed_ms = 120;

// How much of what was learned before gives way to a quicker frame. A slower one counts at once.
static const double forgetting = 0.3;

static int own_supersampling(const struct pel_render_settings *settings) {
    return settings->supersampling.n > 1 ? settings->supersampling.n : 1;
}

static double units(const struct pel_render_settings *settings, const struct pel_quality *quality) {
    const int *region = settings->region;
    double pixels =
        region[2] > 0 ? (double)region[2] * region[3] : (double)settings->width * settings->height;
    double rays = (double)quality->supersampling * quality->supersampling;
    double steps = fmax(settings->step, 1e-3) * quality->step_factor;
    return pixels * rays / ((double)quality->divisor * quality->divisor) / steps;
}

struct pel_render_settings pel_pace_apply(const struct pel_render_settings *settings,
                                          const struct pel_quality *quality) {
    struct pel_render_settings applied = *settings;
    applied.width = (settings->width + quality->divisor - 1) / quality->divisor;
    applied.height = (settings->height + quality->divisor - 1) / quality->divisor;
    const int whole[2] = {settings->width, settings->height};
    const int fewer[2] = {applied.width, applied.height};
    // A region of fewer pixels covers what it covered before, and perhaps a little more.
    for (int axis = 0; axis < 2 && settings->region[2] > 0; axis++) {
        int64_t low = settings->region[axis], high = low + settings->region[2 + axis];
        applied.region[axis] = (int)(low * fewer[axis] / whole[axis]);
        applied.region[2 + axis] =
            (int)((high * fewer[axis] + whole[axis] - 1) / whole[axis]) - applied.region[axis];
    }
    applied.step *= quality->step_factor;
    applied.step_mm *= quality->step_factor;
    if (quality->supersampling < own_supersampling(settings))
        applied.supersampling.n = quality->supersampling;
    if (quality->supersampling == 1)
        applied.supersampling.adaptive = 0;
    return applied;
}

void pel_pace_part(const struct pel_render_settings *settings,
                   const struct pel_render_settings *applied, double part[4]) {
    const int whole[2] = {settings->width, settings->height};
    const int fewer[2] = {applied->width, applied->height};
    for (int axis = 0; axis < 2; axis++) {
        bool all = settings->region[2 + axis] == 0;
        double scale = (double)fewer[axis] / whole[axis];
        double low = settings->region[axis] * scale - applied->region[axis];
        double size = settings->region[2 + axis] * scale;
        part[axis] = all ? 0 : fmax(low / applied->region[2 + axis], 0);
        part[2 + axis] = all ? 1 : fmin(size / applied->region[2 + axis], 1 - part[axis]);
    }
}

double pel_pace_estimate(const struct pel_pace *pace, const struct pel_render_settings *settings,
                         const struct pel_quality *quality) {
    return pace->ms_per_unit * units(settings, quality);
}

void pel_pace_learn(struct pel_pace *pace, const struct pel_render_settings *settings,
                    const struct pel_quality *quality, double ms) {
    double per_unit = ms / units(settings, quality);
    if (pace->ms_per_unit == 0 || per_unit > pace->ms_per_unit)
        pace->ms_per_unit = per_unit;
    else
        pace->ms_per_unit += forgetting * (per_unit - pace->ms_per_unit);
}

struct pel_quality pel_pace_choose(const struct pel_pace *pace,
                                   const struct pel_render_settings *settings, double target_ms) {
    if (pace->ms_per_unit == 0)
        return ladder[FIRST_RUNG];
    int rung = 0;
    while (rung < RUNGS - 1 && pel_pace_estimate(pace, settings, &ladder[rung]) > target_ms)
        rung++;
    return ladder[rung];
}

bool pel_pace_refine(const struct pel_pace *pace, const struct pel_render_settings *settings,
                     const struct pel_quality *shown, struct pel_quality *next) {
    int n = own_supersampling(settings);
    const struct pel_quality stages[] = {{4, 2, 1}, {2, 1, 1}, {1, 1, 1}, {1, 1, n / 2}, {1, 1, n}};
    enum { STAGES = sizeof stages / sizeof *stages };
    double have = units(settings, shown);
    for (int i = 0; i < STAGES; i++) {
        // Half of 2 or 3 rays is the stage before.
        if ((i == 3 && n < 4) || (i == STAGES - 1 && n == 1))
            continue;
        bool last = i == STAGES - 1 || (i == 2 && n == 1);
        const struct pel_quality *after = &stages[i == 2 && n < 4 ? STAGES - 1 : i + 1];
        if (!(units(settings, &stages[i]) > have))
            continue;
        if (!last && pel_pace_estimate(pace, settings, after) < noticed_ms)
            continue;
        *next = stages[i];
        return true;
    }
    return false;
}
