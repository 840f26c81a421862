// memo.h - tables of transfer functions from the frame before, since making one takes as long as
// hundreds of rays.
#ifndef PEL_WORLD_MEMO_H
#define PEL_WORLD_MEMO_H

#include "world/strength.h"

// What else the words of a table depend on.
struct pel_memo_form {
    double low, high; // values that the volume has; for pairs of values only
    bool depth;       // strengths are optical depths
    bool linear;      // the kernel interpolates
};

// One instance's table. Zero-initialise.
struct pel_memo_table {
    struct pel_transfer *transfer; // owned; what the table was made of, down to `rule`
    enum pel_voxel_type type;
    double slope, intercept;
    struct pel_strength_rule rule; // its `depth` is false
    struct pel_table table;        //
    bool gentle;                   // as pel_strength_is_gentle says
    struct pel_memo_form form;     // of the words
    u32 *words;                    // owned; NULL: not yet written
    size_t entries;                // of them
    const u32 *seen;               // entries that tell which values can be seen: the words, or
    size_t seen_entries;           // those beside the words of pairs
};

struct pel_memo {
    struct pel_memo_table tables[PEL_VOLUME_MAX]; // by number of the instance
};

// Makes the table of a transfer function and a volume, unless it is there already. False: MEMORY,
// FORMAT, and then it holds nothing.
bool pel_memo_build(struct pel_memo_table *memo, const struct pel_transfer *transfer,
                    const struct pel_volume *volume, const struct pel_strength_rule *rule);

// Writes its words, unless they are there already. False: MEMORY.
bool pel_memo_write(struct pel_memo_table *memo, const struct pel_memo_form *form);

void pel_memo_finish(struct pel_memo *memo);

#endif
