// sample.h - the value and colour of a volume at a place.
#ifndef PEL_TEST_REFERENCE_SAMPLE_H
#define PEL_TEST_REFERENCE_SAMPLE_H

#include "pellucid.h"

struct reference_sample {
    double value;  // in the file's unit
    bool coloured; // the volume has colours of its own:
    double rgb[3]; // straight, 0..1
    double spread; // sum over the axes of the greatest difference of value between two neighbours
                   // that were interpolated: what an error of one in each weight could do
};

// False when the sample is absent. `p_voxel` may lie outside the voxels' centres: it is clamped.
bool reference_sample_volume(struct reference_sample *sample, const struct pel_volume *volume,
                             enum pel_filter filter, const double p_voxel[3]);

#endif
