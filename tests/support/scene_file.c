// scene_file.c - scenes written as text.
#include "support/scene_file.h"

const char *test_write_scene(const char *leaf, const char *quoted) {
    const char *path = test_temporary_path(leaf);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    for (const char *at = quoted; *at; at++)
        fputc(*at == '\'' ? '"' : *at, stream);
    fclose(stream);
    return path;
}

struct pel_scene *test_load_scene(const char *leaf, const char *quoted, const char *override) {
    struct pel_scene *scene =
        pel_scene_load(test_write_scene(leaf, quoted), &override, override ? 1 : 0);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

int test_write_volumes(void **state) {
    (void)state;
    for (int file = 0; file < 2; file++) {
        FILE *stream = fopen(test_temporary_path(file ? "b.raw" : "a.raw"), "wb");
        if (!stream)
            return -1;
        for (int i = 0; i < 24; i++)
            fputc(i, stream);
        fclose(stream);
    }
    return 0;
}
