// progress.h - a bar on standard error for work a person is waiting for.
#ifndef PEL_CLI_PROGRESS_H
#define PEL_CLI_PROGRESS_H

#include <stdbool.h>

struct progress {
    bool wanted, shown;
    double begin_ms;
};

// The bar appears only on a terminal, unless `quiet`, and only when the work lasts.
void progress_begin(struct progress *progress, bool quiet);

// A pel_progress_callback; `user` is the struct progress.
bool progress_update(double finished, void *user);

// Takes the bar away.
void progress_end(struct progress *progress);

#endif
