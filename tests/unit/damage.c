// damage.c - truncated and bit-flipped files of every volume format give a volume or a sentence:
// no crash, no hang, no output of a library, and no memory that the file could not fill.
#include "support/file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
// teem loses a kilobyte when the parser of some header fields fails; nobody outside can free it.
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:airArrayNew\nleak:airArrayLenSet\n";
}
#endif

enum { SECONDS_PER_FILE = 20, FLIPS_BEHIND = 200, HEADER_BYTES = 600 };

static void too_slow(int number) {
    (void)number;
    static const char text[] = "a damaged file took too long\n";
    (void)!write(2, text, sizeof text - 1);
    _exit(1);
}

static void limit_resources(void) {
    signal(SIGALRM, too_slow);
#ifndef __SANITIZE_ADDRESS__
    // More than the test needs and far less than the sizes that flipped bits claim. The address
    // sanitizer itself reserves terabytes.
    setrlimit(RLIMIT_AS, &(struct rlimit){512u << 20, 512u << 20});
#endif
}

// Loads a file and looks at the answer. `what` tells which damage it was.
static void load(const char *path, const char *what, size_t at) {
    alarm(SECONDS_PER_FILE);
    struct pel_volume *volume = pel_volume_load(path, NULL);
    alarm(0);
    if (!volume) {
        const char *message = pel_error_message();
        if (pel_error_code() == PEL_OK || !message[0] || strstr(message, "allocate") ||
            message[strlen(message) - 1] == '\n')
            fail_msg("%s %zu: code %d, '%s'", what, at, (int)pel_error_code(), message);
    } else if (!volume->voxels || volume->dims[0] < 1 || volume->dims[1] < 1 ||
               volume->dims[2] < 1) {
        fail_msg("%s %zu: an empty volume", what, at);
    } else {
        // Reads the last voxel, so that a sanitizer sees a short allocation.
        pel_volume_value(volume, volume->dims[0] - 1, volume->dims[1] - 1, volume->dims[2] - 1);
    }
    pel_volume_destroy(volume);
}

// Writes damaged versions of `file` as `leaf` and loads `loaded`, which is the file itself or the
// one it belongs to.
static void damage(const char *leaf, const char *loaded, struct test_bytes file) {
    for (size_t count = 0; count < file.count; count += count < HEADER_BYTES ? 1 : 37) {
        test_write(leaf, file.bytes, count);
        load(test_temporary_path(loaded), "truncated at", count);
    }
    // One bit of each byte of the header, and of some behind it.
    size_t header = file.count < HEADER_BYTES ? file.count : HEADER_BYTES;
    uint64_t random = 12345;
    for (size_t i = 0; i < header + FLIPS_BEHIND; i++) {
        size_t at = i < header ? i : (size_t)(test_random(&random) * (double)file.count);
        unsigned char bit = (unsigned char)(1u << (unsigned)(test_random(&random) * 8));
        file.bytes[at] ^= bit;
        test_write(leaf, file.bytes, file.count);
        load(test_temporary_path(loaded), "flipped bit in byte", at);
        file.bytes[at] ^= bit;
    }
    // Several bytes at once.
    for (int i = 0; i < FLIPS_BEHIND; i++) {
        struct test_bytes copy = {0};
        test_put(&copy, file.bytes, file.count);
        for (int j = 0; j < 6; j++) {
            size_t at = (size_t)(test_random(&random) * (double)file.count);
            copy.bytes[at] = (unsigned char)(256 * test_random(&random));
        }
        test_write(leaf, copy.bytes, copy.count);
        load(test_temporary_path(loaded), "random bytes", (size_t)i);
        test_release(&copy);
    }
    test_write(leaf, file.bytes, file.count);
}

