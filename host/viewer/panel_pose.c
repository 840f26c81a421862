// panel_pose.c - where the selected volume lies: numbers, and files of transforms.
#include "viewer/panel.h"

#include <math.h>

static void draw_numbers(struct pel_state *state) {
    static const char *const moves[] = {"right (x)", "anterior (y)", "superior (z)"};
    static const char *const turns[] = {"about x", "about y", "about z"};
    struct pel_pose pose = pel_command_get_pose(state);
    for (int i = 0; i < 6; i++) {
        double *value = i < 3 ? &pose.move_mm[i] : &pose.turn_deg[i - 3];
        // A rounding error would be shown as -0.00.
        if (fabs(*value) < 1e-6)
            *value = 0;
        double limit = i < 3 ? 200 : i == 4 ? 90 : 180;
        if (pel_widget_slide(i < 3 ? moves[i] : turns[i - 3], value, -limit, limit,
                             i < 3 ? "%.2f mm" : "%.2f degrees")) {
            pel_command_set_pose(state, &pose);
            pel_panel_changed(state, i < 3 ? "move a volume" : "turn a volume");
        }
        pel_panel_settle(state);
    }
    pel_widget_quiet_text("Ctrl + click on a number to type it.");
}

void pel_panel_pose(struct pel_state *state) {
    if (pel_widget_check("handles in the picture (h)", &state->handles))
        state->redraw = true;
    draw_numbers(state);
    if (pel_widget_button("back to the file's place"))
        pel_command_do(state, PEL_ACTION_RESET_POSE, 0);
    pel_widget_edit("transform", state->pose_path, sizeof state->pose_path);
    pel_widget_hint("ITK .tfm, FSL .mat, or .txt with 4 x 4 numbers");
    if (pel_widget_button("load"))
        pel_command_load_pose(state, state->pose_path);
    pel_widget_same_line();
    if (pel_widget_button("save"))
        pel_command_save_pose(state, state->pose_path);
}
