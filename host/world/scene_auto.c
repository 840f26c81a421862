// scene_auto.c - a transfer function for a volume nobody has described.
//
// The window reaches from the 2nd to the 98th percentile, so that a few outliers do not decide it.
// Inside it Otsu's threshold (1979) parts background from object: opacity is 0 up to half way from
// the window's bottom to the threshold and grows from there. Opacity is per length, so its unit
// follows the volume's size: light crosses about a dozen units.
#include "world/scene_plan.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "transfer/transfer.h"

// The value that parts the histogram, inside low..high, into two classes with the greatest
// variance between them. Values outside count as the nearest end.
static double otsu_threshold(const struct pel_statistics *statistics, double low, double high) {
    double width = (statistics->max - statistics->min) / PEL_HISTOGRAM_BINS;
    double total = 0, sum = 0, centres[PEL_HISTOGRAM_BINS];
    for (int i = 0; i < PEL_HISTOGRAM_BINS; i++) {
        centres[i] = fmin(fmax(statistics->min + (i + 0.5) * width, low), high);
        total += (double)statistics->histogram[i];
        sum += (double)statistics->histogram[i] * centres[i];
    }
    double below = 0, below_sum = 0, best = -1, threshold = low;
    for (int i = 0; i < PEL_HISTOGRAM_BINS - 1; i++) {
        below += (double)statistics->histogram[i];
        below_sum += (double)statistics->histogram[i] * centres[i];
        double above = total - below;
        if (below == 0 || above == 0)
            continue;
        double apart = below_sum / below - (sum - below_sum) / above;
        double between = below * above * apart * apart;
        if (between > best) {
            best = between;
            threshold = statistics->min + (i + 1) * width;
        }
    }
    return fmin(fmax(threshold, low), high);
}

// Where the window begins, where opacity begins, and where both end.
struct window {
    double low, start, high;
};

// The greatest value that more than one in two thousand reach, to the width of a bin.
static double robust_maximum(const struct pel_statistics *statistics) {
    double width = (statistics->max - statistics->min) / PEL_HISTOGRAM_BINS;
    uint64_t above = 0;
    for (int i = PEL_HISTOGRAM_BINS; i-- > 0;) {
        above += statistics->histogram[i];
        if (above > statistics->count / 2000)
            return statistics->min + (i + 1) * width;
    }
    return statistics->max;
}

static struct window find_window(const struct pel_statistics *statistics) {
    struct window window = {.low = statistics->percentiles[2], .high = statistics->percentiles[98]};
    // In a nearly empty volume both percentiles are background. The window then reaches to the few
    // values beyond, if they are more than outliers: those share the histogram's far bins.
    double width = (statistics->max - statistics->min) / PEL_HISTOGRAM_BINS;
    double top = robust_maximum(statistics);
    if (top - width > window.high && window.high - window.low < 0.05 * (top - window.low))
        window.high = top;
    if (!(window.high > window.low))
        window.high = statistics->max > window.low ? statistics->max : window.low + 1;
    double threshold = otsu_threshold(statistics, window.low, window.high);
    window.start = (window.low + threshold) / 2;
    return window;
}

// The edge of a cube as large as the volume's box.
static double natural_size_mm(const struct pel_volume *volume) {
    double size = cbrt(fabs(pel_matrix_determinant(&volume->world_from_voxel)));
    for (int axis = 0; axis < 3; axis++)
        size *= cbrt(volume->dims[axis]);
    return size;
}

static bool is_hounsfield(const struct pel_volume *volume,
                          const struct pel_statistics *statistics) {
    return strcmp(volume->unit, "HU") == 0 || statistics->min < -500;
}

// Spreads a preset's colours over the window and lays the opacity ramp over it.
static struct pel_transfer *make_ramp(const struct pel_transfer *colours, struct window window,
                                      double unit_mm) {
    struct pel_transfer *transfer = pel_transfer_create(colours->colour_count, 2);
    if (!transfer)
        return NULL;
    double first = colours->colours[0].value;
    double range = colours->colours[colours->colour_count - 1].value - first;
    for (int i = 0; i < colours->colour_count; i++) {
        double share = range > 0 ? (colours->colours[i].value - first) / range : 0;
        transfer->colours[i] = colours->colours[i];
        transfer->colours[i].value = window.low + share * (window.high - window.low);
    }
    transfer->opacities[0] = (struct pel_opacity_point){window.start, 0};
    transfer->opacities[1] = (struct pel_opacity_point){window.high, 0.8};
    transfer->opacity_unit_mm = unit_mm;
    return transfer;
}

struct pel_transfer *pel_scene_auto_transfer(const struct pel_volume *volume,
                                             const struct pel_statistics *statistics,
                                             const char *palette) {
    if (volume->labels)
        return pel_transfer_preset("labels");
    if (!palette && is_hounsfield(volume, statistics))
        return pel_transfer_preset("ct-bone");
    struct pel_transfer *colours = pel_transfer_preset(palette ? palette : "grey");
    if (!colours)
        return NULL;
    struct window window = find_window(statistics);
    if (volume->type == PEL_VOXEL_RGBA8)
        window = (struct window){.low = 0, .high = 255};
    struct pel_transfer *transfer = make_ramp(colours, window, natural_size_mm(volume) / 12);
    pel_transfer_destroy(colours);
    return transfer;
}
