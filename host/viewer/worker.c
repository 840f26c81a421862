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

#include "viewer/save.h"

// How soon a frame in flight notices a new request.
static const double batch_ms = 25;

// A quick picture that takes this many times what it should gives way.
static const double overdue = 2;

enum { SAVES = 8 };

struct pel_worker {
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    struct pel_worker_request pending; // view_count is 0 when there is none
    struct pel_worker_picture *ready;
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
    char *device;            // owned; what the options' device points to
    struct pel_renderer_options options;

    // The thread's own.
    struct pel_renderer *renderer;
    struct pel_pace pace;
};

// One frame of all views of a request.
struct frame {
    struct pel_worker *worker;
    const struct pel_worker_request *request;
    struct pel_quality quality;
    double begin_ms, patience_ms; // gives way to a new request only after this long
    int view, part, part_count;   // being rendered
};

static void request_finish(struct pel_worker_request *request) {
    for (int i = 0; i < request->view_count; i++)
        pel_scene_destroy(request->scenes[i]);
    *request = (struct pel_worker_request){0};
}

static void say(struct pel_worker *worker, const char *sentence) {
    pthread_mutex_lock(&worker->mutex);
    snprintf(worker->sentence, sizeof worker->sentence, "%s", sentence);
    pthread_mutex_unlock(&worker->mutex);
    worker->wake();
}

// ---- One frame, on the thread ------------------------------------------------------------------

static bool go_on(double finished, void *user) {
    struct frame *frame = user;
    double parts = frame->part_count;
    atomic_store(&frame->worker->finished, (frame->part + finished) / parts);
    return !atomic_load(&frame->worker->overtaken) ||
           pel_clock_ms() - frame->begin_ms < frame->patience_ms;
}

static bool is_interlaced(enum pel_stereo_kind kind) {
    return kind == PEL_STEREO_ROW_INTERLACED || kind == PEL_STEREO_COLUMN_INTERLACED ||
           kind == PEL_STEREO_CHECKERBOARD;
}

// The picture with every pixel repeated so that it has the size asked for.
static struct pel_image *enlarge(const struct pel_image *image, int width, int height) {
    struct pel_image *large = pel_image_create(width, height);
    if (!large)
        return NULL;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            size_t from_x = (size_t)((int64_t)x * image->width / width);
            size_t from_y = (size_t)((int64_t)y * image->height / height);
            memcpy(&large->rgba[4 * ((size_t)y * (size_t)width + (size_t)x)],
                   &image->rgba[4 * (from_y * (size_t)image->width + from_x)], 4 * sizeof(float));
        }
    return large;
}

// Rows of both eyes cannot be told apart in a picture that is stretched: the eyes are stretched
// first.
static struct pel_image *render_interlaced(struct pel_renderer *renderer,
                                           const struct pel_scene *scene,
                                           const struct pel_render_settings *whole,
                                           const struct pel_render_options *options,
                                           struct pel_render_statistics *statistics) {
    struct pel_image *eyes[2], *large[2] = {NULL, NULL}, *image = NULL;
    if (!pel_renderer_render_eyes(renderer, scene, options, statistics, eyes))
        return NULL;
    for (int i = 0; i < 2; i++)
        large[i] = enlarge(eyes[i], whole->width, whole->height);
    if (large[0] && large[1])
        image = pel_stereo_compose(&scene->stereo, large[0], large[1]);
    for (int i = 0; i < 2; i++) {
        pel_image_destroy(eyes[i]);
        pel_image_destroy(large[i]);
    }
    return image;
}

