// widget.h - what panels are made of, as plain C. widget.cpp makes it with Dear ImGui.
//
// Widgets are immediate: each call draws one and says what the hand did to it since the last
// picture. Everything is for the main thread, with the OpenGL context of the panels' window.
#ifndef PEL_VIEWER_WIDGET_H
#define PEL_VIEWER_WIDGET_H

#include <stdbool.h>

#include "viewer/event.h"

#ifdef __cplusplus
extern "C" {
#endif

// For a window, whose OpenGL context is current. `scale`: how much larger than usual letters are.
bool pel_widget_start(int window, double scale);
void pel_widget_stop(int window);

// An event of a window, which its panels take for themselves when they want it: true.
bool pel_widget_take_event(const struct pel_event *event);

// A picture of all of a window's panels is made between these two; the second one draws it.
void pel_widget_begin(int window, const int window_px[2], double seconds);
void pel_widget_end(void);

// ---- Places to put widgets ---------------------------------------------------------------------

// A panel at a fixed place, in pixels; widgets follow until the end, whatever begin returned.
void pel_widget_panel_begin(const char *title, double x, double y, double width, double height);
void pel_widget_panel_end(void);

// A window of its own in the middle; `open` becomes false when it is closed.
void pel_widget_dialog_begin(const char *title, double width, double height, bool *open);
void pel_widget_dialog_end(void);

// A heading that opens and closes; what is under it is drawn when it is open.
bool pel_widget_section(const char *title, bool open_at_first);

// Names are told apart by the number between these two.
void pel_widget_push(int number);
void pel_widget_pop(void);
void pel_widget_same_line(void);
void pel_widget_gap(void);

// ---- Widgets -----------------------------------------------------------------------------------

void pel_widget_text(const char *text);
void pel_widget_quiet_text(const char *text); // dimmer, wrapped
void pel_widget_row(const char *left, const char *right, double indent);
void pel_widget_hint(const char *text); // of the widget before, when the pointer rests on it
bool pel_widget_button(const char *label);
bool pel_widget_button_if(bool enabled, const char *label);
bool pel_widget_check(const char *label, bool *value);
// One of the names, which end with NULL; -1 when it is none of them.
bool pel_widget_choose(const char *label, const char *const *names, int *index);
bool pel_widget_select(const char *label, bool selected, double width); // a line of a list
bool pel_widget_edit(const char *label, char *text, int bytes);
bool pel_widget_colour(const char *label, double rgb[3]);
bool pel_widget_slide(const char *label, double *value, double low, double high,
                      const char *format);
bool pel_widget_slide_log(const char *label, double *value, double low, double high,
                          const char *format);
bool pel_widget_slide_int(const char *label, int *value, int low, int high);
bool pel_widget_drag3(const char *label, double value[3], double speed, const char *format);
void pel_widget_progress(double finished, const char *label);

// The hand let go of the widget before.
bool pel_widget_settled(void);

// ---- Drawing -----------------------------------------------------------------------------------

// Room in the panel to draw on and to be dragged on.
struct pel_widget_canvas {
    double x, y, width, height; // pixels of the window
    double pointer[2];          // where the pointer is, 0..1 from the left and from the bottom
    bool hovered, held;         // the pointer is over it; the left button went down on it
    bool pressed, released;     // ... just now
    bool second, twice;         // a click with the right button, a double click
};
struct pel_widget_canvas pel_widget_area(const char *name, double height);

// Colours are 0xAABBGGRR. Until `over` is set, drawing goes into the panel; then behind all
// panels, over the picture.
void pel_widget_draw_over(bool over);
void pel_widget_line(const double from[2], const double to[2], uint32_t colour, double width);
void pel_widget_box(const double low[2], const double high[2], uint32_t colour, bool filled);
void pel_widget_disc(const double centre[2], double radius, uint32_t colour, bool filled);
void pel_widget_write(const double at[2], uint32_t colour, const char *text);
double pel_widget_letter_height(void);
double pel_widget_text_width(const char *text);

#ifdef __cplusplus
}
#endif

#endif
