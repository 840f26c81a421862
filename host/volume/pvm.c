// pvm.c - PVM volumes of Stefan Roettger's volume library, plain or inside his DDS compression.
//
// PVM is text lines and then voxels, i fastest:
//
//     "PVM\n"  [# comments]  "W H D\n"                 "C\n"  voxels
//     "PVM2\n" or "PVM3\n"   "W H D\n" "SX SY SZ\n"    "C\n"  voxels  [four texts, PVM3]
//
// C is bytes per voxel; two are a 16-bit number, high byte first.
//
// DDS ("DDS v3d\n" or "DDS v3e\n") codes the difference of each byte to the one before it, or, past
// the first `strip` bytes, to what the gradient one strip earlier foretells. A stream of bits, most
// significant first: 2 bits skip - 1, 16 bits strip - 1 (a strip of 1 foretells nothing); then
// groups of a 7-bit count, a 3-bit width code and `count` differences of that width; a count of 0
// ends it. Bytes of multi-byte voxels are stored one plane after the other (`skip` planes), in v3e
// within blocks of 2^24 voxels.
#include "volume/volume.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "volume/source.h"

enum { DDS_MAGIC_BYTES = 8, DDS_BLOCK = 1 << 24 };

// A group of 127 zero-width differences takes 10 bits: 102 bytes out of one.
enum { DDS_RATIO = 102 };

struct bits {
    const unsigned char *bytes;
    size_t bit, bit_count;
};

// The next `count` (at most 16) bits; false at the end of the data.
static bool read_bits(struct bits *bits, unsigned count, unsigned *value) {
    if (count > bits->bit_count - bits->bit)
        return false;
    *value = 0;
    for (unsigned i = 0; i < count; i++, bits->bit++)
        *value = *value << 1 | (bits->bytes[bits->bit >> 3] >> (7 - (bits->bit & 7)) & 1u);
    return true;
}

// Undoes the separation into planes of one span of bytes.
static void merge_planes(unsigned char *out, const unsigned char *planes, size_t bytes,
                         size_t skip) {
    for (size_t plane = 0; plane < skip; plane++)
        for (size_t i = plane; i < bytes; i += skip)
            out[i] = *planes++;
}

// Decodes the groups to `out`, which has room for `capacity` bytes. Returns how many there were, or
// 0 with a sentence.
static size_t decode_groups(struct bits *bits, size_t strip, unsigned char *out, size_t capacity) {
    size_t count = 0;
    unsigned value = 0, length, code, difference;
    for (;;) {
        if (!read_bits(bits, 7, &length))
            break;
        if (length == 0) {
            if (count == 0)
                pel_fail(PEL_ERROR_FORMAT, "the DDS data is empty");
            return count;
        }
        if (!read_bits(bits, 3, &code))
            break;
        unsigned width = code ? code + 1 : 0;
        for (unsigned i = 0; i < length; i++) {
            if (count == capacity || !read_bits(bits, width, &difference))
                goto truncated;
            if (strip > 1 && count > strip)
                value += out[count - strip] - (unsigned)out[count - strip - 1];
            value = (value + difference - (1u << width) / 2) & 255;
            out[count++] = (unsigned char)value;
        }
    }
truncated:
    pel_fail(PEL_ERROR_FORMAT, "the DDS data ends after %zu bytes without its mark", count);
    return 0;
}

// Decompresses a whole DDS file. Returns memory to free() with a zero byte behind the `*bytes`.
static char *decode_dds(const char *file, size_t file_bytes, size_t *bytes) {
    struct bits bits = {.bytes = (const unsigned char *)file + DDS_MAGIC_BYTES,
                        .bit_count = (file_bytes - DDS_MAGIC_BYTES) * 8};
    unsigned skip, strip;
    if (!read_bits(&bits, 2, &skip) || !read_bits(&bits, 16, &strip)) {
        pel_fail(PEL_ERROR_FORMAT, "the DDS data ends in its header");
        return NULL;
    }
    skip++, strip++;
    size_t capacity = file_bytes * DDS_RATIO;
    unsigned char *planes = pel_allocate_voxels(capacity), *out = NULL;
    if (!planes)
        return NULL;
    size_t count = decode_groups(&bits, strip, planes, capacity);
    if (count > 0)
        out = pel_allocate(count + 1, 1);
    if (out) {
        size_t block = file[6] == 'e' ? (size_t)DDS_BLOCK * skip : count;
        for (size_t at = 0; at < count; at += block)
            merge_planes(out + at, planes + at, count - at < block ? count - at : block, skip);
        *bytes = count;
    }
    free(planes);
    return (char *)out;
}

