// blend.h - what is between two transfer functions.
#ifndef PEL_TRANSFER_BLEND_H
#define PEL_TRANSFER_BLEND_H

#include "pellucid.h"

// The transfer function at `share` (0..1) of the way from `a` to `b`, both resolved. Each of the
// two curves by itself: with as many points in `a` as in `b` the points move, value and all;
// otherwise the curve is the mix of both at each value, which is piecewise linear again. The
// opacity unit changes linearly; the rest is that of `a`. NULL (MEMORY).
struct pel_transfer *pel_transfer_blend(const struct pel_transfer *a, const struct pel_transfer *b,
                                        double share);

#endif
