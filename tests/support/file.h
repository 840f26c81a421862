// file.h - for tests of readers: files made byte by byte, and what the library said about them.
#ifndef PEL_TEST_FILE_H
#define PEL_TEST_FILE_H

#include "support/test.h"

// Bytes being put together.
struct test_bytes {
    unsigned char *bytes;
    size_t count;
};

// Appends to the bytes; numbers in the byte order asked for.
void test_put(struct test_bytes *out, const void *bytes, size_t count);
void test_put_text(struct test_bytes *out, const char *text);
void test_put_integer(struct test_bytes *out, int64_t value, int bytes, bool big_endian);
void test_put_float(struct test_bytes *out, double value, int bytes, bool big_endian);
void test_release(struct test_bytes *bytes);

// gzip or zlib (`window_bits` 31 or 15) of some bytes.
struct test_bytes test_deflate(const void *bytes, size_t count, int window_bits);

// Writes a file into this test's temporary folder and returns its path, valid as
// test_temporary_path's.
const char *test_write(const char *leaf, const void *bytes, size_t count);
const char *test_write_text(const char *leaf, const char *text);

// Reads a whole file.
struct test_bytes test_read(const char *path);

// From here on warnings are counted and the last one is kept. A cmocka setup function.
int test_watch_warnings(void **state);
int test_warning_count(void);
const char *test_warning(void);

// Fails the test unless the placement is this, within `tolerance` per element.
void test_assert_matrix(const struct pel_volume *volume, const double rows[3][4], double tolerance);

// Fails the test unless loading fails with this code, a sentence that starts with the path once,
// and `fragment` in it.
void test_assert_load_fails(const char *path, const struct pel_load_options *options,
                            enum pel_error code, const char *fragment);

// A volume of 5 x 4 x 3 voxels with an oblique, left-handed placement whose elements are exact
// floats, and a pattern of bytes.
struct pel_volume *test_small_volume(enum pel_voxel_type type);

// Fails the test unless both have the same dimensions, type, placement and voxels.
void test_assert_same_volume(const struct pel_volume *a, const struct pel_volume *b,
                             double tolerance);

#endif
