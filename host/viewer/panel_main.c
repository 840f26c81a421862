// panel_main.c - the panels as a whole: the column on the left, the list of keys, messages.
#include <stdio.h>
#include <string.h>

#include "viewer/panel.h"
#include "viewer/panels.h"

// Of a message, and of a frame before its progress is worth showing.
static const double message_ms = 6000, long_ms = 400;
// Of a sentence that is longer than the window is wide.
enum { MESSAGE_LINES = 6 };

bool pel_panels_exist(void) {
    return true;
}

bool pel_panels_start(struct pel_state *state) {
    for (int i = 0; i < state->window_count; i++) {
        pel_window_draw_on(state->windows[i].window);
        if (!pel_widget_start(i, state->windows[i].scale))
            return false;
    }
    return true;
}

void pel_panels_stop(struct pel_state *state) {
    for (int i = 0; i < state->window_count; i++) {
        pel_window_draw_on(state->windows[i].window);
        pel_widget_stop(i);
    }
}

static int column_width(const struct pel_state *state) {
    if (!state->panels || !state->with_panels)
        return 0;
    int width = (int)(PEL_PANELS_COLUMN * state->windows[0].scale);
    return width < state->windows[0].pixels[0] / 2 ? width : state->windows[0].pixels[0] / 2;
}

int pel_panels_width(const struct pel_state *state) {
    return state->wall_px[0] > 0 ? 0 : column_width(state);
}

bool pel_panels_take_event(const struct pel_event *event) {
    return pel_widget_take_event(event);
}

// ---- For the parts -----------------------------------------------------------------------------

void pel_panel_changed(struct pel_state *state, const char *what) {
    pel_state_change(state, what);
}

void pel_panel_settle(struct pel_state *state) {
    if (pel_widget_settled())
        pel_state_begin_gesture(state);
}

void pel_panel_slide(struct pel_state *state, const char *label, double *value, double low,
                     double high, const char *format) {
    if (pel_widget_slide(label, value, low, high, format))
        pel_panel_changed(state, label);
    pel_panel_settle(state);
}

void pel_panel_slide_log(struct pel_state *state, const char *label, double *value, double low,
                         double high, const char *format) {
    if (pel_widget_slide_log(label, value, low, high, format))
        pel_panel_changed(state, label);
    pel_panel_settle(state);
}

// ---- The column --------------------------------------------------------------------------------

static void draw_column(struct pel_state *state) {
    static const struct {
        const char *title;
        bool open;
        void (*draw)(struct pel_state *state);
    } sections[] = {
        {"Volumes", true, pel_panel_volumes},
        {"Transfer function", true, pel_panel_transfer},
        {"Pose", false, pel_panel_pose},
        {"Compare", false, pel_panel_compare},
        {"Clipping", false, pel_panel_clip},
        {"Look", false, pel_panel_look},
        {"Lights and shading", false, pel_panel_light},
        {"Gradients and surfaces", false, pel_panel_surface},
        {"Stereo", false, pel_panel_stereo},
        {"Animation", false, pel_panel_film},
        {"Quality", false, pel_panel_quality},
        {"Statistics", false, pel_panel_statistics},
        {"File", false, pel_panel_file},
    };
    const struct pel_pane_window *window = &state->windows[0];
    pel_widget_panel_begin("column", 0, 0, column_width(state), window->pixels[1]);
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        pel_widget_push((int)i);
        if (pel_widget_section(sections[i].title, sections[i].open)) {
            sections[i].draw(state);
            pel_widget_gap();
        }
        pel_widget_pop();
    }
    pel_widget_panel_end();
}

static void draw_help(struct pel_state *state) {
    int count;
    const struct pel_key_row *rows = pel_keys_rows(&count);
    double scale = state->windows[0].scale;
    pel_widget_dialog_begin("Keys and mouse (F1 closes this)", 760 * scale, 900 * scale,
                            &state->help);
    for (int i = 0; i < count; i++) {
        if (rows[i].group) {
            pel_widget_gap();
            pel_widget_quiet_text(rows[i].group);
        }
        pel_widget_row(rows[i].keys, rows[i].help, 220 * scale);
    }
    pel_widget_dialog_end();
}

// ---- Messages ----------------------------------------------------------------------------------

// One line over the picture, the lowest being line 0.
static void draw_line(const struct pel_state *state, int line, uint32_t colour, const char *text) {
    const struct pel_pane_window *window = &state->windows[0];
    double height = pel_widget_letter_height() + 8, width = pel_widget_text_width(text) + 16;
    double left = column_width(state) + 12;
    double bottom = window->pixels[1] - 14 - line * (height + 4);
    const double low[2] = {left, bottom - height}, high[2] = {left + width, bottom};
    const double at[2] = {left + 8, bottom - height + 4};
    pel_widget_box(low, high, 0xC0202020, true);
    pel_widget_write(at, colour, text);
}

// How many bytes of the text fit beside the panels: up to a space, or all of a lone word.
static size_t fitting(const struct pel_state *state, const char *text) {
    double room = state->windows[0].pixels[0] - column_width(state) - 40;
    size_t fits = 0;
    char part[512];
    for (size_t end = 0; text[end] && end + 1 < sizeof part;) {
        end += strspn(text + end, " ");
        end += strcspn(text + end, " ");
        snprintf(part, sizeof part, "%.*s", (int)end, text);
        if (fits > 0 && pel_widget_text_width(part) > room)
            break;
        fits = end;
    }
    return fits;
}

// A sentence, in as many lines as it takes, above `line` others. Returns how many lie below then.
static int draw_sentence(const struct pel_state *state, int line, uint32_t colour,
                         const char *text) {
    const char *parts[MESSAGE_LINES];
    size_t bytes[MESSAGE_LINES];
    int count = 0;
    while (*text && count < MESSAGE_LINES) {
        text += strspn(text, " ");
        parts[count] = text;
        bytes[count] = fitting(state, text);
        text += bytes[count++];
    }
    for (int i = 0; i < count; i++) {
        char part[512];
        snprintf(part, sizeof part, "%.*s", (int)bytes[i], parts[i]);
        draw_line(state, line + count - 1 - i, colour, part);
    }
    return line + count;
}

static void draw_messages(struct pel_state *state) {
    int line = 0;
    pel_widget_draw_over(true);
    if (state->message[0] && state->now_ms - state->message_ms < message_ms)
        line = draw_sentence(state, line, 0xFFFFFFFF, state->message);
    if (state->status.sentence[0])
        line = draw_sentence(state, line, 0xFF8080FF, state->status.sentence);
    if (state->status.busy && state->status.running_ms > long_ms) {
        const struct pel_pane_window *window = &state->windows[0];
        double left = column_width(state), width = window->pixels[0] - left;
        const double low[2] = {left, window->pixels[1] - 4.0};
        const double high[2] = {left + width * state->status.finished, window->pixels[1]};
        pel_widget_box(low, high, 0xFFE0A040, true);
        // New kernels and volumes come before the first ray.
        if (!(state->status.finished > 0))
            draw_line(state, line, 0xFFE0A040, "preparing: compiling, sending");
    }
    pel_widget_draw_over(false);
}

void pel_panels_draw(struct pel_state *state, int window, double seconds) {
    pel_widget_begin(window, state->windows[window].pixels, seconds);
    if (window == 0 && state->panels)
        draw_column(state);
    if (window == 0 && state->help)
        draw_help(state);
    if (state->readouts)
        pel_panel_overlay(state, window);
    if (window == 0 && (state->readouts || state->panels))
        draw_messages(state);
    pel_widget_end();
}
