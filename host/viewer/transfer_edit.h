// transfer_edit.h - a transfer function under a hand: its picture over a histogram, points that are
// dragged, window and level. Everything acts on resolved functions, whose values are absolute, and
// leaves them valid.
#ifndef PEL_VIEWER_TRANSFER_EDIT_H
#define PEL_VIEWER_TRANSFER_EDIT_H

#include "pellucid.h"

// The plot: which values it shows, and where it is drawn, in pixels. Opacity 1 is at the top.
struct pel_plot {
    double low, high; // high > low
    double left, top, width, height;
};

// A plot of all of a volume's values and all points, with a little room on either side.
void pel_plot_fit(struct pel_plot *plot, const struct pel_transfer *transfer,
                  const struct pel_statistics *statistics);

// Zooms by a factor about a pixel, and moves: below 1 shows fewer values.
void pel_plot_zoom(struct pel_plot *plot, double x, double factor);

double pel_plot_x(const struct pel_plot *plot, double value);
double pel_plot_y(const struct pel_plot *plot, double opacity);
double pel_plot_value(const struct pel_plot *plot, double x);
double pel_plot_opacity(const struct pel_plot *plot, double y);

// Heights of the histogram in `count` columns over the plot, 0..1, by the logarithm of how many
// voxels there are for each value.
void pel_plot_histogram(const struct pel_plot *plot, const struct pel_statistics *statistics,
                        int count, float heights[]);

// ---- Points ------------------------------------------------------------------------------------

// The point under the pointer, give or take; the later of two in one place. -1: none. Colours are
// told by x alone: they are drawn on a strip.
int pel_transfer_hit_opacity(const struct pel_transfer *transfer, const struct pel_plot *plot,
                             double x, double y, double reach_px);
int pel_transfer_hit_colour(const struct pel_transfer *transfer, const struct pel_plot *plot,
                            double x, double reach_px);

// Moves a point, between its neighbours at most.
void pel_transfer_move_opacity(struct pel_transfer *transfer, int point, double value,
                               double opacity);
void pel_transfer_move_colour(struct pel_transfer *transfer, int point, double value);

// Adds a point; the colour is the one that is there. Returns its index, or -1 when memory ran out.
int pel_transfer_add_opacity(struct pel_transfer *transfer, double value, double opacity);
int pel_transfer_add_colour(struct pel_transfer *transfer, double value);

// Takes a point away; false for the last one.
bool pel_transfer_remove_opacity(struct pel_transfer *transfer, int point);
bool pel_transfer_remove_colour(struct pel_transfer *transfer, int point);

// ---- As a whole --------------------------------------------------------------------------------

// The values between the outer points, and all points moved evenly so that these lie there. A
// function of one value is moved only.
void pel_transfer_window(const struct pel_transfer *transfer, double *low, double *high);
void pel_transfer_set_window(struct pel_transfer *transfer, double low, double high);

// Window and level after a drag: `right` widens the window, e times for 1; `up` lowers its level,
// by the volume's whole range for 1.
void pel_transfer_drag_window(double *low, double *high, const struct pel_statistics *statistics,
                              double right, double up);

// A preset for a volume: one with relative values is spread over low..high, others lie where they
// lie. The opacity unit of `before`, which may be NULL, stays. NULL on failure.
struct pel_transfer *pel_transfer_fit_preset(const char *name,
                                             const struct pel_statistics *statistics, double low,
                                             double high, const struct pel_transfer *before);

#endif
