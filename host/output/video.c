// video.c - pictures into a video, through the program ffmpeg where it is installed.
//
// Codecs are a matter of patents and of decades; ffmpeg knows them. It runs as a child, without a
// shell. Its standard input is one end of a pair of sockets, into which frames go as raw RGB bytes:
// a write to a socket can be told not to raise SIGPIPE, one to a pipe cannot. What it writes is the
// temporary of a pel_output, handed to it as descriptor 3. What it complains about goes to a file
// without a name, whose last line becomes our sentence.
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/image.h"

extern char **environ;

enum { CHILD_OUTPUT = 3, ARGUMENT_MAX = 40 };

struct pel_video {
    struct pel_output output;
    char *path;
    FILE *complaints;
    int width, height, frames_fd;
    pid_t child; // 0: does not run
    unsigned char *row;
};

// How ffmpeg makes each kind of file: quality rather than size. Players of H.264 want even sizes.
#define EVEN "pad=ceil(iw/2)*2:ceil(ih/2)*2"
static const struct kind {
    const char *extension;
    const char *arguments[14];
} kinds[] = {
    {".mp4",
     {"-vf", EVEN, "-c:v", "libx264", "-crf", "16", "-pix_fmt", "yuv420p", "-movflags",
      "+faststart", "-f", "mp4"}},
    {".mkv",
     {"-vf", EVEN, "-c:v", "libx264", "-crf", "16", "-pix_fmt", "yuv420p", "-f", "matroska"}},
    {".webm",
     {"-vf", EVEN, "-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-pix_fmt", "yuv420p", "-f",
      "webm"}},
    {".gif",
     {"-filter_complex", "[0:v]split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0", "-f",
      "gif"}},
};

static const struct kind *find_kind(const char *path) {
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (pel_path_has_extension(path, kinds[i].extension))
            return &kinds[i];
    return NULL;
}

// Runs ffmpeg with our ends of things closed in it.
static bool spawn(struct pel_video *video, char *arguments[], int frames_fd) {
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return pel_fail(PEL_ERROR_MEMORY, "cannot start ffmpeg");
    // All of ours close on exec, and no number is in the way: they are above 3, or its copy stays.
    int output = fcntl(fileno(video->output.stream), F_DUPFD_CLOEXEC, CHILD_OUTPUT + 1);
    int complaints = fcntl(fileno(video->complaints), F_DUPFD_CLOEXEC, CHILD_OUTPUT + 1);
    int frames = fcntl(frames_fd, F_DUPFD_CLOEXEC, CHILD_OUTPUT + 1);
    posix_spawn_file_actions_adddup2(&actions, frames, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, complaints, 2);
    posix_spawn_file_actions_adddup2(&actions, output, CHILD_OUTPUT);
    int code = output < 0 || complaints < 0 || frames < 0
                   ? EMFILE
                   : posix_spawnp(&video->child, arguments[0], &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    for (int i = 0; i < 3; i++)
        if ((int[]){output, complaints, frames}[i] >= 0)
            close((int[]){output, complaints, frames}[i]);
    if (code == 0)
        return true;
    video->child = 0;
    if (code == ENOENT)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "videos are written through the program ffmpeg, which is not installed "
                        "(package ffmpeg)");
    return pel_fail(PEL_ERROR_UNSUPPORTED, "cannot start ffmpeg: %s", strerror(code));
}

static bool start(struct pel_video *video, const struct kind *kind, double fps) {
    char size[32], rate[32];
    snprintf(size, sizeof size, "%dx%d", video->width, video->height);
    snprintf(rate, sizeof rate, "%.9g", fps);
    const char *input[] = {
        "ffmpeg", "-hide_banner", "-loglevel", "error",      "-y", "-f", "rawvideo", "-pix_fmt",
        "rgb24",  "-video_size",  size,        "-framerate", rate, "-i", "pipe:0",   "-an"};
    const char *arguments[ARGUMENT_MAX];
    size_t count = sizeof input / sizeof *input;
    memcpy(arguments, input, sizeof input);
    for (size_t i = 0; kind->arguments[i]; i++)
        arguments[count++] = kind->arguments[i];
    arguments[count++] = "/dev/fd/3";
    arguments[count] = NULL;

    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return pel_fail(PEL_ERROR_FILE, "cannot talk to ffmpeg: %s", strerror(errno));
    video->frames_fd = ends[0];
    bool good = spawn(video, (char **)arguments, ends[1]);
    close(ends[1]);
    return good;
}

