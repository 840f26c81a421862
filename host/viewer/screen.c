// screen.c - what is where in the windows, and drawing it.
#include "viewer/screen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/panels.h"

bool pel_screen_open(struct pel_state *state, char *sentence, size_t bytes) {
    const struct pel_viewer_options *options = state->options;
    // The panels stand beside a picture of the scene's size; a size that was asked for is the
    // whole.
    const struct pel_render_settings *settings = &options->scene->render;
    struct pel_window_options wanted = {.title = "Pellucid", .monitor = options->full_screen};
    // The panels stand beside a picture of the scene's size; a size that was asked for is the
    // whole.
    wanted.place[2] = settings->width + (state->panels ? PEL_PANELS_COLUMN : 0);
    wanted.place[3] = settings->height;
    if (options->size[0] > 0)
        memcpy(&wanted.place[2], options->size, sizeof options->size);
    struct pel_pane_window *window = &state->windows[0];
    window->window = pel_window_create(&wanted, &state->queue, sentence, bytes);
    if (!window->window)
        return false;
    state->window_count = 1;
    window->present = pel_present_create(sentence, bytes);
    if (!window->present)
        return false;
    pel_window_pixels(window->window, window->pixels, &window->scale);
    state->with_panels = pel_panels_start(state);
    return true;
}

void pel_screen_close(struct pel_state *state) {
    if (state->with_panels) {
        pel_window_draw_on(state->windows[0].window);
        pel_panels_stop();
    }
    for (int i = 0; i < state->window_count; i++) {
        pel_window_draw_on(state->windows[i].window);
        pel_present_destroy(state->windows[i].present);
        pel_window_destroy(state->windows[i].window);
    }
    state->window_count = 0;
}

// The picture gives three quarters of its place to slices: axial and coronal above, sagittal at its
// left.
static void make_room_for_slices(struct pel_state *state) {
    const struct pel_rectangle whole = state->views[0].place;
    int left = whole.width / 2, top = whole.height / 2;
    int right = whole.width - left, bottom = whole.height - top;
    const struct pel_rectangle places[] = {{whole.x + left, whole.y + top, right, bottom},
                                           {whole.x, whole.y, left - 1, top - 1},
                                           {whole.x + left, whole.y, right, top - 1},
                                           {whole.x, whole.y + top, left - 1, bottom}};
    if (left < 2 || top < 2)
        return;
    for (int i = 0; i < 4; i++)
        state->views[i] = (struct pel_screen_view){.place = places[i]};
    state->view_count = 4;
    state->slices_old = true;
}

bool pel_screen_layout(struct pel_state *state) {
    struct pel_screen_view views[PEL_WORKER_VIEWS];
    memcpy(views, state->views, sizeof views);
    struct pel_pane_window *window = &state->windows[0];
    pel_window_pixels(window->window, window->pixels, &window->scale);
    state->view_count = state->picture_count = 1;
    int left = pel_panels_width(state);
    state->views[0] =
        (struct pel_screen_view){.place = {left, 0, window->pixels[0] - left, window->pixels[1]}};
    if (state->compare.mode == PEL_COMPARE_SLICES)
        make_room_for_slices(state);
    // A window that is minimised has no pixels.
    if (state->views[0].place.width < 1 || state->views[0].place.height < 1)
        memcpy(state->views, views, sizeof views);
    return memcmp(views, state->views, sizeof views) != 0;
}

void pel_screen_fit_scene(const struct pel_state *state, int view, struct pel_scene *scene) {
    const struct pel_rectangle *place = &state->views[view].place;
    struct pel_render_settings *settings = &scene->render;
    settings->width = place->width;
    settings->height = place->height;
    // Both eyes together fill the place; squeezed ones need an even size.
    switch (scene->stereo.kind) {
    case PEL_STEREO_SIDE_BY_SIDE:
    case PEL_STEREO_TWO_FILES:
        settings->width = place->width > 1 ? place->width / 2 : 1;
        break;
    case PEL_STEREO_TOP_BOTTOM:
        settings->height = place->height > 1 ? place->height / 2 : 1;
        break;
    case PEL_STEREO_SIDE_BY_SIDE_HALF:
        settings->width = place->width > 1 ? place->width & ~1 : 2;
        break;
    case PEL_STEREO_TOP_BOTTOM_HALF:
        settings->height = place->height > 1 ? place->height & ~1 : 2;
        break;
    default:
        break;
    }
}

void pel_screen_upload(struct pel_state *state, int view, int width, int height,
                       const uint8_t *rgba) {
    const struct pel_pane_window *window = &state->windows[state->views[view].window];
    pel_window_draw_on(window->window);
    pel_present_upload(window->present, view, width, height, rgba);
}

// Draws one window into whatever drawing goes to; `seconds` after the last time.
static void draw_window(struct pel_state *state, int number, double seconds) {
    const struct pel_pane_window *window = &state->windows[number];
    pel_present_begin(window->present, window->pixels);
    for (int i = 0; i < state->view_count; i++)
        if (state->views[i].window == number)
            pel_present_draw(window->present, i, &state->views[i].place);
    if (number == 0 && state->with_panels)
        pel_panels_draw(state, seconds);
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

static void copy_pixels(struct pel_image *image, int left, const int size[2], const uint8_t *rgb) {
    for (int y = 0; y < size[1]; y++)
        for (int x = 0; x < size[0]; x++) {
            float *to = &image->rgba[4 * ((size_t)y * (size_t)image->width + (size_t)(left + x))];
            const uint8_t *from = &rgb[3 * ((size_t)y * (size_t)size[0] + (size_t)x)];
            for (int c = 0; c < 3; c++)
                to[c] = (float)from[c] / 255;
            to[3] = 1;
        }
}

bool pel_screen_save(struct pel_state *state, const char *path) {
    int size[2] = {0, 1};
    for (int i = 0; i < state->window_count; i++) {
        size[0] += state->windows[i].pixels[0];
        if (state->windows[i].pixels[1] > size[1])
            size[1] = state->windows[i].pixels[1];
    }
    struct pel_image *image = pel_image_create(size[0], size[1]);
    if (!image)
        return false;
    bool good = true;
    for (int i = 0, left = 0; i < state->window_count; left += state->windows[i++].pixels[0]) {
        const struct pel_pane_window *window = &state->windows[i];
        pel_window_draw_on(window->window);
        if (!pel_present_catch(window->present, window->pixels))
            continue;
        draw_window(state, i, 0);
        uint8_t *rgb = pel_present_caught(window->present);
        if (rgb)
            copy_pixels(image, left, window->pixels, rgb);
        free(rgb);
    }
    good = pel_image_save(image, path, NULL);
    pel_image_destroy(image);
    return good;
}
