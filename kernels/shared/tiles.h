// tiles.h - the order in which the tiles of a picture are rendered; the same for host and kernels.
//
// They lie in rings, one within the other, of which the outermost comes first; each runs clockwise,
// so that neighbours follow each other. What costs most is in the middle of most pictures, so it
// comes last. Where shares of the work are handed out that become smaller towards its end, as PoCL
// does (and OpenMP's guided schedule: Polychronopoulos & Kuck 1987), all threads are busy until it
// comes; if the last shares were cheap, they would wait for one that was large and is not.
#ifndef SHARED_TILES_H
#define SHARED_TILES_H

#include "shared/types.h"

#define TILE_PX 16 // the side of a tile, a square
#define TILES_ALONG(px) (((px) + TILE_PX - 1) / TILE_PX)

// Columns and rows of tiles before one.
struct tile_place {
    i32 x, y;
};

// Where tile n of columns x rows lies: below the last row if there are no more than n.
static inline struct tile_place tile_at(u32 n, i32 columns, i32 rows) {
    struct tile_place place = {0, rows};
    if (n >= (u32)columns * (u32)rows)
        return place;
    i32 at = (i32)n, inset = 0;
    for (i32 ring = 2 * (columns + rows) - 4; at > 0 && at >= ring; ring -= 8) {
        at -= ring;
        inset++;
    }
    const i32 right = columns - 1 - inset, bottom = rows - 1 - inset;
    const i32 across = right - inset, down = bottom - inset;
    if (at <= across) { // along the top
        place.x = inset + at;
        place.y = inset;
    } else if (at <= across + down) { // down on the right
        place.x = right;
        place.y = inset + at - across;
    } else if (at <= across + down + across) { // back along the bottom
        place.x = right - (at - across - down);
        place.y = bottom;
    } else { // and up on the left
        place.x = inset;
        place.y = bottom - (at - across - down - across);
    }
    return place;
}

#endif