// The last line of what ffmpeg complained about, its own name for the thing left out.
static void read_complaint(FILE *stream, size_t bytes, char complaint[]) {
    char line[512];
    snprintf(complaint, bytes, "it said nothing");
    rewind(stream);
    while (fgets(line, sizeof line, stream)) {
        line[strcspn(line, "\r\n")] = '\0';
        if (*line)
            snprintf(complaint, bytes, "%.*s", (int)bytes - 1, line);
    }
}

// Waits for ffmpeg to end. False, with its last words, when it was not content.
static bool wait_for_child(struct pel_video *video) {
    int result = 0;
    if (video->frames_fd >= 0)
        close(video->frames_fd);
    video->frames_fd = -1;
    if (!video->child)
        return true;
    while (waitpid(video->child, &result, 0) < 0)
        if (errno != EINTR)
            return pel_fail(PEL_ERROR_FILE, "ffmpeg was lost: %s", strerror(errno));
    video->child = 0;
    if (WIFEXITED(result) && WEXITSTATUS(result) == 0)
        return true;
    if (WIFEXITED(result) && WEXITSTATUS(result) == 127)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "ffmpeg cannot be run");
    char complaint[400];
    read_complaint(video->complaints, sizeof complaint, complaint);
    if (WIFSIGNALED(result))
        return pel_fail(PEL_ERROR_FILE, "%s: ffmpeg was ended by signal %d", video->path,
                        WTERMSIG(result));
    return pel_fail(PEL_ERROR_FILE, "%s: ffmpeg failed: %s", video->path, complaint);
}

bool pel_video_is_path(const char *path) {
    return find_kind(path) != NULL;
}

struct pel_video *pel_video_create(const char *path, int width, int height, double fps) {
    const struct kind *kind = find_kind(path);
    if (!kind || width < 1 || height < 1 || !(fps > 0)) {
        pel_fail(PEL_ERROR_ARGUMENT,
                 "%s: a video's name ends in .mp4, .webm, .mkv or .gif, and it has a size and a "
                 "rate, not %d x %d at %g",
                 path, width, height, fps);
        return NULL;
    }
    struct pel_video *video = pel_allocate(1, sizeof *video);
    if (!video)
        return NULL;
    *video = (struct pel_video){.width = width, .height = height, .frames_fd = -1};
    video->path = pel_copy_text(path);
    video->row = pel_allocate((size_t)width, 3);
    bool good = video->path && video->row && pel_output_open(&video->output, path);
    if (good) {
        video->complaints = tmpfile();
        good = video->complaints ||
               pel_fail(PEL_ERROR_FILE, "cannot make a temporary file: %s", strerror(errno));
    }
    if (good && start(video, kind, fps))
        return video;
    pel_video_destroy(video);
    return NULL;
}

static bool send_all(int socket, const unsigned char *bytes, size_t count) {
    while (count > 0) {
        ssize_t sent = send(socket, bytes, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return false;
        bytes += sent;
        count -= (size_t)sent;
    }
    return true;
}

bool pel_video_add(struct pel_video *video, const struct pel_image *image) {
    if (image->width != video->width || image->height != video->height)
        return pel_fail(PEL_ERROR_ARGUMENT, "%s: a frame of %d x %d pixels, not %d x %d",
                        video->path, image->width, image->height, video->width, video->height);
    const float *rgba = image->rgba;
    size_t row_bytes = 3 * (size_t)image->width;
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++, rgba += 4)
            for (int c = 0; c < 3; c++)
                video->row[3 * x + c] = (unsigned char)pel_image_quantise(rgba[c], 255);
        // Whoever stops reading has a reason, which is worth more than ours.
        if (!send_all(video->frames_fd, video->row, row_bytes))
            return wait_for_child(video)
                       ? pel_fail(PEL_ERROR_FILE, "%s: ffmpeg ended too early", video->path)
                       : false;
    }
    return true;
}

bool pel_video_finish(struct pel_video *video) {
    bool good = wait_for_child(video) && pel_output_commit(&video->output);
    pel_video_destroy(video);
    return good;
}

void pel_video_destroy(struct pel_video *video) {
    if (!video)
        return;
    if (video->frames_fd >= 0)
        close(video->frames_fd);
    // The reason for giving up is known and must stay; what ffmpeg says to that is not asked.
    if (video->child) {
        kill(video->child, SIGKILL);
        while (waitpid(video->child, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
    pel_output_abandon(&video->output);
    if (video->complaints)
        fclose(video->complaints);
    free(video->path);
    free(video->row);
    free(video);
}
