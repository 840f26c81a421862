// worker.c - renders beside the event loop.
//
// The mutex guards `pending`, `ready` and the sentence, nothing else is shared but two atomics. The
// thread sleeps until there is a request, takes it, and works on it until it is refined or a newer
// one is pending.
#include "viewer/worker.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/crew.h"
#include "viewer/save.h"

// How soon a frame in flight notices a new request.
static const double batch_ms = 8;

// A quick picture that takes this many times what it should gives way.
static const double overdue = 2;

// A quick picture that will take this many times what it should is not waited for.
static const double too_late = 3;

enum { SAVES = 8 };

struct pel_worker {
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    struct pel_request pending; // view_count is 0 when there is none
    struct pel_picture *ready;
    char sentence[PEL_WORKER_SENTENCE];
    struct {
        struct pel_scene *scene; // owned
        char *path;              // owned
    } saves[SAVES];              // the oldest first
    int save_count, saved_count;
    char saved[PEL_WORKER_SENTENCE];
    bool quit, busy;
    double begin_ms; // of the frame in flight
    atomic_bool ending;
    atomic_bool overtaken;   // a request is pending, or the end is
    _Atomic double finished; // share of the frame in flight
    void (*wake)(void);      //

    // The thread's own.
    struct pel_crew *crew;
    struct pel_pace pace;
};

// One frame of all views of a request.
struct frame {
    struct pel_worker *worker;
    const struct pel_request *request;
    struct pel_quality quality;
    double begin_ms, patience_ms; // gives way to a new request only after this long
    double limit_ms;              // is late when it takes longer; 0 = never
    atomic_bool late;
    _Atomic double first_ms, first_finished; // when its first batch was done, and which share
};

static void say(struct pel_worker *worker, const char *sentence) {
    pthread_mutex_lock(&worker->mutex);
    snprintf(worker->sentence, sizeof worker->sentence, "%s", sentence);
    pthread_mutex_unlock(&worker->mutex);
    worker->wake();
}

// ---- One frame, on the thread ------------------------------------------------------------------

// What the whole frame takes from its first batch on, as far as that can be told; 0 = not yet. What
// comes before, building a kernel perhaps, is not paid for every time.
static double projected_ms(struct frame *frame, double now_ms, double finished) {
    double first_ms = atomic_load(&frame->first_ms), first = atomic_load(&frame->first_finished);
    if (first_ms == 0) {
        atomic_store(&frame->first_finished, finished);
        atomic_store(&frame->first_ms, now_ms);
        return 0;
    }
    return finished > first + 0.01 ? (now_ms - first_ms) / (finished - first) : 0;
}

static bool go_on(double finished, void *user) {
    struct frame *frame = user;
    double now_ms = pel_clock_ms(), projected = projected_ms(frame, now_ms, finished);
    atomic_store(&frame->worker->finished, finished);
    if (frame->limit_ms > 0 && projected > frame->limit_ms &&
        projected * (1 - finished) > frame->limit_ms / 2)
        atomic_store(&frame->late, true);
    return !atomic_load(&frame->late) && (!atomic_load(&frame->worker->overtaken) ||
                                          now_ms - frame->begin_ms < frame->patience_ms);
}

// ---- The thread --------------------------------------------------------------------------------

// A frame that was given up still teaches what it would have taken.
static void learn(struct pel_worker *worker, struct frame *frame,
                  const struct pel_picture *picture) {
    double now_ms = pel_clock_ms();
    double ms = picture ? now_ms - frame->begin_ms - picture->statistics.build_ms
                        : projected_ms(frame, now_ms, atomic_load(&worker->finished));
    if (ms > 0)
        pel_pace_learn(&worker->pace, &frame->request->scenes[0]->render, &frame->quality, ms);
}

static void hand_over(struct pel_worker *worker, struct pel_picture *picture) {
    pthread_mutex_lock(&worker->mutex);
    struct pel_picture *old = worker->ready;
    worker->ready = picture;
    worker->sentence[0] = '\0';
    pthread_mutex_unlock(&worker->mutex);
    pel_picture_destroy(old);
    worker->wake();
}

// What became of a frame.
enum outcome { SHOWN, LATE, OVERTAKEN, FAILED };

