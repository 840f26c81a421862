// describe.c - what `pellucid info` says about one volume.
#include "cli/describe.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/frame.h"
#include "cli/report.h"

enum { SKETCH_CELLS = 64 };

static const int shown_percentiles[] = {1, 5, 25, 50, 75, 95, 99};
enum { SHOWN_PERCENTILES = sizeof shown_percentiles / sizeof *shown_percentiles };

static void begin_line(int indent, const char *label) {
    printf("%*s%-12s ", indent, "", label);
}

// Counts as bars of eighths, on a logarithmic scale: air would hide everything else.
static void print_sketch(const uint64_t *histogram) {
    static const char *const bars[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    double cells[SKETCH_CELLS] = {0}, highest = 0;
    for (int bin = 0; bin < PEL_HISTOGRAM_BINS; bin++)
        cells[bin * SKETCH_CELLS / PEL_HISTOGRAM_BINS] += (double)histogram[bin];
    for (int i = 0; i < SKETCH_CELLS; i++)
        highest = fmax(highest, cells[i]);
    for (int i = 0; i < SKETCH_CELLS; i++) {
        int level = highest > 0 ? (int)lround(8 * log1p(cells[i]) / log1p(highest)) : 0;
        // What is there at all is seen.
        fputs(bars[cells[i] > 0 && level == 0 ? 1 : level], stdout);
    }
    putchar('\n');
}

static void print_frame(const struct pel_volume *volume, int indent) {
    struct frame frame;
    frame_describe(&frame, volume);
    double spacing_mm[3];
    pel_volume_spacing(volume, spacing_mm);
    begin_line(indent, "spacing");
    printf("%.6g x %.6g x %.6g mm, in all %.5g x %.5g x %.5g mm\n", spacing_mm[0], spacing_mm[1],
           spacing_mm[2], frame.size_mm[0], frame.size_mm[1], frame.size_mm[2]);
    begin_line(indent, "axes");
    if (frame.oblique_deg > 0)
        printf("%s, oblique by %.3g degrees\n", frame.axes, frame.oblique_deg);
    else
        printf("%s\n", frame.axes);
    begin_line(indent, "origin");
    printf("%.6g, %.6g, %.6g mm\n", frame.origin[0], frame.origin[1], frame.origin[2]);
    if (volume->space[0]) {
        begin_line(indent, "placed by");
        printf("%s\n", volume->space);
    }
}

static void print_values(const struct pel_volume *volume, const struct pel_statistics *statistics,
                         int indent) {
    begin_line(indent, "values");
    if (statistics->count == 0) {
        printf("none: every voxel is absent\n");
        return;
    }
    printf("%.6g to %.6g%s%s, mean %.6g, deviation %.6g\n", statistics->min, statistics->max,
           volume->unit[0] ? " " : "", volume->unit, statistics->mean, statistics->deviation);
    if (volume->slope != 1 || volume->intercept != 0) {
        begin_line(indent, "rescaled");
        printf("value = %.9g * raw + %.9g\n", volume->slope, volume->intercept);
    }
    begin_line(indent, "percentiles");
    for (int i = 0; i < SHOWN_PERCENTILES; i++)
        printf("%s%d%%: %.5g", i ? "  " : "", shown_percentiles[i],
               statistics->percentiles[shown_percentiles[i]]);
    putchar('\n');
    if (statistics->absent_count > 0) {
        begin_line(indent, "absent");
        printf("%zu voxels (%.3g %%)\n", statistics->absent_count,
               100.0 * (double)statistics->absent_count /
                   (double)(statistics->count + statistics->absent_count));
    }
    begin_line(indent, "histogram");
    print_sketch(statistics->histogram);
    if (!volume->labels && pel_volume_seems_labels(volume)) {
        begin_line(indent, "perhaps");
        printf("a label map: --labels takes it as one, and --set volumes.0.labels=true of render "
               "and view\n");
    }
}

void describe_print(const struct pel_volume *volume, const struct pel_statistics *statistics,
                    int indent) {
    char bytes[REPORT_TEXT_BYTES];
    begin_line(indent, "voxels");
    printf("%d x %d x %d %s%s, %s\n", volume->dims[0], volume->dims[1], volume->dims[2],
           pel_voxel_type_name(volume->type), volume->labels ? " labels" : "",
           report_bytes(bytes, pel_volume_bytes(volume)));
    print_frame(volume, indent);
    print_values(volume, statistics, indent);
}

static json_t *dims_json(const int dims[3]) {
    json_t *array = json_array();
    for (int axis = 0; axis < 3; axis++)
        json_array_append_new(array, json_integer(dims[axis]));
    return array;
}

static void add_frame(json_t *object, const struct pel_volume *volume) {
    struct frame frame;
    frame_describe(&frame, volume);
    double spacing_mm[3];
    pel_volume_spacing(volume, spacing_mm);
    json_object_set_new(object, "spacing_mm", report_numbers(spacing_mm, 3));
    json_object_set_new(object, "size_mm", report_numbers(frame.size_mm, 3));
    json_object_set_new(object, "axes", json_string(frame.axes));
    json_object_set_new(object, "oblique_deg", report_number(frame.oblique_deg));
    json_object_set_new(object, "origin_mm", report_numbers(frame.origin, 3));
    json_t *rows = json_array();
    for (int row = 0; row < 4; row++)
        json_array_append_new(rows, report_numbers(volume->world_from_voxel.m[row], 4));
    json_object_set_new(object, "world_from_voxel", rows);
    json_object_set_new(object, "space", report_text(volume->space));
}

static void add_values(json_t *object, const struct pel_statistics *statistics) {
    json_object_set_new(object, "count", json_integer((json_int_t)statistics->count));
    json_object_set_new(object, "absent_count", json_integer((json_int_t)statistics->absent_count));
    json_object_set_new(object, "min", report_number(statistics->min));
    json_object_set_new(object, "max", report_number(statistics->max));
    json_object_set_new(object, "mean", report_number(statistics->mean));
    json_object_set_new(object, "deviation", report_number(statistics->deviation));
    json_object_set_new(object, "percentiles", report_numbers(statistics->percentiles, 101));
    json_t *histogram = json_array();
    for (int bin = 0; bin < PEL_HISTOGRAM_BINS; bin++)
        json_array_append_new(histogram, json_integer((json_int_t)statistics->histogram[bin]));
    json_object_set_new(object, "histogram", histogram);
}

json_t *describe_json(const struct pel_volume *volume, const struct pel_statistics *statistics) {
    json_t *object = json_object();
    json_object_set_new(object, "name", report_text(volume->name));
    json_object_set_new(object, "dims", dims_json(volume->dims));
    json_object_set_new(object, "type", json_string(pel_voxel_type_name(volume->type)));
    json_object_set_new(object, "labels", json_boolean(volume->labels));
    json_object_set_new(object, "seems_labels", json_boolean(pel_volume_seems_labels(volume)));
    json_object_set_new(object, "bytes", json_integer((json_int_t)pel_volume_bytes(volume)));
    add_frame(object, volume);
    json_object_set_new(object, "unit", report_text(volume->unit));
    json_object_set_new(object, "slope", report_number(volume->slope));
    json_object_set_new(object, "intercept", report_number(volume->intercept));
    add_values(object, statistics);
    return object;
}
