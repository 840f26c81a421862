// lender.h - buffers of OpenGL that the rendering thread lets OpenCL write.
//
// The rendering thread has an OpenGL context of its own, behind a window that is never seen, which
// shares its objects with those of the windows. There OpenCL finds it, and buffers are made,
// acquired and released by one thread. A buffer goes round: it is lent for a picture, travels with
// it to the main thread, is read into a texture there behind a fence, and is given back with the
// picture. It is lent again when the fence has been passed, so OpenGL is done with it before OpenCL
// acquires it; and OpenCL is done with it before the picture leaves the rendering thread.
#ifndef PEL_VIEWER_LENDER_H
#define PEL_VIEWER_LENDER_H

#include "pellucid.h"

struct pel_lender;
struct pel_loan; // a buffer that was lent
struct pel_window;

// For the main thread: `window` is never seen and shares its objects with the others; it is taken.
// NULL, and the window is gone, when memory ran out. Destroying comes after the rendering thread
// has left and all loans are returned.
struct pel_lender *pel_lender_create(struct pel_window *window);
void pel_lender_destroy(struct pel_lender *lender);

// For the rendering thread: enters the context and tells its handles, and leaves it after the
// renderers that share it are gone.
void pel_lender_enter(struct pel_lender *lender, struct pel_gl *gl);
void pel_lender_leave(struct pel_lender *lender);

// For the rendering thread: a buffer of at least so many bytes, which OpenGL is done with. The
// renderer forgets one that has to go for that. NULL when there is none.
struct pel_loan *pel_lender_lend(struct pel_lender *lender, struct pel_renderer *renderer,
                                 size_t bytes);

// OpenGL's name of the buffer; 0 for NULL.
uint32_t pel_loan_name(const struct pel_loan *loan);

// For the main thread: OpenGL was told to read the buffer, in the context that is current.
void pel_loan_read(struct pel_loan *loan);

// For any thread; NULL is fine.
void pel_loan_return(struct pel_loan *loan);

#endif
