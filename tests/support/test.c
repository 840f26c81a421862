// test.c - paths and random numbers for tests.
#include "support/test.h"

#include <ftw.h>
#include <unistd.h>

enum { RING = 8, PATH_BYTES = 1024 };

static char *next_path(void) {
    static char paths[RING][PATH_BYTES];
    static int next;
    return paths[next++ % RING];
}

const char *test_data_path(const char *relative) {
    const char *root = getenv("PELLUCID_TEST_DATA");
    char *path = next_path();
    snprintf(path, PATH_BYTES, "%s/%s", root ? root : TEST_DATA_DEFAULT, relative);
    return path;
}

void test_need_data(const char *relative) {
    if (access(test_data_path(relative), R_OK) == 0)
        return;
    printf("skipped: %s is missing (PELLUCID_TEST_DATA names its folder)\n", relative);
    exit(77);
}

static char temporary_folder[64];

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *level) {
    (void)status, (void)kind, (void)level;
    return remove(path);
}

static void remove_temporary_folder(void) {
    nftw(temporary_folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

const char *test_temporary_path(const char *leaf) {
    if (!temporary_folder[0]) {
        strcpy(temporary_folder, "/tmp/pellucid-test-XXXXXX");
        if (!mkdtemp(temporary_folder))
            abort();
        atexit(remove_temporary_folder);
    }
    char *path = next_path();
    snprintf(path, PATH_BYTES, "%s/%s", temporary_folder, leaf);
    return path;
}

double test_random(uint64_t *state) {
    // splitmix64 (Steele, Lea & Flood 2014).
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}