// Redirects what libraries print, and fails if they did.
static int silence(void) {
    fflush(stderr);
    int kept = dup(2);
    int file = open(test_temporary_path("stderr"), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    dup2(file, 2);
    close(file);
    return kept;
}

static void assert_silent(int kept) {
    fflush(stderr);
    dup2(kept, 2);
    close(kept);
    struct test_bytes printed = test_read(test_temporary_path("stderr"));
    if (printed.count > 0)
        fail_msg("a library printed: %.200s", (char *)printed.bytes);
    test_release(&printed);
}

static void damage_saved(const char *leaf, const char *damaged) {
    struct pel_volume *volume = test_small_volume(PEL_VOXEL_I16);
    assert_true(pel_volume_save(volume, test_temporary_path(leaf)));
    pel_volume_destroy(volume);
    int kept = silence();
    struct test_bytes file = test_read(test_temporary_path(damaged));
    damage(damaged, leaf, file);
    test_release(&file);
    assert_silent(kept);
}

static void test_nifti(void **state) {
    (void)state;
    damage_saved("a.nii", "a.nii");
}

static void test_nifti_gzip(void **state) {
    (void)state;
    damage_saved("a.nii.gz", "a.nii.gz");
}

static void test_nrrd(void **state) {
    (void)state;
    damage_saved("a.nrrd", "a.nrrd");
}

static void test_nhdr(void **state) {
    (void)state;
    damage_saved("a.nhdr", "a.nhdr");
}

static void test_metaimage(void **state) {
    (void)state;
    damage_saved("a.mha", "a.mha");
}

static void test_metaimage_header(void **state) {
    (void)state;
    damage_saved("a.mhd", "a.mhd");
}

static void test_sidecar(void **state) {
    (void)state;
    damage_saved("a.raw", "a.raw.json");
}

// Headers with the features that the savers do not use.
static void damage_text(const char *leaf, const char *header, const void *data, size_t count) {
    struct test_bytes file = {0};
    test_put_text(&file, header);
    test_put(&file, data, count);
    test_write(leaf, file.bytes, file.count);
    struct pel_volume *volume = pel_volume_load(test_temporary_path(leaf), NULL);
    if (!volume)
        fail_msg("%s", pel_error_message());
    pel_volume_destroy(volume);
    int kept = silence();
    damage(leaf, leaf, file);
    test_release(&file);
    assert_silent(kept);
}

static void test_nrrd_encodings(void **state) {
    (void)state;
    unsigned char voxels[24];
    for (int i = 0; i < 24; i++)
        voxels[i] = (unsigned char)(11 * i);
    struct test_bytes packed = test_deflate(voxels, sizeof voxels, 31);
    damage_text("gzip.nrrd",
                "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nspacings: 1 2 nan\n"
                "axis mins: 0 nan 1\naxis maxs: 4 5 nan\ncenters: cell node ???\n"
                "labels: \"a\" \"b\" \"c\"\nunits: \"mm\" \"um\" \"m\"\nencoding: gzip\n"
                "key:=value\n\n",
                packed.bytes, packed.count);
    test_release(&packed);
    // The 24 bytes 0, 11, 22 .. as the bzip2 program packs them.
    static const unsigned char bzip2[] = {
        0x42, 0x5a, 0x68, 0x39, 0x31, 0x41, 0x59, 0x26, 0x53, 0x59, 0x2e, 0x67, 0xb1,
        0x37, 0x0,  0x0,  0x0,  0x7f, 0xff, 0xc0, 0x8,  0x1,  0x0,  0x20, 0x4,  0x0,
        0x80, 0x10, 0x2,  0x0,  0x40, 0x8,  0x1,  0x0,  0x20, 0x4,  0x0,  0x80, 0x10,
        0x2,  0x0,  0x40, 0x8,  0x1,  0x0,  0x20, 0x4,  0x0,  0x80, 0x10, 0x2,  0x20,
        0x0,  0x22, 0x80, 0x1,  0xa6, 0x86, 0x4c, 0x85, 0x6,  0x8d, 0x1a, 0xc,  0x80,
        0xd1, 0x5c, 0xf8, 0x46, 0x53, 0xa5, 0x6d, 0x7c, 0x64, 0x34, 0x3b, 0xe7, 0x48,
        0xfc, 0x8b, 0xf1, 0x77, 0x24, 0x53, 0x85, 0x9,  0x2,  0xe6, 0x7b, 0x13, 0x70};
    damage_text("bzip2.nrrd",
                "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: bzip2\n\n", bzip2,
                sizeof bzip2);
    static const char text[] = "1 2 3 4 5 6 7 8\n9 10 11 12 13 14 15 16\n17 18 19 20 21 22 23 24\n";
    damage_text(
        "text.nrrd",
        "NRRD0004\ntype: float\ndimension: 4\nspace: LPS\nsizes: 3 2 2 2\n"
        "kinds: vector domain domain domain\n"
        "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace units: \"mm\" \"mm\" \"mm\"\n"
        "measurement frame: (1,0,0) (0,1,0) (0,0,1)\nencoding: ascii\n\n",
        text, sizeof text - 1);
    static const char hex[] = "00010203 04050607 08090a0b\n0c0d0e0f 10111213 14151617\n";
    damage_text("hex.nrrd",
                "NRRD0004\ntype: ushort\ndimension: 3\nsizes: 3 2 2\nendian: big\n"
                "sample units: \"HU\"\nencoding: hex\n\n",
                hex, sizeof hex - 1);
}

static void test_nrrd_file_lists(void **state) {
    (void)state;
    unsigned char slice[12] = {0};
    test_write("s01.raw", slice, 12);
    test_write("s02.raw", slice, 12);
    damage_text("pattern.nhdr",
                "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\nbyte skip: 0\n"
                "line skip: 0\ndata file: s%02d.raw 1 2 1\n",
                "", 0);
    damage_text("list.nhdr",
                "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n"
                "data file: LIST\ns01.raw\ns02.raw\n",
                "", 0);
}

static void test_metaimage_features(void **state) {
    (void)state;
    unsigned char voxels[24] = {1, 2, 3};
    struct test_bytes packed = test_deflate(voxels, sizeof voxels, 15);
    char header[512];
    snprintf(header, sizeof header,
             "ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = True\n"
             "CompressedDataSize = %zu\nRotation = 0 1 0 1 0 0 0 0 1\nPosition = 1 2 3\n"
             "ElementSize = 1 2 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n"
             "ElementDataFile = LOCAL\n",
             packed.count);
    damage_text("packed.mha", header, packed.bytes, packed.count);
    test_release(&packed);
    test_write("s01.raw", voxels, 12);
    test_write("s02.raw", voxels, 12);
    damage_text("pattern.mhd",
                "NDims = 3\nDimSize = 4 3 2\nHeaderSize = -1\nElementType = MET_UCHAR\n"
                "ElementNumberOfChannels = 1\nElementDataFile = s%02d.raw 1 2 1\n",
                "", 0);
    damage_text("list.mhd",
                "NDims = 3\nDimSize = 2 3 2\nElementType = MET_SHORT\nElementByteOrderMSB = True\n"
                "ElementDataFile = LIST 2D\ns01.raw\ns02.raw\n",
                "", 0);
}

static void test_pvm(void **state) {
    (void)state;
    unsigned char voxels[48] = {1, 2, 3};
    damage_text("plain.pvm", "PVM3\n4 3 2\n1 1 2.5\n2\n", voxels, 48);
    // Groups of every width; what they decode to is no PVM header.
    struct test_bytes file = {0};
    test_put_text(&file, "DDS v3e\n");
    for (int i = 0; i < 120; i++)
        test_put_integer(&file, i * 37 + 1, 1, false);
    int kept = silence();
    damage("packed.pvm", "packed.pvm", file);
    assert_silent(kept);
    test_release(&file);
}

static void test_nifti2_and_pair(void **state) {
    (void)state;
    struct test_bytes header = {0};
    static const unsigned char zeros[540];
    test_put(&header, zeros, 540);
    const int32_t size = 540;
    const int64_t dims[8] = {3, 4, 3, 2, 1, 1, 1, 1};
    const int16_t datatype = 4, bits = 16;
    memcpy(header.bytes, &size, 4);
    memcpy(header.bytes + 4, "ni2\0\r\n\032\n", 8);
    memcpy(header.bytes + 12, &datatype, 2);
    memcpy(header.bytes + 14, &bits, 2);
    memcpy(header.bytes + 16, dims, sizeof dims);
    test_write("pair.hdr", header.bytes, header.count);
    test_write("pair.img", zeros, 48);
    struct pel_volume *volume = pel_volume_load(test_temporary_path("pair.hdr"), NULL);
    assert_non_null(volume);
    pel_volume_destroy(volume);
    int kept = silence();
    damage("pair.hdr", "pair.hdr", header);
    assert_silent(kept);
    test_release(&header);
}

int main(void) {
    limit_resources();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nifti),
        cmocka_unit_test(test_nifti_gzip),
        cmocka_unit_test(test_nifti2_and_pair),
        cmocka_unit_test(test_nrrd),
        cmocka_unit_test(test_nhdr),
        cmocka_unit_test(test_nrrd_encodings),
        cmocka_unit_test(test_nrrd_file_lists),
        cmocka_unit_test(test_metaimage),
        cmocka_unit_test(test_metaimage_header),
        cmocka_unit_test(test_metaimage_features),
        cmocka_unit_test(test_sidecar),
        cmocka_unit_test(test_pvm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
