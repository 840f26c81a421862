// present.cl - a picture as a window shows it: 8 bits a channel, rounded as they are in a file.

// The nearest of 256 levels, halves upwards, and 0 for NaN. The product with 255 is rounded and may
// lead to the level beside; the sign of a fused one is exact, and tells.
static inline uchar4 quantise(float4 value) {
    const float4 share = fmin(fmax(value, 0.0f), 1.0f);
    float4 level = floor(share * 255.0f + 0.5f);
    level += convert_float4(fma(share, (float4)(255.0f), 0.5f - level) < 0.0f);
    level -= convert_float4(fma(share, (float4)(255.0f), -0.5f - level) >= 0.0f);
    return convert_uchar4(level);
}

// Pixel `corner` of a picture whose rows have `row` pixels is the first of `width` x `height` that
// are wanted.
__kernel void present(__global const float4 *picture, __global uchar4 *pixels, const uint width, const uint height,
                      const uint row, const uint corner) {
    const uint pixel = (uint)get_global_id(0);
    if (pixel < width * height)
        pixels[pixel] = quantise(picture[corner + pixel / width * row + pixel % width]);
}
