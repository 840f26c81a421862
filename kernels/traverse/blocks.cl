// blocks.cl - skips by two-level sparse blocks: a hierarchy leads to the first one, and from there
// rays walk from block to block (Derin et al. 2021, block walking and culling).
//
// In a block the ray goes from sub-block to sub-block, past those that are not stored or in which
// nothing can be seen. A block of which no bin of values can be seen is left at once. Behind a
// block the ray is in one that lies beside it and is known to it, or in none; only then is the
// hierarchy searched again, whose nodes are culled by their bins. A cursor keeps where its ray
// leaves a sub-block with something in it, and until then there is nothing to do.
// Included by span.cl.
#ifndef BLOCKS_CL
#define BLOCKS_CL

#include "shared/grid.h"
#include "traverse/hierarchy.cl"
#include "traverse/leap.cl"

#define LOAD_BLOCK(at) words[at]
#define LOAD_NUMBER(at) numbers[at]
#define LOAD_SEEN(at) seen[at]

// A sixth, of what is less than 2^15 and not negative.
#define BLOCK_OF(sub_block) ((sub_block)*10923 >> 16)

// Where a ray is at some sample.
struct block_place {
    struct place at;
    integer sx, sy, sz; // sub-block
    integer bx, by, bz; // block
};

INLINE struct block_place find_place(const struct cursor *cursor, integer i, int bits) {
    struct block_place place;
    place.at = cursor_place(cursor, i);
    place.sx = TO_INTEGER(place.at.x) >> bits;
    place.sy = TO_INTEGER(place.at.y) >> bits;
    place.sz = TO_INTEGER(place.at.z) >> bits;
    place.bx = BLOCK_OF(place.sx);
    place.by = BLOCK_OF(place.sy);
    place.bz = BLOCK_OF(place.sz);
    return place;
}

INLINE mask is_beside(integer offset) {
    return MASK(offset >= -1) & MASK(offset <= 1);
}

// Goes on to the block that a ray is in now, from the one it was in. The lanes in which it is none
// that is known from there.
INLINE mask walk(__global const int *words, struct cursor *cursor, const struct block_place *place,
                 mask asks) {
    const integer packed =
        place->bx | place->by << BLOCK_PLACE_BITS | place->bz << 2 * BLOCK_PLACE_BITS;
    const mask none = MASK(cursor->block < 0);
    const integer at = max(cursor->block, (integer)(0)) * BLOCK_WORDS;
    const integer last = GATHER(int, LOAD_BLOCK, at);
    const mask moved = asks & (none | MASK(last != packed));
    if (!any_lane(moved))
        return moved;
    const integer low = (integer)((1 << BLOCK_PLACE_BITS) - 1);
    const integer x = place->bx - (last & low), y = place->by - (last >> BLOCK_PLACE_BITS & low),
                  z = place->bz - (last >> 2 * BLOCK_PLACE_BITS);
    const mask known = is_beside(x) & is_beside(y) & is_beside(z) & ~none & moved;
    const integer beside = CHOOSE((integer)(13), z * 9 + y * 3 + x + 13, known);
    const integer next = GATHER(int, LOAD_BLOCK, at + (BLOCK_BESIDE + beside));
    cursor->block = CHOOSE(cursor->block, CHOOSE((integer)(-1), next, known), moved);
    return moved & MASK(cursor->block < 0);
}

// The hierarchy of a part, or NULL where nothing is stored.
INLINE __global const struct bvh_node *part_nodes(__constant struct part *part,
                                                  __global const uchar *cells) {
    const uint nodes = ((__global const struct block_grid *)cells)[part->number].nodes;
    return nodes ? (__global const struct bvh_node *)(cells + nodes) : 0;
}

// Searches the hierarchy for the blocks that lost rays enter next, and moves them there. The lanes
// that rounding leaves just outside of a block: they take a sample.
INLINE mask enter_blocks(__global const struct block_grid *grid, __global const uchar *cells,
                         struct cursor *cursor, const struct block_place *place, integer *i,
                         mask lost) {
    __global const int *words = (__global const int *)(cells + grid->blocks);
    const struct leaf leaf = find_leaf((__global const struct bvh_node *)(cells + grid->nodes),
                                       (int)grid->visible, cursor, TO_REAL(*i), lost);
    cursor->block = CHOOSE(cursor->block, -1 - leaf.link, lost);
    const integer next = max(*i, leaf_entry(&leaf));
    const mask stays = lost & MASK(next == *i);
    *i = CHOOSE(*i, next, lost);
    const integer at = max(cursor->block, (integer)(0)) * BLOCK_WORDS;
    const integer packed =
        place->bx | place->by << BLOCK_PLACE_BITS | place->bz << 2 * BLOCK_PLACE_BITS;
    return stays & MASK(GATHER(int, LOAD_BLOCK, at) != packed);
}

