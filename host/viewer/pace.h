// pace.h - how good a picture may be to be ready in time.
//
// The cost of a frame is taken to be proportional to its rays times the samples along each:
// pixels x rays a pixel / step. What a unit of that costs on this device, for this scene, is
// learned from each frame.
#ifndef PEL_VIEWER_PACE_H
#define PEL_VIEWER_PACE_H

#include <stdbool.h>

#include "pellucid.h"

// How a frame differs from what its scene asks for. The scene's own is {1, 1, its n}.
struct pel_quality {
    int divisor;        // of width and height; >= 1
    double step_factor; // >= 1
    int supersampling;  // n x n rays a pixel; >= 1
};

// Starts as {0}: nothing is known.
struct pel_pace {
    double ms_per_unit;
};

// The settings of a frame of this quality.
struct pel_render_settings pel_pace_apply(const struct pel_render_settings *settings,
                                          const struct pel_quality *quality);

// What shows the settings' region of a picture that was made with the applied ones, which may cover
// a little more: left and top edge, width and height, in shares of the picture.
void pel_pace_part(const struct pel_render_settings *settings,
                   const struct pel_render_settings *applied, double part[4]);

// What a frame of this quality will take; 0 when nothing was learned yet.
double pel_pace_estimate(const struct pel_pace *pace, const struct pel_render_settings *settings,
                         const struct pel_quality *quality);

// Learns that a frame of this quality took `ms`, or would have.
void pel_pace_learn(struct pel_pace *pace, const struct pel_render_settings *settings,
                    const struct pel_quality *quality, double ms);

// The best quality, without supersampling, that keeps to `target_ms`. A cautious one while nothing
// is known.
struct pel_quality pel_pace_choose(const struct pel_pace *pace,
                                   const struct pel_render_settings *settings, double target_ms);

// The next better quality on the way to the scene's own, leaving out those that are not worth
// showing because what comes after them is nearly as quick. False when `shown` is the scene's own.
bool pel_pace_refine(const struct pel_pace *pace, const struct pel_render_settings *settings,
                     const struct pel_quality *shown, struct pel_quality *next);

#endif
