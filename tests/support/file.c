// file.c - for tests of readers: files made byte by byte, and what the library said about them.
#include "support/file.h"

#include <math.h>
#include <unistd.h>
#include <zlib.h>

#include "base/file.h"

void test_put(struct test_bytes *out, const void *bytes, size_t count) {
    out->bytes = realloc(out->bytes, out->count + count + 1);
    if (!out->bytes)
        abort();
    memcpy(out->bytes + out->count, bytes, count);
    out->count += count;
}

void test_put_text(struct test_bytes *out, const char *text) {
    test_put(out, text, strlen(text));
}

void test_put_integer(struct test_bytes *out, int64_t value, int bytes, bool big_endian) {
    unsigned char raw[8];
    for (int i = 0; i < bytes; i++)
        raw[big_endian ? bytes - 1 - i : i] = (unsigned char)((uint64_t)value >> (8 * i));
    test_put(out, raw, (size_t)bytes);
}

void test_put_float(struct test_bytes *out, double value, int bytes, bool big_endian) {
    float narrow = (float)value;
    uint32_t narrow_bits;
    uint64_t wide_bits;
    memcpy(&narrow_bits, &narrow, sizeof narrow);
    memcpy(&wide_bits, &value, sizeof value);
    test_put_integer(out, (int64_t)(bytes == 4 ? narrow_bits : wide_bits), bytes, big_endian);
}

void test_release(struct test_bytes *bytes) {
    free(bytes->bytes);
    *bytes = (struct test_bytes){0};
}

struct test_bytes test_deflate(const void *bytes, size_t count, int window_bits) {
    z_stream stream = {.next_in = (z_const Bytef *)bytes, .avail_in = (uInt)count};
    if (deflateInit2(&stream, 9, Z_DEFLATED, window_bits, 9, Z_DEFAULT_STRATEGY) != Z_OK)
        abort();
    struct test_bytes out = {.count = deflateBound(&stream, count) + 64};
    out.bytes = malloc(out.count);
    stream.next_out = out.bytes;
    stream.avail_out = (uInt)out.count;
    if (!out.bytes || deflate(&stream, Z_FINISH) != Z_STREAM_END)
        abort();
    out.count = stream.total_out;
    deflateEnd(&stream);
    return out;
}

const char *test_write(const char *leaf, const void *bytes, size_t count) {
    const char *path = test_temporary_path(leaf);
    // A new file, because some file systems write a truncated one out at once.
    unlink(path);
    FILE *stream = fopen(path, "wb");
    if (!stream || (count > 0 && fwrite(bytes, 1, count, stream) != count) || fclose(stream) != 0)
        abort();
    return path;
}

const char *test_write_text(const char *leaf, const char *text) {
    return test_write(leaf, text, strlen(text));
}

struct test_bytes test_read(const char *path) {
    struct test_bytes file = {0};
    file.bytes = (unsigned char *)pel_file_read(path, 1u << 30, &file.count);
    if (!file.bytes)
        fail_msg("%s", pel_error_message());
    return file;
}

static int warning_count;
static char last_warning[1024];

static void keep_warning(const char *message, void *user) {
    (void)user;
    warning_count++;
    snprintf(last_warning, sizeof last_warning, "%s", message);
}

int test_watch_warnings(void **state) {
    (void)state;
    warning_count = 0;
    last_warning[0] = '\0';
    pel_on_warning(keep_warning, NULL);
    return 0;
}

int test_warning_count(void) {
    return warning_count;
}

const char *test_warning(void) {
    return last_warning;
}

void test_assert_matrix(const struct pel_volume *volume, const double rows[3][4],
                        double tolerance) {
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            if (!(fabs(volume->world_from_voxel.m[r][c] - rows[r][c]) <= tolerance))
                fail_msg("%s: world_from_voxel[%d][%d] is %.9g instead of %.9g", volume->name, r, c,
                         volume->world_from_voxel.m[r][c], rows[r][c]);
}

void test_assert_load_fails(const char *path, const struct pel_load_options *options,
                            enum pel_error code, const char *fragment) {
    struct pel_volume *volume = pel_volume_load(path, options);
    if (volume)
        fail_msg("%s: was read, instead of '%s'", path, fragment);
    const char *message = pel_error_message();
    if (pel_error_code() != code || !strstr(message, fragment))
        fail_msg("code %d, '%s', instead of code %d, '%s'", (int)pel_error_code(), message,
                 (int)code, fragment);
    if (strncmp(message, path, strlen(path)) != 0 || strstr(message + 1, path))
        fail_msg("'%s' does not name %s once", message, path);
}

struct pel_volume *test_small_volume(enum pel_voxel_type type) {
    struct pel_volume *volume = pel_volume_create("small", (const int[]){5, 4, 3}, type);
    const double rows[3][4] = {{0.75, 0.5, 0.25, -7.5}, {-0.5, 1.25, 0, 11}, {0.125, 0, -3, 0.5}};
    memcpy(volume->world_from_voxel.m, rows, sizeof rows);
    uint64_t random = 7;
    for (size_t i = 0; i < pel_volume_bytes(volume); i++)
        ((unsigned char *)volume->voxels)[i] = (unsigned char)(256 * test_random(&random));
    for (size_t i = 0; type == PEL_VOXEL_F32 && i < 60; i++)
        ((float *)volume->voxels)[i] = (float)i / 4 - 3;
    return volume;
}

void test_assert_same_volume(const struct pel_volume *a, const struct pel_volume *b,
                             double tolerance) {
    assert_memory_equal(a->dims, b->dims, sizeof a->dims);
    assert_int_equal(a->type, b->type);
    test_assert_matrix(a, b->world_from_voxel.m, tolerance);
    assert_memory_equal(a->voxels, b->voxels, pel_volume_bytes(a));
}
