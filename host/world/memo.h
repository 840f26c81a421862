// memo.h - tables of transfer functions from the frame before, since making one takes as long as
// hundreds of rays.
//
// All tables of a frame, and all lists of visible entries, lie one after the other. They stay
// where they are for the next frame, and what is the same and in the same place is not copied
// again.
#ifndef PEL_WORLD_MEMO_H
#define PEL_WORLD_MEMO_H

#include "world/strength.h"

// What else the words of a table depend on.
struct pel_memo_form {
    double low, high; // values that the volume has; for pairs of values only
    bool depth;       // strengths are optical depths
    bool linear;      // the kernel interpolates
    bool glows;       // what has no strength can be seen where it has a colour
};

// The share of a volume's voxels that a table shows, and what of either that was made of.
struct pel_memo_shown {
    bool known;
    float scale, bias; // to find the table's entries
    double min, max;   // of the volume's values
    size_t count;
    uint64_t histogram[PEL_HISTOGRAM_BINS];
    double share;
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
    u32 *visible;    // owned; the first of these from each one on that can be seen, one more
    size_t seen_end; // behind the last of them
    uint64_t frame;  // in which both were last put among those of all, from there on:
    size_t word_place, visible_place;
    struct pel_memo_shown shown;
};

// Words of one frame that stay for the next. They are the memo's.
struct pel_memo_words {
    u32 *words;
    size_t count, room;
    uint64_t version; // of those that have been written; never 0
};

struct pel_memo {
    struct pel_memo_table tables[PEL_VOLUME_MAX]; // by number of the instance
    struct pel_memo_words words, visible;         // of all tables of this frame
    uint64_t frame;                               // its number
};

// Begins a frame: there are no words yet.
void pel_memo_begin(struct pel_memo *memo);

// Makes the table of a transfer function and a volume, unless it is there already. False: MEMORY,
// FORMAT, and then it holds nothing.
bool pel_memo_build(struct pel_memo_table *memo, const struct pel_transfer *transfer,
                    const struct pel_volume *volume, const struct pel_strength_rule *rule);

// Writes its words, unless they are there already. False: MEMORY.
bool pel_memo_write(struct pel_memo_table *memo, const struct pel_memo_form *form);

// Puts the table's words and visible behind those of the tables before. False: MEMORY.
bool pel_memo_place(struct pel_memo *memo, struct pel_memo_table *table);

// Appends room for some words, to be written, and lets *added point there. False: MEMORY.
bool pel_memo_append(struct pel_memo_words *words, size_t count, u32 **added);

void pel_memo_finish(struct pel_memo *memo);

#endif
