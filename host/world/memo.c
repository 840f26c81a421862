// memo.c - tables of transfer functions from the frame before.
//
// A table of 4096 entries takes a logarithm for each, twice: to see how it may be read, and to
// write it. Where only the camera or a pose changes it stays what it was, so each instance's is
// kept beside all that it was made of.
#include "world/memo.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "shared/variant.h"
#include "world/pairs.h"

static void forget(struct pel_memo_table *memo) {
    pel_transfer_destroy(memo->transfer);
    pel_table_finish(&memo->table);
    free(memo->words);
    free(memo->visible);
    *memo = (struct pel_memo_table){0};
}

static bool same_transfer(const struct pel_transfer *a, const struct pel_transfer *b) {
    return a->scale == b->scale && a->opacity_unit_mm == b->opacity_unit_mm &&
           a->nearest == b->nearest && a->table_entries == b->table_entries &&
           a->colour_count == b->colour_count && a->opacity_count == b->opacity_count &&
           memcmp(a->colours, b->colours, (size_t)a->colour_count * sizeof *a->colours) == 0 &&
           memcmp(a->opacities, b->opacities, (size_t)a->opacity_count * sizeof *a->opacities) == 0;
}

static bool same_rule(const struct pel_strength_rule *a, const struct pel_strength_rule *b) {
    return a->step_mm == b->step_mm && a->density == b->density &&
           a->opacity_unit_mm == b->opacity_unit_mm && a->depth == b->depth &&
           a->model == b->model && a->emission == b->emission;
}

bool pel_memo_build(struct pel_memo_table *memo, const struct pel_transfer *transfer,
                    const struct pel_volume *volume, const struct pel_strength_rule *rule) {
    if (memo->transfer && same_transfer(memo->transfer, transfer) && memo->type == volume->type &&
        memo->slope == volume->slope && memo->intercept == volume->intercept &&
        same_rule(&memo->rule, rule))
        return true;
    forget(memo);
    memo->type = volume->type;
    memo->slope = volume->slope;
    memo->intercept = volume->intercept;
    memo->rule = *rule;
    if (!pel_table_build(&memo->table, transfer, volume)) {
        forget(memo);
        return false;
    }
    memo->gentle = pel_strength_is_gentle(&memo->table, rule);
    memo->transfer = pel_transfer_copy(transfer);
    if (!memo->transfer)
        forget(memo);
    return memo->transfer != NULL;
}

// The pairs, and behind them a line of entries that tells at which values something can be seen.
static bool write_pairs(struct pel_memo_table *memo, const struct pel_strength_rule *rule) {
    memo->entries = (size_t)PAIR_ENTRIES * PAIR_ENTRIES;
    memo->seen_entries = PAIR_ENTRIES;
    memo->words =
        pel_allocate((memo->entries + PAIR_ENTRIES) * PEL_STRENGTH_WORDS, sizeof *memo->words);
    if (!memo->words)
        return false;
    u32 *along = memo->words + memo->entries * PEL_STRENGTH_WORDS;
    memo->seen = along;
    pel_pairs_write(memo->words, (u32(*)[PEL_STRENGTH_WORDS])along, &memo->table,
                    (double[]){memo->form.low, memo->form.high}, rule);
    return true;
}

static bool write_strengths(struct pel_memo_table *memo, const struct pel_strength_rule *rule) {
    int refinement = pel_strength_refinement(&memo->table, memo->form.linear);
    // One entry more: interpolation at the last one reads the next, at weight 0.
    size_t entries = (size_t)(memo->table.entry_count - 1) * (size_t)refinement + 2;
    memo->words = pel_allocate(entries * PEL_STRENGTH_WORDS, sizeof *memo->words);
    if (!memo->words)
        return false;
    pel_strength_write(memo->words, &memo->table, refinement, rule);
    memcpy(memo->words + (entries - 1) * PEL_STRENGTH_WORDS,
           memo->words + (entries - 2) * PEL_STRENGTH_WORDS,
           PEL_STRENGTH_WORDS * sizeof *memo->words);
    memo->entries = memo->seen_entries = entries;
    memo->seen = memo->words;
    return true;
}