// Renders one quality and hands it over, unless it takes longer than `limit_ms` (0: whatever).
static enum outcome show(struct pel_worker *worker, const struct pel_request *request,
                         const struct pel_quality *quality, double limit_ms, bool quick,
                         bool final) {
    struct frame frame = {.worker = worker, .request = request, .quality = *quality};
    frame.begin_ms = pel_clock_ms();
    frame.patience_ms = quick ? overdue * request->target_ms : 0;
    frame.limit_ms = limit_ms;
    atomic_store(&worker->finished, 0);
    pthread_mutex_lock(&worker->mutex);
    worker->begin_ms = frame.begin_ms;
    pthread_mutex_unlock(&worker->mutex);
    const struct pel_crew_frame asked = {
        .request = request, .quality = *quality, .batch_ms = batch_ms, .go_on = go_on, &frame};
    struct pel_crew_trouble trouble;
    struct pel_picture *picture = pel_crew_render(worker->crew, &asked, &trouble);
    bool overtaken = !picture && atomic_load(&worker->overtaken), late = atomic_load(&frame.late);
    if (picture || overtaken || late)
        learn(worker, &frame, picture);
    if (picture) {
        picture->final = final;
        picture->frame_ms = pel_clock_ms() - frame.begin_ms;
        hand_over(worker, picture);
        return SHOWN;
    }
    if (late || overtaken)
        return late ? LATE : OVERTAKEN;
    say(worker, trouble.sentence);
    return FAILED;
}

// A quick picture. One that turns out to take far too long, because what is seen now costs more
// than what was seen before, makes room for a worse one.
static enum outcome show_quickly(struct pel_worker *worker, const struct pel_request *request,
                                 struct pel_quality *quality, bool *more,
                                 struct pel_quality *next) {
    enum outcome outcome = LATE;
    for (int tries = 0; outcome == LATE; tries++) {
        const struct pel_render_settings *settings = &request->scenes[0]->render;
        double limit_ms = tries < 3 ? too_late * request->target_ms : 0;
        *quality = pel_pace_choose(&worker->pace, settings, request->target_ms);
        *more = pel_pace_refine(&worker->pace, settings, quality, next);
        outcome = show(worker, request, quality, limit_ms, true, !*more);
    }
    return outcome;
}

// Works on a request until it is done with: refined, failed, or only meant to be quick. False when
// something came between.
static bool work(struct pel_worker *worker, const struct pel_request *request) {
    const struct pel_render_settings *settings = &request->scenes[0]->render;
    struct pel_quality quality, next;
    bool more;
    if (show_quickly(worker, request, &quality, &more, &next) != SHOWN)
        return !atomic_load(&worker->overtaken);
    while (more && !request->moving) {
        if (atomic_load(&worker->overtaken))
            return false;
        quality = next;
        // Whether this is the last stage may change with what is learned; its quality tells.
        more = pel_pace_refine(&worker->pace, settings, &quality, &next);
        if (show(worker, request, &quality, 0, false, !more) != SHOWN)
            return !atomic_load(&worker->overtaken);
    }
    return true;
}

static bool go_on_saving(double finished, void *user) {
    struct pel_worker *worker = user;
    atomic_store(&worker->finished, finished);
    return !atomic_load(&worker->ending);
}

// Saves the oldest that waits, with the mutex locked before and after.
static void save_one(struct pel_worker *worker) {
    struct pel_scene *scene = worker->saves[0].scene;
    char *path = worker->saves[0].path;
    worker->begin_ms = pel_clock_ms();
    atomic_store(&worker->finished, 0);
    pthread_mutex_unlock(&worker->mutex);
    struct pel_renderer *renderer = pel_crew_first(worker->crew);
    const struct pel_render_options options = {
        .progress = go_on_saving, .user = worker, .batch_ms = batch_ms};
    bool good = renderer && pel_save_picture(renderer, scene, path, &options);
    char sentence[PEL_WORKER_SENTENCE];
    snprintf(sentence, sizeof sentence, "%s%s", good ? "saved " : "",
             good ? path : pel_error_message());
    pel_scene_destroy(scene);
    free(path);
    pthread_mutex_lock(&worker->mutex);
    memmove(&worker->saves[0], &worker->saves[1], (SAVES - 1) * sizeof worker->saves[0]);
    worker->save_count--;
    memcpy(worker->saved, sentence, sizeof sentence);
    worker->saved_count++;
    worker->wake();
}

