// probe.h - what one ray was found to meet, as the kernel `probe` writes it.
#ifndef SHARED_PROBE_H
#define SHARED_PROBE_H

#include "shared/types.h"
#include "shared/world.h"

// Room for samples. A longer ray is counted to its end but its later samples are not written.
#define PROBE_SAMPLE_MAX 65536

// A part that the ray crosses: its samples first <= i < end.
struct probe_part {
    i32 part, first, end;
    float first_mm, step_mm; // where its sample 0 lies on the ray, and the distance to the next
    i32 pad[3];
};

SHARED_ASSERT(sizeof(struct probe_part) == 32, probe_part_size);

// One sample of one part.
struct probe_sample {
    float x, y, z;  // place in memory coordinates
    float raw;      // value as the reader gave it
    float strength; // as the tables hold it; 0: not visible
    float r, g, b;  // straight colour, shaded; 0 where it is not visible
    float before;   // opacity that the ray had gathered
    i32 part;
    i32 number; // of the sample
    i32 steps;  // that it stands for, itself the first
};

SHARED_ASSERT(sizeof(struct probe_sample) == 48, probe_sample_size);

struct probe {
    float4 light; // premultiplied, background included
    i32 part_count;
    i32 sample_count; // may be more than there is room for
    i32 pad[2];
    struct probe_part parts[WORLD_PART_MAX];
};

SHARED_ASSERT(sizeof(struct probe) == 32 + 32 * WORLD_PART_MAX, probe_size);

#endif
