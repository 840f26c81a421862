// world.h - what one frame is made of, as a kernel reads it from constant memory.
//
// Coordinates called `world` here are RAS millimetres relative to the middle of the scene, so that floats
// keep their precision however far from the origin a scanner put its volumes. `memory` coordinates are
// voxel coordinates shifted so that they count from the first stored voxel, border included.
//
//     struct world
//       struct camera [2]      the only part that changes when the camera moves; of both eyes
//       bounds, step ...       one per frame
//       struct lamp lamps[]    what shaded volumes are lit by
//       struct bvh_node nodes[] a hierarchy over the parts' boxes
//       struct part parts[]    one box of voxels each, in the order of the scene's list
#ifndef SHARED_WORLD_H
#define SHARED_WORLD_H

#include "shared/bvh.h"
#include "shared/types.h"
#include "shared/variant.h"

// 32 volumes, and room for the slabs of volumes too large for one buffer.
#define WORLD_PART_MAX 64

// Rows of clip planes and boxes: of 32 volumes, 8 boxes of three rows each and 8 of the scene. And of masks: 32 ranges
// of values for each part, and a matrix between each part and one of its mask's.
#define WORLD_CUT_MAX (32 * 16 * 3 + 32 * WORLD_PART_MAX + 3 * 32 * 32)

// And behind them the directions of ambient occlusion.
#define WORLD_ROW_MAX (WORLD_CUT_MAX + OCCLUSION_MAX)

// The ray of picture-plane coordinates (u, v), in -1..1 upwards and to the right, starts at
// eye + u * eye_right + v * eye_up and runs along forward + u * right + v * up.
struct camera {
    float4 eye, eye_right, eye_up;
    float4 forward, right, up;
};

SHARED_ASSERT(sizeof(struct camera) == 96, camera_size);

struct lamp {
    float4 place;  // of a point; towards a directional one, of length 1
    float4 colour; // times intensity
    i32 kind;      // one of LAMP_*
    i32 pad[3];
};

SHARED_ASSERT(sizeof(struct lamp) == 48, lamp_size);

// A whole volume, or a slab of one: the intersection of the volume's box with first <= z < last.
struct part {
    float4 voxel_from_world[3]; // rows of an affine matrix
    float4 box_low, box_high;   // voxel coordinates
    float4 memory_from_voxel;   // to be added to voxel coordinates
    float4 atlas_from_memory;   // and to memory coordinates, where the part lies in an image
    float4 memory_high;         // memory coordinates end here (and begin at 1/2) for gradients
    float4 material;            // ambient, diffuse, specular, shininess
    float table_scale;          // table entry = raw * table_scale + table_bias
    float table_bias;
    float table_last;           // the last entry's index
    u32 table;                  // index of the table's first word
    u32 offset;                 // element of voxel memory (0,0,0) in its buffer
    i32 brick_row, brick_slice; // bricks from one row and slice of them to the next (shared/brick.h)
    i32 buffer;                 // which voxel buffer
    i32 voxels;                 // one of VOXELS_*
    i32 filter;                 // one of FILTERS_*
    i32 table_nearest;          // 1: round the entry, 0: interpolate between entries
    u32 cells;                  // index of the part's first cell (shared/grid.h)
    i32 cell_row, cell_slice;   // cells from one row and slice of them to the next
    u32 ranges;                 // index of the first cell's range of values
    u32 visible;                // index of the first of the visible entries from each one on
    float normal_scale;         // from a difference over two voxels to ranges of the table per voxel, negative
    float spacing_mm;           // of the nearest voxels
    i32 shading;                // one of SHADING_*
    i32 one_sided;              // 1: light comes only from where the normal points
    float4 surface_values;      // model iso: of its surfaces, raw as samples are, ascending
    float4 surfaces[4];         // their straight colours and opacities
    i32 surface_count;          //
    i32 model;                  // one of MODEL_*
    float step_mm;              // the distance of its samples where it has a grid of its own
    float density;              //
    i32 number;                 // of the part
    float rank;                 // of its priority among the visible instances'
    i32 medium;                 // which of the media that are mixed, or MEDIUM_NONE
    i32 cuts;                   // index of the first of its clips: planes, boxes, cut-away boxes
    i32 plane_count, box_count, hole_count;
    i32 gradient;               // one of GRADIENT_*
    i32 styled;                 // 1: opacity follows the gradient, as the next two say
    i32 ramp_count;             //
    i32 recipe; // 1 + number of what is worked out at every sample; 0: there are voxels
    i32 mask_cuts;  // index of the first of the rows of its mask (kernels/mask.cl)
    i32 mask_part, mask_count; // the parts whose values decide where it is shown; 0: everywhere
    i32 mask_range_count;      // ranges of values that are selected
    i32 mask_inverted;         // 1: shown where none is
    u32 variation;         // index of the first variation of its table (kernels/stride_cells.cl),
    float variation_scale; // of one for each entry of what is this many entries here
    i32 stride_max;        // the longest run of samples that may have one stand for them: 1, 2 or 4
    i32 stride_nought;     // 1: something may appear or change anywhere; variation counts from nothing
    float seen_from, seen_to;   // table entries outside seen_from <= entry < seen_to show nothing
    i32 pad[2];
    float4 silhouette;          // base, strength and exponent; and the factor before all ramps
    float4 ramps[GRADIENT_RAMPS]; // start, 1 / width, in ranges of the table per mm; rise of the factor
};

