// pvm.c - PVM files, plain and in DDS compression. The encoder here is written from the format's
// description, bit by bit; that real files decode is a test of the data folder (formats.c).
#include "support/file.h"

// A stream of bits, the first one highest.
struct bit_writer {
    struct test_bytes out;
    unsigned byte, count;
};

static void put_bits(struct bit_writer *writer, unsigned value, unsigned count) {
    while (count-- > 0) {
        writer->byte = writer->byte << 1 | (value >> count & 1);
        if (++writer->count == 8) {
            unsigned char byte = (unsigned char)writer->byte;
            test_put(&writer->out, &byte, 1);
            writer->byte = writer->count = 0;
        }
    }
}

// Compresses `plain`: planes of every skip-th byte, then differences to the gradient one strip
// before, in groups of 100 with 8 bits each, or none where all differences are 0.
static struct test_bytes compress(const struct test_bytes *plain, unsigned skip, unsigned strip) {
    struct bit_writer writer = {0};
    unsigned char planes[4096];
    int differences[4096];
    size_t count = 0;
    assert_true(plain->count <= sizeof planes);
    for (size_t plane = 0; plane < skip; plane++)
        for (size_t i = plane; i < plain->count; i += skip)
            planes[count++] = plain->bytes[i];
    for (size_t i = 0; i < count; i++) {
        int expected = i > 0 ? planes[i - 1] : 0;
        if (strip > 1 && i > strip)
            expected += planes[i - strip] - planes[i - strip - 1];
        differences[i] = (planes[i] - expected) & 255;
    }
    test_put_text(&writer.out, "DDS v3d\n");
    put_bits(&writer, skip - 1, 2);
    put_bits(&writer, strip - 1, 16);
    for (size_t i = 0; i < count;) {
        size_t length = count - i < 100 ? count - i : 100;
        bool zero = true;
        for (size_t j = 0; j < length; j++)
            zero = zero && differences[i + j] == 0;
        put_bits(&writer, (unsigned)length, 7);
        // Code 7 is 8 bits wide, code 0 none.
        put_bits(&writer, zero ? 0 : 7, 3);
        for (size_t j = 0; j < length && !zero; j++)
            put_bits(&writer, (unsigned)(differences[i + j] + 128) & 255, 8);
        i += length;
    }
    put_bits(&writer, 0, 7);
    put_bits(&writer, 0, 7);
    return writer.out;
}

static struct test_bytes make_pvm(const char *header, int voxels, int bytes) {
    struct test_bytes file = {0};
    test_put_text(&file, header);
    // High byte first, and a stretch of equal values.
    for (int i = 0; i < voxels; i++)
        test_put_integer(&file, i < 60 ? i * (bytes == 2 ? 1001 : 3) : 7, bytes, true);
    return file;
}

static struct pel_volume *load_bytes(const struct test_bytes *file) {
    struct pel_volume *volume =
        pel_volume_load(test_write("a.pvm", file->bytes, file->count), NULL);
    if (!volume)
        fail_msg("%s", pel_error_message());
    return volume;
}

static void assert_content(const struct pel_volume *volume, int bytes) {
    assert_memory_equal(volume->dims, ((int[]){10, 7, 6}), sizeof volume->dims);
    assert_int_equal(volume->type, bytes == 2 ? PEL_VOXEL_U16 : PEL_VOXEL_U8);
    for (int i = 0; i < 420; i++)
        assert_true(pel_volume_value(volume, i % 10, i / 10 % 7, i / 70) ==
                    (i < 60 ? i * (bytes == 2 ? 1001 : 3) : 7));
}

static void test_headers(void **state) {
    (void)state;
    static const struct {
        const char *header;
        int bytes;
        double spacing[3];
    } headers[] = {
        {"PVM\n10 7 6\n1\n", 1, {1, 1, 1}},
        {"PVM\n# made by hand\n# twice\n10 7 6\n2\n", 2, {1, 1, 1}},
        {"PVM2\n10 7 6\n0.5 1 2.5\n1\n", 1, {0.5, 1, 2.5}},
        {"PVM3\n10 7 6\n2 2 2e-1\n2\n", 2, {2, 2, 0.2}},
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        struct test_bytes file = make_pvm(headers[i].header, 420, headers[i].bytes);
        test_put_text(&file, "description");
        struct pel_volume *volume = load_bytes(&file);
        assert_content(volume, headers[i].bytes);
        const double *s = headers[i].spacing;
        test_assert_matrix(
            volume, (const double[3][4]){{s[0], 0, 0, 0}, {0, s[1], 0, 0}, {0, 0, s[2], 0}}, 0);
        pel_volume_destroy(volume);
        test_release(&file);
    }
}

static void test_compression(void **state) {
    (void)state;
    for (int bytes = 1; bytes <= 2; bytes++) {
        for (unsigned strip = 1; strip <= 70; strip += 23) {
            for (unsigned skip = 1; skip <= 4; skip++) {
                struct test_bytes plain =
                    make_pvm(bytes == 1 ? "PVM\n10 7 6\n1\n" : "PVM\n10 7 6\n2\n", 420, bytes);
                struct test_bytes packed = compress(&plain, skip, strip);
                struct pel_volume *volume = load_bytes(&packed);
                assert_content(volume, bytes);
                pel_volume_destroy(volume);
                // Version "e" merges planes in blocks, of which this is less than one.
                packed.bytes[6] = 'e';
                volume = load_bytes(&packed);
                assert_content(volume, bytes);
                pel_volume_destroy(volume);
                test_release(&plain);
                test_release(&packed);
            }
        }
    }
}

static void assert_fails(const char *header, int voxels, enum pel_error code,
                         const char *fragment) {
    struct test_bytes file = make_pvm(header, voxels, 1);
    test_assert_load_fails(test_write("bad.pvm", file.bytes, file.count), NULL, code, fragment);
    test_release(&file);
}

static void test_errors(void **state) {
    (void)state;
    assert_fails("PVM\n10 7 6\n1\n", 419, PEL_ERROR_FORMAT, "need 420 bytes, the file has 419");
    assert_fails("PVM\n60000 60000 60000\n2\n", 5, PEL_ERROR_FORMAT, "need 432000000000000 bytes");
    assert_fails("PVM\n10 7 6\n3\n", 5, PEL_ERROR_UNSUPPORTED, "3 bytes per voxel");
    assert_fails("PVM\n10 7\n", 0, PEL_ERROR_FORMAT, "lacks a number");
    assert_fails("PVM2\n10 7 6\n1 -1 1\n1\n", 5, PEL_ERROR_FORMAT, "lacks a voxel size");
    assert_fails("PVM\n0 7 6\n1\n", 5, PEL_ERROR_FORMAT, "0 voxels along axis 0");
    assert_fails("DDS v3d\n", 0, PEL_ERROR_FORMAT, "ends in its header");
    struct test_bytes plain = make_pvm("PVM\n10 7 6\n1\n", 420, 1);
    struct test_bytes packed = compress(&plain, 1, 5);
    test_assert_load_fails(test_write("cut.pvm", packed.bytes, packed.count - 4), NULL,
                           PEL_ERROR_FORMAT, "without its mark");
    test_release(&plain);
    test_release(&packed);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_headers),
        cmocka_unit_test(test_compression),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
