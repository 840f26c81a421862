// bench.h - what `pellucid bench` measures, and how.
//
// A suite is a list of cases. All cases of a run, and the other programs (peers) they are compared
// with, are measured in turns, A B C A B C ..., so that what else the machine does hits all of them
// alike. Each turn adds one time to each case; the report takes their medians.
//
//     command_bench.c     options -> suites
//     bench_task.c ...    suites -> cases
//     bench_run.c         the turns
//     bench_peer.c        one turn of another program
//     bench_start.c       one turn of starting this program
//     bench_sequential.c  one turn of one thread in plain C
//     bench_plot.c        cases -> bar charts
//     bench_report.c      cases -> JSON lines
//     bench_table.c       cases -> a Markdown table
//     bench_ways.c        the ways to skip, and what `--skip` takes of them
#ifndef PEL_CLI_BENCH_H
#define PEL_CLI_BENCH_H

#include <stdio.h>

#include "pellucid.h"

enum { BENCH_PEERS = 8, BENCH_NAME_BYTES = 48, BENCH_FRAMES_MOST = 1000 };

// Another program that does the work of a case.
struct bench_peer {
    char name[BENCH_NAME_BYTES];
    const char *command; // for sh, with {placeholders}; borrowed
};

struct bench_options {
    int frames;        // turns
    int width, height; // 0: the suite's own
    int largest;       // voxels along a side of the largest volume of a suite
    unsigned skips;    // ways to skip that were asked for: bit w is PEL_SKIP_w; 0: the suite's own
    bool shading;      // of the task: also with light
    const char *json, *markdown, *plot, *data;
    const char *only; // a pattern of bench_keep_only; NULL: all cases
    struct pel_renderer_options renderer;
    struct bench_peer peers[BENCH_PEERS];
    int peer_count;
};

enum bench_kind {
    BENCH_FRAME,      // a frame of a scene whose voxels and kernels are on the device already
    BENCH_COLD_START, // the whole program, with no kernel compiled before
    BENCH_SEQUENTIAL, // a frame of one volume by one thread in plain C
    BENCH_WARM_START, // the whole program, with the kernels of the last cold start
};

// Times in milliseconds, one for each turn taken.
struct bench_times {
    double *ms; // owned, room for options.frames
    int count;
};

// What a case's row tells besides its times.
enum bench_detail {
    BENCH_PLAIN,
    BENCH_SKIPPING, // how much is skipped, and what that takes
    BENCH_CHANGING, // what a change sends and derives
};

struct bench_case {
    enum bench_kind kind;
    char suite[16], name[BENCH_NAME_BYTES];
    char transfer[16];       // of the task: "T1"; else ""
    int volumes;             //
    int baseline;            // the case it is compared with; -1: none
    bool optional;           // a device that cannot do it leaves it out
    bool with_peers;         // peers do the same work
    bool shaded;             // for peers to know
    struct pel_scene *scene; // borrowed from the bench; NULL for starts
    int width, height;       // of the picture, overruling the scene's
    bool sets_skip;          // as the next two say, overruling the scene
    enum pel_skip skip;      //
    struct pel_brick_settings bricks;
    enum pel_reader reader; // as asked for
    int lanes;              // as asked for; 0: the device's choice
    int work_group;         // likewise
    int work_group_rows;    // likewise
    int compute_units;      // of the device; 0: all
    enum bench_detail detail;
    double depth[2]; // of bricks: clusters on a ray, and bricks alone; 0: not looked at
    // Changes the scene before the frame that counts; NULL: nothing changes.
    void (*change)(struct pel_scene *scene, int turn);
    double published_fps; // frames per second that a paper reports of this work; 0: none

    // Results.
    char problem[256];                       // why it was left out; "": it was not
    struct pel_render_statistics statistics; // of the last frame
    struct bench_times frame, kernel;        // all of a frame; the kernel alone
    struct bench_times derive;               // what skipping goes by, when it changes
    struct bench_times peers[BENCH_PEERS];   //
    char peer_problems[BENCH_PEERS][256];    // why a peer was left out of this case
    struct bench_times ratios[BENCH_PEERS];  // ours over the peer's, turn by turn
    struct bench_times baseline_ratio;       // ours over the baseline's, turn by turn
};

struct bench {
    struct bench_options options;
    struct bench_case *cases; // owned
    int case_count;
    struct bench_kept *kept;      // owned; see bench.c
    struct bench_engine *engines; // owned; see bench_run.c
    bool generated_task;          // the task's volume is of our own making
};

// Functions that return bool or a pointer have said why when they return false or NULL.
void bench_init(struct bench *bench);
void bench_finish(struct bench *bench);

// A new case of one frame with the run's own device options, or NULL after a message. It stays
// valid until the next one is added.
struct bench_case *bench_add(struct bench *bench, const char *suite, const char *name);

// Drops the cases that the shell pattern `only` does not find in "SUITE NAME xVOLUMES WxH", such as
// "task T1, distance x8 640x480", but not the baselines of those it finds. False after a message,
// where none is left.
bool bench_keep_only(struct bench *bench);

