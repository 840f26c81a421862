// bench_start.c - the suite `start`: how long somebody waits for the first picture.
//
// The program itself is run on a small scene, once with no kernel compiled before (cold) and once
// with what that run has left in the driver's cache (warm). The environment points the caches of
// PoCL, Mesa, NVIDIA's and whoever follows XDG to a folder of ours.
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <jansson.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/report.h"

enum { WIDTH = 320, HEIGHT = 240 };

static const char scene_text[] =
    "{\"volumes\": [{\"generate\": {\"kind\": \"c60\", \"size\": 48}}]}\n";

static const char *const cache_names[] = {"POCL_CACHE_DIR", "XDG_CACHE_HOME",
                                          "MESA_SHADER_CACHE_DIR", "CUDA_CACHE_PATH"};

enum { CACHES = sizeof cache_names / sizeof *cache_names };

bool bench_folder_create(char *path) {
    const char *parent = getenv("TMPDIR");
    bool fits =
        snprintf(path, 256, "%s/pellucid-bench-XXXXXX", parent && *parent ? parent : "/tmp") < 256;
    if (fits && mkdtemp(path))
        return true;
    cli_fail(PEL_ERROR_FILE, "%s: cannot create: %s", path, strerror(fits ? errno : ENAMETOOLONG));
    // What is not ours is not to be removed.
    path[0] = '\0';
    return false;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *walk) {
    (void)status, (void)type, (void)walk;
    return remove(path);
}

void bench_folder_remove(const char *path) {
    enum { OPEN_FOLDERS = 16 };
    nftw(path, remove_entry, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS);
}

// Waits for a child; true when it succeeded.
static bool wait_for(pid_t child, char problem[256]) {
    int status;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return snprintf(problem, 256, "cannot wait: %s", strerror(errno)), false;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status))
        snprintf(problem, 256, "exit status %d", WEXITSTATUS(status));
    else
        snprintf(problem, 256, "signal %d", WTERMSIG(status));
    return false;
}

// This process's environment with the caches in `cache`. `texts` holds what is new; the result is
// memory to free(), its strings are not.
static char **environment_with(const char *cache, char texts[CACHES][320]) {
    size_t count = 0, kept = 0;
    while (environ[count])
        count++;
    char **environment = calloc(count + CACHES + 1, sizeof *environment);
    if (!environment)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        bool replaced = false;
        for (int c = 0; c < CACHES; c++) {
            size_t length = strlen(cache_names[c]);
            replaced |=
                strncmp(environ[i], cache_names[c], length) == 0 && environ[i][length] == '=';
        }
        if (!replaced)
            environment[kept++] = environ[i];
    }
    for (int c = 0; c < CACHES; c++) {
        snprintf(texts[c], sizeof texts[c], "%s=%s", cache_names[c], cache);
        environment[kept++] = texts[c];
    }
    return environment;
}

static bool write_scene(const char *path) {
    FILE *file = fopen(path, "w");
    bool good = file && fputs(scene_text, file) >= 0;
    return file && fclose(file) == 0 && good;
}

// Which device the program says it has used.
static void read_device(struct pel_render_statistics *statistics, const char *path) {
    json_t *object = json_load_file(path, 0, NULL);
    const char *device = json_string_value(json_object_get(object, "device"));
    const char *driver = json_string_value(json_object_get(object, "driver"));
    snprintf(statistics->device, sizeof statistics->device, "%s", device ? device : "");
    snprintf(statistics->driver, sizeof statistics->driver, "%s", driver ? driver : "");
    json_decref(object);
}

// What the program is run with.
struct start {
    char program[4096], scene[300], picture[300], output[300], size[32], lanes[16], group[16];
    char *arguments[20];
};

static bool prepare(struct start *start, const struct pel_renderer_options *renderer,
                    const char *cache, char problem[256]) {
    ssize_t length = readlink("/proc/self/exe", start->program, sizeof start->program - 1);
    if (length < 0)
        return snprintf(problem, 256, "/proc/self/exe: %s", strerror(errno)), false;
    start->program[length] = '\0';
    snprintf(start->scene, sizeof start->scene, "%s/scene.json", cache);
    snprintf(start->picture, sizeof start->picture, "%s/picture.png", cache);
    snprintf(start->output, sizeof start->output, "%s/output.json", cache);
    snprintf(start->size, sizeof start->size, "%dx%d", WIDTH, HEIGHT);
    snprintf(start->lanes, sizeof start->lanes, "%d", renderer->lanes);
    snprintf(start->group, sizeof start->group, "%d", renderer->work_group);
    if (!write_scene(start->scene))
        return snprintf(problem, 256, "%.160s: cannot write: %s", start->scene, strerror(errno)),
               false;
    char *always[] = {
        start->program,
        "render",
        start->scene,
        "-o",
        start->picture,
        "--size",
        start->size,
        "--quiet",
        "--json",
        "--reader",
        (char *)report_reader(renderer->reader),
    };
    int count = sizeof always / sizeof *always;
    memcpy(start->arguments, always, sizeof always);
    if (renderer->device) {
        start->arguments[count++] = "--device";
        start->arguments[count++] = (char *)renderer->device;
    }
    if (renderer->lanes) {
        start->arguments[count++] = "--lanes";
        start->arguments[count++] = start->lanes;
    }
    if (renderer->work_group) {
        start->arguments[count++] = "--work-group";
        start->arguments[count++] = start->group;
    }
    return true;
}

bool bench_start_run(const struct bench *bench, struct bench_case *one, const char *cache,
                     double *ms, char problem[256]) {
    struct start start = {.arguments = {NULL}};
    if (!prepare(&start, &bench->options.renderer, cache, problem))
        return false;
    char texts[CACHES][320];
    char **environment = environment_with(cache, texts);
    if (!environment)
        return snprintf(problem, 256, "no memory"), false;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, start.output,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    double begin_ms = pel_clock_ms();
    pid_t child;
    int error = posix_spawn(&child, start.program, &actions, NULL, start.arguments, environment);
    posix_spawn_file_actions_destroy(&actions);
    free(environment);
    if (error)
        return snprintf(problem, 256, "cannot run %.160s: %s", start.program, strerror(error)),
               false;
    if (!wait_for(child, problem))
        return false;
    *ms = pel_clock_ms() - begin_ms;
    read_device(&one->statistics, start.output);
    return true;
}

int bench_add_start(struct bench *bench) {
    static const char *const names[] = {"cold", "warm"};
    int first = bench->case_count;
    for (int i = 0; i < 2; i++) {
        struct bench_case *added = bench_add(bench, "start", names[i]);
        if (!added)
            return (int)PEL_ERROR_MEMORY;
        added->kind = i == 0 ? BENCH_COLD_START : BENCH_WARM_START;
        added->width = WIDTH;
        added->height = HEIGHT;
        added->baseline = i == 0 ? -1 : first;
    }
    return PEL_OK;
}
