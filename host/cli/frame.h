// frame.h - how a volume lies in the body, in words.
#ifndef PEL_CLI_FRAME_H
#define PEL_CLI_FRAME_H

#include "pellucid.h"

struct frame {
    char axes[4]; // where i, j and k lead to: "RAS", "LPI", ...
    double
        oblique_deg;   // the largest angle between one of them and the world axis it is named after
    double origin[3];  // RAS millimetres of the centre of voxel (0,0,0)
    double size_mm[3]; // of the whole volume, along i, j, k
};

void frame_describe(struct frame *frame, const struct pel_volume *volume);

#endif
