// worker.h - renders beside the event loop.
//
// One thread owns the renderers. It is given requests, of which only the newest counts, and hands
// back pictures, of which only the newest is kept. While things move, a request gets one picture,
// as good as can be had in the time for a frame; at rest it is refined up to the scene's own
// quality. A new request abandons a refinement at once, and a quick picture only when that takes
// far longer than it should: else a hand that never stops would never see anything.
//
// All functions are for the thread that created the worker.
#ifndef PEL_VIEWER_WORKER_H
#define PEL_VIEWER_WORKER_H

#include "viewer/request.h"

enum { PEL_WORKER_SENTENCE = 512 };

// What the worker is doing.
struct pel_worker_status {
    bool busy;
    double finished, running_ms;        // of the frame in flight
    char sentence[PEL_WORKER_SENTENCE]; // why the newest request failed, or ""
    char saved[PEL_WORKER_SENTENCE];    // what became of the newest picture that was saved
    int saved_count;                    // how many were, or failed
};

// Starts the thread, which opens the device by itself: that it cannot is a sentence in the status.
// `wake` is called from the thread whenever there is something new. Where devices can, pictures are
// left in what `lender` lends, which may be NULL. NULL when no thread can be had.
struct pel_worker *pel_worker_create(const struct pel_renderer_options *options,
                                     struct pel_lender *lender, void (*wake)(void));
void pel_worker_destroy(struct pel_worker *worker);

// Takes the request's scenes.
void pel_worker_submit(struct pel_worker *worker, const struct pel_request *request);

// Saves a picture of the scene, which it takes, at its own size and quality, before it goes on with
// the requests. False when memory ran out or too many wait already; the scene is then destroyed.
bool pel_worker_save(struct pel_worker *worker, struct pel_scene *scene, const char *path);

// The newest picture if there is one that was not taken yet, else NULL. The caller owns it.
struct pel_picture *pel_worker_take(struct pel_worker *worker);

void pel_worker_ask(struct pel_worker *worker, struct pel_worker_status *status);

#endif
