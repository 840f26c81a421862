// transfer_edit.c - a transfer function under a hand.
#include "viewer/transfer_edit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Values farther out are of no use to a device.
static const double value_max = 1e30;

static double clamp(double value, double low, double high) {
    return fmin(fmax(value, low), high);
}

// ---- The plot ----------------------------------------------------------------------------------

void pel_plot_fit(struct pel_plot *plot, const struct pel_transfer *transfer,
                  const struct pel_statistics *statistics) {
    double low, high;
    pel_transfer_window(transfer, &low, &high);
    low = fmin(low, statistics->min);
    high = fmax(high, statistics->max);
    double room = high > low ? 0.02 * (high - low) : fmax(1e-3 * fabs(high), 1e-6);
    plot->low = low - room;
    plot->high = high + room;
}

void pel_plot_zoom(struct pel_plot *plot, double x, double factor) {
    double value = pel_plot_value(plot, x), range = plot->high - plot->low;
    // Beyond that the plot would show rounding errors.
    double least = 1e-9 * fmax(fabs(plot->low), fabs(plot->high));
    if (!(range * factor > least) || !(range * factor < value_max))
        return;
    plot->low = value + (plot->low - value) * factor;
    plot->high = value + (plot->high - value) * factor;
}

double pel_plot_x(const struct pel_plot *plot, double value) {
    return plot->left + (value - plot->low) / (plot->high - plot->low) * plot->width;
}

double pel_plot_y(const struct pel_plot *plot, double opacity) {
    return plot->top + (1 - opacity) * plot->height;
}

double pel_plot_value(const struct pel_plot *plot, double x) {
    return plot->low + (x - plot->left) / plot->width * (plot->high - plot->low);
}

double pel_plot_opacity(const struct pel_plot *plot, double y) {
    return clamp(1 - (y - plot->top) / plot->height, 0, 1);
}

void pel_plot_histogram(const struct pel_plot *plot, const struct pel_statistics *statistics,
                        int count, float heights[]) {
    double width = (statistics->max - statistics->min) / PEL_HISTOGRAM_BINS, most = 0;
    for (int i = 0; i < PEL_HISTOGRAM_BINS; i++)
        most = fmax(most, log1p((double)statistics->histogram[i]));
    for (int column = 0; column < count; column++) {
        // A column is as high as the highest of the bins it covers.
        double first = plot->low + (plot->high - plot->low) * column / count;
        double last = plot->low + (plot->high - plot->low) * (column + 1) / count;
        double low = width > 0 ? floor((first - statistics->min) / width) : 0;
        double high = width > 0 ? ceil((last - statistics->min) / width) - 1 : 0;
        bool outside = last <= statistics->min || first > statistics->max;
        double height = 0;
        for (double bin = fmax(low, 0);
             !outside && bin <= fmin(fmax(low, high), PEL_HISTOGRAM_BINS - 1); bin++)
            height = fmax(height, log1p((double)statistics->histogram[(int)bin]));
        heights[column] = most > 0 ? (float)(height / most) : 0;
    }
}

// ---- Points ------------------------------------------------------------------------------------

int pel_transfer_hit_opacity(const struct pel_transfer *transfer, const struct pel_plot *plot,
                             double x, double y, double reach_px) {
    int best = -1;
    double nearest = reach_px;
    for (int i = 0; i < transfer->opacity_count; i++) {
        double distance = hypot(pel_plot_x(plot, transfer->opacities[i].value) - x,
                                pel_plot_y(plot, transfer->opacities[i].opacity) - y);
        if (distance <= nearest) {
            nearest = distance;
            best = i;
        }
    }
    return best;
}

int pel_transfer_hit_colour(const struct pel_transfer *transfer, const struct pel_plot *plot,
                            double x, double reach_px) {
    int best = -1;
    double nearest = reach_px;
    for (int i = 0; i < transfer->colour_count; i++) {
        double distance = fabs(pel_plot_x(plot, transfer->colours[i].value) - x);
        if (distance <= nearest) {
            nearest = distance;
            best = i;
        }
    }
    return best;
}

void pel_transfer_move_opacity(struct pel_transfer *transfer, int point, double value,
                               double opacity) {
    struct pel_opacity_point *points = transfer->opacities;
    double low = point > 0 ? points[point - 1].value : -value_max;
    double high = point + 1 < transfer->opacity_count ? points[point + 1].value : value_max;
    points[point].value = clamp(value, low, high);
    points[point].opacity = clamp(opacity, 0, 1);
}

