// viewer.h - a window on a scene, to explore and change it by hand.
#ifndef PEL_VIEWER_VIEWER_H
#define PEL_VIEWER_VIEWER_H

#include "pellucid.h"

// How long it took from inputs to pictures that show them (latency.h).
struct pel_viewer_latency {
    int inputs;              // wanted
    int measured, in_flight; // that were measured, and that came while a frame was in flight
    int lost;                // that did nothing
    double full_ms;          // of the first frame of full quality
    double median_ms, worst_ms;
};

// How pictures came into the windows.
struct pel_viewer_report {
    int pictures, shared;             // how many, and those through buffers that OpenCL shares
    char reason[PEL_GL_REASON_BYTES]; // why the last one did not come through these; or ""
};

struct pel_viewer_options {
    struct pel_scene *scene; // borrowed; the viewer works on a copy
    const char *scene_path;  // where the scene came from and is saved to; NULL = from volumes
    struct pel_renderer_options renderer;
    int size[2];            // of the window in screen coordinates; 0 = as the scene's picture
    int full_screen;        // on this monitor, counted from 1; 0 = in a window
    bool bare;              // begins without panels and read-outs
    const char *script;     // events to replay; NULL = none
    const char *screenshot; // the window's picture goes there at the end; NULL = nowhere
    int frames;             // ends after so many pictures were shown; 0 = does not
    struct pel_viewer_latency *latency; // measured, and then the end; NULL = is not
    struct pel_viewer_report *report;   // filled at the end; or NULL
    double rate;                        // pictures per second to hold while things move; 0 = 30
};

// Opens the window and returns when it was closed, or when script and frames are at their end:
// PEL_OK, or what kept it from opening or from saving the screenshot. The reason is then in
// `sentence`. For the main thread.
enum pel_error pel_viewer_run(const struct pel_viewer_options *options, char *sentence,
                              size_t bytes);

#endif
