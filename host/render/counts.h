// counts.h - the numbers of samples that packets leave behind, added up.
#ifndef PEL_RENDER_COUNTS_H
#define PEL_RENDER_COUNTS_H

#include "render/tiles.h"

// Adds what all packets have counted. Tiles of both eyes take turns, whether those are tiles of two
// pictures or a work-item's of one. False: MEMORY, DEVICE.
bool pel_counts_add(struct pel_buffer *buffer, const struct pel_tiling *tiling, int eyes,
                    int pictures, struct pel_render_statistics *statistics);

#endif
