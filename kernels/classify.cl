// classify.cl - from a raw value to what it emits and hides within one step.
//
// A table entry is two words: the strength as a float, and the straight colour as 10 bits each of
// red, green and blue. Strength is the opacity of one step where a sample holds one volume at a
// time, and the optical depth of one step where extinctions add (STRENGTH_DEPTH). It keeps a
// float's precision because hundreds of small ones add up along a ray; a colour is only ever
// averaged, so a 1023rd is enough. The strength comes first and alone: colours are looked up only
// when some lane of the packet can be seen.
#ifndef CLASSIFY_CL
#define CLASSIFY_CL

#include "sample.cl"

#ifndef TABLE_LINEAR
#define TABLE_LINEAR 0 // 1: interpolate between entries; 0: the tables are so fine that the nearest do
#endif
#ifndef TABLE_SPACE
#define TABLE_SPACE __constant // where the tables are: __constant while they fit, else __global
#endif

// Where a lane's value lies in its table.
struct entry {
    integer word; // of the entry at or below the value
#if TABLE_LINEAR
    real weight; // of the entry above
#endif
};

// Finds the entry. Clears the lanes of *present whose value is absent (NaN).
INLINE struct entry find_entry(__constant struct part *part, real raw, mask *present) {
    struct entry entry;
    real x = raw * part->table_scale + part->table_bias;
#if VOXELS & VOXELS_F32
    const mask absent = MASK(x != x);
    *present &= ~absent;
    x = CHOOSE(x, (real)(0.0f), absent);
#endif
    x = AT_LEAST(x, (real)(0.0f));
    x = AT_MOST(x, (real)(part->table_last));
#if TABLE_LINEAR
    if (part->table_nearest)
        x = TO_REAL(TO_INTEGER(x + 0.5f));
    const integer index = TO_INTEGER(x);
    entry.weight = x - TO_REAL(index);
#else
    const integer index = TO_INTEGER(x + 0.5f);
#endif
    entry.word = index * 2 + (int)part->table;
    return entry;
}

#define LOAD_STRENGTH(at) as_float(table[at])
#define LOAD_NEXT_STRENGTH(at) as_float(table[(at) + 2])
#define LOAD_COLOUR(at) (int)table[(at) + 1]
#define LOAD_NEXT_COLOUR(at) (int)table[(at) + 3]

// The strength of each lane.
INLINE real entry_strength(TABLE_SPACE const uint *table, const struct entry *entry) {
    const real low = GATHER(float, LOAD_STRENGTH, entry->word);
#if TABLE_LINEAR
    const real high = GATHER(float, LOAD_NEXT_STRENGTH, entry->word);
    return mix_lanes(low, high, entry->weight);
#else
    return low;
#endif
}

INLINE real ten_bits(integer colour, int shift) {
    return TO_REAL((colour >> shift) & 1023) * (1.0f / 1023.0f);
}

// The straight colour of each lane.
INLINE void entry_colour(TABLE_SPACE const uint *table, const struct entry *entry, real *r, real *g,
                         real *b) {
    const integer low = GATHER(int, LOAD_COLOUR, entry->word);
#if TABLE_LINEAR
    const integer high = GATHER(int, LOAD_NEXT_COLOUR, entry->word);
    *r = mix_lanes(ten_bits(low, 0), ten_bits(high, 0), entry->weight);
    *g = mix_lanes(ten_bits(low, 10), ten_bits(high, 10), entry->weight);
    *b = mix_lanes(ten_bits(low, 20), ten_bits(high, 20), entry->weight);
#else
    *r = ten_bits(low, 0);
    *g = ten_bits(low, 10);
    *b = ten_bits(low, 20);
#endif
}

#endif
