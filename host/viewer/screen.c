// screen.c - what is where in the windows, and drawing it.
#include "viewer/screen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/panels.h"
#include "viewer/wall.h"

// ---- Windows -----------------------------------------------------------------------------------

static bool open_window(struct pel_state *state, const struct pel_window_options *wanted,
                        char *sentence, size_t bytes) {
    struct pel_pane_window *window = &state->windows[state->window_count];
    struct pel_window_options options = *wanted;
    if (state->sharing && state->window_count > 0)
        options.shares = state->windows[0].window;
    window->window = pel_window_create(&options, &state->queue, sentence, bytes);
    if (!window->window)
        return false;
    state->window_count++;
    window->present = pel_present_create(sentence, bytes);
    if (!window->present)
        return false;
    pel_window_pixels(window->window, window->pixels, &window->scale);
    return true;
}

static bool open_single(struct pel_state *state, char *sentence, size_t bytes) {
    const struct pel_viewer_options *options = state->options;
    const struct pel_render_settings *settings = &options->scene->render;
    struct pel_window_options wanted = {.title = "Pellucid", .monitor = options->full_screen};
    // The panels stand beside a picture of the scene's size; a size that was asked for is the
    // whole.
    wanted.place[2] = settings->width + (state->panels ? PEL_PANELS_COLUMN : 0);
    wanted.place[3] = settings->height;
    if (options->size[0] > 0)
        memcpy(&wanted.place[2], options->size, sizeof options->size);
    return open_window(state, &wanted, sentence, bytes);
}

static bool open_wall(struct pel_state *state, char *sentence, size_t bytes) {
    const struct pel_viewer_options *options = state->options;
    const struct pel_wall *wall = &options->scene->wall;
    const struct pel_render_settings *settings = &options->scene->render;
    state->wall_px[0] = options->size[0] > 0 ? options->size[0] : settings->width;
    state->wall_px[1] = options->size[0] > 0 ? options->size[1] : settings->height;
    // Panels hide what is behind them, so they come only when they are called.
    state->panels = false;
    for (int i = 0; i < wall->region_count; i++) {
        struct pel_wall_part part = pel_wall_place(wall, i, state->wall_px);
        struct pel_window_options wanted = {.title = "Pellucid",
                                            .number = i,
                                            .placed = true,
                                            .monitor = wall->regions[i].monitor + 1,
                                            .unadorned = true,
                                            .follows = i > 0};
        memcpy(wanted.place, part.region, sizeof part.region);
        if (wanted.monitor > pel_window_monitor_count()) {
            pel_state_say(state, "there is no monitor %d: region %d is a window",
                          wall->regions[i].monitor, i);
            wanted.monitor = 0;
        }
        if (!open_window(state, &wanted, sentence, bytes))
            return false;
    }
    return true;
}

// Windows share their objects only when a device can have a part in it.
static bool is_sharing_possible(void) {
    struct pel_device_info devices[PEL_DEVICE_MAX];
    int count = pel_device_list(devices);
    for (int i = 0; i < count; i++)
        if (devices[i].gl_sharing && devices[i].usable)
            return true;
    return false;
}

// Gives the rendering thread an OpenGL context of its own, if that is of use.
static void open_lender(struct pel_state *state) {
    if (!state->sharing) {
        snprintf(state->unshared, sizeof state->unshared, "no device has cl_khr_gl_sharing");
        return;
    }
    struct pel_window *unseen =
        pel_window_create_unseen(state->windows[0].window, state->unshared, sizeof state->unshared);
    state->lender = unseen ? pel_lender_create(unseen) : NULL;
}

bool pel_screen_open(struct pel_state *state, char *sentence, size_t bytes) {
    int monitors = pel_window_monitor_count(), wanted = state->options->full_screen - 1;
    if (wanted >= monitors && monitors == 1)
        snprintf(sentence, bytes, "there is no monitor %d, only 0", wanted);
    else if (wanted >= monitors)
        snprintf(sentence, bytes, "there is no monitor %d, only 0 to %d", wanted, monitors - 1);
    if (wanted >= monitors)
        return false;
    bool wall = state->options->scene->wall.region_count > 0;
    state->sharing = is_sharing_possible();
    if (!(wall ? open_wall(state, sentence, bytes) : open_single(state, sentence, bytes)))
        return false;
    open_lender(state);
    state->with_panels = pel_panels_start(state);
    if (wall && state->options->full_screen)
        pel_screen_toggle_full_screen(state);
    return true;
}

