// widen.h - from the number types files hold to the few a renderer wants.
//
// A file may hold 32 and 64-bit integers and doubles; a volume may not. Values are kept exactly
// where one of the 16-bit types can, and otherwise become 32-bit floats with one warning that
// counts what was rounded.
#ifndef PEL_VOLUME_WIDEN_H
#define PEL_VOLUME_WIDEN_H

#include "pellucid.h"

enum pel_wide_type { PEL_WIDE_I32, PEL_WIDE_U32, PEL_WIDE_I64, PEL_WIDE_U64, PEL_WIDE_F64 };

// Makes a volume of dims[0] * dims[1] * dims[2] native-endian `values`, which are borrowed and
// aligned for their type. Integers that all fit become int16 or uint16, everything else float32.
// NaN and Inf, and doubles beyond the range of a float, are absent. NULL on failure (MEMORY,
// FORMAT).
struct pel_volume *pel_volume_from_wide(const char *name, const int dims[3],
                                        enum pel_wide_type type, const void *values);

// The same for a block of any number type, as readers find it in a file. The first five count as
// pel_voxel_type does.
enum pel_element {
    PEL_ELEMENT_U8,
    PEL_ELEMENT_I8,
    PEL_ELEMENT_U16,
    PEL_ELEMENT_I16,
    PEL_ELEMENT_F32,
    PEL_ELEMENT_I32,
    PEL_ELEMENT_U32,
    PEL_ELEMENT_I64,
    PEL_ELEMENT_U64,
    PEL_ELEMENT_F64,
};

size_t pel_element_bytes(enum pel_element element);

// The wide type of an element that no volume can have.
enum pel_wide_type pel_element_wide(enum pel_element element);

// Whether this machine is.
bool pel_little_endian(void);

// Reverses the bytes of each of `count` elements in place.
void pel_swap_bytes(void *values, size_t count, size_t element_bytes);

// One volume within a block of numbers that may hold several channels and time steps.
struct pel_selection {
    int dims[3];
    enum pel_element element; //
    size_t stride[3];         // elements from one voxel to the next along i, j, k
    size_t first;             // element of voxel (0,0,0)
    int components;           // kept per voxel, `component_stride` apart: 1, or 3 and 4 of uint8,
                              // which become RGB8 and RGBA8
    size_t component_stride;  //
    bool swap;                // the block has the other byte order
};

// Decides what becomes of `channels` values per voxel, `stride` elements apart: 3 or 4 of uint8 are
// a colour unless options->split_channels is set, and of others options->channel is taken, with a
// warning when nobody asked. Fails (ARGUMENT) when there is no such channel.
bool pel_select_channel(struct pel_selection *selection, const char *name, int64_t channels,
                        size_t stride, const struct pel_load_options *options);

// The same for options->time of `steps` time steps.
bool pel_select_time(struct pel_selection *selection, const char *name, int64_t steps,
                     size_t stride, const struct pel_load_options *options);

// Copies a selection out of `block`, which the caller made sure is large enough.
struct pel_volume *pel_volume_select(const char *name, const struct pel_selection *selection,
                                     const void *block);

#endif
