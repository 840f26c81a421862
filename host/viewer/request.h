// request.h - what the event loop asks to be rendered, and what it gets for it.
#ifndef PEL_VIEWER_REQUEST_H
#define PEL_VIEWER_REQUEST_H

#include "viewer/lender.h"
#include "viewer/pace.h"

// Both sides of a comparison in every window of a wall.
enum { PEL_REQUEST_VIEWS = 2 * PEL_WALL_MAX };

struct pel_request {
    uint64_t id;                                 // comes back with the pictures
    struct pel_scene *scenes[PEL_REQUEST_VIEWS]; // owned; one for each view, of their own sizes
    const char *devices[PEL_REQUEST_VIEWS];      // what renders each, borrowed from its scene; NULL
                                                 // or "": what renders the rest
    int view_count;
    bool moving;      // more is to come: one quick picture, no refinement
    bool compared;    // the host wants the pixels
    double target_ms; // for the quick picture
};

// One view's pixels, as they go into an 8-bit file: RGBA, rows from the top. While things move they
// may be fewer than asked for.
struct pel_pixels {
    int width, height;
    uint8_t *rgba;         // owned by the picture; NULL: they are in the loan
    struct pel_loan *loan; // returned with the picture; or NULL
    double part[4]; // what of them the view shows: left and top edge, width and height, in shares
};

// All views of one request at one moment.
struct pel_picture {
    uint64_t id;
    struct pel_pixels views[PEL_REQUEST_VIEWS];
    int view_count;
    bool final; // of the scene's own quality
    struct pel_quality quality;
    double frame_ms;                         // from its begin until it could be taken
    struct pel_render_statistics statistics; // of the last view; of pixels that are on the host
                                             // though there was a lender, gl_reason says why
};

// Takes the request's scenes away.
void pel_request_finish(struct pel_request *request);
void pel_picture_destroy(struct pel_picture *picture);

#endif