void pel_screen_close(struct pel_state *state) {
    if (state->with_panels)
        pel_panels_stop(state);
    for (int i = 0; i < state->window_count; i++) {
        pel_window_draw_on(state->windows[i].window);
        pel_present_destroy(state->windows[i].present);
        pel_window_destroy(state->windows[i].window);
    }
    state->window_count = 0;
    pel_lender_destroy(state->lender);
    state->lender = NULL;
}

void pel_screen_name(struct pel_state *state) {
    const char *slash = strrchr(state->scene_path, '/');
    const char *file = slash ? slash + 1 : state->scene_path;
    char name[sizeof state->name];
    snprintf(name, sizeof name, "%.255s%s - Pellucid", *file ? file : "new scene",
             pel_history_is_saved(state->history) ? "" : "*");
    if (strcmp(name, state->name) == 0)
        return;
    memcpy(state->name, name, sizeof name);
    for (int i = 0; i < state->window_count; i++) {
        char title[sizeof name + 32];
        int length = snprintf(title, sizeof title, "%s", name);
        if (state->window_count > 1)
            snprintf(title + length, sizeof title - (size_t)length, " %d of %d", i + 1,
                     state->window_count);
        pel_window_name(state->windows[i].window, title);
    }
}

void pel_screen_toggle_full_screen(struct pel_state *state) {
    uint64_t taken = 0; // bits of monitors
    for (int i = 0; i < state->window_count; i++) {
        int monitor = pel_window_monitor(state->windows[i].window);
        if (monitor > 0 && taken >> monitor % 64 & 1)
            continue;
        taken |= UINT64_C(1) << monitor % 64;
        pel_window_toggle_full_screen(state->windows[i].window);
    }
}

// ---- Layout ------------------------------------------------------------------------------------

// A view that is all of its picture.
static struct pel_screen_view make_view(struct pel_rectangle place) {
    return (struct pel_screen_view){
        .place = place, .whole = {place.width, place.height}, .part = {0, 0, 1, 1}};
}

// The picture gives three quarters of its place to slices: axial and coronal above, sagittal at its
// left. False when there is no room; in the order of the views' slots.
static bool cut_in_four(const struct pel_rectangle *whole, struct pel_rectangle places[4]) {
    int left = whole->width / 2, top = whole->height / 2;
    int right = whole->width - left, bottom = whole->height - top;
    places[0] = (struct pel_rectangle){whole->x + left, whole->y + top, right, bottom};
    places[1] = (struct pel_rectangle){whole->x, whole->y, left - 1, top - 1};
    places[2] = (struct pel_rectangle){whole->x + left, whole->y, right, top - 1};
    places[3] = (struct pel_rectangle){whole->x, whole->y + top, left - 1, bottom};
    return left >= 2 && top >= 2;
}

static int most(int a, int b) {
    return a > b ? a : b;
}

static int least(int a, int b) {
    return a < b ? a : b;
}

// Adds the part of one of four pictures that a window of a wall shows, if there is one.
static void add_part(struct pel_state *state, int window, int slot, bool slices) {
    const struct pel_wall_part *part = &state->windows[window].part;
    const struct pel_rectangle wall = {0, 0, part->whole[0], part->whole[1]};
    struct pel_rectangle places[4] = {wall};
    if (slices && !cut_in_four(&wall, places))
        return;
    const struct pel_rectangle *of = &places[slot];
    const int *region = part->region;
    int left = most(of->x, region[0]), right = least(of->x + of->width, region[0] + region[2]);
    int top = most(of->y, region[1]), bottom = least(of->y + of->height, region[1] + region[3]);
    if (right > left && bottom > top)
        state->views[state->view_count++] = (struct pel_screen_view){
            .window = window,
            .slot = slot,
            .place = {left - region[0], top - region[1], right - left, bottom - top},
            .whole = {of->width, of->height},
            .offset = {left - of->x, top - of->y},
            .part = {0, 0, 1, 1},
        };
}