SHARED_ASSERT(sizeof(struct part) == 480, part_size);

struct world {
    struct camera camera, second; // with EYES_ONE, the second is not looked at
    float4 bounds_low, bounds_high; // of all parts
    float4 background;              // premultiplied
    float step_mm;
    float phase;       // of the first sample, in steps
    float termination; // opacity beyond which a ray ends; above 1: never
    i32 origin_bounds; // 1: samples count from the bounds, 0: from the nearest part
    i32 width, height; // in pixels, of the picture or of the part of it that is rendered
    i32 tiles_x, tiles_y; // tiles in a row and in a column of that (shared/tiles.h)
    i32 part_count;
    i32 whole_width, whole_height; // of the whole picture
    i32 left, top;                 // where the part lies in it
    i32 rays_n;         // supersampling: rays_n x rays_n rays a pixel (shared/pattern.h)
    i32 pattern;        // one of PATTERN_*
    i32 reconstruction; // one of RECONSTRUCTION_*
    u32 seed;           // of all random choices
    float contrast;     // between neighbours, beyond which a pixel takes all its rays; 0: all do
    i32 lamp_count;
    i32 debug; // one of DEBUG_*
    i32 medium_count; // instances that are mixed
    i32 weave_x, weave_y; // EYES_WOVEN: pixels where weave_x * x + weave_y * y is odd are the second eye's
    i32 pictures; // above each other, one of each eye: 1 or 2
    i32 row_px, eye_px; // EYES_BOTH: pixels from one row to the next, and from one picture to the other
    float stride_depth; // how much optical depth a run of samples may vary
    i32 merge_linear; // EYES_MERGED: 1: the matrix acts on linear light, 0: on values as they are stored
    float4 merge[6];  // and its columns: red, green, blue of the first eye, then of the second
    float4 merged_background; // what it makes of two backgrounds
    float shadow_step_mm, shadow_length_mm, shadow_strength;
    float occlusion_step_mm, occlusion_radius_mm, occlusion_strength;
    i32 occlusion_count; // directions,
    i32 directions;      // and the index of the first one's row
    struct bvh_node nodes[2 * WORLD_PART_MAX]; // over the boxes of all parts that are shown, if there are several
    struct lamp lamps[LAMP_MAX];
    struct part parts[WORLD_PART_MAX];
    float4 cuts[WORLD_ROW_MAX]; // only as many as there are reach the device
};

SHARED_ASSERT(sizeof(struct world) ==
                  496 + 48 * LAMP_MAX + (64 + 480) * WORLD_PART_MAX + 16 * WORLD_ROW_MAX,
              world_size);

#endif
