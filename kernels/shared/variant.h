// variant.h - the numbers behind a kernel variant's names, the same for host and kernels.
#ifndef SHARED_VARIANT_H
#define SHARED_VARIANT_H

// READER: where voxels are read from.
#define READER_BUFFER 0 // plain memory and our own interpolation
#define READER_IMAGE 1  // 3-D images and the device's filter

// MIXING: how volumes that overlap share a sample (docs/picture.md).
#define MIXING_OVER 0
#define MIXING_SUM 1
#define MIXING_ORDERED 2
#define MIXING_MAX 3
#define MIXING_PRIORITY 4
#define MIXING_UNION 5
#define MIXING_INTERSECTION 6
#define MIXING_DIFFERENCE 7

// Of a part that is not mixed with others: its model is none of absorption.
#define MEDIUM_NONE (-1)

// VOXELS: which classes of voxels occur, one bit each. Signed integers are stored with their sign
// bit flipped, as unsigned ones; RGB is stored as RGBA with the luminance as alpha.
#define VOXELS_U8 1
#define VOXELS_U16 2
#define VOXELS_F32 4
#define VOXELS_RGBA 8
#define VOXEL_CLASS_COUNT 4

// FILTERS: which filters occur, one bit each.
#define FILTERS_LINEAR 1
#define FILTERS_NEAREST 2
#define FILTERS_CUBIC_B_SPLINE 4
#define FILTERS_CATMULL_ROM 8
#define FILTERS_CUBIC (FILTERS_CUBIC_B_SPLINE | FILTERS_CATMULL_ROM)

// SKIP: how empty space is skipped.
#define SKIP_NONE 0     // not at all
#define SKIP_GRID 1     // cell by cell
#define SKIP_DISTANCE 2 // by the distance to the nearest cell with something in it
#define SKIP_OCTREE 3   // by the nodes of an octree
#define SKIP_BVH 4      // by a hierarchy over clusters of bricks
#define SKIP_BLOCKS 5   // from block to block, and by the sub-blocks in them

// Of a part: how light is gathered in it (docs/picture.md, "Optical models").
#define MODEL_ABSORPTION 0
#define MODEL_PREINTEGRATED 1 // absorption between samples, from a table of pairs of values
#define MODEL_EMISSION 2
#define MODEL_MIP 3
#define MODEL_MINIP 4
#define MODEL_AVERAGE 5
#define MODEL_ISO 6
#define MODEL_THESIS 7

// Values along each side of a preintegrated part's table.
#define PAIR_ENTRIES 256

// MODELS: what else than absorption, gathered front to back, occurs, one bit each.
#define MODELS_THESIS 1
#define MODELS_ISO 2
#define MODELS_PROJECTION 4 // mip, minip and average
#define MODELS_PREINTEGRATED 8
#define MODELS_BACKWARD 16 // the last sample of a ray comes first
#define MODELS_EMISSION 32 // and nothing else: the exact integrator

// Of a part: how it is shaded. The knob SHADING is 1 when any part is.
#define SHADING_NONE 0
#define SHADING_BLINN_PHONG 1
#define SHADING_PHONG 2

// SECONDARY: which rays go on from the samples that are shaded, one bit each.
#define SECONDARY_SHADOWS 1   // to each lamp
#define SECONDARY_OCCLUSION 2 // around the normal
#define OCCLUSION_MAX 64      // of these

// Of a part: how its gradient is found. The knob STYLE is 1 when some part has another than central
// differences, or opacity that follows the gradient.
#define GRADIENT_CENTRAL 0
#define GRADIENT_SOBEL 1
#define GRADIENT_ANALYTIC 2

// Ramps that opacity follows with the gradient.
#define GRADIENT_RAMPS 3

// The gradient, in ranges of the table per voxel, at which a normal has half its squared length: so
// small a one in floats has no direction to be trusted.
#define SHADE_SOFTNESS 0x1p-16f

// Of a lamp: where its light comes from.
#define LAMP_HEADLIGHT 0   // the viewer, along each ray
#define LAMP_DIRECTIONAL 1 // one direction
#define LAMP_POINT 2       // one place
#define LAMP_MAX 8

// EYES: whose rays the picture's are.
#define EYES_ONE 1
#define EYES_BOTH 2  // two pictures, the second eye's behind the first one's; their tiles take turns
#define EYES_WOVEN 3 // one picture, whose pixels are one eye's or the other's
#define EYES_DEPTH 4 // one picture, and behind it how far away what each pixel shows is
#define EYES_MERGED 5 // one picture, each pixel a colour made of both eyes' (kernels/glasses.cl)

// What a debug view shows of each ray (kernels/debug.cl). The knob DEBUG is 1 when the device
// counts.
#define DEBUG_NONE 0
#define DEBUG_SAMPLES 1    // samples taken
#define DEBUG_SPANS 2      // spans with a constant set of parts
#define DEBUG_PARTS 3      // parts crossed: depth complexity
#define DEBUG_WORK_GROUP 4 // which work-group made the pixel
#define DEBUG_WORK_ITEM 5  // which work-item of its group
#define DEBUG_TIME 6       // milliseconds of the pixel's tile, by the host's clock
#define DEBUG_CLUSTERS 7   // leaves of a hierarchy crossed: clusters of bricks, or blocks
#define DEBUG_NODES 8      // nodes of it crossed

// What each packet counts of its rays' samples.
#define SAMPLES_TAKEN 0
#define SAMPLES_POSSIBLE 1 // all those inside a part
#define SAMPLES_BEHIND 2   // of these, those behind the end of a ray that ended early
#define SAMPLES_SPARED 3   // and those that others stand for, in longer strides
#define PARTS_ENTERED 4    // and parts that the packet came to
#define SAMPLE_COUNTS 5

// Voxels are bound as this many buffers, so that a quarter of the device's memory each, which
// OpenCL guarantees, is all of it.
#define VOXEL_BUFFERS 4

#endif