// The first entry from each one on, and from behind them all, of which something can be seen; where
// there is none, it is the one behind them all.
static bool list_visible(struct pel_memo_table *memo) {
    memo->visible = pel_allocate(memo->seen_entries + 1, sizeof *memo->visible);
    if (!memo->visible)
        return false;
    memo->visible[memo->seen_entries] = (u32)memo->seen_entries;
    memo->seen_end = 0;
    for (size_t i = memo->seen_entries; i-- > 0;) {
        float strength;
        memcpy(&strength, &memo->seen[PEL_STRENGTH_WORDS * i], sizeof strength);
        bool glows = memo->form.glows && memo->seen[PEL_STRENGTH_WORDS * i + 1] != 0;
        bool seen = strength > 0 || glows;
        memo->visible[i] = seen ? (u32)i : memo->visible[i + 1];
        if (seen && memo->seen_end == 0)
            memo->seen_end = i + 1;
    }
    return true;
}

bool pel_memo_write(struct pel_memo_table *memo, const struct pel_memo_form *form) {
    if (memo->words && memo->form.low == form->low && memo->form.high == form->high &&
        memo->form.depth == form->depth && memo->form.linear == form->linear &&
        memo->form.glows == form->glows)
        return true;
    free(memo->words);
    free(memo->visible);
    memo->words = memo->visible = NULL;
    memo->frame = 0;
    memo->shown.known = false;
    memo->form = *form;
    struct pel_strength_rule rule = memo->rule;
    rule.depth = form->depth;
    bool good =
        rule.model == MODEL_PREINTEGRATED ? write_pairs(memo, &rule) : write_strengths(memo, &rule);
    if (good && list_visible(memo))
        return true;
    free(memo->words);
    memo->words = NULL;
    return false;
}

void pel_memo_begin(struct pel_memo *memo) {
    if (memo->frame++ == 0)
        memo->words.version = memo->visible.version = 1;
    memo->words.count = memo->visible.count = 0;
}

static bool make_room(struct pel_memo_words *words, size_t more) {
    size_t count = words->count + more;
    if (count > words->room) {
        size_t room = count + count / 2;
        u32 *grown = realloc(words->words, room * sizeof *grown);
        if (!grown)
            return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu words for tables", room);
        words->words = grown;
        words->room = room;
    }
    words->count = count;
    return true;
}

bool pel_memo_append(struct pel_memo_words *words, size_t count, u32 **added) {
    size_t before = words->count;
    if (!make_room(words, count))
        return false;
    words->version++;
    *added = words->words + before;
    return true;
}

bool pel_memo_place(struct pel_memo *memo, struct pel_memo_table *table) {
    size_t words = table->entries * PEL_STRENGTH_WORDS, visible = table->seen_entries + 1;
    // Kernels load two entries at once, so an empty one lies before and behind each table.
    size_t word_place = memo->words.count + PEL_STRENGTH_WORDS, visible_place = memo->visible.count;
    if (!make_room(&memo->words, words + 2 * PEL_STRENGTH_WORDS) ||
        !make_room(&memo->visible, visible))
        return false;
    // Since then only what lies before has been written, by the tables before this one.
    bool there = table->frame > 0 && table->frame == memo->frame - 1 &&
                 table->word_place == word_place && table->visible_place == visible_place;
    if (!there) {
        u32 *place = memo->words.words + word_place;
        memset(place - PEL_STRENGTH_WORDS, 0, PEL_STRENGTH_WORDS * sizeof *place);
        memcpy(place, table->words, words * sizeof *place);
        memset(place + words, 0, PEL_STRENGTH_WORDS * sizeof *place);
        memcpy(memo->visible.words + visible_place, table->visible,
               visible * sizeof *table->visible);
        memo->words.version++;
        memo->visible.version++;
    }
    table->frame = memo->frame;
    table->word_place = word_place;
    table->visible_place = visible_place;
    return true;
}

void pel_memo_finish(struct pel_memo *memo) {
    for (int k = 0; k < PEL_VOLUME_MAX; k++)
        forget(&memo->tables[k]);
    free(memo->words.words);
    free(memo->visible.words);
    *memo = (struct pel_memo){0};
}