static struct pel_image *render_view(struct frame *frame,
                                     struct pel_render_statistics *statistics) {
    const struct pel_scene *scene = frame->request->scenes[frame->view];
    const struct pel_render_options options = {
        .progress = go_on, .user = frame, .batch_ms = batch_ms};
    struct pel_scene seen = *scene; // borrows everything
    seen.render = pel_pace_apply(&scene->render, &frame->quality);
    for (int i = 0; i < seen.instance_count; i++) {
        seen.instances[i].step *= frame->quality.step_factor;
        seen.instances[i].step_mm *= frame->quality.step_factor;
    }
    // Squeezed eyes need an even size.
    if (scene->stereo.kind == PEL_STEREO_SIDE_BY_SIDE_HALF)
        seen.render.width += seen.render.width & 1;
    if (scene->stereo.kind == PEL_STEREO_TOP_BOTTOM_HALF)
        seen.render.height += seen.render.height & 1;
    if (frame->quality.divisor > 1 && is_interlaced(scene->stereo.kind))
        return render_interlaced(frame->worker->renderer, &seen, &scene->render, &options,
                                 statistics);
    return pel_renderer_render(frame->worker->renderer, &seen, &options, statistics);
}

// As in an 8-bit file. The comparison is false for NaN.
static uint8_t quantise(float value) {
    if (!(value > 0))
        return 0;
    return value >= 1 ? 255 : (uint8_t)((double)value * 255 + 0.5);
}

static bool take_pixels(struct pel_worker_pixels *pixels, const struct pel_image *image) {
    size_t count = (size_t)image->width * (size_t)image->height * 4;
    *pixels = (struct pel_worker_pixels){image->width, image->height, malloc(count)};
    if (!pixels->rgba)
        return false;
    for (size_t i = 0; i < count; i++)
        pixels->rgba[i] = quantise(image->rgba[i]);
    return true;
}

static struct pel_worker_picture *render_frame(struct frame *frame) {
    struct pel_worker_picture *picture = calloc(1, sizeof *picture);
    if (!picture)
        return NULL;
    picture->id = frame->request->id;
    picture->quality = frame->quality;
    frame->part_count = frame->request->view_count;
    for (int i = 0; i < frame->request->view_count; i++) {
        frame->view = frame->part = i;
        struct pel_image *image = render_view(frame, &picture->statistics);
        bool good = image && take_pixels(&picture->views[i], image);
        pel_image_destroy(image);
        if (!good) {
            pel_worker_picture_destroy(picture);
            return NULL;
        }
        picture->view_count++;
    }
    return picture;
}

// ---- The thread --------------------------------------------------------------------------------

// A frame that was given up still teaches what it would have taken.
static void learn(struct pel_worker *worker, const struct frame *frame, bool whole,
                  double build_ms) {
    double share = whole ? 1 : atomic_load(&worker->finished);
    double ms = pel_clock_ms() - frame->begin_ms - build_ms;
    if (share > 0.02 && ms > 0)
        pel_pace_learn(&worker->pace, &frame->request->scenes[0]->render, &frame->quality,
                       ms / share);
}

static void hand_over(struct pel_worker *worker, struct pel_worker_picture *picture) {
    pthread_mutex_lock(&worker->mutex);
    struct pel_worker_picture *old = worker->ready;
    worker->ready = picture;
    worker->sentence[0] = '\0';
    pthread_mutex_unlock(&worker->mutex);
    pel_worker_picture_destroy(old);
    worker->wake();
}

// Renders one quality and hands it over. False when the request is done with: it failed, or a newer
// one came.
static bool show(struct pel_worker *worker, const struct pel_worker_request *request,
                 const struct pel_quality *quality, bool quick, bool final) {
    struct frame frame = {.worker = worker, .request = request, .quality = *quality};
    frame.begin_ms = pel_clock_ms();
    frame.patience_ms = quick ? overdue * request->target_ms : 0;
    atomic_store(&worker->finished, 0);
    pthread_mutex_lock(&worker->mutex);
    worker->begin_ms = frame.begin_ms;
    pthread_mutex_unlock(&worker->mutex);
    struct pel_worker_picture *picture = render_frame(&frame);
    bool given_up = !picture && atomic_load(&worker->overtaken);
    if (picture || given_up)
        learn(worker, &frame, picture != NULL, picture ? picture->statistics.build_ms : 0);
    if (picture) {
        picture->final = final;
        picture->frame_ms = pel_clock_ms() - frame.begin_ms;
        hand_over(worker, picture);
        return true;
    }
    if (!given_up) {
        say(worker, pel_error_message());
        // A device that was lost does not come back by itself; one that is too small stays so.
        if (pel_error_code() == PEL_ERROR_DEVICE) {
            pel_renderer_destroy(worker->renderer);
            worker->renderer = NULL;
        }
    }
    return false;
}

