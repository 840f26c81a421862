// classify.cl - from a raw value to what it emits and hides within one step.
//
// A table entry is two words: the strength as a float, and the straight colour as 10 bits each of
// red, green and blue. Strength is the opacity of one step where a sample holds one volume at a
// time, and the optical depth of one step where extinctions add (STRENGTH_DEPTH). It keeps a
// float's precision because hundreds of small ones add up along a ray; a colour is only ever
// averaged, so a 1023rd is enough. Both are loaded at once: two loads and a blend for two lanes take
// half the time of the gather instruction that a list of words becomes, and often there are two.
#ifndef CLASSIFY_CL
#define CLASSIFY_CL

#include "sample.cl"

#ifndef TABLE_LINEAR
#define TABLE_LINEAR 0 // 1: interpolate between entries; 0: the tables are so fine that the nearest do
#endif
#ifndef TABLE_SPACE
#define TABLE_SPACE __constant // where the tables are: __constant while they fit, else __global
#endif

// What the table holds for a lane's value.
struct entry {
    real strength;
    integer colour; // of the entry at or below the value
#if TABLE_LINEAR
    integer colour_above;
    real weight; // of the entry above
#endif
};

// Two entries that begin at any one. Tables have one more before and behind them (host/world/memo.c).
struct __attribute__((packed, aligned(8))) two_entries {
    uint4 words;
};

// The words of each lane's entry.
INLINE void load_entries(TABLE_SPACE const uint *table, const struct indices *at, real *strengths,
                         integer *colours) {
#define TWO_ENTRIES(at) ((TABLE_SPACE const struct two_entries *)(table + 2 * (at)))->words
#define ENTRY_PAIR(lane)                                                                           \
    (uint4)(TWO_ENTRIES((size_t)at->of[lane]).lo, TWO_ENTRIES((size_t)at->of[lane + 1] - 1).hi)
#if LANES == 1
    *strengths = as_float(table[2 * at->of[0]]);
    *colours = (int)table[2 * at->of[0] + 1];
#else
#if LANES == 4
    const uint4 low = ENTRY_PAIR(0), high = ENTRY_PAIR(2);
#elif LANES == 8
    const uint8 low = (uint8)(ENTRY_PAIR(0), ENTRY_PAIR(2)),
                high = (uint8)(ENTRY_PAIR(4), ENTRY_PAIR(6));
#else
    const uint16 low = (uint16)(ENTRY_PAIR(0), ENTRY_PAIR(2), ENTRY_PAIR(4), ENTRY_PAIR(6)),
                 high = (uint16)(ENTRY_PAIR(8), ENTRY_PAIR(10), ENTRY_PAIR(12), ENTRY_PAIR(14));
#endif
    *strengths = AS_REAL((LANES_JOIN(uint, LANES))(low.even, high.even));
    *colours = AS_INTEGER((LANES_JOIN(uint, LANES))(low.odd, high.odd));
#endif
}

// What makes a place in the part's table, cut off, the entry that is read there: the nearest, but
// where the table is read between its entries.
INLINE float table_shift(__constant struct part *part) {
    return TABLE_LINEAR && !part->table_nearest ? 0.0f : 0.5f;
}

// Where values lie in the part's table. Clears the lanes of *present whose value is absent (NaN).
INLINE real table_place(__constant struct part *part, real raw, mask *present) {
    const real x = raw * part->table_scale + (part->table_bias + table_shift(part));
#if VOXELS & VOXELS_F32
    const mask absent = MASK(x != x);
    *present &= ~absent;
    return CHOOSE(x, (real)(0.0f), absent);
#else
    return x;
#endif
}

// Where in the part's table a lane's entry is.
struct address {
    integer number; // by keep_indices
#if TABLE_LINEAR
    real weight; // of the entry above
#endif
};

INLINE void find_address(__constant struct part *part, real place, struct address *address) {
    place = AT_LEAST(place, (real)(0.0f));
    place = AT_MOST(place, (real)(part->table_last + table_shift(part)));
    const integer number = TO_INTEGER(place);
#if TABLE_LINEAR
    address->weight = part->table_nearest ? (real)(0.0f) : place - TO_REAL(number);
#endif
    keep_indices(&address->number, number);
}

// The entry there. Rusticl loses what a loop assigns to parts of an array as whole structures (Mesa
// 26), so it is filled in.
INLINE void load_entry(TABLE_SPACE const uint *table, __constant struct part *part,
                       const struct address *address, struct entry *entry) {
    const struct indices at = read_indices(&address->number);
    table += part->table;
    load_entries(table, &at, &entry->strength, &entry->colour);
#if TABLE_LINEAR
    entry->weight = address->weight;
    real above;
    load_entries(table + 2, &at, &above, &entry->colour_above);
    entry->strength = mix_lanes(entry->strength, above, entry->weight);
#endif
}

// One that shows nothing. Without, PoCL keeps the entry of the sample before in memory.
INLINE void clear_entry(struct entry *entry) {
    entry->strength = (real)(0.0f);
    entry->colour = (integer)(0);
#if TABLE_LINEAR
    entry->colour_above = (integer)(0);
    entry->weight = (real)(0.0f);
#endif
}

// The entry of a value. Clears the lanes of *present whose value is absent.
INLINE struct entry find_entry(TABLE_SPACE const uint *table, __constant struct part *part, real raw,
                               mask *present) {
    struct address address;
    find_address(part, table_place(part, raw, present), &address);
    struct entry entry;
    load_entry(table, part, &address, &entry);
    return entry;
}

#if MODELS & MODELS_PREINTEGRATED
// Where a value lies in one direction of a table of pairs: the entry below, and the weight of the
// one above.
struct side {
    integer entry;
    real weight;
};

INLINE struct side find_side(__constant struct part *part, real raw) {
    real x = raw * part->table_scale + part->table_bias;
    x = AT_LEAST(x, (real)(0.0f));
    x = AT_MOST(x, (real)(part->table_last));
    struct side side;
    side.entry = min(TO_INTEGER(x), (integer)(PAIR_ENTRIES - 2));
    side.weight = x - TO_REAL(side.entry);
    return side;
}
#endif

#define LOAD_STRENGTH(at) as_float(table[at])
#define LOAD_COLOUR(at) (int)table[(at) + 1]

// A colour's red, green or blue, from bit `first` on. The two bits behind blue are 0.
INLINE real ten_bits(integer colour, int first) {
    const integer bits = colour >> first;
    return TO_REAL(first < 20 ? bits & 1023 : bits) * (1.0f / 1023.0f);
}

// The straight colour of each lane.
INLINE void entry_colour(const struct entry *entry, real *r, real *g, real *b) {
    *r = ten_bits(entry->colour, 0);
    *g = ten_bits(entry->colour, 10);
    *b = ten_bits(entry->colour, 20);
#if TABLE_LINEAR
    *r = mix_lanes(*r, ten_bits(entry->colour_above, 0), entry->weight);
    *g = mix_lanes(*g, ten_bits(entry->colour_above, 10), entry->weight);
    *b = mix_lanes(*b, ten_bits(entry->colour_above, 20), entry->weight);
#endif
}

#endif
