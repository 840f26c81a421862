// none.cl - skips nothing: every sample inside the box may be visible.
#ifndef NONE_CL
#define NONE_CL

#include "traverse/cursor.cl"

// The next sample from i on that may be visible.
INLINE integer cursor_leap(__constant struct part *part, __global const uchar *cells,
                           const struct cursor *cursor, integer i, mask asks) {
    return CHOOSE((integer)(SAMPLE_NEVER), max(i, cursor->next), MASK(i < cursor->end));
}

#endif
