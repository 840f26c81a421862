// state.h - everything the viewer knows, shared by the files that react to events, lay the window
// out and draw it.
#ifndef PEL_VIEWER_STATE_H
#define PEL_VIEWER_STATE_H

#include "viewer/clip_handles.h"
#include "viewer/compare.h"
#include "viewer/film.h"
#include "viewer/gauge.h"
#include "viewer/handles.h"
#include "viewer/history.h"
#include "viewer/navigation.h"
#include "viewer/pick.h"
#include "viewer/present.h"
#include "viewer/slice.h"
#include "viewer/viewer.h"
#include "viewer/wall.h"
#include "viewer/window.h"
#include "viewer/worker.h"

enum { PEL_STATE_SENTENCE = 512 };

// One window on the screen.
struct pel_pane_window {
    struct pel_window *window;
    struct pel_present *present;
    int pixels[2];
    double scale;              // how much larger than usual letters are
    struct pel_wall_part part; // of a wall, what it shows
};

// Of each window the picture and the three planes.
enum { PEL_SCREEN_VIEWS = 4 * PEL_WALL_MAX };

// One picture in a window, or the part of one that a window of a wall shows.
struct pel_screen_view {
    int window;
    int slot; // 0: the picture; 1 and more: slice slot - 1
    struct pel_rectangle place;
    int whole[2];   // pixels of the picture
    int offset[2];  // where in it the window's part begins; 0 without a wall
    double part[4]; // of the pixels that came last, what is shown of them: see pel_pixels
};

// What the hand is doing in the picture.
enum pel_drag {
    PEL_DRAG_NONE,
    PEL_DRAG_TURN,
    PEL_DRAG_PAN,
    PEL_DRAG_ZOOM,
    PEL_DRAG_TILT,
    PEL_DRAG_HANDLE,
    PEL_DRAG_CLIP,   // what cuts, by its gizmo
    PEL_DRAG_FACE,   // a face of a box that cuts
    PEL_DRAG_CROSS,  // the cross-hair, in a slice
    PEL_DRAG_SPLIT,  // the line between two volumes
    PEL_DRAG_LEVELS, // window and level of the selected volume
};

struct pel_state {
    const struct pel_viewer_options *options;
    struct pel_scene *scene;
    struct pel_history *history;
    struct pel_navigation navigation; // its camera is the scene's
    char name[512];                   // of the windows
    char scene_path[4096];            // where the scene is saved; "" = not yet
    char pose_path[1024];             // of the transform that the panel loads and saves
    int selected;                     // instance
    int preset;                       // the last one that a key chose

    // The hand.
    uint32_t held;               // bits of the actions whose keys are down
    enum pel_drag drag;          //
    int drag_view;               // where it began
    double drag_px[2];           // where the pointer was last, from the view's corner
    bool handles;                // of the selected volume are shown
    int clip;                    // whose handles are shown, counted from 1; 0 = none
    int face;                    // of a box that is dragged
    struct pel_clip clip_before; // when the drag began
    struct pel_handle_drag handle_drag;
    struct pel_transfer *levels_before; // owned; the transfer function when a drag of levels began
    double drag_from_px[2];             // where the drag began
    struct pel_pick pick;               // what is under the pointer
    bool picked;                        // since it moved
    uint64_t gesture;     // number of the present drag or key press: its changes are one step
    double pointer_px[2]; // where the pointer is, in the window
    int pointer_window;   //

    struct pel_event_queue queue;
    struct pel_pane_window windows[PEL_WALL_MAX];
    int window_count;
    struct pel_worker *worker;
    struct pel_lender *lender;          // of buffers that the worker shares with OpenGL, or NULL
    char unshared[PEL_GL_REASON_BYTES]; // why there is none

    struct pel_film film; // the scene's animation

    // Comparing.
    struct pel_compare compare;
    int sides[2];         // instances
    bool compare_old;     // what is compared has to be put together anew
    long flicker_turn;    //
    double cross[3];      // the cross-hair, in the world
    bool crossed;         // it has a place
    bool slices_windowed; // values as grey
    bool slices_old;      // slices have to be rendered anew

    // The values of the selected volume's mask, as they are typed.
    char mask_text[1024];
    char mask_written[1024]; // as they are

    // The plot of the transfer function.
    int opacity_point, colour_point; // taken last
    bool plot_held;                  // something is dragged on it
    double plot_low, plot_high;      // the values it shows

    // What is shown, and whether it is what should be.
    struct pel_screen_view views[PEL_SCREEN_VIEWS];
    int view_count;
    int picture_count;        // of the views, those that the worker renders; slices follow them
    int wall_px[2];           // of the whole wall as it was opened; 0 without one
    uint64_t version, sent;   // counts the changes; the last one that was given to the worker
    bool sent_moving;         // as one of many
    double changed_ms;        // when the last change was
    bool quick;               // only a quick picture of `sent` was asked for
    struct pel_picture *kept; // owned; the newest one
    struct pel_picture shown; // what is on the screen, without its pixels
    struct pel_worker_status status;
    int saved_count;             // pictures that the worker saved, and of which the user was told
    int save_size[2];            // of the next one; 0 = as the window's
    bool with_panels;            // there is something that can draw them
    bool panels, readouts, help; // whether they are shown
    double drawn_ms;             // when the windows were drawn last
    int shown_count;             // pictures so far
    int shared_count;            // and those of them that came through shared buffers
    bool redraw;                 // the windows must be drawn again
    bool sharing;                // they share their OpenGL objects

    char message[PEL_STATE_SENTENCE]; // to the user
    double message_ms;                // when it was said
    struct pel_script *script;        // NULL unless one is played
    struct pel_latency *latency;      // NULL unless it is measured
    bool quit;
    double now_ms;
};

// The scene is to be rendered anew.
void pel_state_renew(struct pel_state *state);

// The scene was changed by something that the undo button calls `what`. Changes of one gesture are
// one step.
void pel_state_change(struct pel_state *state, const char *what);

// What follows is a gesture of its own.
void pel_state_begin_gesture(struct pel_state *state);

// The navigation's camera becomes the scene's.
void pel_state_move_camera(struct pel_state *state);

// Takes another scene in place of the present one, which is destroyed.
void pel_state_set_scene(struct pel_state *state, struct pel_scene *scene);

// The view of the camera as the picture shows it that a view is, or is a part of; false when there
// is none.
bool pel_state_view(const struct pel_state *state, int number, struct pel_view *view);

// The gizmo of the selected volume in the picture, whole; false when it is not shown.
bool pel_state_gizmo(const struct pel_state *state, struct pel_gizmo *gizmo);

// The gizmo of the clip whose handles are shown; false when there is none.
bool pel_state_clip_gizmo(const struct pel_state *state, struct pel_gizmo *gizmo);

// The view of the picture in a window; -1 when that shows slices only.
int pel_state_picture_in(const struct pel_state *state, int window);

// The faces of the orientation cube in the last window with a part of the picture, in its pixels; 0
// when it is not shown.
int pel_state_cube(const struct pel_state *state, struct pel_cube_face faces[3]);

// Width over height of the picture that the camera is for.
double pel_state_aspect(const struct pel_state *state);

// Says something to the user, in the window.
void pel_state_say(struct pel_state *state, const char *format, ...) PEL_PRINTF(2, 3);

#endif
