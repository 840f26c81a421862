// panel_file.c - saving, undoing, and what the last picture took.
#include <stdio.h>
#include <string.h>

#include "viewer/panel.h"
#include "viewer/show.h"

void pel_panel_statistics(struct pel_state *state) {
    const struct pel_render_statistics *taken = &state->shown.statistics;
    const struct pel_quality *quality = &state->shown.quality;
    const char *reason = pel_show_presented(state);
    char text[1024];
    snprintf(text, sizeof text,
             "%.1f pictures/s, %.1f ms each\n"
             "1/%d of the pixels' width, %.2g x the step, %d x %d rays%s\n"
             "%.3g million samples, %.3g million rays\n"
             "prepare %.2f  build %.1f  upload %.2f  skip %.2f\n"
             "render %.1f  download %.2f ms\n"
             "%.1f MiB on the device, %.1f KiB sent\n%s\n"
             "presented by: %s%s",
             state->shown.frame_ms > 0 ? 1e3 / state->shown.frame_ms : 0, state->shown.frame_ms,
             quality->divisor, quality->step_factor, quality->supersampling, quality->supersampling,
             state->shown.final ? "" : ", being refined", (double)taken->samples * 1e-6,
             (double)taken->rays * 1e-6, taken->prepare_ms, taken->build_ms, taken->upload_ms,
             taken->skip_ms, taken->render_ms, taken->download_ms,
             (double)taken->device_bytes / 1048576.0, (double)taken->uploaded_bytes / 1024.0,
             taken->device, reason[0] ? "pixel buffer\n" : "shared buffer", reason);
    pel_widget_text(text);
}

static void draw_step(struct pel_state *state, const char *label, const char *name,
                      enum pel_action action) {
    char text[160];
    snprintf(text, sizeof text, "%s%s%s", label, name ? ": " : "", name ? name : "");
    if (pel_widget_button_if(name != NULL, text))
        pel_command_do(state, action, 0);
}

void pel_panel_file(struct pel_state *state) {
    pel_widget_edit("scene file", state->scene_path, sizeof state->scene_path);
    if (pel_widget_button("save the scene"))
        pel_command_do(state, PEL_ACTION_SAVE_SCENE, 0);
    pel_widget_same_line();
    if (pel_widget_button("save the picture"))
        pel_command_do(state, PEL_ACTION_SAVE_PICTURE, 0);
    pel_widget_slide_int("picture width", &state->save_size[0], 0, 8192);
    pel_widget_slide_int("picture height", &state->save_size[1], 0, 8192);
    pel_widget_hint("0: as the window's");
    draw_step(state, "undo", pel_history_undo_name(state->history), PEL_ACTION_UNDO);
    draw_step(state, "redo", pel_history_redo_name(state->history), PEL_ACTION_REDO);
}
