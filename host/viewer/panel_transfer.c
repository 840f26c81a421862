// panel_transfer.c - the transfer function of the selected volume: its opacity over a histogram, a
// strip of its colours, and points to drag on both.
//
// A click on nothing adds a point, a drag moves one, the right button takes it away.
#include <stdio.h>
#include <string.h>

#include "viewer/panel.h"
#include "viewer/transfer_edit.h"

static const double plot_px = 130, strip_px = 18, reach_px = 8;

static const uint32_t bars = 0xFF606060, curve = 0xFFE0E0E0, point = 0xFF40C0FF,
                      ground = 0xFF181818;

enum { COLUMNS = 256 };

static struct pel_instance *selected(struct pel_state *state) {
    return &state->scene->instances[state->selected];
}

static void changed(struct pel_state *state) {
    pel_panel_changed(state, "transfer function");
}

// A plot that lies on a canvas.
static struct pel_plot place_plot(struct pel_state *state, const struct pel_widget_canvas *canvas) {
    const struct pel_instance *instance = selected(state);
    struct pel_plot plot = {
        .left = canvas->x, .top = canvas->y, .width = canvas->width, .height = canvas->height};
    // While a point is dragged the plot stays as it is, or it would run away from the pointer.
    if (state->plot_held && canvas->held) {
        plot.low = state->plot_low;
        plot.high = state->plot_high;
        return plot;
    }
    pel_plot_fit(&plot, instance->transfer, &state->scene->statistics[instance->volume]);
    state->plot_low = plot.low;
    state->plot_high = plot.high;
    return plot;
}

static void draw_histogram(struct pel_state *state, const struct pel_plot *plot) {
    const struct pel_instance *instance = selected(state);
    float heights[COLUMNS];
    pel_plot_histogram(plot, &state->scene->statistics[instance->volume], COLUMNS, heights);
    double bottom = plot->top + plot->height, width = plot->width / COLUMNS;
    for (int i = 0; i < COLUMNS; i++) {
        const double low[2] = {plot->left + i * width, bottom - (double)heights[i] * plot->height};
        const double high[2] = {plot->left + (i + 1) * width, bottom};
        if (heights[i] > 0)
            pel_widget_box(low, high, bars, true);
    }
}

static void draw_opacity(const struct pel_transfer *transfer, const struct pel_plot *plot) {
    int count = transfer->opacity_count;
    double at[2], before[2] = {plot->left, pel_plot_y(plot, transfer->opacities[0].opacity)};
    for (int i = 0; i <= count; i++) {
        const struct pel_opacity_point *here = &transfer->opacities[i < count ? i : count - 1];
        at[0] = i < count ? pel_plot_x(plot, here->value) : plot->left + plot->width;
        at[1] = pel_plot_y(plot, here->opacity);
        pel_widget_line(before, at, curve, 1.5);
        memcpy(before, at, sizeof before);
    }
    for (int i = 0; i < count; i++) {
        at[0] = pel_plot_x(plot, transfer->opacities[i].value);
        at[1] = pel_plot_y(plot, transfer->opacities[i].opacity);
        pel_widget_disc(at, 4.5, point, true);
    }
}

static void edit_opacity(struct pel_state *state) {
    struct pel_transfer *transfer = selected(state)->transfer;
    struct pel_widget_canvas canvas = pel_widget_area("opacity", plot_px * state->windows[0].scale);
    struct pel_plot plot = place_plot(state, &canvas);
    const double low[2] = {canvas.x, canvas.y};
    const double high[2] = {canvas.x + canvas.width, canvas.y + canvas.height};
    double x = canvas.x + canvas.pointer[0] * canvas.width;
    double y = canvas.y + (1 - canvas.pointer[1]) * canvas.height;
    double value = pel_plot_value(&plot, x), opacity = pel_plot_opacity(&plot, y);
    int hit = pel_transfer_hit_opacity(transfer, &plot, x, y, reach_px);
    if (canvas.pressed) {
        pel_state_begin_gesture(state);
        state->plot_held = true;
        state->opacity_point = hit >= 0 ? hit : pel_transfer_add_opacity(transfer, value, opacity);
        if (hit < 0)
            changed(state);
    } else if (canvas.held && state->opacity_point >= 0 &&
               state->opacity_point < transfer->opacity_count) {
        const struct pel_opacity_point before = transfer->opacities[state->opacity_point];
        pel_transfer_move_opacity(transfer, state->opacity_point, value, opacity);
        const struct pel_opacity_point *now = &transfer->opacities[state->opacity_point];
        if (now->value != before.value || now->opacity != before.opacity)
            changed(state);
    } else if (canvas.second && hit >= 0 && pel_transfer_remove_opacity(transfer, hit)) {
        changed(state);
    }
    if (canvas.released)
        state->plot_held = false;
    pel_widget_box(low, high, ground, true);
    draw_histogram(state, &plot);
    draw_opacity(transfer, &plot);
    if (canvas.hovered) {
        char text[96];
        snprintf(text, sizeof text, "%.5g %s: %.3f per %g mm", value,
                 state->scene->volumes[selected(state)->volume]->unit,
                 opacity < 0   ? 0
                 : opacity > 1 ? 1
                               : opacity,
                 transfer->opacity_unit_mm);
        pel_widget_write((double[]){canvas.x + 4, canvas.y + 2}, 0xFFC0C0C0, text);
    }
}