// The samples before a ray leaves its sub-block, or its whole block.
INLINE real samples_to_leave(real x, real delta, integer sub_block, integer block, mask whole,
                             int bits) {
    const integer low = CHOOSE(sub_block, block * BLOCK_SIDE, whole);
    const integer size = CHOOSE((integer)(1), (integer)(BLOCK_SIDE), whole);
    const integer plane = CHOOSE(low, low + size, MASK(delta >= 0.0f)) << bits;
    return samples_to_plane(x, delta, plane);
}

// Passes what is empty of the blocks that rays are in. The lanes in which there is something to
// see.
INLINE mask pass_sub_blocks(__global const struct block_grid *grid, __global const uchar *cells,
                            struct cursor *cursor, const struct block_place *place, integer *i,
                            mask asks) {
    __global const int *words = (__global const int *)(cells + grid->blocks);
    __global const uchar *numbers = cells + grid->blocks;
    __global const uchar *seen = cells + grid->seen;
    const integer block = max(cursor->block, (integer)(0));
    const integer at = block * BLOCK_WORDS;
    const integer bins = GATHER(int, LOAD_BLOCK, at + BLOCK_BINS_WORD);
    const mask culled = MASK((bins & (int)grid->visible) == 0);
    const integer x = place->sx - place->bx * BLOCK_SIDE, y = place->sy - place->by * BLOCK_SIDE,
                  z = place->sz - place->bz * BLOCK_SIDE;
    const integer inside = CHOOSE((integer)(0), (z * BLOCK_SIDE + y) * BLOCK_SIDE + x, asks);
    const integer number =
        TO_INTEGER(GATHER(uchar, LOAD_NUMBER, (at + BLOCK_NUMBERS) * 4 + inside));
    const mask stored = asks & MASK(number != BLOCK_ABSENT);
    const integer first = GATHER(int, LOAD_BLOCK, at + BLOCK_FIRST);
    const integer record = CHOOSE((integer)(0), first + number, stored);
    const mask full =
        stored & ~culled &
        MASK((TO_INTEGER(GATHER(uchar, LOAD_SEEN, record)) & (int)grid->visible) != 0);

    const int bits = grid->bits;
    real count = samples_to_leave(place->at.x, cursor->dx, place->sx, place->bx, culled, bits);
    count =
        fmin(count, samples_to_leave(place->at.y, cursor->dy, place->sy, place->by, culled, bits));
    count =
        fmin(count, samples_to_leave(place->at.z, cursor->dz, place->sz, place->bz, culled, bits));
    const integer behind = *i + whole_leap(count);
    cursor->inside = CHOOSE(cursor->inside, behind, full);
    *i = CHOOSE(*i, behind, asks & ~full);
    return full;
}

// The next sample from i on that may be visible, in the lanes that ask.
INLINE integer cursor_leap(__constant struct part *part, __global const uchar *cells,
                           struct cursor *cursor, integer i, mask asks) {
    i = max(i, cursor->next);
    asks &= MASK(i < cursor->end) & MASK(i >= cursor->inside);
    if (any_lane(asks)) {
        __global const struct block_grid *grid =
            &((__global const struct block_grid *)cells)[part->number];
        __global const int *words = (__global const int *)(cells + grid->blocks);
        if (grid->nodes == 0)
            return (integer)(SAMPLE_NEVER);
        while (any_lane(asks)) {
            const struct block_place place = find_place(cursor, i, grid->bits);
            const mask lost = walk(words, cursor, &place, asks);
            if (any_lane(lost)) {
                const mask grazes = enter_blocks(grid, cells, cursor, &place, &i, lost);
                cursor->inside = CHOOSE(cursor->inside, i + 1, grazes);
                asks &= ~grazes;
            }
            asks &= ~pass_sub_blocks(grid, cells, cursor, &place, &i, asks & ~lost);
            asks &= MASK(i < cursor->end);
        }
    }
    return CHOOSE((integer)(SAMPLE_NEVER), i, MASK(i < cursor->end));
}

#endif
