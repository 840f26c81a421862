// progress.c - a bar on standard error for work a person is waiting for.
#include "cli/progress.h"

#include <stdio.h>
#include <unistd.h>

#include "cli/report.h"

enum { PATIENCE_MS = 500, BAR_CELLS = 40 };

void progress_begin(struct progress *progress, bool quiet) {
    *progress = (struct progress){
        .wanted = !quiet && isatty(STDERR_FILENO),
        .begin_ms = pel_clock_ms(),
    };
}

bool progress_update(double finished, void *user) {
    struct progress *progress = user;
    if (!progress->wanted || pel_clock_ms() - progress->begin_ms < PATIENCE_MS)
        return true;
    int cells = (int)(finished * BAR_CELLS);
    fprintf(stderr, "\r[%.*s%*s] %3d %%", cells, "########################################",
            BAR_CELLS - cells, "", (int)(finished * 100));
    progress->shown = true;
    return true;
}

void progress_end(struct progress *progress) {
    if (progress->shown)
        fputs("\r\033[K", stderr);
    progress->shown = false;
}
