// window.h - windows on a screen, through GLFW: the only file that knows it.
//
// Everything here is for the main thread, but where it says otherwise.
#ifndef PEL_VIEWER_WINDOW_H
#define PEL_VIEWER_WINDOW_H

#include <stddef.h>

#include "pellucid.h"
#include "viewer/event.h"

struct pel_window;

struct pel_window_options {
    const char *title;
    int number;     // comes back as `window` of its events
    int place[4];   // x, y, width, height in screen coordinates
    bool placed;    // x and y count; else the desktop chooses
    int monitor;    // full screen on this one, counted from 1; 0 = in a window
    bool unadorned; // without frame and title, for walls
    bool follows;   // does not wait for the screen: another window of the same picture does
    struct pel_window *shares; // has the same objects of OpenGL, but for what holds others; or NULL
};

// Begins and ends the use of windows. False, with the reason in `sentence`, when there is no
// display.
bool pel_window_start(char *sentence, size_t bytes);
void pel_window_stop(void);

// Opens a window whose OpenGL is 3.3 core, and makes that current. Its events go to the queue,
// which must live as long. NULL, with the reason in `sentence`.
struct pel_window *pel_window_create(const struct pel_window_options *options,
                                     struct pel_event_queue *queue, char *sentence, size_t bytes);
void pel_window_destroy(struct pel_window *window);

// A window that is never seen, for another thread's OpenGL, which shares objects with `other`. What
// was current stays so. NULL, with the reason in `sentence`.
struct pel_window *pel_window_create_unseen(struct pel_window *other, char *sentence, size_t bytes);

// Waits for events, `seconds` at most, and puts them into the queues.
void pel_window_wait(double seconds);

// Ends a wait; for any thread.
void pel_window_wake(void);

// Pixels of the picture, which may be more than screen coordinates. `scale` is how much larger
// than usual things should be drawn.
void pel_window_pixels(struct pel_window *window, int pixels[2], double *scale);

// OpenGL commands of this thread are for this window from now on, or NULL: for none. A window is
// drawn on by one thread at a time.
void pel_window_draw_on(struct pel_window *window);

// The handles of what this thread's OpenGL commands are for; any thread.
void pel_window_tell_context(struct pel_gl *gl);

// Shows what was drawn.
void pel_window_show(struct pel_window *window);

// How many monitors there are, and which one has most of the window, counted from 1; 0 = none.
int pel_window_monitor_count(void);
int pel_window_monitor(struct pel_window *window);

// Full screen on the monitor that has most of the window, and back.
void pel_window_toggle_full_screen(struct pel_window *window);
void pel_window_name(struct pel_window *window, const char *title);

#endif
