// replay.c - feeds every file of the folders given to a fuzz target, where there is no libFuzzer.
//
// Folders may hold folders. Exits with 0 and prints the count; a folder that is missing or holds
// nothing fails, so that a corpus cannot vanish unnoticed. A crash names the input by the line
// printed before it.
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/fuzz.h"

static int count;

static int replay_entry(const char *path, const struct stat *status, int kind, struct FTW *level) {
    (void)level;
    if (kind != FTW_F)
        return 0;
    printf("%s\n", path);
    fflush(stdout);
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return 1;
    // Exactly as large as the input, so that reading one byte beyond it is found.
    size_t size = (size_t)status->st_size;
    uint8_t *data = malloc(size ? size : 1);
    bool good = data && fread(data, 1, size, stream) == size;
    fclose(stream);
    if (good) {
        LLVMFuzzerTestOneInput(data, size);
        count++;
    }
    free(data);
    return !good;
}

int main(int argument_count, char **arguments) {
    if (argument_count < 2) {
        fprintf(stderr, "usage: %s FOLDER...\n", arguments[0]);
        return 2;
    }
    for (int i = 1; i < argument_count; i++) {
        int before = count;
        if (nftw(arguments[i], replay_entry, 8, FTW_PHYS) != 0 || count == before) {
            fprintf(stderr, "%s: cannot be read, or holds no input\n", arguments[i]);
            return 1;
        }
    }
    printf("%d inputs\n", count);
    return 0;
}
