// probe_log.cl - what the ray loop tells a probe of each sample. Only where LANES is 1.
// Included by march.cl.
#ifndef PROBE_LOG_CL
#define PROBE_LOG_CL

#include "span.cl"

INLINE void log_sample(struct crossing *crossing, int c, int i, int steps, float x, float y,
                       float z, float raw, float strength, float before) {
    if (crossing->logged < PROBE_SAMPLE_MAX) {
        __global struct probe_sample *sample = &crossing->log[crossing->logged];
        sample->x = x;
        sample->y = y;
        sample->z = z;
        sample->raw = raw;
        sample->strength = strength;
        sample->r = sample->g = sample->b = 0;
        sample->before = before;
        sample->part = crossing->parts[c];
        sample->number = i;
        sample->steps = steps;
    }
    crossing->logged++;
}

// Adds the colour of the sample that was logged last.
INLINE void log_colour(struct crossing *crossing, float r, float g, float b) {
    if (crossing->logged > PROBE_SAMPLE_MAX)
        return;
    __global struct probe_sample *sample = &crossing->log[crossing->logged - 1];
    sample->r = r;
    sample->g = g;
    sample->b = b;
}

#endif
