// latency.h - measures how long it takes from an input to a picture that shows it.
//
// Inputs are put into the queue one by one, each while the worker is refining the picture of the
// one before, which is the worst moment: the frame in flight has to be given up first.
#ifndef PEL_VIEWER_LATENCY_H
#define PEL_VIEWER_LATENCY_H

#include "viewer/state.h"

struct pel_latency;

// Measures `inputs` of them. NULL: memory ran out.
struct pel_latency *pel_latency_create(int inputs);
void pel_latency_destroy(struct pel_latency *latency);

// A turn of the loop begins: perhaps it is time for an input.
void pel_latency_begin_turn(struct pel_latency *latency, struct pel_state *state);

// The windows were just shown.
void pel_latency_end_turn(struct pel_latency *latency, const struct pel_state *state);

// All were measured; the result goes to the viewer's options.
bool pel_latency_is_over(const struct pel_latency *latency);
void pel_latency_report(const struct pel_latency *latency, const struct pel_state *state,
                        struct pel_viewer_latency *result);

#endif
