// panel_overlay.c - read-outs over the picture: which way is which, how long is what.
#include <stdio.h>

#include "viewer/gauge.h"
#include "viewer/panel.h"
#include "viewer/show.h"

static const uint32_t white = 0xFFFFFFFF, shade = 0xA0000000, taken = 0xFF40E0FF;

// The faces of the patient that are seen, with their letters.
static void draw_cube(const struct pel_state *state) {
    struct pel_cube_face faces[3];
    int count = pel_state_cube(state, faces);
    for (int i = 0; i < count; i++) {
        const struct pel_cube_face *face = &faces[i];
        for (int corner = 0; corner < 4; corner++)
            pel_widget_line(face->corners[corner], face->corners[(corner + 1) % 4], 0xFFD0D0D0,
                            1.5);
        // A face seen from its edge has no room for its letter.
        if (face->brightness < 0.3)
            continue;
        const char letter[2] = {face->letter, 0};
        const double at[2] = {face->centre[0] - pel_widget_text_width(letter) / 2,
                              face->centre[1] - pel_widget_letter_height() / 2};
        pel_widget_write(at, white, letter);
    }
}

// The bar is true at the distance of the camera's target.
static void draw_scale(const struct pel_state *state, const struct pel_view *view,
                       const struct pel_rectangle *where) {
    double scale = state->windows[0].scale;
    struct pel_scale_bar bar;
    if (!pel_scale_bar_make(&bar, view, 140 * scale))
        return;
    double right = where->x + where->width - 110 * scale;
    double left = right - bar.length_px, y = where->y + where->height - 20 * scale;
    pel_widget_line((double[]){left, y + 1}, (double[]){right, y + 1}, shade, 5 * scale);
    pel_widget_line((double[]){left, y}, (double[]){right, y}, white, 2 * scale);
    for (int i = 0; i < 2; i++) {
        double x = i ? right : left;
        pel_widget_line((double[]){x, y - 5 * scale}, (double[]){x, y + 5 * scale}, white,
                        2 * scale);
    }
    const double at[2] = {(left + right - pel_widget_text_width(bar.text)) / 2,
                          y - 6 * scale - pel_widget_letter_height()};
    pel_widget_write(at, white, bar.text);
}

// Where the picture's own pixels begin in the window of a view: outside of it on most of a wall.
static struct pel_rectangle picture_place(const struct pel_screen_view *view) {
    return (struct pel_rectangle){view->place.x - view->offset[0], view->place.y - view->offset[1],
                                  view->whole[0], view->whole[1]};
}

// A gizmo: arrows red, green and blue along x, y and z, rings about them.
static void draw_gizmo(const struct pel_gizmo *gizmo, enum pel_handle hot,
                       const struct pel_rectangle *where) {
    static const uint32_t colours[] = {0xFF5050FF, 0xFF50E050, 0xFFFF8050, 0xFFE0E0E0};
    for (int handle = PEL_HANDLE_NONE + 1; handle < PEL_HANDLE_COUNT; handle++) {
        double points[PEL_HANDLE_POINTS][2];
        int count = pel_gizmo_outline(gizmo, (enum pel_handle)handle, points);
        uint32_t colour = handle == (int)hot               ? taken
                          : handle >= PEL_HANDLE_MOVE_VIEW ? colours[3]
                                                           : colours[(handle - 1) % 3];
        for (int i = 0; i < count; i++)
            points[i][0] += where->x, points[i][1] += where->y;
        for (int i = 1; i < count; i++)
            pel_widget_line(points[i - 1], points[i], colour, handle == (int)hot ? 3 : 2);
    }
}

// The handle of a gizmo that is taken, or under the pointer.
static enum pel_handle hot_handle(const struct pel_state *state, const struct pel_gizmo *gizmo,
                                  enum pel_drag drag, const double at[2]) {
    if (state->drag != PEL_DRAG_NONE)
        return state->drag == drag ? state->handle_drag.handle : PEL_HANDLE_NONE;
    return at ? pel_gizmo_hit(gizmo, at, 8 * state->windows[0].scale) : PEL_HANDLE_NONE;
}

static void draw_edge(const struct pel_view *view, const double ends[2][3],
                      const struct pel_rectangle *where) {
    double pixels[2][2];
    if (!pel_view_project(view, ends[0], pixels[0]) || !pel_view_project(view, ends[1], pixels[1]))
        return;
    for (int end = 0; end < 2; end++)
        pixels[end][0] += where->x, pixels[end][1] += where->y;
    pel_widget_line(pixels[0], pixels[1], 0xC0E0C040, 1);
}

// The clip whose handles are shown: its outline, its gizmo, and discs on the faces of a box.
static void draw_clip(const struct pel_state *state, const struct pel_rectangle *where,
                      const double at[2]) {
    struct pel_gizmo gizmo;
    if (!pel_state_clip_gizmo(state, &gizmo))
        return;
    const struct pel_clip *clip = &state->scene->clips[state->clip - 1];
    double lines[PEL_CLIP_LINES][2][3], reach_px = 8 * state->windows[0].scale;
    int count = pel_clip_outline(clip, 1.6 * gizmo.size_mm, lines);
    for (int i = 0; i < count; i++)
        draw_edge(&gizmo.view, (const double(*)[3])lines[i], where);
    struct pel_handle_box box = pel_clip_box(clip);
    bool has_faces = clip->kind == PEL_CLIP_BOX;
    int face = state->drag == PEL_DRAG_FACE ? state->face
               : has_faces && at && state->drag == PEL_DRAG_NONE
                   ? pel_box_hit(&box, &gizmo.view, at, reach_px)
                   : -1;
    draw_gizmo(&gizmo, face >= 0 ? PEL_HANDLE_NONE : hot_handle(state, &gizmo, PEL_DRAG_CLIP, at),
               where);
    for (int i = 0; has_faces && i < 6; i++) {
        double middle[3], pixel[2];
        pel_box_face(&box, i, middle);
        if (!pel_view_project(&gizmo.view, middle, pixel))
            continue;
        pixel[0] += where->x, pixel[1] += where->y;
        pel_widget_disc(pixel, 0.7 * reach_px, i == face ? taken : 0xFFE0C040, true);
    }
}

