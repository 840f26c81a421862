// latency.c - measures how long it takes from an input to a picture that shows it.
#include "viewer/latency.h"

#include <stdlib.h>

// After a quick picture was seen, the worker has this long to get into the middle of a refinement.
static const double pause_ms = 400;

struct pel_latency {
    int wanted, count;
    double *ms;       // owned; of each input
    bool waiting;     // for the picture of an input
    bool began;       // the first complete picture was seen
    double put_ms;    // when the input came
    uint64_t version; // of the scene before it
    uint64_t first;   // ... and before the first one
    double next_ms;   // when the next input comes
    double full_ms;   // of the longest frame of full quality
    int unfinished;   // inputs that came while a frame was in flight
    double x;         // where the pointer is
};

struct pel_latency *pel_latency_create(int inputs) {
    struct pel_latency *latency = calloc(1, sizeof *latency);
    if (!latency)
        return NULL;
    latency->wanted = inputs;
    latency->ms = calloc((size_t)inputs, sizeof *latency->ms);
    if (!latency->ms) {
        free(latency);
        return NULL;
    }
    return latency;
}

void pel_latency_destroy(struct pel_latency *latency) {
    if (!latency)
        return;
    free(latency->ms);
    free(latency);
}

bool pel_latency_is_over(const struct pel_latency *latency) {
    return latency->count == latency->wanted;
}

// The button goes down once, and then the pointer moves a little for each input.
static void put_input(struct pel_latency *latency, struct pel_state *state) {
    const struct pel_rectangle *place = &state->views[0].place;
    struct pel_event event = {.x = place->x + place->width / 2.0 + latency->x,
                              .y = place->y + place->height / 2.0};
    if (latency->count == 0) {
        latency->first = state->version;
        event.kind = PEL_EVENT_BUTTON;
        event.down = true;
        pel_event_push(&state->queue, &event);
    }
    latency->x += 7;
    event.x += 7;
    event.kind = PEL_EVENT_POINTER;
    pel_event_push(&state->queue, &event);
    latency->version = state->version;
    latency->unfinished += state->status.busy;
    latency->put_ms = pel_clock_ms();
    latency->waiting = true;
}

void pel_latency_begin_turn(struct pel_latency *latency, struct pel_state *state) {
    if (!latency->began) {
        latency->began = state->shown_count > 0 && state->shown.final;
        latency->next_ms = pel_clock_ms() + pause_ms;
        if (latency->began)
            latency->full_ms = state->shown.frame_ms;
        return;
    }
    if (!latency->waiting && !pel_latency_is_over(latency) && pel_clock_ms() >= latency->next_ms)
        put_input(latency, state);
}

void pel_latency_end_turn(struct pel_latency *latency, const struct pel_state *state) {
    if (!latency->waiting || state->shown.id <= latency->version)
        return;
    double now_ms = pel_clock_ms();
    latency->ms[latency->count++] = now_ms - latency->put_ms;
    latency->waiting = false;
    latency->next_ms = now_ms + pause_ms;
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void pel_latency_report(const struct pel_latency *latency, const struct pel_state *state,
                        struct pel_viewer_latency *result) {
    int count = latency->count;
    qsort(latency->ms, (size_t)count, sizeof *latency->ms, compare);
    result->measured = count;
    result->in_flight = latency->unfinished;
    result->full_ms = latency->full_ms;
    result->median_ms = count ? latency->ms[count / 2] : 0;
    result->worst_ms = count ? latency->ms[count - 1] : 0;
    // Each input is one change of the scene.
    result->lost = count - (int)(state->version - latency->first);
}
