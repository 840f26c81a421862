// narrow.h - from the host's doubles to the floats of kernels.
#ifndef PEL_WORLD_NARROW_H
#define PEL_WORLD_NARROW_H

#include "shared/types.h"

static inline float4 pel_narrow(const double v[3], double w) {
    return (float4){(float)v[0], (float)v[1], (float)v[2], (float)w};
}

#endif
