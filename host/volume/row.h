// row.h - rows of voxels as doubles: what operations on volumes of any type work on. A row is read
// channel by channel, worked on, and written back in the type of the target.
#ifndef PEL_VOLUME_ROW_H
#define PEL_VOLUME_ROW_H

#include "pellucid.h"

// Values per voxel: 3 and 4 for colours, 1 for all others.
int pel_row_channels(enum pel_voxel_type type);

// The first byte of row (j, k).
void *pel_row_at(const struct pel_volume *volume, int j, int k);

// Reads row (j, k) as dims[0] * channels raw values.
void pel_row_read(const struct pel_volume *volume, int j, int k, double *out);

// The least and greatest raw value of an integer or colour type.
void pel_row_type_range(enum pel_voxel_type type, double *low, double *high);

// Writes row (j, k). For integer types values are rounded to nearest (halves up) and clamped; a NaN
// becomes the least one. Returns how many values were clamped, NaNs not counted.
size_t pel_row_write(struct pel_volume *volume, int j, int k, const double *in);

#endif
