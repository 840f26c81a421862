// passes.c - passes of the occupancy kernel over the cells of a part.
#include "render/passes.h"

// Cells are many and little work each.
enum { GROUP = 64 };

bool pel_pass_set_part(struct pel_occupancy *occupancy, const struct pel_world *world, int p,
                       size_t cells[3], size_t *count) {
    pel_world_cells(world, p, cells);
    *count = cells[0] * cells[1] * cells[2];
    return pel_kernel_set_u32(occupancy->kernel, 5, (uint32_t)p) &&
           pel_kernel_set_u32(occupancy->kernel, 6, (uint32_t)*count);
}

bool pel_pass_run(struct pel_occupancy *occupancy, const struct pel_buffer *in,
                  const struct pel_buffer *out, size_t items, uint32_t pass) {
    struct pel_kernel *kernel = occupancy->kernel;
    size_t group = GROUP, most = pel_kernel_max_group(kernel);
    while (group > most && group > 1)
        group /= 2;
    return pel_kernel_set_buffer(kernel, 3, in) && pel_kernel_set_buffer(kernel, 4, out) &&
           pel_kernel_set_u32(kernel, 8, pass) &&
           pel_kernel_launch(kernel, (items + group - 1) / group * group, group);
}

bool pel_pass_read_bricks(struct pel_occupancy *occupancy, const struct pel_world *world, int size,
                          uint8_t *bricks) {
    bool good = true;
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        size_t dims[3], first = world->bytes.parts[p].cells;
        good = pel_buffer_read(occupancy->cells, first, pel_hierarchy_bricks(world, p, size, dims),
                               bricks + first);
    }
    return good;
}

uint32_t pel_pass_bits(const struct pel_world *world, int size) {
    uint32_t bits = 0;
    while (world->cell_side << bits < size)
        bits++;
    return bits;
}
