// bench_task.c - the suite `task`: one 8-bit volume of 256^3 voxels with three transfer functions,
// alone and as 2, 4 and 8 copies that overlap, each turned 15 degrees further.
//
// T1 is mostly transparent, T2 nearly a surface, T3 a rainbow with something everywhere: between
// them they are the easy and the hard cases of a ray caster. Tables are read at their nearest entry
// and volumes blended in order, as most programs do, so that others can be given the same work. All
// copies have memory of their own, because those of different scans would.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zlib.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/report.h"

enum { SIZE = 256, TABLE = 256, COPIES = 8, TRANSFERS = 3 };

static const char *const transfer_names[TRANSFERS] = {"T1", "T2", "T3"};

struct task {
    struct pel_volume *volumes[COPIES];
    struct pel_transfer *transfers[TRANSFERS];
};

// ---- Where the work comes from -----------------------------------------------------------------

// DIR/oracle/LEAF, or DIR/LEAF.
static bool find_file(char *path, size_t bytes, const char *folder, const char *leaf) {
    snprintf(path, bytes, "%s/oracle/%s", folder, leaf);
    if (access(path, R_OK) == 0)
        return true;
    snprintf(path, bytes, "%s/%s", folder, leaf);
    return access(path, R_OK) == 0;
}

// Reads a file, through gzip where it is compressed, that has exactly `bytes` bytes.
static int read_exactly(void *to, size_t bytes, const char *folder, const char *leaf) {
    char path[4096];
    if (!find_file(path, sizeof path, folder, leaf))
        return cli_fail(PEL_ERROR_FILE, "%s: there is neither oracle/%s nor %s", folder, leaf,
                        leaf);
    gzFile file = gzopen(path, "rb");
    if (!file)
        return cli_fail(PEL_ERROR_FILE, "%s: cannot open", path);
    int got = gzread(file, to, (unsigned)bytes);
    bool whole = got == (int)bytes && gzgetc(file) == -1;
    gzclose(file);
    return whole ? PEL_OK
                 : cli_fail(PEL_ERROR_FORMAT, "%s: there must be exactly %zu bytes", path, bytes);
}

static struct pel_transfer *new_transfer(int colour_count, int opacity_count) {
    struct pel_transfer *transfer = calloc(1, sizeof *transfer);
    if (!transfer)
        return NULL;
    transfer->colours = calloc((size_t)colour_count, sizeof *transfer->colours);
    transfer->opacities = calloc((size_t)opacity_count, sizeof *transfer->opacities);
    transfer->colour_count = colour_count;
    transfer->opacity_count = opacity_count;
    transfer->opacity_unit_mm = 1;
    transfer->nearest = true;
    transfer->table_entries = TABLE;
    if (transfer->colours && transfer->opacities)
        return transfer;
    pel_transfer_destroy(transfer);
    return NULL;
}

// A table of 256 times red, green, blue and opacity per voxel length, in floats.
static int load_transfer(struct pel_transfer **transfer, const char *folder, const char *name) {
    char leaf[32];
    float table[TABLE][4];
    snprintf(leaf, sizeof leaf, "tf_%s.f32", name);
    int status = read_exactly(table, sizeof table, folder, leaf);
    if (status)
        return status;
    *transfer = new_transfer(TABLE, TABLE);
    if (!*transfer)
        return cli_fail(PEL_ERROR_MEMORY, "cannot allocate a transfer function");
    for (int j = 0; j < TABLE; j++) {
        (*transfer)->colours[j] =
            (struct pel_colour_point){j, {table[j][0], table[j][1], table[j][2]}};
        (*transfer)->opacities[j] = (struct pel_opacity_point){j, table[j][3]};
    }
    return PEL_OK;
}

static int load_task(struct task *task, const char *folder) {
    int status = read_exactly(task->volumes[0]->voxels, (size_t)SIZE * SIZE * SIZE, folder,
                              "task256.raw.gz");
    for (int t = 0; !status && t < TRANSFERS; t++)
        status = load_transfer(&task->transfers[t], folder, transfer_names[t]);
    return status;
}

