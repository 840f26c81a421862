// state.c - what the viewer knows.
#include "viewer/state.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>

double pel_state_clock_ms(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

void pel_state_change(struct pel_state *state) {
    state->version++;
    state->changed_ms = pel_state_clock_ms();
    state->redraw = true;
}

void pel_state_say(struct pel_state *state, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state->message, sizeof state->message, format, arguments);
    va_end(arguments);
    state->message_ms = pel_state_clock_ms();
    state->redraw = true;
}
