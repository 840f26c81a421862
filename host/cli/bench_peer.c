// bench_peer.c - one turn of another program.
//
// A peer is a command for sh with placeholders for the work. It takes warm-up frames and medians of
// its own; the last line of its standard output is a JSON object with "median_ms".
#include <ctype.h>
#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <jansson.h>

#include "cli/bench.h"
#include "cli/nearest.h"
#include "cli/options.h"

static const char *const placeholders[] = {"tf", "width", "height", "volumes", "shading", "data"};

enum { PLACEHOLDERS = sizeof placeholders / sizeof *placeholders };

// Finds the next {word} in `text`, with `*word_length` letters; shell's own ${word} is none.
static const char *next_placeholder(const char *text, const char *begin, int *word_length) {
    for (const char *c = text; *c; c++) {
        if (*c != '{' || (c > begin && c[-1] == '$'))
            continue;
        int length = 0;
        while (isalpha((unsigned char)c[1 + length]))
            length++;
        if (length > 0 && c[1 + length] == '}') {
            *word_length = length;
            return c;
        }
    }
    return NULL;
}

static int find_placeholder(const char *word, int length) {
    for (int i = 0; i < PLACEHOLDERS; i++)
        if ((int)strlen(placeholders[i]) == length &&
            strncmp(word, placeholders[i], (size_t)length) == 0)
            return i;
    return -1;
}

bool bench_peer_check(const struct bench_peer *peer) {
    int length;
    for (const char *c = peer->command; (c = next_placeholder(c, peer->command, &length)); c++) {
        if (find_placeholder(c + 1, length) >= 0)
            continue;
        char word[32];
        snprintf(word, sizeof word, "%.*s", length, c + 1);
        const char *nearest = cli_nearest(word, placeholders, PLACEHOLDERS);
        cli_fail(PEL_ERROR_ARGUMENT,
                 "--peer %s: {%s} is none of {tf}, {width}, {height}, {volumes}, {shading}, "
                 "{data}%s%s%s",
                 peer->name, word, nearest ? "; did you mean {" : "", nearest ? nearest : "",
                 nearest ? "}?" : "");
        return false;
    }
    return true;
}

bool bench_peer_shades(const struct bench_peer *peer) {
    int length;
    for (const char *c = peer->command; (c = next_placeholder(c, peer->command, &length)); c++)
        if (strcmp(placeholders[find_placeholder(c + 1, length)], "shading") == 0)
            return true;
    return false;
}

// The command with its placeholders filled in; memory to free(), or NULL.
static char *fill_in(const struct bench *bench, const struct bench_case *work,
                     const char *command) {
    char *filled = NULL;
    size_t bytes;
    FILE *stream = open_memstream(&filled, &bytes);
    if (!stream)
        return NULL;
    const char *rest = command, *found;
    int length;
    while ((found = next_placeholder(rest, command, &length))) {
        fwrite(rest, 1, (size_t)(found - rest), stream);
        switch (find_placeholder(found + 1, length)) {
        case 0:
            fputs(work->transfer, stream);
            break;
        case 1:
            fprintf(stream, "%d", work->width);
            break;
        case 2:
            fprintf(stream, "%d", work->height);
            break;
        case 3:
            fprintf(stream, "%d", work->volumes);
            break;
        case 4:
            fprintf(stream, "%d", work->shaded);
            break;
        default:
            fputs(bench->options.data ? bench->options.data : "", stream);
        }
        rest = found + length + 2;
    }
    fputs(rest, stream);
    return fclose(stream) == 0 ? filled : NULL;
}

// Starts sh; what it prints can be read from `*output`. 0, or an errno.
static int start(const char *command, pid_t *child, FILE **output) {
    int ends[2];
    if (pipe(ends) != 0)
        return errno;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    char *arguments[] = {"sh", "-c", (char *)command, NULL};
    int error = posix_spawnp(child, "sh", &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    *output = error ? NULL : fdopen(ends[0], "r");
    if (!*output)
        close(ends[0]);
    return error;
}

// The last line that is not empty; memory to free(), or NULL.
static char *last_line(FILE *stream) {
    char *line = NULL, *last = NULL;
    size_t room = 0;
    while (getline(&line, &room, stream) >= 0) {
        if (line[strspn(line, " \t\r\n")] == '\0')
            continue;
        free(last);
        last = line;
        line = NULL;
        room = 0;
    }
    free(line);
    return last;
}

bool bench_peer_run(const struct bench *bench, const struct bench_case *work, int peer, double *ms,
                    char problem[256]) {
    char *command = fill_in(bench, work, bench->options.peers[peer].command);
    pid_t child;
    FILE *output = NULL;
    int error = command ? start(command, &child, &output) : ENOMEM;
    free(command);
    if (error)
        return snprintf(problem, 256, "cannot run sh: %s", strerror(error)), false;
    char *line = output ? last_line(output) : NULL;
    if (output)
        fclose(output);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    json_error_t where;
    json_t *object = line ? json_loads(line, 0, &where) : NULL;
    json_t *median = json_object_get(object, "median_ms");
    *ms = json_number_value(median);
    bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0 && *ms > 0;
    if (!WIFEXITED(status))
        snprintf(problem, 256, "signal %d", WTERMSIG(status));
    else if (WEXITSTATUS(status))
        snprintf(problem, 256, "exit status %d", WEXITSTATUS(status));
    else if (!good)
        snprintf(problem, 256, "its last line is not JSON with a positive \"median_ms\": %.150s",
                 line ? strtok(line, "\n") : "nothing");
    json_decref(object);
    free(line);
    return good;
}
