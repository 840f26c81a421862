// crew.h - renderers that work on the views of one frame, each on its own device.
#ifndef PEL_VIEWER_CREW_H
#define PEL_VIEWER_CREW_H

#include "viewer/request.h"

struct pel_crew;

// Why a frame failed.
struct pel_crew_trouble {
    enum pel_error code;
    char sentence[512];
};

// How a frame is to be made. `go_on` is called between its batches, by several threads at once,
// with the share that is finished; when it returns false the frame is given up.
struct pel_crew_frame {
    const struct pel_request *request;
    struct pel_quality quality;
    double batch_ms;
    pel_progress_callback go_on;
    void *user;
};

// A crew with no renderers yet: they are made when they are needed. Pictures stay in what the
// lender lends where that can be; it may be NULL. NULL: memory ran out.
struct pel_crew *pel_crew_create(const struct pel_renderer_options *options,
                                 struct pel_lender *lender);

// Called first by the thread that asks for everything below, which then destroys the crew, too.
void pel_crew_enter(struct pel_crew *crew);
void pel_crew_destroy(struct pel_crew *crew);

// The one on the options' own device; NULL, with the library's error set, when there is none.
struct pel_renderer *pel_crew_first(struct pel_crew *crew);

// Renders all views of a frame, those of different devices at the same time. NULL, with the reason
// in *trouble, when one of them failed or the frame was given up. A device that failed is opened
// anew with the next frame.
struct pel_picture *pel_crew_render(struct pel_crew *crew, const struct pel_crew_frame *frame,
                                    struct pel_crew_trouble *trouble);

#endif