static void add_parts(struct pel_state *state, bool slices) {
    state->view_count = 0;
    for (int slot = 0; slot < (slices ? 4 : 1); slot++) {
        for (int i = 0; i < state->window_count; i++)
            add_part(state, i, slot, slices);
        if (slot == 0)
            state->picture_count = state->view_count;
    }
}

// All windows show parts of one picture, or of one with slices beside it. There is always a
// picture, which a wall that does not cover its lower right would otherwise not show.
static void lay_out_wall(struct pel_state *state) {
    for (int i = 0; i < state->window_count; i++)
        state->windows[i].part =
            pel_wall_fit(&state->options->scene->wall, i, state->wall_px, state->windows[i].pixels);
    add_parts(state, state->compare.mode == PEL_COMPARE_SLICES);
    if (state->picture_count == 0)
        add_parts(state, false);
}

static void lay_out_single(struct pel_state *state) {
    const int *pixels = state->windows[0].pixels;
    int left = pel_panels_width(state);
    const struct pel_rectangle whole = {left, 0, pixels[0] - left, pixels[1]};
    struct pel_rectangle places[4];
    state->view_count = state->picture_count = 1;
    state->views[0] = make_view(whole);
    if (state->compare.mode != PEL_COMPARE_SLICES || !cut_in_four(&whole, places))
        return;
    for (int i = 0; i < 4; i++) {
        state->views[i] = make_view(places[i]);
        state->views[i].slot = i;
    }
    state->view_count = 4;
}

bool pel_screen_layout(struct pel_state *state) {
    struct pel_screen_view views[PEL_SCREEN_VIEWS];
    memcpy(views, state->views, sizeof views);
    int view_count = state->view_count;
    for (int i = 0; i < state->window_count; i++) {
        struct pel_pane_window *window = &state->windows[i];
        int pixels[2];
        pel_window_pixels(window->window, pixels, &window->scale);
        // A window that is minimised has none.
        if (pixels[0] > 0 && pixels[1] > 0)
            memcpy(window->pixels, pixels, sizeof pixels);
    }
    if (state->wall_px[0] > 0)
        lay_out_wall(state);
    else
        lay_out_single(state);
    // The panels may take all of a window.
    for (int i = 0; i < state->view_count; i++)
        if (state->views[i].place.width < 1 || state->views[i].place.height < 1)
            state->views[i] = views[i];
    bool moved = view_count != state->view_count;
    for (int i = 0; i < state->view_count; i++) {
        const struct pel_screen_view *now = &state->views[i], *before = &views[i];
        moved = moved || now->window != before->window || now->slot != before->slot ||
                memcmp(&now->place, &before->place, sizeof now->place) != 0 ||
                memcmp(now->whole, before->whole, sizeof now->whole) != 0 ||
                memcmp(now->offset, before->offset, sizeof now->offset) != 0;
    }
    state->slices_old = state->slices_old || moved;
    return moved;
}

// ---- Scenes ------------------------------------------------------------------------------------

// Both eyes together fill the picture; squeezed ones need an even size.
static void fit_eyes(struct pel_scene *scene) {
    struct pel_render_settings *settings = &scene->render;
    int axis = scene->stereo.kind == PEL_STEREO_TOP_BOTTOM ||
               scene->stereo.kind == PEL_STEREO_TOP_BOTTOM_HALF;
    int *size = axis == 0 ? &settings->width : &settings->height;
    int *from = &settings->region[axis], *part = &settings->region[2 + axis];
    switch (scene->stereo.kind) {
    case PEL_STEREO_SIDE_BY_SIDE:
    case PEL_STEREO_TWO_FILES:
    case PEL_STEREO_TOP_BOTTOM:
        *size = *size > 1 ? *size / 2 : 1;
        *from /= 2;
        *part /= 2;
        break;
    case PEL_STEREO_SIDE_BY_SIDE_HALF:
    case PEL_STEREO_TOP_BOTTOM_HALF:
        if (*part > 0)
            *part = *part > 1 ? *part & ~1 : *part;
        else
            *size = *size > 1 ? *size & ~1 : 2;
        break;
    default:
        break;
    }
}

void pel_screen_fit_whole(const struct pel_state *state, struct pel_scene *scene) {
    struct pel_render_settings *settings = &scene->render;
    settings->width = state->views[0].whole[0];
    settings->height = state->views[0].whole[1];
    memset(settings->region, 0, sizeof settings->region);
    fit_eyes(scene);
}