static uint32_t pack_colour(const double rgba[4]) {
    uint32_t colour = 0xFF000000;
    for (int i = 0; i < 3; i++)
        colour |= (uint32_t)(rgba[i] * 255 + 0.5) << 8 * i;
    return colour;
}

static void draw_strip(const struct pel_transfer *transfer, const struct pel_plot *plot,
                       int chosen) {
    double width = plot->width / COLUMNS;
    for (int i = 0; i < COLUMNS; i++) {
        double left = plot->left + i * width, rgba[4];
        pel_transfer_evaluate(transfer, pel_plot_value(plot, left + width / 2), rgba);
        pel_widget_box((double[]){left, plot->top},
                       (double[]){left + width, plot->top + plot->height}, pack_colour(rgba), true);
    }
    for (int i = 0; i < transfer->colour_count; i++) {
        double x = pel_plot_x(plot, transfer->colours[i].value);
        pel_widget_line((double[]){x, plot->top}, (double[]){x, plot->top + plot->height},
                        i == chosen ? 0xFFFFFFFF : 0xFF000000, i == chosen ? 3 : 2);
    }
}

static void edit_colours(struct pel_state *state) {
    struct pel_transfer *transfer = selected(state)->transfer;
    struct pel_widget_canvas canvas =
        pel_widget_area("colours", strip_px * state->windows[0].scale);
    struct pel_plot plot = place_plot(state, &canvas);
    double x = canvas.x + canvas.pointer[0] * canvas.width, value = pel_plot_value(&plot, x);
    int hit = pel_transfer_hit_colour(transfer, &plot, x, reach_px);
    if (canvas.pressed) {
        pel_state_begin_gesture(state);
        state->plot_held = true;
        state->colour_point = hit >= 0 ? hit : pel_transfer_add_colour(transfer, value);
        if (hit < 0)
            changed(state);
    } else if (canvas.held && state->colour_point >= 0 &&
               state->colour_point < transfer->colour_count) {
        double before = transfer->colours[state->colour_point].value;
        pel_transfer_move_colour(transfer, state->colour_point, value);
        if (transfer->colours[state->colour_point].value != before)
            changed(state);
    } else if (canvas.second && hit >= 0 && pel_transfer_remove_colour(transfer, hit)) {
        changed(state);
    }
    if (canvas.released)
        state->plot_held = false;
    draw_strip(transfer, &plot, state->colour_point);
    if (state->colour_point >= 0 && state->colour_point < transfer->colour_count) {
        if (pel_widget_colour("colour of the point", transfer->colours[state->colour_point].rgb))
            changed(state);
        pel_panel_settle(state);
    }
}

static void draw_window(struct pel_state *state) {
    struct pel_instance *instance = selected(state);
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    double low, high, range = statistics->max - statistics->min;
    pel_transfer_window(instance->transfer, &low, &high);
    if (!(range > 0))
        return;
    double least = statistics->min - range / 2, most = statistics->max + range / 2;
    bool moved = pel_widget_slide("from", &low, least, most, "%.5g");
    pel_panel_settle(state);
    moved |= pel_widget_slide("to", &high, least, most, "%.5g");
    pel_panel_settle(state);
    if (moved && low < high) {
        pel_transfer_set_window(instance->transfer, low, high);
        changed(state);
    }
}

void pel_panel_transfer(struct pel_state *state) {
    struct pel_instance *instance = selected(state);
    edit_opacity(state);
    edit_colours(state);
    draw_window(state);
    // A function that was edited is no preset any more, so none is claimed.
    int preset = -1;
    if (pel_widget_choose("preset", pel_transfer_presets(), &preset))
        pel_command_preset(state, preset);
    pel_panel_slide_log(state, "opacity unit", &instance->transfer->opacity_unit_mm, 0.01, 100,
                        "%.3g mm");
    pel_widget_quiet_text("Click: new point. Right click: away with it. Shift + drag in the "
                          "picture: window and level.");
}
