// panel_overlay.c - read-outs over the picture: which way is which, how long is what.
#include <math.h>
#include <stdio.h>

#include "viewer/panel.h"
#include "viewer/vector.h"
#include "viewer/view.h"

static const uint32_t white = 0xFFFFFFFF, shade = 0xA0000000;

// A face of the cube: its letter, the axis it looks along, and to which side.
static const struct {
    const char *letter;
    int axis;
    double side;
} faces[] = {{"R", 0, 1}, {"L", 0, -1}, {"A", 1, 1}, {"P", 1, -1}, {"S", 2, 1}, {"I", 2, -1}};

// Where a point of a cube of half edges 1 around nothing is drawn.
static void place(const struct pel_view *view, const double centre[2], double half_px,
                  const double p[3], double px[2]) {
    px[0] = centre[0] + half_px * vector_dot(p, view->right);
    px[1] = centre[1] - half_px * vector_dot(p, view->up);
}

// The faces that are seen, and on each what lies there: right, left, anterior, posterior, superior,
// inferior.
static void draw_cube(const struct pel_state *state, const struct pel_view *view,
                      const struct pel_rectangle *where) {
    double half_px = 22 * state->windows[0].scale;
    const double centre[2] = {where->x + where->width - 2.2 * half_px,
                              where->y + where->height - 2.2 * half_px};
    for (size_t i = 0; i < sizeof faces / sizeof *faces; i++) {
        int axis = faces[i].axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (faces[i].side * view->forward[axis] >= 0)
            continue;
        double corners[4][2], middle[2], p[3];
        p[axis] = faces[i].side;
        for (int corner = 0; corner < 4; corner++) {
            p[u] = corner == 0 || corner == 3 ? -1 : 1;
            p[v] = corner < 2 ? -1 : 1;
            place(view, centre, half_px, p, corners[corner]);
        }
        p[u] = p[v] = 0;
        place(view, centre, half_px, p, middle);
        for (int corner = 0; corner < 4; corner++)
            pel_widget_line(corners[corner], corners[(corner + 1) % 4], 0xFFD0D0D0, 1.5);
        // A face seen from its edge has no room for its letter.
        if (fabs(view->forward[axis]) < 0.3)
            continue;
        const double at[2] = {middle[0] - pel_widget_text_width(faces[i].letter) / 2,
                              middle[1] - pel_widget_letter_height() / 2};
        pel_widget_write(at, white, faces[i].letter);
    }
}

// The longest of 1, 2, 5, 10, ... millimetres that takes no more than this.
static double round_length(double most_mm) {
    double decade = pow(10, floor(log10(most_mm)));
    return most_mm >= 5 * decade ? 5 * decade : most_mm >= 2 * decade ? 2 * decade : decade;
}

// The bar is true at the distance of the camera's target.
static void draw_scale(const struct pel_state *state, const struct pel_view *view,
                       const struct pel_rectangle *where) {
    double scale = state->windows[0].scale, mm_per_px = pel_view_target_mm_per_px(view);
    if (!(mm_per_px > 0) || !isfinite(mm_per_px))
        return;
    double mm = round_length(140 * scale * mm_per_px), px = mm / mm_per_px;
    double right = where->x + where->width - 110 * scale;
    double y = where->y + where->height - 20 * scale;
    const double from[2] = {right - px, y}, to[2] = {right, y};
    pel_widget_line((double[]){from[0], y + 1}, (double[]){to[0], y + 1}, shade, 5 * scale);
    pel_widget_line(from, to, white, 2 * scale);
    for (int i = 0; i < 2; i++) {
        double x = i ? to[0] : from[0];
        pel_widget_line((double[]){x, y - 5 * scale}, (double[]){x, y + 5 * scale}, white,
                        2 * scale);
    }
    char text[32];
    snprintf(text, sizeof text, "%g mm", mm);
    const double at[2] = {right - px / 2 - pel_widget_text_width(text) / 2,
                          y - 6 * scale - pel_widget_letter_height()};
    pel_widget_write(at, white, text);
}

void pel_panel_overlay(struct pel_state *state) {
    const struct pel_rectangle *where = &state->views[0].place;
    struct pel_view view;
    if (!pel_view_make(&view, &state->scene->camera, where->width, where->height))
        return;
    pel_widget_draw_over(true);
    draw_cube(state, &view, where);
    draw_scale(state, &view, where);
    pel_widget_draw_over(false);
}
