// sample_image.cl - voxels in 3-D images, interpolated by the device.
//
// OpenCL C cannot index an array of images, so the volumes of one class lie side by side in one
// image, an atlas. Each keeps its border of one voxel, which repeats its edge, so that the filter
// never sees a neighbour. Weights have as few as 8 fractional bits in hardware.
// Included by sample.cl.
#ifndef SAMPLE_IMAGE_CL
#define SAMPLE_IMAGE_CL

// The atlases of the classes that occur, with commas between them.
#if VOXELS & VOXELS_U8
#define ATLAS_U8(text) text
#else
#define ATLAS_U8(text)
#endif
#if VOXELS & VOXELS_U16
#define ATLAS_U16(text) text
#else
#define ATLAS_U16(text)
#endif
#if VOXELS & VOXELS_F32
#define ATLAS_F32(text) text
#else
#define ATLAS_F32(text)
#endif
#if VOXELS & VOXELS_RGBA
#define ATLAS_RGBA(text) text
#else
#define ATLAS_RGBA(text)
#endif
#define COMMA ,
#define MEMORY_PARAMETERS                                                                          \
    ATLAS_U8(__read_only image3d_t atlas_u8 COMMA)                                                 \
    ATLAS_U16(__read_only image3d_t atlas_u16 COMMA)                                               \
    ATLAS_F32(__read_only image3d_t atlas_f32 COMMA)                                               \
    ATLAS_RGBA(__read_only image3d_t atlas_rgba COMMA) const int atlas_count
#define MEMORY_ARGUMENTS                                                                           \
    ATLAS_U8(atlas_u8 COMMA) ATLAS_U16(atlas_u16 COMMA) ATLAS_F32(atlas_f32 COMMA)                 \
        ATLAS_RGBA(atlas_rgba COMMA) atlas_count

__constant sampler_t filter =
    CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP_TO_EDGE |
    (FILTERS & (FILTERS_LINEAR | FILTERS_CUBIC_B_SPLINE) ? CLK_FILTER_LINEAR : CLK_FILTER_NEAREST);

INLINE float4 read_atlas(MEMORY_PARAMETERS, __constant struct part *part, bool nearest, float x,
                         float y, float z) {
    // Texel centres lie at halves, and there a linear filter reads one texel.
    float4 at = (float4)(x, y, z, 0.0f) + part->atlas_from_memory;
    if (nearest)
        at = floor(at + 0.5f);
    at += 0.5f;
#if VOXELS & VOXELS_U8
    if (IS_CLASS(part, VOXELS_U8))
        return read_imagef(atlas_u8, filter, at);
#endif
#if VOXELS & VOXELS_U16
    if (IS_CLASS(part, VOXELS_U16))
        return read_imagef(atlas_u16, filter, at);
#endif
#if VOXELS & VOXELS_F32
    if (IS_CLASS(part, VOXELS_F32))
        // An absent voxel (NaN) makes absent what it is interpolated with, at weight 0, too.
        return nearest ? read_imagef(atlas_f32, convert_int4(at)) : read_imagef(atlas_f32, filter, at);
#endif
#if VOXELS & VOXELS_RGBA
    if (IS_CLASS(part, VOXELS_RGBA))
        return read_imagef(atlas_rgba, filter, at);
#endif
    return (float4)(0.0f);
}

INLINE struct sample fetch_part(MEMORY_PARAMETERS, __constant struct part *part, bool nearest,
                                real x, real y, real z) {
    struct sample s;
    float4 texels[LANES];
#if LANES == 1
    texels[0] = read_atlas(MEMORY_ARGUMENTS, part, nearest, x, y, z);
#else
    float xs[LANES], ys[LANES], zs[LANES];
    STORE_LANES(x, xs);
    STORE_LANES(y, ys);
    STORE_LANES(z, zs);
    for (int lane = 0; lane < LANES; lane++)
        texels[lane] = read_atlas(MEMORY_ARGUMENTS, part, nearest, xs[lane], ys[lane], zs[lane]);
#endif
#define RED(lane) texels[lane].x
#define GREEN(lane) texels[lane].y
#define BLUE(lane) texels[lane].z
#define ALPHA(lane) texels[lane].w
#if VOXELS & VOXELS_RGBA
    s.r = ALL_LANES(RED);
    s.g = ALL_LANES(GREEN);
    s.b = ALL_LANES(BLUE);
    s.raw = IS_CLASS(part, VOXELS_RGBA) ? ALL_LANES(ALPHA) : s.r;
#else
    s.raw = ALL_LANES(RED);
#endif
    return s;
}

#endif
