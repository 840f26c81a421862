// bench_report.c - the machine, and the cases as JSON lines.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/bench.h"
#include "cli/report.h"

// The processor's name, as Linux tells it; "" elsewhere.
static void find_cpu(char *name, size_t bytes) {
    FILE *file = fopen("/proc/cpuinfo", "r");
    char *line = NULL;
    size_t room = 0;
    name[0] = '\0';
    while (file && !name[0] && getline(&line, &room, file) >= 0) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon)
            snprintf(name, bytes, "%s", colon + 1 + strspn(colon + 1, " \t"));
    }
    name[strcspn(name, "\n")] = '\0';
    free(line);
    if (file)
        fclose(file);
}

// The device the frames were rendered on.
static const struct pel_device_info *find_device(const struct bench *bench,
                                                 const struct pel_device_info *devices, int count) {
    const char *name = "", *driver = "";
    for (int i = 0; i < bench->case_count && !name[0]; i++) {
        name = bench->cases[i].statistics.device;
        driver = bench->cases[i].statistics.driver;
    }
    for (int i = 0; i < count; i++)
        if (strcmp(devices[i].name, name) == 0 && strcmp(devices[i].driver, driver) == 0)
            return &devices[i];
    return NULL;
}

void bench_machine_describe(struct bench_machine *machine, const struct bench *bench) {
    *machine = (struct bench_machine){.cores = (int)sysconf(_SC_NPROCESSORS_ONLN)};
    find_cpu(machine->cpu, sizeof machine->cpu);
    struct pel_device_info *devices = calloc(PEL_DEVICE_MAX, sizeof *devices);
    int count = devices ? pel_device_list(devices) : 0;
    const struct pel_device_info *device = find_device(bench, devices, count);
    if (device) {
        memcpy(machine->device, device->name, sizeof machine->device);
        memcpy(machine->driver, device->driver, sizeof machine->driver);
        memcpy(machine->version, device->version, sizeof machine->version);
        machine->compute_units = device->compute_units;
    }
    free(devices);
}

// Names ending in _ms, and how many turns they come from.
static void add_times(json_t *object, const struct bench_times *times) {
    json_object_set_new(object, "median_ms", report_number(bench_median(times)));
    json_object_set_new(object, "min_ms", report_number(bench_least(times)));
    json_object_set_new(object, "max_ms", report_number(bench_greatest(times)));
    json_object_set_new(object, "frames", json_integer(times->count));
}

static json_t *bricks_json(const struct bench_case *one) {
    const struct pel_brick_statistics *bricks = &one->statistics.bricks;
    json_t *object = json_object();
    json_object_set_new(object, "size", json_integer(bricks->size));
    json_object_set_new(object, "total", json_integer((json_int_t)bricks->total));
    json_object_set_new(object, "active", json_integer((json_int_t)bricks->active));
    json_object_set_new(object, "clusters", json_integer((json_int_t)bricks->clusters));
    json_object_set_new(object, "resident", json_integer((json_int_t)bricks->resident));
    json_object_set_new(object, "activity_ms", report_number(bricks->activity_ms));
    json_object_set_new(object, "cluster_ms", report_number(bricks->cluster_ms));
    json_object_set_new(object, "tree_ms", report_number(bricks->tree_ms));
    if (one->depth[1] > 0) {
        json_object_set_new(object, "depth", report_number(one->depth[0]));
        json_object_set_new(object, "depth_apart", report_number(one->depth[1]));
    }
    return object;
}

