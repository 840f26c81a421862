// panels_none.c - no panels: the program was built without Dear ImGui.
#include "viewer/panels.h"

bool pel_panels_exist(void) {
    return false;
}

bool pel_panels_start(struct pel_state *state) {
    (void)state;
    return false;
}

void pel_panels_stop(struct pel_state *state) {
    (void)state;
}

int pel_panels_width(const struct pel_state *state) {
    (void)state;
    return 0;
}

bool pel_panels_take_event(const struct pel_event *event) {
    (void)event;
    return false;
}

void pel_panels_draw(struct pel_state *state, int window, double seconds) {
    (void)state, (void)window, (void)seconds;
}