// Handles of the selected volume and of what cuts; `at` is where the pointer is in the picture,
// NULL when it is in another window.
static void draw_handles(const struct pel_state *state, const struct pel_rectangle *where,
                         const double at[2]) {
    struct pel_gizmo gizmo;
    if (pel_state_gizmo(state, &gizmo))
        draw_gizmo(&gizmo, hot_handle(state, &gizmo, PEL_DRAG_HANDLE, at), where);
    draw_clip(state, where, at);
}

// Where the pointer's ray first sees something, and what every volume is there.
static void draw_values(struct pel_state *state, const struct pel_view *view,
                        const struct pel_screen_view *shown) {
    const struct pel_rectangle *where = &shown->place, picture = picture_place(shown);
    double right = state->pointer_px[0] - where->x, down = state->pointer_px[1] - where->y;
    if (state->drag != PEL_DRAG_NONE || right < 0 || down < 0 || right >= where->width ||
        down >= where->height)
        return;
    const double at[2] = {state->pointer_px[0] - picture.x, state->pointer_px[1] - picture.y};
    if (!state->picked)
        pel_pick(&state->pick, state->scene, view, at);
    state->picked = true;
    const struct pel_pick *pick = &state->pick;
    if (!pick->hit)
        return;
    double line_px = pel_widget_letter_height() + 3, y = where->y + 10;
    double x = where->x + 12;
    char text[160];
    snprintf(text, sizeof text, "%.1f %.1f %.1f mm (R A S)", pick->position[0], pick->position[1],
             pick->position[2]);
    for (int i = -1; i < pick->count; i++, y += line_px) {
        const struct pel_instance *instance = &state->scene->instances[i < 0 ? 0 : i];
        if (i >= 0 && !pick->values[i].inside)
            snprintf(text, sizeof text, "%s: outside", instance->name);
        else if (i >= 0)
            snprintf(text, sizeof text, "%s %.5g %s", instance->name, pick->values[i].value,
                     state->scene->volumes[instance->volume]->unit);
        const double low[2] = {x - 4, y - 1};
        const double high[2] = {x + pel_widget_text_width(text) + 4, y + line_px - 2};
        pel_widget_box(low, high, shade, true);
        pel_widget_write((double[]){x, y}, white, text);
    }
}

// The line of a split, and the cross-hair in the picture.
static void draw_comparison(const struct pel_state *state, const struct pel_view *view,
                            const struct pel_rectangle *where) {
    const struct pel_compare *compare = &state->compare;
    if (compare->mode == PEL_COMPARE_SPLIT) {
        double x = where->x + compare->split * where->width;
        double y = where->y + compare->split * where->height;
        if (compare->across)
            pel_widget_line((double[]){where->x, y}, (double[]){where->x + where->width, y}, white,
                            1);
        else
            pel_widget_line((double[]){x, where->y}, (double[]){x, where->y + where->height}, white,
                            1);
    }
    double at[2];
    if (compare->mode == PEL_COMPARE_SLICES && pel_view_project(view, state->cross, at)) {
        at[0] += where->x, at[1] += where->y;
        pel_widget_disc(at, 5, 0xFF40E0FF, false);
    }
}

// The cross-hair in the slices of a window, or the parts of them there, and what they are.
static void draw_crosses(const struct pel_state *state, int window) {
    for (int i = state->picture_count; i < state->view_count; i++) {
        const struct pel_screen_view *shown = &state->views[i];
        const struct pel_rectangle *place = &shown->place;
        struct pel_slice slice;
        double at[2];
        if (shown->window != window || !pel_show_slice(state, i, &slice))
            continue;
        pel_slice_pixel(&slice, state->cross, at);
        double right = place->x + place->width, bottom = place->y + place->height;
        double x = place->x + at[0] - shown->offset[0], y = place->y + at[1] - shown->offset[1];
        if (y >= place->y && y < bottom)
            pel_widget_line((double[]){place->x, y}, (double[]){right, y}, 0xA040E0FF, 1);
        if (x >= place->x && x < right)
            pel_widget_line((double[]){x, place->y}, (double[]){x, bottom}, 0xA040E0FF, 1);
        if (i == state->picture_count || state->views[i - 1].slot != shown->slot)
            pel_widget_write((double[]){place->x + 6, place->y + 4}, white,
                             pel_slice_names()[slice.plane]);
    }
}

void pel_panel_overlay(struct pel_state *state, int window) {
    int number = pel_state_picture_in(state, window);
    struct pel_view view;
    pel_widget_draw_over(true);
    draw_crosses(state, window);
    if (number >= 0 && pel_state_view(state, number, &view)) {
        const struct pel_screen_view *shown = &state->views[number];
        const struct pel_rectangle picture = picture_place(shown);
        const double at[2] = {state->pointer_px[0] - picture.x, state->pointer_px[1] - picture.y};
        if (number == state->picture_count - 1) {
            draw_cube(state);
            draw_scale(state, &view, &shown->place);
        }
        draw_handles(state, &picture, window == state->pointer_window ? at : NULL);
        draw_comparison(state, &view, &picture);
        if (window == state->pointer_window)
            draw_values(state, &view, shown);
    }
    pel_widget_draw_over(false);
}
