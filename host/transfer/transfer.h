// transfer.h - inside the library: making, checking and stretching transfer functions.
#ifndef PEL_TRANSFER_TRANSFER_H
#define PEL_TRANSFER_TRANSFER_H

#include "pellucid.h"

// Values and their differences must survive as floats on a device; tables must be of sensible size.
#define PEL_TRANSFER_VALUE_MAX 1e37
#define PEL_TRANSFER_ENTRIES_MIN 2
#define PEL_TRANSFER_ENTRIES_MAX 65536

// A transfer function with room for that many points, all zero: absolute, opacity per 1 mm,
// interpolated. NULL (MEMORY). Give it back to pel_transfer_destroy.
struct pel_transfer *pel_transfer_create(int colour_count, int opacity_count);

// Fail (FORMAT) with a sentence that names the point and the value, unless values ascend and are
// within +-1e37, percentiles lie in 0..100, colours and opacities in 0..1, the opacity unit is
// positive, the table has 0 or 2..65536 entries and each curve a point. The second and third look
// at one point and its predecessor only.
bool pel_transfer_check(const struct pel_transfer *transfer);
bool pel_transfer_check_colour(const struct pel_transfer *transfer, int point);
bool pel_transfer_check_opacity(const struct pel_transfer *transfer, int point);

// Turns relative values into absolute ones, with 0 at `low` and 1 at `high`; low <= high.
void pel_transfer_stretch(struct pel_transfer *transfer, double low, double high);

#endif
