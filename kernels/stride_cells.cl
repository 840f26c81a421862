// stride_cells.cl - how long a run of samples may be that begins or ends in a cell
// (docs/picture.md, "Adaptive steps").
//
// The transfer function's variation up to each entry of its table, summed up on the host, tells
// with two look-ups how much it can change over the values of a cell.
// Included by occupancy.cl.
#ifndef STRIDE_CELLS_CL
#define STRIDE_CELLS_CL

// Values that are whole entries are so to rounding.
#define STRIDE_SLACK 0x1p-10f

// The longest run that may begin in cell i of a part. `visible` has the variations as pairs: of all
// entries up to one, and of that one from nothing.
static uchar find_stride(__constant struct world *world, __constant struct part *part,
                         __global const float2 *ranges, __global const uint *visible,
                         struct cell_dims dims, int i) {
    if (part->stride_max == 1)
        return 1;
    const float2 range = reachable(part, ranges + part->ranges, dims, i);
    if (range.x > range.y)
        return (uchar)part->stride_max;
    const float a = range.x * part->table_scale + part->table_bias;
    const float b = range.y * part->table_scale + part->table_bias;
    const float low = clamp(fmin(a, b), 0.0f, part->table_last) * part->variation_scale,
                high = clamp(fmax(a, b), 0.0f, part->table_last) * part->variation_scale;
    const int first = (int)floor(low + STRIDE_SLACK), last = (int)ceil(high - STRIDE_SLACK);
    __global const uint *words = visible + part->variation;
    float variation = as_float(words[2 * last]) - as_float(words[2 * first]);
    if (part->stride_nought)
        variation += as_float(words[2 * first + 1]);
    int stride = part->stride_max;
    while (stride > 1 && variation * (float)stride > world->stride_depth)
        stride /= 2;
    return (uchar)stride;
}

#endif