void pel_screen_fit_scene(const struct pel_state *state, int view, struct pel_scene *scene) {
    const struct pel_screen_view *shown = &state->views[view];
    struct pel_render_settings *settings = &scene->render;
    settings->width = shown->whole[0];
    settings->height = shown->whole[1];
    const int region[4] = {shown->offset[0], shown->offset[1], shown->place.width,
                           shown->place.height};
    bool all = region[2] == settings->width && region[3] == settings->height;
    memset(settings->region, 0, sizeof settings->region);
    if (!all)
        memcpy(settings->region, region, sizeof region);
    fit_eyes(scene);
}

const char *pel_screen_device(const struct pel_state *state, int number,
                              const struct pel_scene *scene) {
    int region = state->views[number % state->picture_count].window;
    return region < scene->wall.region_count ? scene->wall.regions[region].device : "";
}

// ---- Drawing -----------------------------------------------------------------------------------

void pel_screen_upload(struct pel_state *state, int view, const struct pel_pixels *pixels) {
    struct pel_screen_view *shown = &state->views[view];
    const struct pel_pane_window *window = &state->windows[shown->window];
    memcpy(shown->part, pixels->part, sizeof shown->part);
    pel_window_draw_on(window->window);
    int slot = shown->slot;
    if (pixels->rgba) {
        pel_present_upload(window->present, slot, pixels->width, pixels->height, pixels->rgba);
    } else if (pixels->loan) {
        pel_present_take(window->present, slot, pixels->width, pixels->height,
                         pel_loan_name(pixels->loan));
        pel_loan_read(pixels->loan);
    }
}

// Draws one window into whatever drawing goes to; `seconds` after the last time.
static void draw_window(struct pel_state *state, int number, double seconds) {
    const struct pel_pane_window *window = &state->windows[number];
    pel_present_begin(window->present, window->pixels);
    for (int i = 0; i < state->view_count; i++) {
        const struct pel_screen_view *view = &state->views[i];
        if (view->window == number)
            pel_present_draw(window->present, view->slot, view->part, &view->place);
    }
    if (state->with_panels)
        pel_panels_draw(state, number, seconds);
}

void pel_screen_draw(struct pel_state *state) {
    double seconds = (state->now_ms - state->drawn_ms) / 1e3;
    state->drawn_ms = state->now_ms;
    for (int i = 0; i < state->window_count; i++) {
        pel_window_draw_on(state->windows[i].window);
        draw_window(state, i, seconds);
    }
    for (int i = 0; i < state->window_count; i++)
        pel_window_show(state->windows[i].window);
}

static void copy_pixels(struct pel_image *image, const int at[2], const int size[2],
                        const uint8_t *rgb) {
    for (int y = 0; y < size[1] && at[1] + y < image->height; y++)
        for (int x = 0; x < size[0] && at[0] + x < image->width; x++) {
            size_t to_pixel = (size_t)(at[1] + y) * (size_t)image->width + (size_t)(at[0] + x);
            const uint8_t *from = &rgb[3 * ((size_t)y * (size_t)size[0] + (size_t)x)];
            for (int c = 0; c < 3; c++)
                image->rgba[4 * to_pixel + (size_t)c] = (float)from[c] / 255;
        }
}

bool pel_screen_save(struct pel_state *state, const char *path) {
    const int *size =
        state->wall_px[0] > 0 ? state->windows[0].part.whole : state->windows[0].pixels;
    struct pel_image *image = pel_image_create(size[0], size[1]);
    if (!image)
        return false;
    for (size_t i = 0; i < (size_t)size[0] * (size_t)size[1]; i++)
        memcpy(&image->rgba[4 * i], (float[]){0, 0, 0, 1}, 4 * sizeof *image->rgba);
    for (int i = 0; i < state->window_count; i++) {
        const struct pel_pane_window *window = &state->windows[i];
        pel_window_draw_on(window->window);
        if (!pel_present_catch(window->present, window->pixels))
            continue;
        draw_window(state, i, 0);
        uint8_t *rgb = pel_present_caught(window->present);
        if (rgb)
            copy_pixels(image, window->part.region, window->pixels, rgb);
        free(rgb);
    }
    bool good = pel_image_save(image, path, NULL);
    pel_image_destroy(image);
    return good;
}
