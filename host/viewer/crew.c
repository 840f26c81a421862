// crew.c - renderers that work on the views of one frame.
//
// Views are shared out by the device that each wants. The first device's views are rendered on the
// thread that asks, those of every other one on a thread that lives as long as the frame.
#include "viewer/crew.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What the options say, and one for each region of a wall.
enum { MEMBERS = 1 + PEL_WALL_MAX };

struct member {
    char *device; // owned; NULL: as the options leave it
    struct pel_renderer *renderer;
};

struct pel_crew {
    struct pel_renderer_options options;
    struct pel_lender *lender; // borrowed; NULL, or the first member's renderer may use its buffers
    bool entered;
    struct member members[MEMBERS];
    int member_count;
};

// One member's part of a frame.
struct share {
    struct pel_crew *crew;
    const struct pel_crew_frame *frame;
    struct pel_picture *picture;
    struct share *all; // of the frame, `share_count` of them
    int share_count;
    struct member *member;
    int views[PEL_REQUEST_VIEWS], view_count;
    int done;                // of its views
    _Atomic double finished; // of all its views
    atomic_bool *failed;     // some share did
    struct pel_crew_trouble *trouble;
    pthread_t thread;
    bool threaded;
};

// ---- One view ----------------------------------------------------------------------------------

static bool is_interlaced(enum pel_stereo_kind kind) {
    return kind == PEL_STEREO_ROW_INTERLACED || kind == PEL_STEREO_COLUMN_INTERLACED ||
           kind == PEL_STEREO_CHECKERBOARD;
}

// Of interlaced eyes: a region that begins at an odd place begins with the second one.
static bool begins_with_second(enum pel_stereo_kind kind, const int region[4]) {
    bool column = region[0] % 2 != 0, row = region[1] % 2 != 0;
    return kind == PEL_STEREO_ROW_INTERLACED      ? row
           : kind == PEL_STEREO_COLUMN_INTERLACED ? column
                                                  : column != row;
}

// The part of a picture with every pixel repeated so that it has the size asked for.
static struct pel_image *enlarge(const struct pel_image *image, const double part[4], int width,
                                 int height) {
    struct pel_image *large = pel_image_create(width, height);
    for (int y = 0; large && y < height; y++)
        for (int x = 0; x < width; x++) {
            size_t from_x = (size_t)((part[0] + (x + 0.5) / width * part[2]) * image->width);
            size_t from_y = (size_t)((part[1] + (y + 0.5) / height * part[3]) * image->height);
            memcpy(&large->rgba[4 * ((size_t)y * (size_t)width + (size_t)x)],
                   &image->rgba[4 * (from_y * (size_t)image->width + from_x)], 4 * sizeof(float));
        }
    return large;
}

// Rows of both eyes cannot be told apart in a picture that is stretched: the eyes are stretched
// first, and `part` becomes all of it.
static struct pel_image *
render_interlaced(struct pel_renderer *renderer, const struct pel_scene *scene,
                  const struct pel_render_settings *asked, const struct pel_render_options *options,
                  struct pel_render_statistics *statistics, double part[4]) {
    struct pel_image *eyes[2], *large[2] = {NULL, NULL}, *image = NULL;
    const int *region = asked->region;
    int width = region[2] > 0 ? region[2] : asked->width;
    int height = region[3] > 0 ? region[3] : asked->height;
    if (!pel_renderer_render_eyes(renderer, scene, options, statistics, eyes))
        return NULL;
    for (int i = 0; i < 2; i++)
        large[i] = enlarge(eyes[i], part, width, height);
    bool second = begins_with_second(scene->stereo.kind, region);
    if (large[0] && large[1])
        image = pel_stereo_compose(&scene->stereo, large[second], large[!second]);
    for (int i = 0; i < 2; i++) {
        pel_image_destroy(eyes[i]);
        pel_image_destroy(large[i]);
    }
    memcpy(part, (double[]){0, 0, 1, 1}, 4 * sizeof *part);
    return image;
}

static bool go_on(double finished, void *user) {
    struct share *share = user;
    const struct pel_crew_frame *frame = share->frame;
    atomic_store(&share->finished, (share->done + finished) / share->view_count);
    double sum = 0;
    for (int i = 0; i < share->share_count; i++)
        sum += atomic_load(&share->all[i].finished) * share->all[i].view_count;
    return !atomic_load(share->failed) &&
           frame->go_on(sum / frame->request->view_count, frame->user);
}

// Squeezed eyes need an even size: a region grows to the right or to the left.
static void make_even(int *whole, int *from, int *size) {
    if (*size == 0)
        *whole += *whole & 1;
    else if (*size % 2 != 0 && *from + *size < *whole)
        ++*size;
    else if (*size % 2 != 0 && *from > 0)
        --*from, ++*size;
}

