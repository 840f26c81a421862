// lender.c - buffers of OpenGL that the rendering thread lets OpenCL write.
#include "viewer/lender.h"

#include <epoxy/gl.h>
#include <pthread.h>
#include <stdlib.h>

#include "viewer/window.h"

// Of each view one that is rendered, one that waits and one that is shown.
enum { LOANS = 96 };

// OpenGL that takes longer to read a buffer is not waited for.
static const GLuint64 patience_ns = 1000000000;

struct pel_loan {
    struct pel_lender *lender;
    GLuint name; // 0: it was never lent
    size_t bytes;
    GLsync fence; // behind what reads it; NULL = nothing does
    bool lent;
};

struct pel_lender {
    struct pel_window *window;
    pthread_mutex_t mutex; // guards `lent` and `fence`
    struct pel_loan loans[LOANS];
};

struct pel_lender *pel_lender_create(struct pel_window *window) {
    struct pel_lender *lender = calloc(1, sizeof *lender);
    if (!lender) {
        pel_window_destroy(window);
        return NULL;
    }
    lender->window = window;
    pthread_mutex_init(&lender->mutex, NULL);
    for (int i = 0; i < LOANS; i++)
        lender->loans[i].lender = lender;
    return lender;
}

void pel_lender_destroy(struct pel_lender *lender) {
    if (!lender)
        return;
    pthread_mutex_destroy(&lender->mutex);
    pel_window_destroy(lender->window);
    free(lender);
}

void pel_lender_enter(struct pel_lender *lender, struct pel_gl *gl) {
    pel_window_draw_on(lender->window);
    pel_window_tell_context(gl);
}

void pel_lender_leave(struct pel_lender *lender) {
    for (int i = 0; i < LOANS; i++) {
        struct pel_loan *loan = &lender->loans[i];
        if (loan->name)
            glDeleteBuffers(1, &loan->name);
        if (loan->fence)
            glDeleteSync(loan->fence);
        loan->name = 0;
        loan->fence = NULL;
    }
    pel_window_draw_on(NULL);
}

// One that is free: the smallest that is large enough, else any.
static struct pel_loan *choose(struct pel_lender *lender, size_t bytes) {
    struct pel_loan *best = NULL;
    for (int i = 0; i < LOANS; i++) {
        struct pel_loan *loan = &lender->loans[i];
        if (loan->lent)
            continue;
        bool fits = loan->bytes >= bytes, best_fits = best && best->bytes >= bytes;
        if (!best || (fits && (!best_fits || loan->bytes < best->bytes)))
            best = loan;
    }
    return best;
}

// Makes the store anew, under a new name: what knew the old one cannot mistake it.
static bool enlarge(struct pel_loan *loan, struct pel_renderer *renderer, size_t bytes) {
    if (loan->name) {
        pel_renderer_forget_gl(renderer, loan->name);
        glDeleteBuffers(1, &loan->name);
    }
    while (glGetError() != GL_NO_ERROR) // of before is no news
        continue;
    glGenBuffers(1, &loan->name);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, loan->name);
    glBufferData(GL_PIXEL_UNPACK_BUFFER, (GLsizeiptr)bytes, NULL, GL_STREAM_DRAW);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    bool good = glGetError() == GL_NO_ERROR;
    loan->bytes = good ? bytes : 0;
    return good;
}

struct pel_loan *pel_lender_lend(struct pel_lender *lender, struct pel_renderer *renderer,
                                 size_t bytes) {
    pthread_mutex_lock(&lender->mutex);
    struct pel_loan *loan = choose(lender, bytes);
    GLsync fence = NULL;
    if (loan) {
        loan->lent = true;
        fence = loan->fence;
        loan->fence = NULL;
    }
    pthread_mutex_unlock(&lender->mutex);
    if (!loan)
        return NULL;
    GLenum passed = fence ? glClientWaitSync(fence, 0, patience_ns) : GL_ALREADY_SIGNALED;
    if (passed != GL_ALREADY_SIGNALED && passed != GL_CONDITION_SATISFIED) {
        loan->fence = fence;
        pel_loan_return(loan);
        return NULL;
    }
    if (fence)
        glDeleteSync(fence);
    bool good = loan->bytes >= bytes || enlarge(loan, renderer, bytes);
    glFinish();
    if (good)
        return loan;
    pel_loan_return(loan);
    return NULL;
}

uint32_t pel_loan_name(const struct pel_loan *loan) {
    return loan ? loan->name : 0;
}

void pel_loan_read(struct pel_loan *loan) {
    GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    // Nobody else makes the fence start on its way.
    glFlush();
    pthread_mutex_lock(&loan->lender->mutex);
    GLsync old = loan->fence;
    loan->fence = fence;
    pthread_mutex_unlock(&loan->lender->mutex);
    if (old)
        glDeleteSync(old);
}

void pel_loan_return(struct pel_loan *loan) {
    if (!loan)
        return;
    pthread_mutex_lock(&loan->lender->mutex);
    loan->lent = false;
    pthread_mutex_unlock(&loan->lender->mutex);
}