// A scene of `count` volumes, one instance each, as the reference task wants it: samples every half
// voxel, opacity over 0.95 ends a ray, blended in order. Borrowed from the bench, as are the
// volumes, which several scenes may share. `keep` hands a volume or a loaded scene to the bench.
struct pel_scene *bench_scene(struct bench *bench, struct pel_volume *const *volumes, int count);
bool bench_keep_volume(struct bench *bench, struct pel_volume *volume);
bool bench_keep_scene(struct bench *bench, struct pel_scene *scene);

// A copy of a volume's voxels, so that several volumes share no memory; kept by the bench.
struct pel_volume *bench_copy_volume(struct bench *bench, const struct pel_volume *volume);

// Looks at all of a scene from the front; false after a message.
bool bench_fit_camera(struct pel_scene *scene, int width, int height);

// `count` copies of a volume in one place, each turned a little further, or side by side, in the
// transfer function `hot`, thin enough to see through many, mixed by their sum. Borrowed from the
// bench.
struct pel_scene *bench_ball_scene(struct bench *bench, struct pel_volume *const *balls, int count,
                                   bool side_by_side);

// A rotation about the y axis through `centre`, right-handed.
struct pel_matrix bench_rotation(double degrees, const double centre[3]);

bool bench_time_add(struct bench *bench, struct bench_times *times, double ms);
double bench_median(const struct bench_times *times);
double bench_least(const struct bench_times *times);
double bench_greatest(const struct bench_times *times);

// ---- Suites ------------------------------------------------------------------------------------

// Each adds its cases and returns an exit status.
int bench_add_task(struct bench *bench);
int bench_add_volumes(struct bench *bench);
int bench_add_start(struct bench *bench);
int bench_add_workgroup(struct bench *bench);
int bench_add_thesis(struct bench *bench);
int bench_add_stereo(struct bench *bench);
int bench_add_skip(struct bench *bench);
int bench_add_scaling(struct bench *bench);
int bench_add_changes(struct bench *bench);
int bench_add_scene_file(struct bench *bench, const char *path);

// A volume with the character of the task's: noisy shell and smooth blobs, two thirds of the voxels
// exactly 0, the same at every call. NULL after a message.
struct pel_volume *bench_task_volume(int size);

// The task's transfer function T1, T2 or T3 (t = 0, 1, 2) as it is without the task's files. The
// caller owns it. NULL after a message.
struct pel_transfer *bench_task_transfer(int t);

// ---- Ways to skip ------------------------------------------------------------------------------

enum { BENCH_WAYS = PEL_SKIP_BLOCKS + 1 };

// Reads a way's name, or "all"; false after a message.
bool bench_read_skip(const char *text, unsigned *skips);

// The ways in order: none first, which the others are compared with, and auto last.
enum pel_skip bench_way(int n);

// Makes a case skip in one way, whatever its scene says, and tell what that takes.
void bench_set_skip(struct bench_case *one, enum pel_skip skip);

// Whether a way was asked for, or none was and it is one of the suite's own.
bool bench_wants_skip(const struct bench *bench, enum pel_skip skip, unsigned own);

// The ways that all of a suite's cases try.
#define BENCH_ALL_WAYS (((1U << BENCH_WAYS) - 1) & ~1U)

// ---- Measuring ---------------------------------------------------------------------------------

// Takes all turns; returns an exit status.
int bench_run(struct bench *bench);

// Checks a peer's placeholders; false after a message.
bool bench_peer_check(const struct bench_peer *peer);

// Whether a peer can be asked for shaded pictures: its command has {shading}.
bool bench_peer_shades(const struct bench_peer *peer);

// Runs a peer once on the work of a case. `*ms` is the "median_ms" of the JSON object in the last
// line of its output. On failure false, and why in `problem`.
bool bench_peer_run(const struct bench *bench, const struct bench_case *work, int peer, double *ms,
                    char problem[256]);

// Starts this program once on a small scene, with the kernel caches in the folder `cache`.
bool bench_start_run(const struct bench *bench, struct bench_case *one, const char *cache,
                     double *ms, char problem[256]);

// Makes an empty folder and takes it away with all that is in it. `path` has room for 256 bytes,
// and is empty where there is none.
bool bench_folder_create(char *path);
void bench_folder_remove(const char *path);

// Renders a case's scene, of one volume of 8-bit voxels without gradients, in plain C: one thread,
// one ray after the other, trilinear, no skipping. On failure false, after a message.
bool bench_sequential_run(const struct bench_case *one, double *ms, uint64_t *samples);

// ---- Reports -----------------------------------------------------------------------------------

// What the measurements were taken on.
struct bench_machine {
    char cpu[128], device[128], driver[128], version[128];
    int cores, compute_units;
};

void bench_machine_describe(struct bench_machine *machine, const struct bench *bench);

// One line of JSON for each case.
void bench_write_json(FILE *file, const struct bench *bench, const struct bench_machine *machine);

// One aligned Markdown table for each suite.
void bench_write_table(FILE *file, const struct bench *bench, const struct bench_machine *machine);

// A bar chart of each suite's medians as SVG, one above the other.
void bench_write_plot(FILE *file, const struct bench *bench, const struct bench_machine *machine);

#endif