// The scene as it is seen at the frame's quality; borrows everything.
static struct pel_scene scene_of_quality(const struct pel_scene *scene,
                                         const struct pel_quality *quality, double part[4]) {
    struct pel_scene seen = *scene;
    seen.render = pel_pace_apply(&scene->render, quality);
    for (int i = 0; i < seen.instance_count; i++) {
        seen.instances[i].step *= quality->step_factor;
        seen.instances[i].step_mm *= quality->step_factor;
    }
    struct pel_render_settings *render = &seen.render;
    if (scene->stereo.kind == PEL_STEREO_SIDE_BY_SIDE_HALF)
        make_even(&render->width, &render->region[0], &render->region[2]);
    if (scene->stereo.kind == PEL_STEREO_TOP_BOTTOM_HALF)
        make_even(&render->height, &render->region[1], &render->region[3]);
    pel_pace_part(&scene->render, render, part);
    return seen;
}

// Lends the view a buffer of OpenGL for its picture, where the renderer shares them.
static struct pel_loan *lend(const struct share *share, const struct pel_render_settings *render) {
    const struct pel_crew *crew = share->crew;
    if (!crew->lender || share->frame->request->compared || share->member != &crew->members[0])
        return NULL;
    size_t width = (size_t)(render->region[2] > 0 ? render->region[2] : render->width);
    size_t height = (size_t)(render->region[3] > 0 ? render->region[3] : render->height);
    return pel_lender_lend(crew->lender, share->member->renderer, 4 * width * height);
}

static struct pel_image *render_view(struct share *share, int view,
                                     struct pel_render_statistics *statistics) {
    const struct pel_scene *scene = share->frame->request->scenes[view];
    const struct pel_quality *quality = &share->frame->quality;
    struct pel_render_options options = {
        .progress = go_on, .user = share, .batch_ms = share->frame->batch_ms};
    struct pel_pixels *pixels = &share->picture->views[view];
    struct pel_scene seen = scene_of_quality(scene, quality, pixels->part);
    pixels->loan = lend(share, &seen.render);
    options.gl_buffer = pel_loan_name(pixels->loan);
    if (quality->divisor > 1 && is_interlaced(scene->stereo.kind))
        return render_interlaced(share->member->renderer, &seen, &scene->render, &options,
                                 statistics, pixels->part);
    return pel_renderer_render(share->member->renderer, &seen, &options, statistics);
}

// As in an 8-bit file. The comparison is false for NaN.
static uint8_t quantise(float value) {
    if (!(value > 0))
        return 0;
    return value >= 1 ? 255 : (uint8_t)((double)value * 255 + 0.5);
}

// Without them the picture is in the loan.
static bool take_pixels(struct pel_pixels *pixels, const struct pel_image *image) {
    size_t count = (size_t)image->width * (size_t)image->height * 4;
    pixels->width = image->width;
    pixels->height = image->height;
    if (!image->rgba)
        return true;
    pel_loan_return(pixels->loan);
    pixels->loan = NULL;
    pixels->rgba = malloc(count);
    for (size_t i = 0; pixels->rgba && i < count; i++)
        pixels->rgba[i] = quantise(image->rgba[i]);
    return pixels->rgba != NULL;
}

// Says why the host has the pixels, where the renderer was not asked to do without.
static void explain(const struct share *share, struct pel_render_statistics *statistics) {
    const char *reason = !share->crew->lender                        ? ""
                         : share->frame->request->compared           ? "pictures are compared"
                         : share->member != &share->crew->members[0] ? "its device is another one"
                                                                     : "OpenGL has no buffer";
    if (!statistics->gl_reason[0])
        snprintf(statistics->gl_reason, sizeof statistics->gl_reason, "%s", reason);
}

// ---- One member's views ------------------------------------------------------------------------

static bool open_renderer(struct pel_crew *crew, struct member *member) {
    struct pel_renderer_options options = crew->options;
    options.device = member->device;
    // OpenGL is with the thread of the first one.
    if (member != &crew->members[0])
        options.gl = (struct pel_gl){0};
    if (!member->renderer)
        member->renderer = pel_renderer_create(&options);
    return member->renderer != NULL;
}

static bool render_views(struct share *share) {
    struct pel_picture *picture = share->picture;
    if (!open_renderer(share->crew, share->member))
        return false;
    for (; share->done < share->view_count; share->done++) {
        int view = share->views[share->done];
        struct pel_render_statistics statistics;
        struct pel_image *image = render_view(share, view, &statistics);
        bool good = image && take_pixels(&picture->views[view], image);
        if (good && image->rgba)
            explain(share, &statistics);
        pel_image_destroy(image);
        if (!good)
            return false;
        if (view == picture->view_count - 1)
            picture->statistics = statistics;
    }
    return true;
}

