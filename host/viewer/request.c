// request.c - what the event loop asks to be rendered, and what it gets for it.
#include "viewer/request.h"

#include <stdlib.h>

void pel_request_finish(struct pel_request *request) {
    for (int i = 0; i < request->view_count; i++)
        pel_scene_destroy(request->scenes[i]);
    *request = (struct pel_request){0};
}

void pel_picture_destroy(struct pel_picture *picture) {
    if (!picture)
        return;
    for (int i = 0; i < PEL_REQUEST_VIEWS; i++) {
        free(picture->views[i].rgba);
        pel_loan_return(picture->views[i].loan);
    }
    free(picture);
}