// Tables like those of the files, from their corners.
struct pel_transfer *bench_task_transfer(int t) {
    enum { POINTS = 9 };
    static const struct {
        int colour_count, opacity_count;
        struct pel_colour_point colours[POINTS];
        struct pel_opacity_point opacities[POINTS];
    } made[TRANSFERS] = {
        {5,
         5,
         {{0, {0, 0, 0.5}},
          {12, {0.1, 0.2, 0.8}},
          {60, {0.2, 0.6, 0.9}},
          {130, {0.9, 0.9, 0.3}},
          {255, {1, 0.5, 0.4}}},
         {{12, 0}, {60, 0.0015}, {130, 0.003}, {200, 0.005}, {255, 0.006}}},
        {5,
         4,
         {{0, {0, 0, 0}},
          {89, {0.8, 0.6, 0.4}},
          {110, {0.9, 0.7, 0.5}},
          {180, {0.9, 0.3, 0.2}},
          {255, {1, 1, 1}}},
         {{89, 0}, {110, 0.9}, {180, 0.95}, {255, 0.98}}},
        {9,
         4,
         {{0, {0, 0, 0}},
          {32, {1, 0, 0}},
          {64, {1, 0.5, 0}},
          {96, {1, 1, 0}},
          {128, {0, 1, 0}},
          {159, {0, 1, 1}},
          {191, {0, 0, 1}},
          {223, {1, 0, 1}},
          {255, {0, 0, 0}}},
         {{0, 0}, {32, 0.0975}, {223, 0.0975}, {255, 0}}},
    };
    struct pel_transfer *transfer = new_transfer(made[t].colour_count, made[t].opacity_count);
    if (!transfer) {
        cli_fail(PEL_ERROR_MEMORY, "cannot allocate a transfer function");
        return NULL;
    }
    memcpy(transfer->colours, made[t].colours,
           (size_t)made[t].colour_count * sizeof *made[t].colours);
    memcpy(transfer->opacities, made[t].opacities,
           (size_t)made[t].opacity_count * sizeof *made[t].opacities);
    return transfer;
}

// Without the files, the work is of the same kind but not the same.
static int make_task(struct bench *bench, struct task *task) {
    fprintf(stderr,
            "pellucid: no task256.raw.gz (--data names its folder): measuring a volume of "
            "Pellucid's own making%s\n",
            bench->options.peer_count ? "; peers may have another" : "");
    bench->generated_task = true;
    struct pel_volume *made = bench_task_volume(SIZE);
    if (!made)
        return (int)PEL_ERROR_MEMORY;
    memcpy(task->volumes[0]->voxels, made->voxels, pel_volume_bytes(made));
    pel_volume_destroy(made);
    for (int t = 0; t < TRANSFERS; t++)
        if (!(task->transfers[t] = bench_task_transfer(t)))
            return (int)PEL_ERROR_MEMORY;
    return PEL_OK;
}

// From the folder of --data, which must have the files; else from that of $PELLUCID_TEST_DATA.
static int get_task(struct bench *bench, struct task *task) {
    task->volumes[0] = pel_volume_create("task", (int[3]){SIZE, SIZE, SIZE}, PEL_VOXEL_U8);
    if (!task->volumes[0])
        return cli_fail_library();
    if (!bench_keep_volume(bench, task->volumes[0]))
        return (int)PEL_ERROR_MEMORY;
    const char *folder = bench->options.data ? bench->options.data : getenv("PELLUCID_TEST_DATA");
    char path[4096];
    int status;
    if (folder && (bench->options.data || find_file(path, sizeof path, folder, "task256.raw.gz")))
        status = load_task(task, bench->options.data = folder);
    else
        status = make_task(bench, task);
    for (int k = 1; !status && k < COPIES; k++) {
        task->volumes[k] = bench_copy_volume(bench, task->volumes[0]);
        if (!task->volumes[k])
            status = (int)PEL_ERROR_MEMORY;
    }
    return status;
}

// ---- Cases -------------------------------------------------------------------------------------

static struct pel_scene *task_scene(struct bench *bench, const struct task *task, int t,
                                    int volumes) {
    static const double centre[3] = {127.5, 127.5, 127.5};
    struct pel_scene *scene = bench_scene(bench, task->volumes, volumes);
    if (!scene)
        return NULL;
    scene->camera = (struct pel_camera){.eye = {554.4242, 458.022, 816.0875},
                                        .target = {127.5, 127.5, 127.5},
                                        .up = {0, 1, 0},
                                        .fov_deg = 30};
    for (int k = 0; k < volumes; k++) {
        scene->instances[k].transform = bench_rotation(15.0 * k, centre);
        scene->instances[k].transfer = pel_transfer_copy(task->transfers[t]);
        if (!scene->instances[k].transfer) {
            cli_fail_library();
            return NULL;
        }
    }
    return scene;
}

// One case. Skipping, and light, add to its name.
static struct bench_case *add_case(struct bench *bench, const struct task *task, int t, int volumes,
                                   enum pel_skip skip, bool shaded) {
    char name[32], way[32] = "";
    if (skip != PEL_SKIP_NONE)
        snprintf(way, sizeof way, ", %s", report_skip(skip));
    snprintf(name, sizeof name, "%s%s%s", transfer_names[t], shaded ? " shaded" : "", way);
    struct bench_case *added = bench_add(bench, "task", name);
    struct pel_scene *scene = added ? task_scene(bench, task, t, volumes) : NULL;
    if (!scene)
        return NULL;
    scene->render.skip = skip;
    for (int k = 0; shaded && k < volumes; k++)
        scene->instances[k].material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    added->scene = scene;
    snprintf(added->transfer, sizeof added->transfer, "%s", transfer_names[t]);
    added->volumes = volumes;
    added->shaded = shaded;
    added->with_peers = true;
    return added;
}