static void *work(void *user) {
    struct share *share = user;
    if (render_views(share))
        return NULL;
    enum pel_error code = pel_error_code() ? pel_error_code() : PEL_ERROR_MEMORY;
    // The others give up because this one did, which is no news.
    if (!atomic_exchange(share->failed, true)) {
        share->trouble->code = code;
        snprintf(share->trouble->sentence, sizeof share->trouble->sentence, "%s",
                 pel_error_code() ? pel_error_message() : "cannot allocate a picture");
    }
    // A device that was lost does not come back by itself.
    if (code == PEL_ERROR_DEVICE) {
        pel_renderer_destroy(share->member->renderer);
        share->member->renderer = NULL;
    }
    return NULL;
}

// ---- The crew ----------------------------------------------------------------------------------

// The member for a device, who may be new; NULL when memory ran out.
static struct member *find_member(struct pel_crew *crew, const char *device) {
    if (!device || !*device)
        return &crew->members[0];
    for (int i = 1; i < crew->member_count; i++)
        if (strcmp(crew->members[i].device, device) == 0)
            return &crew->members[i];
    if (crew->member_count == MEMBERS)
        return &crew->members[0];
    struct member *member = &crew->members[crew->member_count];
    member->device = strdup(device);
    if (member->device)
        crew->member_count++;
    return member->device ? member : NULL;
}

// Shares the views out; false when memory ran out.
static bool share_out(struct pel_crew *crew, const struct pel_crew_frame *frame,
                      struct share *shares, int *share_count) {
    *share_count = 0;
    for (int view = 0; view < frame->request->view_count; view++) {
        struct member *member = find_member(crew, frame->request->devices[view]);
        int i = 0;
        while (i < *share_count && shares[i].member != member)
            i++;
        if (!member)
            return false;
        if (i == *share_count) {
            shares[i].member = member;
            ++*share_count;
        }
        shares[i].views[shares[i].view_count++] = view;
    }
    for (int i = 1; i < *share_count; i++)
        if (shares[i].member == &crew->members[0]) {
            struct share first = shares[0];
            shares[0] = shares[i];
            shares[i] = first;
        }
    return true;
}

// Lets all members work; the first one on this thread, which may be the one that has OpenGL.
static void let_work(struct share *shares, int count) {
    for (int i = 1; i < count; i++)
        shares[i].threaded = pthread_create(&shares[i].thread, NULL, work, &shares[i]) == 0;
    for (int i = 0; i < count; i++)
        if (!shares[i].threaded)
            work(&shares[i]);
    for (int i = 1; i < count; i++)
        if (shares[i].threaded)
            pthread_join(shares[i].thread, NULL);
}

struct pel_picture *pel_crew_render(struct pel_crew *crew, const struct pel_crew_frame *frame,
                                    struct pel_crew_trouble *trouble) {
    struct pel_picture *picture = calloc(1, sizeof *picture);
    struct share *shares = calloc(MEMBERS, sizeof *shares);
    int count = 0;
    atomic_bool failed = false;
    *trouble = (struct pel_crew_trouble){PEL_ERROR_MEMORY, "cannot allocate a frame"};
    bool good = picture && shares && share_out(crew, frame, shares, &count);
    if (good) {
        picture->id = frame->request->id;
        picture->quality = frame->quality;
        picture->view_count = frame->request->view_count;
        for (int i = 0; i < count; i++) {
            struct share *share = &shares[i];
            share->crew = crew;
            share->frame = frame;
            share->picture = picture;
            share->all = shares;
            share->share_count = count;
            share->failed = &failed;
            share->trouble = trouble;
        }
        let_work(shares, count);
    }
    free(shares);
    if (good && !failed)
        return picture;
    pel_picture_destroy(picture);
    return NULL;
}

struct pel_renderer *pel_crew_first(struct pel_crew *crew) {
    return open_renderer(crew, &crew->members[0]) ? crew->members[0].renderer : NULL;
}

struct pel_crew *pel_crew_create(const struct pel_renderer_options *options,
                                 struct pel_lender *lender) {
    struct pel_crew *crew = calloc(1, sizeof *crew);
    if (!crew)
        return NULL;
    crew->options = *options;
    crew->lender = lender;
    crew->member_count = 1;
    if (options->device) {
        crew->members[0].device = strdup(options->device);
        if (!crew->members[0].device) {
            free(crew);
            return NULL;
        }
    }
    return crew;
}

void pel_crew_enter(struct pel_crew *crew) {
    crew->entered = true;
    if (crew->lender)
        pel_lender_enter(crew->lender, &crew->options.gl);
}

void pel_crew_destroy(struct pel_crew *crew) {
    if (!crew)
        return;
    for (int i = 0; i < crew->member_count; i++) {
        pel_renderer_destroy(crew->members[i].renderer);
        free(crew->members[i].device);
    }
    if (crew->lender && crew->entered)
        pel_lender_leave(crew->lender);
    free(crew);
}
