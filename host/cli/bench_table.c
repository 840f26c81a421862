// bench_table.c - the cases as Markdown tables that also read well in a terminal.
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/bench.h"
#include "cli/report.h"

enum {
    COLUMN_CASE,
    COLUMN_NAME,
    COLUMN_SIZE,
    COLUMN_VOLUMES,
    COLUMN_READER,
    COLUMN_LANES,
    COLUMN_MEDIAN,
    COLUMN_RANGE,
    COLUMN_KERNEL,
    COLUMN_SAMPLES,
    COLUMN_SPEED,
    COLUMN_RAYS,
    COLUMN_DERIVE,
    COLUMN_SENT,
    COLUMN_SKIP_BYTES,
    COLUMN_DEVICE_BYTES,
    COLUMN_BRICKS,
    COLUMN_ACTIVE,
    COLUMN_CLUSTERS,
    COLUMN_DEPTH,
    COLUMN_KERNEL_INFO,
    COLUMN_FPS,
    COLUMN_PUBLISHED,
    COLUMN_BASELINE,
    COLUMN_PEERS, // one for each
    COLUMNS = COLUMN_PEERS + BENCH_PEERS,
    CELL_BYTES = 64,
};

struct row {
    char cells[COLUMNS][CELL_BYTES];
};

static void set(struct row *row, int column, const char *format, ...) PEL_PRINTF(3, 4);

static void set(struct row *row, int column, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(row->cells[column], CELL_BYTES, format, arguments);
    va_end(arguments);
}

// Three digits, whatever the size.
static void set_number(struct row *row, int column, double value) {
    if (!isfinite(value))
        return;
    int digits = value >= 100 ? 0 : value >= 10 ? 1 : 2;
    set(row, column, "%.*f", digits, value);
}

static void fill_header(struct row *row, const struct bench *bench) {
    static const char *const names[COLUMN_PEERS] = {
        "#",          "case",          "pixels",
        "volumes",    "reader",        "lanes",
        "ms",         "range",         "kernel ms",
        "Msamples",   "Msamples/s",    "Mrays/s",
        "derive ms",  "sent KiB",      "skip KiB",
        "device MiB", "bricks",        "active",
        "clusters",   "depth, apart",  "kernel max, multiple, private bytes",
        "fps",        "published fps", "ratio",
    };
    for (int c = 0; c < COLUMN_PEERS; c++)
        set(row, c, "%s", names[c]);
    for (int p = 0; p < bench->options.peer_count; p++)
        set(row, COLUMN_PEERS + p, "/ %s", bench->options.peers[p].name);
}

// What skipping takes, and what a change sends.
static void fill_detail(struct row *row, const struct bench_case *one) {
    const struct pel_render_statistics *statistics = &one->statistics;
    const struct pel_brick_statistics *bricks = &statistics->bricks;
    if (one->detail == BENCH_PLAIN || one->problem[0])
        return;
    set_number(row, COLUMN_DERIVE, bench_median(&one->derive));
    if (one->detail == BENCH_CHANGING) {
        set_number(row, COLUMN_SENT, (double)statistics->uploaded_bytes / 1024);
        return;
    }
    set_number(row, COLUMN_RAYS, (double)statistics->rays / bench_median(&one->frame) / 1e3);
    set_number(row, COLUMN_SKIP_BYTES, (double)statistics->skip_bytes / 1024);
    set_number(row, COLUMN_DEVICE_BYTES, (double)statistics->device_bytes / (1 << 20));
    if (bricks->size == 0)
        return;
    set(row, COLUMN_BRICKS, "%llu", (unsigned long long)bricks->total);
    set(row, COLUMN_ACTIVE, "%llu", (unsigned long long)bricks->active);
    set(row, COLUMN_CLUSTERS, "%llu", (unsigned long long)bricks->clusters);
    if (one->depth[1] > 0)
        set(row, COLUMN_DEPTH, "%.2f, %.2f", one->depth[0], one->depth[1]);
}