// 1, 2, 4 and 8 volumes with one transfer function in one size.
static bool add_copies(struct bench *bench, const struct task *task, int t, const int size[2]) {
    int first = bench->case_count;
    for (int volumes = 1; volumes <= COPIES; volumes *= 2) {
        struct bench_case *added = add_case(bench, task, t, volumes, PEL_SKIP_NONE, false);
        if (!added)
            return false;
        added->baseline = volumes > 1 ? first : -1;
        added->width = size[0];
        added->height = size[1];
    }
    return true;
}

// One volume and eight, or with light one, with empty space skipped, compared with the same
// without: the case from `first` on with as many volumes.
static bool add_skips(struct bench *bench, const struct task *task, int t, const int size[2],
                      int first, bool shaded) {
    static const unsigned own = 1U << PEL_SKIP_GRID | 1U << PEL_SKIP_DISTANCE;
    for (int volumes = 1; volumes <= (shaded ? 1 : COPIES); volumes *= COPIES) {
        for (enum pel_skip skip = PEL_SKIP_AUTO; skip <= PEL_SKIP_BLOCKS; skip++) {
            if (skip == PEL_SKIP_NONE || !bench_wants_skip(bench, skip, own))
                continue;
            struct bench_case *added = add_case(bench, task, t, volumes, skip, shaded);
            if (!added)
                return false;
            added->width = size[0];
            added->height = size[1];
            for (int c = first; added->baseline < 0; c++)
                if (bench->cases[c].volumes == volumes)
                    added->baseline = c;
        }
    }
    return true;
}

// One volume with light, compared with the same without, and with empty space skipped.
static bool add_shaded(struct bench *bench, const struct task *task, int t, const int size[2],
                       int first) {
    int index = bench->case_count;
    struct bench_case *added = add_case(bench, task, t, 1, PEL_SKIP_NONE, true);
    if (!added)
        return false;
    added->width = size[0];
    added->height = size[1];
    added->baseline = first;
    return add_skips(bench, task, t, size, index, true);
}

// One volume with every number of lanes and both readers. The run's own choice comes once more, so
// that what is compared follows closely in a turn.
static bool add_variants(struct bench *bench, const struct bench_case *like) {
    static const struct {
        const char *name;
        enum pel_reader reader;
        int lanes;
    } variants[] = {
        {"T1, as chosen", 0, 0},
        {"T1, 1 lane", 0, 1},
        {"T1, 4 lanes", 0, 4},
        {"T1, 8 lanes", 0, 8},
        {"T1, 16 lanes", 0, 16},
        {"T1, buffer", PEL_READER_BUFFER, 0},
        {"T1, image", PEL_READER_IMAGE, 0},
    };
    struct bench_case first = *like;
    int baseline = bench->case_count;
    for (size_t i = 0; i < sizeof variants / sizeof *variants; i++) {
        struct bench_case *added = bench_add(bench, "task", variants[i].name);
        if (!added)
            return false;
        memcpy(added->transfer, first.transfer, sizeof added->transfer);
        added->scene = first.scene;
        added->width = first.width;
        added->height = first.height;
        added->baseline = i > 0 ? baseline : -1;
        added->optional = i > 0;
        if (variants[i].reader)
            added->reader = variants[i].reader;
        if (variants[i].lanes)
            added->lanes = variants[i].lanes;
    }
    return true;
}

int bench_add_task(struct bench *bench) {
    static const int usual[2][2] = {{640, 480}, {1920, 1080}};
    const int given[2] = {bench->options.width, bench->options.height};
    struct task task = {0};
    int first = bench->case_count;
    int status = get_task(bench, &task);
    bool good = !status;
    for (int s = 0; good && s < (given[0] ? 1 : 2); s++) {
        const int *size = given[0] ? given : usual[s];
        for (int t = 0; good && t < TRANSFERS; t++) {
            int copies = bench->case_count;
            good = add_copies(bench, &task, t, size) &&
                   add_skips(bench, &task, t, size, copies, false) &&
                   (!bench->options.shading || add_shaded(bench, &task, t, size, copies));
        }
    }
    good = good && add_variants(bench, &bench->cases[first]);
    for (int t = 0; t < TRANSFERS; t++)
        pel_transfer_destroy(task.transfers[t]);
    return status ? status : good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