static void *run(void *user) {
    struct pel_worker *worker = user;
    pel_crew_enter(worker->crew);
    pthread_mutex_lock(&worker->mutex);
    while (!worker->quit) {
        worker->busy = true;
        if (worker->save_count > 0) {
            save_one(worker);
            continue;
        }
        if (worker->pending.view_count == 0) {
            worker->busy = false;
            pthread_cond_wait(&worker->changed, &worker->mutex);
            continue;
        }
        struct pel_request request = worker->pending;
        worker->pending = (struct pel_request){0};
        atomic_store(&worker->overtaken, false);
        worker->begin_ms = pel_clock_ms();
        pthread_mutex_unlock(&worker->mutex);
        bool done = work(worker, &request);
        pthread_mutex_lock(&worker->mutex);
        // After a picture was saved, the one on the screen goes on where nothing newer came.
        if (!done && worker->pending.view_count == 0)
            worker->pending = request;
        else
            pel_request_finish(&request);
    }
    pthread_mutex_unlock(&worker->mutex);
    pel_crew_destroy(worker->crew);
    return NULL;
}

// ---- The event loop's side ---------------------------------------------------------------------

void pel_worker_ask(struct pel_worker *worker, struct pel_worker_status *status) {
    pthread_mutex_lock(&worker->mutex);
    status->busy = worker->busy || worker->pending.view_count > 0 || worker->save_count > 0;
    status->running_ms = worker->busy ? pel_clock_ms() - worker->begin_ms : 0;
    status->finished = atomic_load(&worker->finished);
    memcpy(status->sentence, worker->sentence, sizeof status->sentence);
    memcpy(status->saved, worker->saved, sizeof status->saved);
    status->saved_count = worker->saved_count;
    pthread_mutex_unlock(&worker->mutex);
}

struct pel_picture *pel_worker_take(struct pel_worker *worker) {
    pthread_mutex_lock(&worker->mutex);
    struct pel_picture *picture = worker->ready;
    worker->ready = NULL;
    pthread_mutex_unlock(&worker->mutex);
    return picture;
}

void pel_worker_submit(struct pel_worker *worker, const struct pel_request *request) {
    pthread_mutex_lock(&worker->mutex);
    struct pel_request old = worker->pending;
    worker->pending = *request;
    atomic_store(&worker->overtaken, true);
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
    pel_request_finish(&old);
}

bool pel_worker_save(struct pel_worker *worker, struct pel_scene *scene, const char *path) {
    char *copy = strdup(path);
    pthread_mutex_lock(&worker->mutex);
    bool good = copy && worker->save_count < SAVES;
    if (good) {
        worker->saves[worker->save_count].scene = scene;
        worker->saves[worker->save_count++].path = copy;
        // The picture on the screen waits.
        atomic_store(&worker->overtaken, true);
        pthread_cond_signal(&worker->changed);
    }
    pthread_mutex_unlock(&worker->mutex);
    if (!good) {
        pel_scene_destroy(scene);
        free(copy);
    }
    return good;
}

struct pel_worker *pel_worker_create(const struct pel_renderer_options *options,
                                     struct pel_lender *lender, void (*wake)(void)) {
    struct pel_worker *worker = calloc(1, sizeof *worker);
    if (!worker)
        return NULL;
    worker->wake = wake;
    worker->crew = pel_crew_create(options, lender);
    if (!worker->crew) {
        free(worker);
        return NULL;
    }
    pthread_mutex_init(&worker->mutex, NULL);
    pthread_cond_init(&worker->changed, NULL);
    if (pthread_create(&worker->thread, NULL, run, worker) != 0) {
        pthread_cond_destroy(&worker->changed);
        pthread_mutex_destroy(&worker->mutex);
        pel_crew_destroy(worker->crew);
        free(worker);
        return NULL;
    }
    return worker;
}

void pel_worker_destroy(struct pel_worker *worker) {
    if (!worker)
        return;
    pthread_mutex_lock(&worker->mutex);
    worker->quit = true;
    atomic_store(&worker->ending, true);
    atomic_store(&worker->overtaken, true);
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
    pthread_join(worker->thread, NULL);
    pel_request_finish(&worker->pending);
    for (int i = 0; i < worker->save_count; i++) {
        pel_scene_destroy(worker->saves[i].scene);
        free(worker->saves[i].path);
    }
    pel_picture_destroy(worker->ready);
    pthread_cond_destroy(&worker->changed);
    pthread_mutex_destroy(&worker->mutex);
    free(worker);
}