void pel_transfer_move_colour(struct pel_transfer *transfer, int point, double value) {
    struct pel_colour_point *points = transfer->colours;
    double low = point > 0 ? points[point - 1].value : -value_max;
    double high = point + 1 < transfer->colour_count ? points[point + 1].value : value_max;
    points[point].value = clamp(value, low, high);
}

int pel_transfer_add_opacity(struct pel_transfer *transfer, double value, double opacity) {
    size_t count = (size_t)transfer->opacity_count;
    struct pel_opacity_point *points = realloc(transfer->opacities, (count + 1) * sizeof *points);
    if (!points)
        return -1;
    transfer->opacities = points;
    size_t at = 0;
    while (at < count && points[at].value <= value)
        at++;
    memmove(&points[at + 1], &points[at], (count - at) * sizeof *points);
    points[at] =
        (struct pel_opacity_point){clamp(value, -value_max, value_max), clamp(opacity, 0, 1)};
    transfer->opacity_count++;
    return (int)at;
}

int pel_transfer_add_colour(struct pel_transfer *transfer, double value) {
    double rgba[4];
    size_t count = (size_t)transfer->colour_count;
    pel_transfer_evaluate(transfer, value, rgba);
    struct pel_colour_point *points = realloc(transfer->colours, (count + 1) * sizeof *points);
    if (!points)
        return -1;
    transfer->colours = points;
    size_t at = 0;
    while (at < count && points[at].value <= value)
        at++;
    memmove(&points[at + 1], &points[at], (count - at) * sizeof *points);
    points[at] =
        (struct pel_colour_point){clamp(value, -value_max, value_max), {rgba[0], rgba[1], rgba[2]}};
    transfer->colour_count++;
    return (int)at;
}

bool pel_transfer_remove_opacity(struct pel_transfer *transfer, int point) {
    if (transfer->opacity_count < 2)
        return false;
    transfer->opacity_count--;
    for (int i = point; i < transfer->opacity_count; i++)
        transfer->opacities[i] = transfer->opacities[i + 1];
    return true;
}

bool pel_transfer_remove_colour(struct pel_transfer *transfer, int point) {
    if (transfer->colour_count < 2)
        return false;
    transfer->colour_count--;
    for (int i = point; i < transfer->colour_count; i++)
        transfer->colours[i] = transfer->colours[i + 1];
    return true;
}

// ---- As a whole --------------------------------------------------------------------------------

void pel_transfer_window(const struct pel_transfer *transfer, double *low, double *high) {
    *low = fmin(transfer->colours[0].value, transfer->opacities[0].value);
    *high = fmax(transfer->colours[transfer->colour_count - 1].value,
                 transfer->opacities[transfer->opacity_count - 1].value);
}

void pel_transfer_set_window(struct pel_transfer *transfer, double low, double high) {
    double from, to;
    pel_transfer_window(transfer, &from, &to);
    low = clamp(low, -value_max, value_max);
    high = clamp(high, low, value_max);
    double scale = to > from ? (high - low) / (to - from) : 0;
    if (!(to > from))
        low = (low + high) / 2;
    // The outer points land on the ends exactly; rounding must not put any beyond them.
    for (int i = 0; i < transfer->colour_count; i++)
        transfer->colours[i].value =
            clamp(low + scale * (transfer->colours[i].value - from), low, fmax(low, high));
    for (int i = 0; i < transfer->opacity_count; i++)
        transfer->opacities[i].value =
            clamp(low + scale * (transfer->opacities[i].value - from), low, fmax(low, high));
}

void pel_transfer_drag_window(double *low, double *high, const struct pel_statistics *statistics,
                              double right, double up) {
    double range = fmax(statistics->max - statistics->min, *high - *low);
    double level = (*low + *high) / 2 - up * range;
    double width = (*high - *low) * exp(right);
    // A window must not close for good, nor grow beyond all sense.
    width = clamp(width, 1e-6 * range, 1e3 * range);
    *low = level - width / 2;
    *high = level + width / 2;
}

struct pel_transfer *pel_transfer_fit_preset(const char *name,
                                             const struct pel_statistics *statistics, double low,
                                             double high, const struct pel_transfer *before) {
    struct pel_transfer *transfer = pel_transfer_preset(name);
    if (!transfer)
        return NULL;
    struct pel_statistics window = *statistics;
    if (transfer->scale == PEL_VALUES_RELATIVE && high > low) {
        window.min = low;
        window.max = high;
    }
    pel_transfer_resolve(transfer, &window);
    if (before)
        transfer->opacity_unit_mm = before->opacity_unit_mm;
    return transfer;
}
