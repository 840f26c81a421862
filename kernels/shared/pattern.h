// pattern.h - where in its pixel a ray goes through, and other seeded choices; the same bits for
// host and kernels.
//
// A choice is a function of (seed, pixel, number) and of nothing else, so pictures repeat whatever
// computes them and in whatever order. Everything is 32-bit integer arithmetic; places are whole
// multiples of 2^-24 pixel, which floats hold exactly. Sources: regular, jittered and n-rooks after
// Shirley 1991 (Discrepancy as a quality measure for sample distributions); multi-jittered after
// Chiu, Shirley & Wang 1994 (Graphics Gems IV), its shuffles computed one element at a time as
// Kensler 2013 does (Correlated multi-jittered sampling); Hammersley after Wong, Luk & Heng 1997.
#ifndef SHARED_PATTERN_H
#define SHARED_PATTERN_H

#include "shared/types.h"

// How the n x n rays of a pixel are spread.
#define PATTERN_REGULAR 0        // in the middles of n x n cells
#define PATTERN_JITTERED 1       // anywhere in each of n x n cells
#define PATTERN_ROOKS 2          // one in each of n^2 columns and of n^2 rows
#define PATTERN_MULTI_JITTERED 3 // both of the former two
#define PATTERN_HAMMERSLEY 4     // evenly spaced along x, by the radical inverse along y

// How rays become a pixel.
#define RECONSTRUCTION_BOX 0      // the mean of the pixel's own
#define RECONSTRUCTION_GAUSSIAN 1 // weighted by distance, with those of the eight neighbours

#define PATTERN_RAYS_MAX 64

// The number of a ray through the pixel's centre, whatever the pattern; it comes before ray 0.
#define RAY_CENTRE 0xffffffffu

// Which choice a number stands for. Ray s takes 2 s and 2 s + 1.
#define DRAW_PHASE 128  // + s: the phase of ray s
#define DRAW_COLUMN 192 // + i: the shuffle in column i
#define DRAW_ROW 200    // + j: and in row j
#define DRAW_TURN 208   // + 0 to 2: the rotation of the directions around samples

// A place in a pixel: from its left and top edge, in 2^-24 of its side, below 2^24.
struct pattern_place {
    u32 x, y;
};

// Scrambles the bits of a number, one to one (Wellons's lowbias32).
static inline u32 pattern_scramble(u32 v) {
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

// What all choices of a pixel derive from.
static inline u32 pattern_key(u32 seed, u32 x_px, u32 y_px) {
    return pattern_scramble(pattern_scramble(pattern_scramble(seed + 0x9e3779b9u) ^ x_px) ^ y_px);
}

// A choice: 32 random bits.
static inline u32 pattern_draw(u32 key, u32 number) {
    return pattern_scramble(key + (number + 1) * 0x9e3779b9u);
}

// Where element i of `count` (at most PATTERN_RAYS_MAX) goes in a shuffle. Each step is one to one
// on the numbers of as many bits as count - 1 has; whoever leaves the range goes on until he is
// back in it.
static inline u32 pattern_shuffle(u32 i, u32 count, u32 choice) {
    u32 bits = 0;
    while (1u << bits < count)
        bits++;
    const u32 mask = (1u << bits) - 1, shift = bits > 1 ? bits / 2 : 1;
    do {
        for (u32 round = 0; round < 4; round++) {
            const u32 key = pattern_draw(choice, round);
            i = (i * (key >> 8 | 1) + key) & mask;
            i ^= i >> shift;
        }
    } while (i >= count);
    return i;
}

// The bits of s mirrored at the point, as a fraction of 2^24; at most 24 bits of s count.
static inline u32 pattern_radical_inverse(u32 s) {
    u32 inverse = 0;
    for (u32 bit = 1u << 23; s > 0 && bit > 0; s >>= 1, bit >>= 1)
        if (s & 1)
            inverse |= bit;
    return inverse;
}

// Somewhere in cell `cell` of `count` that share a side evenly. The last bits are set so that
// rounding down does not leave the cell.
static inline u32 pattern_in_cell(u32 cell, u32 count, u32 choice) {
    return ((cell << 24) + ((choice & 0xffffffu) | (PATTERN_RAYS_MAX - 1))) / count;
}

// The middle of the same.
static inline u32 pattern_cell_middle(u32 cell, u32 count) {
    return ((2 * cell + 1) << 23) / count;
}

// The place of ray s of n x n, s < n * n, n <= 8.
static inline struct pattern_place pattern_place(i32 pattern, u32 n, u32 key, u32 s) {
    const u32 count = n * n, column = s % n, row = s / n;
    const u32 first = pattern_draw(key, 2 * s), second = pattern_draw(key, 2 * s + 1);
    struct pattern_place place;
    if (pattern == PATTERN_JITTERED) {
        place.x = pattern_in_cell(column, n, first);
        place.y = pattern_in_cell(row, n, second);
    } else if (pattern == PATTERN_ROOKS) {
        place.x = pattern_in_cell(s, count, first);
        place.y = pattern_in_cell(pattern_shuffle(s, count, pattern_draw(key, DRAW_ROW)), count, second);
    } else if (pattern == PATTERN_MULTI_JITTERED) {
        const u32 x = pattern_shuffle(row, n, pattern_draw(key, DRAW_COLUMN + column));
        const u32 y = pattern_shuffle(column, n, pattern_draw(key, DRAW_ROW + row));
        place.x = pattern_in_cell(column * n + x, count, first);
        place.y = pattern_in_cell(row * n + y, count, second);
    } else if (pattern == PATTERN_HAMMERSLEY) {
        u32 half_gap = 1u << 23; // of the inverses of all numbers with as many bits
        for (u32 reach = 1; reach < count; reach *= 2)
            half_gap >>= 1;
        place.x = pattern_cell_middle(s, count);
        place.y = pattern_radical_inverse(s) + half_gap;
    } else {
        place.x = pattern_cell_middle(column, n);
        place.y = pattern_cell_middle(row, n);
    }
    return place;
}

#endif