// Works on a request until it is done with: refined, failed, or only meant to be quick. False when
// something came between.
static bool work(struct pel_worker *worker, const struct pel_worker_request *request) {
    if (!worker->renderer)
        worker->renderer = pel_renderer_create(&worker->options);
    if (!worker->renderer) {
        say(worker, pel_error_message());
        return true;
    }
    const struct pel_render_settings *settings = &request->scenes[0]->render;
    struct pel_quality quality = pel_pace_choose(&worker->pace, settings, request->target_ms);
    struct pel_quality next;
    bool more = pel_pace_refine(&worker->pace, settings, &quality, &next);
    if (!show(worker, request, &quality, true, !more))
        return !atomic_load(&worker->overtaken);
    while (more && !request->moving) {
        if (atomic_load(&worker->overtaken))
            return false;
        quality = next;
        // Whether this is the last stage may change with what is learned; its quality tells.
        more = pel_pace_refine(&worker->pace, settings, &quality, &next);
        if (!show(worker, request, &quality, false, !more))
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
    if (!worker->renderer)
        worker->renderer = pel_renderer_create(&worker->options);
    const struct pel_render_options options = {
        .progress = go_on_saving, .user = worker, .batch_ms = batch_ms};
    bool good = worker->renderer && pel_save_picture(worker->renderer, scene, path, &options);
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
        struct pel_worker_request request = worker->pending;
        worker->pending = (struct pel_worker_request){0};
        atomic_store(&worker->overtaken, false);
        worker->begin_ms = pel_clock_ms();
        pthread_mutex_unlock(&worker->mutex);
        bool done = work(worker, &request);
        pthread_mutex_lock(&worker->mutex);
        // After a picture was saved, the one on the screen goes on where nothing newer came.
        if (!done && worker->pending.view_count == 0)
            worker->pending = request;
        else
            request_finish(&request);
    }
    pthread_mutex_unlock(&worker->mutex);
    pel_renderer_destroy(worker->renderer);
    return NULL;
}

// ---- The event loop's side ---------------------------------------------------------------------

void pel_worker_picture_destroy(struct pel_worker_picture *picture) {
    if (!picture)
        return;
    for (int i = 0; i < PEL_WORKER_VIEWS; i++)
        free(picture->views[i].rgba);
    free(picture);
}

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

struct pel_worker_picture *pel_worker_take(struct pel_worker *worker) {
    pthread_mutex_lock(&worker->mutex);
    struct pel_worker_picture *picture = worker->ready;
    worker->ready = NULL;
    pthread_mutex_unlock(&worker->mutex);
    return picture;
}

void pel_worker_submit(struct pel_worker *worker, const struct pel_worker_request *request) {
    pthread_mutex_lock(&worker->mutex);
    struct pel_worker_request old = worker->pending;
    worker->pending = *request;
    atomic_store(&worker->overtaken, true);
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
    request_finish(&old);
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
                                     void (*wake)(void)) {
    struct pel_worker *worker = calloc(1, sizeof *worker);
    if (!worker)
        return NULL;
    worker->options = *options;
    worker->wake = wake;
    if (options->device) {
        worker->options.device = worker->device = strdup(options->device);
        if (!worker->device) {
            free(worker);
            return NULL;
        }
    }
    pthread_mutex_init(&worker->mutex, NULL);
    pthread_cond_init(&worker->changed, NULL);
    if (pthread_create(&worker->thread, NULL, run, worker) != 0) {
        pthread_cond_destroy(&worker->changed);
        pthread_mutex_destroy(&worker->mutex);
        free(worker->device);
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
    request_finish(&worker->pending);
    for (int i = 0; i < worker->save_count; i++) {
        pel_scene_destroy(worker->saves[i].scene);
        free(worker->saves[i].path);
    }
    pel_worker_picture_destroy(worker->ready);
    pthread_cond_destroy(&worker->changed);
    pthread_mutex_destroy(&worker->mutex);
    free(worker->device);
    free(worker);
}