// Reads one whole number.
static bool parse_count(const char **at, int64_t *number) {
    char *after;
    errno = 0;
    *number = strtoll(*at, &after, 10);
    if (after == *at || errno != 0)
        return pel_fail(PEL_ERROR_FORMAT, "the PVM header lacks a number");
    *at = after;
    return true;
}

static bool parse_length(const char **at, double *number) {
    char *after;
    *number = strtod(*at, &after);
    if (after == *at || !isfinite(*number) || *number <= 0)
        return pel_fail(PEL_ERROR_FORMAT, "the PVM header lacks a voxel size");
    *at = after;
    return true;
}

// Parses the text; a zero byte behind the file bounds every number. `*voxels` is where they start.
static bool parse_header(const char *file, int64_t dims[3], double spacing[3], int64_t *components,
                         const char **voxels) {
    const char *at = file + 3;
    bool has_spacing = *at == '2' || *at == '3';
    at += has_spacing;
    if (*at != '\n')
        return pel_fail(PEL_ERROR_FORMAT, "not a PVM file");
    at++;
    while (*at == '#')
        at += strcspn(at, "\n") + (strchr(at, '\n') != NULL);
    for (int i = 0; i < 3; i++)
        if (!parse_count(&at, &dims[i]))
            return false;
    for (int i = 0; has_spacing && i < 3; i++)
        if (!parse_length(&at, &spacing[i]))
            return false;
    if (!parse_count(&at, components))
        return false;
    if (*at != '\n')
        return pel_fail(PEL_ERROR_FORMAT, "the PVM header does not end in a line");
    *voxels = at + 1;
    return true;
}

static struct pel_volume *volume_from_pvm(const char *name, const char *file, size_t bytes) {
    int64_t dims[3] = {0}, components = 0;
    double spacing[3] = {1, 1, 1};
    const char *voxels = file;
    if (bytes < 5 || memcmp(file, "PVM", 3) != 0) {
        pel_fail(PEL_ERROR_FORMAT, "not a PVM file");
        return NULL;
    }
    if (!parse_header(file, dims, spacing, &components, &voxels))
        return NULL;
    if (components != 1 && components != 2) {
        pel_fail(PEL_ERROR_UNSUPPORTED, "%lld bytes per voxel, PVM files of 1 and 2 are read",
                 (long long)components);
        return NULL;
    }
    size_t needed;
    if (!pel_block_bytes(dims, (size_t)components, (size_t)(file + bytes - voxels), &needed))
        return NULL;
    struct pel_selection selection = {
        .dims = {(int)dims[0], (int)dims[1], (int)dims[2]},
        .element = components == 2 ? PEL_ELEMENT_U16 : PEL_ELEMENT_U8,
        .stride = {1, (size_t)dims[0], (size_t)dims[0] * (size_t)dims[1]},
        .components = 1,
        .swap = components == 2 && pel_little_endian(),
    };
    struct pel_volume *volume = pel_volume_select(name, &selection, voxels);
    if (!volume)
        return NULL;
    for (int i = 0; i < 3; i++)
        volume->world_from_voxel.m[i][i] = spacing[i];
    strcpy(volume->space, "PVM voxel size");
    return volume;
}

struct pel_volume *pel_pvm_load(const char *path, const struct pel_load_options *options) {
    (void)options;
    size_t bytes;
    char *file = pel_file_read(path, (size_t)PTRDIFF_MAX / DDS_RATIO, &bytes);
    if (file && bytes >= DDS_MAGIC_BYTES &&
        (memcmp(file, "DDS v3d\n", 8) == 0 || memcmp(file, "DDS v3e\n", 8) == 0)) {
        char *decoded = decode_dds(file, bytes, &bytes);
        free(file);
        file = decoded;
    }
    if (!file)
        return NULL;
    struct pel_volume *volume = volume_from_pvm(pel_path_leaf(path), file, bytes);
    free(file);
    return volume;
}
