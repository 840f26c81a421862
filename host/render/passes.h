// passes.h - inside the render module: passes of the occupancy kernel over the cells of a part.
#ifndef PEL_RENDER_PASSES_H
#define PEL_RENDER_PASSES_H

#include "render/occupancy.h"

// Binds what belongs to part p and to no other; *count is the number of its cells.
bool pel_pass_set_part(struct pel_occupancy *occupancy, const struct pel_world *world, int p,
                       size_t cells[3], size_t *count);

// One pass (PASS_*) with that many work-items, from `in` to `out`.
bool pel_pass_run(struct pel_occupancy *occupancy, const struct pel_buffer *in,
                  const struct pel_buffer *out, size_t items, uint32_t pass);

// Brings the bricks of `size` voxels that PASS_BRICK or PASS_BINS have left of each part, a byte
// each, from the place of its first cell on.
bool pel_pass_read_bricks(struct pel_occupancy *occupancy, const struct pel_world *world, int size,
                          uint8_t *bricks);

// A brick of `size` voxels has 2^bits cells along a side.
uint32_t pel_pass_bits(const struct pel_world *world, int size);

#endif
