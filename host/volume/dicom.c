// dicom.c - DICOM series, turned into NIfTI by the program dcm2niix where it is installed.
//
// DICOM is a standard of thousands of pages with as many dialects; dcm2niix knows them. It writes
// into a folder of our own, which is removed afterwards. Each series becomes one .nii.
#include "volume/volume.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

extern char **environ;

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *level) {
    (void)status, (void)kind, (void)level;
    return remove(path);
}

// Runs dcm2niix on a folder or, with "-s y", on a single file. Its output is dropped: what it made
// is the answer.
static bool convert(const char *path, const char *folder) {
    struct stat status;
    bool single = stat(path, &status) == 0 && S_ISREG(status.st_mode);
    char *arguments[] = {
        "dcm2niix",     "-z",         "n", "-b", "n", "-f", "%s_%d", "-s", single ? "y" : "n", "-o",
        (char *)folder, (char *)path, NULL};
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return pel_fail(PEL_ERROR_MEMORY, "cannot start dcm2niix");
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child;
    int code = posix_spawnp(&child, arguments[0], &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code == ENOENT)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "DICOM is read through the program dcm2niix, which is not installed "
                        "(package dcm2niix)");
    if (code != 0)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "cannot start dcm2niix: %s", strerror(code));
    int result;
    while (waitpid(child, &result, 0) < 0)
        if (errno != EINTR)
            return pel_fail(PEL_ERROR_FILE, "dcm2niix was lost: %s", strerror(errno));
    // It also fails for a folder where only some files are no images, so what counts is below.
    if (WIFEXITED(result) && WEXITSTATUS(result) == 127)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "dcm2niix cannot be run");
    return true;
}

// The only series in `folder`, as a path to free(); NULL with a sentence that lists them otherwise.
static char *only_series(const char *folder) {
    struct dirent **entries;
    int entry_count = scandir(folder, &entries, NULL, versionsort);
    char list[1024] = "", *path = NULL;
    int count = 0;
    for (int i = 0; i < entry_count; i++) {
        const char *name = entries[i]->d_name;
        if (pel_path_has_extension(name, ".nii")) {
            size_t used = strlen(list);
            snprintf(list + used, sizeof list - used, "%s%.*s", count ? ", " : "",
                     (int)strlen(name) - 4, name);
            if (count++ == 0 && asprintf(&path, "%s/%s", folder, name) < 0)
                path = NULL;
        }
        free(entries[i]);
    }
    if (entry_count >= 0)
        free(entries);
    if (count == 1 && path)
        return path;
    free(path);
    if (count == 0)
        pel_fail(PEL_ERROR_FORMAT, "dcm2niix finds no image in it");
    else
        pel_fail(PEL_ERROR_UNSUPPORTED, "%d series where one is needed (%s), keep each in a folder",
                 count, list);
    return NULL;
}

struct pel_volume *pel_dicom_load(const char *path, const struct pel_load_options *options) {
    const char *root = getenv("TMPDIR");
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s/pellucid-dicom-XXXXXX", root && *root ? root : "/tmp");
    if (!mkdtemp(folder)) {
        pel_fail(PEL_ERROR_FILE, "cannot make a temporary folder: %s", strerror(errno));
        return NULL;
    }
    // A path that begins with "-" would be taken for an option.
    char *safe_path = NULL, *series = NULL;
    if (asprintf(&safe_path, "%s%s", path[0] == '-' ? "./" : "", path) < 0) {
        safe_path = NULL;
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
    }
    if (safe_path && convert(safe_path, folder))
        series = only_series(folder);
    struct pel_volume *volume = series ? pel_nifti_load(series, options) : NULL;
    if (volume) {
        char *name = pel_copy_text(pel_path_leaf(path));
        if (name) {
            free(volume->name);
            volume->name = name;
        }
    }
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    free(safe_path);
    free(series);
    return volume;
}
