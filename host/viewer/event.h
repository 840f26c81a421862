// event.h - what hands do: keys, the mouse, dropped files, windows that change. Real windows and
// scripts make the same events, and everything behind the queue cannot tell them apart.
#ifndef PEL_VIEWER_EVENT_H
#define PEL_VIEWER_EVENT_H

#include <stdbool.h>
#include <stdint.h>

enum pel_event_kind {
    PEL_EVENT_NONE,
    PEL_EVENT_POINTER, // the pointer is at x, y
    PEL_EVENT_BUTTON,  // a mouse button went down or up, at x, y
    PEL_EVENT_WHEEL,   // by `wheel` notches, away from the hand is positive
    PEL_EVENT_KEY,     // a key went down (again, when `repeat`) or up
    PEL_EVENT_TEXT,    // a character was typed
    PEL_EVENT_DROP,    // a file was dropped on the window
    PEL_EVENT_SIZE,    // the window has another size, or must be drawn again
    PEL_EVENT_CLOSE,   // the window's close button
};

enum pel_button { PEL_BUTTON_LEFT, PEL_BUTTON_RIGHT, PEL_BUTTON_MIDDLE };

enum { PEL_SHIFT = 1, PEL_CONTROL = 2, PEL_ALT = 4 };

// Keys that print something are the character they print without modifiers, letters small: 'w',
// '+', ' '. The others follow.
enum pel_key {
    PEL_KEY_ESCAPE = 256,
    PEL_KEY_ENTER,
    PEL_KEY_TAB,
    PEL_KEY_BACKSPACE,
    PEL_KEY_INSERT,
    PEL_KEY_DELETE,
    PEL_KEY_LEFT,
    PEL_KEY_RIGHT,
    PEL_KEY_UP,
    PEL_KEY_DOWN,
    PEL_KEY_PAGE_UP,
    PEL_KEY_PAGE_DOWN,
    PEL_KEY_HOME,
    PEL_KEY_END,
    PEL_KEY_F1,
    PEL_KEY_F12 = PEL_KEY_F1 + 11,
    PEL_KEY_COUNT,
};

struct pel_event {
    enum pel_event_kind kind;
    int window;        // which one, from 0
    double x, y;       // pixels of its picture, from the top left corner
    int button;        // enum pel_button
    int key;           // a character, or enum pel_key
    int modifiers;     // PEL_SHIFT and so on, added up
    bool down, repeat; // of buttons and keys
    double wheel;      //
    uint32_t text;     // Unicode
    char *path;        // of a drop; owned by the queue until it is taken, then by the taker
};

// Events in the order they happened. Starts as {0}.
struct pel_event_queue {
    struct pel_event *events; // owned
    int first, count, capacity;
};

// Appends an event; a pointer that only moves on replaces the move before. False when memory ran
// out.
bool pel_event_push(struct pel_event_queue *queue, const struct pel_event *event);

// Takes the oldest. False when there is none.
bool pel_event_take(struct pel_event_queue *queue, struct pel_event *event);

// What is left is dropped.
void pel_event_finish(struct pel_event_queue *queue);

#endif
