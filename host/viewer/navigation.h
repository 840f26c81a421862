// navigation.h - how a hand moves a camera. No window system: keys and drags come as numbers.
//
// Three ways to turn: `orbit` goes round the target as a globe is turned, about its axis and up and
// down; `trackball` rolls the scene as a ball under the hand, with no direction preferred; `fly`
// turns the camera where it stands. All of them turn by quaternions that act on the camera's own
// axes, which are kept perpendicular: there is no pole to get stuck at, and full turns about every
// axis come back to where they began.
#ifndef PEL_VIEWER_NAVIGATION_H
#define PEL_VIEWER_NAVIGATION_H

#include "viewer/view.h"

enum pel_navigation_mode { PEL_NAVIGATION_ORBIT, PEL_NAVIGATION_TRACKBALL, PEL_NAVIGATION_FLY };

enum { PEL_VIEWPOINT_COUNT = 10 };

struct pel_navigation {
    enum pel_navigation_mode mode;
    struct pel_camera camera; // what the hand moves; `up` is perpendicular to the line of sight
    struct pel_camera home;   // where it began
    bool upside_down;         // at the begin of a drag: orbiting turns the other way then
    struct {
        bool set;
        struct pel_camera camera;
    } viewpoints[PEL_VIEWPOINT_COUNT];
    // A transition: from `from` to `to`, of which `elapsed_s` of `duration_s` are over; 0 = none.
    struct pel_camera from, to;
    double elapsed_s, duration_s;
};

// The names of the modes, in the order of the enum; and the views behind the keys 1 to 6. Both
// lists end with NULL.
const char *const *pel_navigation_mode_names(void);
const char *const *pel_navigation_view_names(void);

// Starts at a camera, which reset brings back. Viewpoints are empty.
void pel_navigation_start(struct pel_navigation *navigation, const struct pel_camera *camera);

// Takes another camera at once, and ends a transition. `home` stays.
void pel_navigation_set(struct pel_navigation *navigation, const struct pel_camera *camera);

// ---- Drags -------------------------------------------------------------------------------------

// A button went down: settles which way orbiting turns until the next. Ends a transition.
void pel_navigation_begin(struct pel_navigation *navigation);

// The pointer moved from one pixel of a picture of that size to another.
// - rotate: as the mode says. Orbit and trackball turn by half a turn over the picture's height; in
//   fly the picture follows the pointer.
// - pan: what is at the target's distance follows the pointer exactly.
// - zoom: upwards goes closer, ten times over the picture's height.
// - roll: turns the picture about its centre, after the pointer.
void pel_navigation_rotate(struct pel_navigation *navigation, const int size[2],
                           const double from_px[2], const double to_px[2]);
void pel_navigation_pan(struct pel_navigation *navigation, const int size[2],
                        const double from_px[2], const double to_px[2]);
void pel_navigation_zoom(struct pel_navigation *navigation, const int size[2],
                         const double from_px[2], const double to_px[2]);
void pel_navigation_roll(struct pel_navigation *navigation, const int size[2],
                         const double from_px[2], const double to_px[2]);

// The wheel turned by so many clicks, forwards being positive: the picture grows by a tenth with
// each, and what is at the target's distance under the pointer stays there.
void pel_navigation_wheel(struct pel_navigation *navigation, const int size[2],
                          const double at_px[2], double clicks);

// ---- Keys --------------------------------------------------------------------------------------

// Turns to the right and up (negative: left and down) by angles: the target about the eye when
// flying, as the thesis has it, the eye about the target otherwise. And clockwise about the line of
// sight.
void pel_navigation_turn(struct pel_navigation *navigation, double right_deg, double up_deg);
void pel_navigation_tilt(struct pel_navigation *navigation, double clockwise_deg);

// Moves camera and target along the camera's axes, by shares of their distance: right, up, forward.
void pel_navigation_move(struct pel_navigation *navigation, const double right_up_forward[3]);

// ---- Places ------------------------------------------------------------------------------------

// A named side of the bounds, all of them in the picture; false for another name or no box. Fit
// keeps the direction instead. Both move smoothly if `seconds` is above 0.
bool pel_navigation_view(struct pel_navigation *navigation, const char *name,
                         const struct pel_bounds *bounds, double aspect, double seconds);
bool pel_navigation_fit(struct pel_navigation *navigation, const struct pel_bounds *bounds,
                        double aspect, double seconds);

// Back to where it started.
void pel_navigation_reset(struct pel_navigation *navigation, double seconds);

// Changes between perspective and parallel rays; what is at the target's distance keeps its size.
// With parallel rays the eye goes back until all of the bounds are before it; they may be NULL.
void pel_navigation_toggle_orthographic(struct pel_navigation *navigation,
                                        const struct pel_bounds *bounds);

// Changes the field of view; what is at the target's distance keeps its size.
void pel_navigation_set_fov(struct pel_navigation *navigation, double fov_deg);

// Viewpoints, 0 .. PEL_VIEWPOINT_COUNT - 1; recall is false for an empty one.
void pel_navigation_store(struct pel_navigation *navigation, int slot);
bool pel_navigation_recall(struct pel_navigation *navigation, int slot, double seconds);

// ---- Transitions -------------------------------------------------------------------------------

// Goes to a camera in that time, or at once when it is 0.
void pel_navigation_go(struct pel_navigation *navigation, const struct pel_camera *camera,
                       double seconds);

// Time went on. True when the camera moved.
bool pel_navigation_tick(struct pel_navigation *navigation, double seconds);

// The camera between two: 0 is the first, 1 the second. It turns about one axis, and distances
// change by equal factors in equal times.
struct pel_camera pel_navigation_between(const struct pel_camera *first,
                                         const struct pel_camera *second, double share);

#endif
