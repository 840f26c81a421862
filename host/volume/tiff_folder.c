// tiff_folder.c - the files of a stack of slices, in natural order: slice2 before slice10.
#include "volume/tiff.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

// Runs of digits compare as numbers of any length, everything else byte by byte.
static int compare_naturally(const char *a, const char *b) {
    while (*a && *b) {
        if (isdigit((unsigned char)*a) && isdigit((unsigned char)*b)) {
            a += strspn(a, "0");
            b += strspn(b, "0");
            size_t a_digits = strspn(a, "0123456789"), b_digits = strspn(b, "0123456789");
            int order =
                a_digits != b_digits ? (a_digits < b_digits ? -1 : 1) : strncmp(a, b, a_digits);
            if (order)
                return order;
            a += a_digits;
            b += b_digits;
        } else if (*a != *b) {
            return (unsigned char)*a < (unsigned char)*b ? -1 : 1;
        } else {
            a++, b++;
        }
    }
    return *a ? 1 : *b ? -1 : 0;
}

static int compare_paths(const void *a, const void *b) {
    const char *left = *(char *const *)a, *right = *(char *const *)b;
    int order = compare_naturally(left, right);
    return order ? order : strcmp(left, right);
}

static bool append(struct pel_tiff_list *list, const char *folder, const char *name) {
    void *grown = realloc(list->paths, (size_t)(list->count + 1) * sizeof *list->paths);
    if (!grown)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %d file names", list->count + 1);
    list->paths = grown;
    char *path = NULL;
    size_t length = folder ? strlen(folder) : 0;
    bool slash = length > 0 && folder[length - 1] != '/';
    if (asprintf(&path, "%s%s%s", folder ? folder : "", slash ? "/" : "", name) < 0)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
    list->paths[list->count++] = path;
    return true;
}

// The visible .tif and .tiff files; a macOS archive hides a "._NAME.tif" beside each.
static bool list_folder(struct pel_tiff_list *list, const char *path) {
    DIR *folder = opendir(path);
    if (!folder)
        return pel_fail(PEL_ERROR_FILE, "%s: %s", path, strerror(errno));
    bool done = true;
    for (struct dirent *entry; done && (entry = readdir(folder));)
        if (entry->d_name[0] != '.' && (pel_path_has_extension(entry->d_name, ".tif") ||
                                        pel_path_has_extension(entry->d_name, ".tiff")))
            done = append(list, path, entry->d_name);
    closedir(folder);
    if (done && list->count == 0)
        return pel_fail(PEL_ERROR_FILE, "%s: a folder without .tif files", path);
    return done;
}

static bool list_pattern(struct pel_tiff_list *list, const char *pattern) {
    glob_t found;
    int status = glob(pattern, GLOB_NOSORT, NULL, &found);
    if (status == GLOB_NOMATCH)
        return pel_fail(PEL_ERROR_FILE, "%s: no such file, and no file matches", pattern);
    if (status != 0)
        return pel_fail(PEL_ERROR_FILE, "%s: cannot be searched for", pattern);
    bool done = true;
    for (size_t i = 0; done && i < found.gl_pathc; i++)
        done = append(list, NULL, found.gl_pathv[i]);
    globfree(&found);
    return done;
}

bool pel_tiff_list_init(struct pel_tiff_list *list, const char *path) {
    *list = (struct pel_tiff_list){0};
    struct stat status;
    bool exists = stat(path, &status) == 0, done;
    if (exists && S_ISDIR(status.st_mode))
        done = list_folder(list, path);
    else if (exists || !strpbrk(path, "*?["))
        done = append(list, NULL, path);
    else
        done = list_pattern(list, path);
    if (!done) {
        pel_tiff_list_finish(list);
        return false;
    }
    qsort(list->paths, (size_t)list->count, sizeof *list->paths, compare_paths);
    return true;
}

void pel_tiff_list_finish(struct pel_tiff_list *list) {
    for (int i = 0; i < list->count; i++)
        free(list->paths[i]);
    free(list->paths);
    *list = (struct pel_tiff_list){0};
}