static void fill_row(struct row *row, const struct bench *bench, int index) {
    const struct bench_case *one = &bench->cases[index];
    const struct pel_render_statistics *statistics = &one->statistics;
    set(row, COLUMN_CASE, "%d", index + 1);
    set(row, COLUMN_NAME, "%s", one->name);
    set(row, COLUMN_SIZE, "%dx%d", one->width, one->height);
    set(row, COLUMN_VOLUMES, "%d", one->volumes);
    set_number(row, COLUMN_MEDIAN, bench_median(&one->frame));
    if (one->frame.count > 1)
        set(row, COLUMN_RANGE, "%.*f-%.*f", bench_least(&one->frame) < 10, bench_least(&one->frame),
            bench_least(&one->frame) < 10, bench_greatest(&one->frame));
    if (one->problem[0])
        set(row, COLUMN_MEDIAN, "-");
    double samples = (double)statistics->samples;
    if (one->kind == BENCH_FRAME && !one->problem[0]) {
        set(row, COLUMN_READER, "%s", report_reader(statistics->reader));
        set(row, COLUMN_LANES, "%d", statistics->lanes);
        set_number(row, COLUMN_KERNEL, bench_median(&one->kernel));
        set_number(row, COLUMN_SAMPLES, samples / 1e6);
        set_number(row, COLUMN_SPEED, samples / bench_median(&one->frame) / 1e3);
    }
    if (one->kind == BENCH_FRAME)
        fill_detail(row, one);
    // Where a paper has frames per second, so have we; where groups vary, what the kernel bears.
    if (one->published_fps > 0) {
        set_number(row, COLUMN_FPS, 1e3 / bench_median(&one->frame));
        set(row, COLUMN_PUBLISHED, "%.1f", one->published_fps);
    }
    if (one->work_group_rows && !one->problem[0])
        set(row, COLUMN_KERNEL_INFO, "%zu, %zu, %llu", statistics->kernel.max_work_group,
            statistics->kernel.work_group_multiple,
            (unsigned long long)statistics->kernel.private_bytes);
    if (one->baseline_ratio.count)
        set(row, COLUMN_BASELINE, "%.2f of #%d", bench_median(&one->baseline_ratio),
            one->baseline + 1);
    for (int p = 0; one->with_peers && p < bench->options.peer_count; p++)
        if (one->ratios[p].count)
            set(row, COLUMN_PEERS + p, "%.2f", bench_median(&one->ratios[p]));
}

static void print_row(FILE *file, const struct row *row, const int widths[COLUMNS]) {
    for (int c = 0; c < COLUMNS; c++) {
        const char *cell = row->cells[c];
        if (widths[c] && c == COLUMN_NAME)
            fprintf(file, "| %-*s ", widths[c], cell);
        else if (widths[c])
            fprintf(file, "| %*s ", widths[c], cell);
    }
    fputs("|\n", file);
}

// A rule that aligns names left and numbers right.
static void print_rule(FILE *file, const int widths[COLUMNS]) {
    for (int c = 0; c < COLUMNS; c++) {
        if (!widths[c])
            continue;
        fputs(c == COLUMN_NAME ? "|:" : "|-", file);
        for (int i = 0; i < widths[c]; i++)
            fputc('-', file);
        fputs(c == COLUMN_NAME ? "-" : ":", file);
    }
    fputs("|\n", file);
}

// The rows of cases `first` up to `end`; a column with nothing in it is left out.
static void print_table(FILE *file, const struct bench *bench, int first, int end) {
    int count = end - first + 1;
    struct row *rows = calloc((size_t)count, sizeof *rows);
    if (!rows)
        return;
    int widths[COLUMNS] = {0};
    fill_header(&rows[0], bench);
    for (int r = 1; r < count; r++)
        fill_row(&rows[r], bench, first + r - 1);
    for (int c = 0; c < COLUMNS; c++) {
        bool used = false;
        for (int r = 1; r < count; r++)
            used |= rows[r].cells[c][0] != '\0';
        for (int r = 0; used && r < count; r++)
            if ((int)strlen(rows[r].cells[c]) > widths[c])
                widths[c] = (int)strlen(rows[r].cells[c]);
    }
    print_row(file, &rows[0], widths);
    print_rule(file, widths);
    for (int r = 1; r < count; r++)
        print_row(file, &rows[r], widths);
    free(rows);
}

void bench_write_table(FILE *file, const struct bench *bench, const struct bench_machine *machine) {
    fprintf(file, "Pellucid %s", pel_version());
    if (machine->device[0])
        fprintf(file, " on %s, %s, driver %s, %d compute units", machine->device, machine->version,
                machine->driver, machine->compute_units);
    fprintf(file, "; host %s, %d cores\n\n", machine->cpu[0] ? machine->cpu : "processor unknown",
            machine->cores);
    fprintf(file, "Medians of %d frame%s, taken in turns with all other cases.",
            bench->options.frames, bench->options.frames == 1 ? "" : "s");
    if (bench->options.peer_count)
        fputs(" / NAME: our time over that of the peer, below 1 is faster.", file);
    fputc('\n', file);
    for (int first = 0, end; first < bench->case_count; first = end) {
        const char *suite = bench->cases[first].suite;
        for (end = first; end < bench->case_count; end++)
            if (strcmp(bench->cases[end].suite, suite) != 0)
                break;
        fprintf(file, "\n**%s**%s\n\n", suite,
                strcmp(suite, "task") == 0 && bench->generated_task
                    ? ", with a volume of Pellucid's own making"
                    : "");
        print_table(file, bench, first, end);
    }
}