static void add_frame(json_t *object, const struct bench_case *one) {
    const struct pel_render_statistics *statistics = &one->statistics;
    double samples = (double)statistics->samples;
    json_object_set_new(object, "kernel_ms", report_number(bench_median(&one->kernel)));
    json_object_set_new(object, "samples", json_integer((json_int_t)statistics->samples));
    json_object_set_new(object, "msamples_s",
                        report_number(samples / bench_median(&one->frame) / 1e3));
    json_object_set_new(object, "reader", json_string(report_reader(statistics->reader)));
    json_object_set_new(object, "lanes", json_integer(statistics->lanes));
    json_object_set_new(object, "work_group", json_integer(statistics->work_group));
    json_object_set_new(object, "kernel_max_work_group",
                        json_integer((json_int_t)statistics->kernel.max_work_group));
    json_object_set_new(object, "kernel_work_group_multiple",
                        json_integer((json_int_t)statistics->kernel.work_group_multiple));
    json_object_set_new(object, "kernel_private_bytes",
                        json_integer((json_int_t)statistics->kernel.private_bytes));
    json_object_set_new(object, "kernel_local_bytes",
                        json_integer((json_int_t)statistics->kernel.local_bytes));
    json_object_set_new(object, "device_bytes", json_integer((json_int_t)statistics->device_bytes));
    json_object_set_new(object, "uploaded_bytes",
                        json_integer((json_int_t)statistics->uploaded_bytes));
    json_object_set_new(object, "skip", json_string(report_skip(statistics->skip)));
    json_object_set_new(object, "skip_ms", report_number(bench_median(&one->derive)));
    json_object_set_new(object, "skip_bytes", json_integer((json_int_t)statistics->skip_bytes));
    json_object_set_new(object, "samples_skipped",
                        json_integer((json_int_t)statistics->samples_skipped));
    json_object_set_new(object, "boxes_entered",
                        json_integer((json_int_t)statistics->boxes_entered));
    json_object_set_new(object, "rays", json_integer((json_int_t)statistics->rays));
    if (one->compute_units)
        json_object_set_new(object, "compute_units", json_integer(one->compute_units));
    if (statistics->bricks.size > 0)
        json_object_set_new(object, "bricks", bricks_json(one));
}

static json_t *peers_json(const struct bench *bench, const struct bench_case *one) {
    json_t *peers = json_object();
    for (int p = 0; p < bench->options.peer_count; p++) {
        json_t *peer = json_object();
        add_times(peer, &one->peers[p]);
        json_object_set_new(peer, "ratio", report_number(bench_median(&one->ratios[p])));
        if (one->peer_problems[p][0])
            json_object_set_new(peer, "problem", report_text(one->peer_problems[p]));
        json_object_set_new(peers, bench->options.peers[p].name, peer);
    }
    return peers;
}

static json_t *case_json(const struct bench *bench, int index,
                         const struct bench_machine *machine) {
    const struct bench_case *one = &bench->cases[index];
    json_t *object = json_object();
    json_object_set_new(object, "suite", json_string(one->suite));
    json_object_set_new(object, "case", json_integer(index + 1));
    json_object_set_new(object, "name", report_text(one->name));
    if (one->transfer[0])
        json_object_set_new(object, "tf", json_string(one->transfer));
    json_object_set_new(object, "width", json_integer(one->width));
    json_object_set_new(object, "height", json_integer(one->height));
    json_object_set_new(object, "shaded", json_boolean(one->shaded));
    json_object_set_new(object, "volumes", json_integer(one->volumes));
    if (strcmp(one->suite, "task") == 0)
        json_object_set_new(object, "data",
                            json_string(bench->generated_task ? "generated" : "files"));
    add_times(object, &one->frame);
    if (one->kind == BENCH_FRAME && !one->problem[0])
        add_frame(object, one);
    if (one->problem[0])
        json_object_set_new(object, "problem", report_text(one->problem));
    if (one->baseline >= 0) {
        json_object_set_new(object, "baseline", json_integer(one->baseline + 1));
        json_object_set_new(object, "baseline_ratio",
                            report_number(bench_median(&one->baseline_ratio)));
    }
    if (one->work_group_rows)
        json_object_set_new(object, "work_group_rows", json_integer(one->work_group_rows));
    if (one->published_fps > 0)
        json_object_set_new(object, "published_fps", report_number(one->published_fps));
    if (one->with_peers && bench->options.peer_count)
        json_object_set_new(object, "peers", peers_json(bench, one));
    json_object_set_new(object, "device", report_text(machine->device));
    json_object_set_new(object, "driver", report_text(machine->driver));
    json_object_set_new(object, "threads", json_integer(machine->compute_units));
    json_object_set_new(object, "cpu", report_text(machine->cpu));
    json_object_set_new(object, "cores", json_integer(machine->cores));
    json_object_set_new(object, "version", json_string(pel_version()));
    return object;
}

void bench_write_json(FILE *file, const struct bench *bench, const struct bench_machine *machine) {
    for (int i = 0; i < bench->case_count; i++) {
        json_t *object = case_json(bench, i, machine);
        json_dumpf(object, file, JSON_COMPACT | JSON_REAL_PRECISION(6));
        json_decref(object);
        fputc('\n', file);
    }
}
