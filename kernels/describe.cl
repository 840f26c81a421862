// describe.cl - the device's own idea of the structs it shares with the host, for the test that
// compares the two.
#include "shared/recipe.h"
#include "shared/world.h"

#define OFFSET(type, member) ((uint)((__private char *)&((type *)&space)->member - (__private char *)&space))

// The same for a recipe, after the world's.
void describe_recipe(__global uint *out) {
    struct recipe space;
    *out++ = sizeof(struct instruction);
    *out++ = sizeof(struct recipe);
    *out++ = OFFSET(struct recipe, gradients);
    *out++ = OFFSET(struct recipe, grid_start);
    *out++ = OFFSET(struct recipe, grid_step);
    *out++ = OFFSET(struct recipe, object_scale);
    *out++ = OFFSET(struct recipe, object_bias);
    *out++ = OFFSET(struct recipe, grid_dims);
    *out++ = OFFSET(struct recipe, object_dims);
    *out++ = OFFSET(struct recipe, code);
    *out++ = OFFSET(struct recipe, permutation);
    *out++ = OFFSET(struct recipe, length);
    *out++ = OFFSET(struct recipe, seed);
    *out++ = OFFSET(struct recipe, time);
    *out++ = OFFSET(struct recipe, object_low);
    *out++ = OFFSET(struct recipe, object_span);
    *out++ = OFFSET(struct recipe, object_offset);
}

// Writes the sizes and offsets in the order in which tests/kernel/layout.c lists them.
__kernel void describe(__global uint *out) {
    struct world space;
    *out++ = sizeof(struct camera);
    *out++ = OFFSET(struct camera, eye);
    *out++ = OFFSET(struct camera, eye_right);
    *out++ = OFFSET(struct camera, eye_up);
    *out++ = OFFSET(struct camera, forward);
    *out++ = OFFSET(struct camera, right);
    *out++ = OFFSET(struct camera, up);
    *out++ = sizeof(struct lamp);
    *out++ = OFFSET(struct lamp, place);
    *out++ = OFFSET(struct lamp, colour);
    *out++ = OFFSET(struct lamp, kind);
    *out++ = sizeof(struct part);
    *out++ = OFFSET(struct part, voxel_from_world);
    *out++ = OFFSET(struct part, box_low);
    *out++ = OFFSET(struct part, box_high);
    *out++ = OFFSET(struct part, memory_from_voxel);
    *out++ = OFFSET(struct part, atlas_from_memory);
    *out++ = OFFSET(struct part, memory_high);
    *out++ = OFFSET(struct part, material);
    *out++ = OFFSET(struct part, table_scale);
    *out++ = OFFSET(struct part, table_bias);
    *out++ = OFFSET(struct part, table_last);
    *out++ = OFFSET(struct part, table);
    *out++ = OFFSET(struct part, offset);
    *out++ = OFFSET(struct part, brick_row);
    *out++ = OFFSET(struct part, brick_slice);
    *out++ = OFFSET(struct part, buffer);
    *out++ = OFFSET(struct part, voxels);
    *out++ = OFFSET(struct part, filter);
    *out++ = OFFSET(struct part, table_nearest);
    *out++ = OFFSET(struct part, cells);
    *out++ = OFFSET(struct part, cell_row);
    *out++ = OFFSET(struct part, cell_slice);
    *out++ = OFFSET(struct part, ranges);
    *out++ = OFFSET(struct part, visible);
    *out++ = OFFSET(struct part, normal_scale);
    *out++ = OFFSET(struct part, spacing_mm);
    *out++ = OFFSET(struct part, shading);
    *out++ = OFFSET(struct part, one_sided);
    *out++ = OFFSET(struct part, surface_values);
    *out++ = OFFSET(struct part, surfaces);
    *out++ = OFFSET(struct part, surface_count);
    *out++ = OFFSET(struct part, model);
    *out++ = OFFSET(struct part, step_mm);
    *out++ = OFFSET(struct part, density);
    *out++ = OFFSET(struct part, number);
    *out++ = OFFSET(struct part, rank);
    *out++ = OFFSET(struct part, medium);
    *out++ = OFFSET(struct part, recipe);
    *out++ = OFFSET(struct part, mask_cuts);
    *out++ = OFFSET(struct part, mask_part);
    *out++ = OFFSET(struct part, mask_count);
    *out++ = OFFSET(struct part, mask_range_count);
    *out++ = OFFSET(struct part, mask_inverted);
    *out++ = OFFSET(struct part, cuts);
    *out++ = OFFSET(struct part, plane_count);
    *out++ = OFFSET(struct part, box_count);
    *out++ = OFFSET(struct part, hole_count);
    *out++ = OFFSET(struct part, gradient);
    *out++ = OFFSET(struct part, styled);
    *out++ = OFFSET(struct part, ramp_count);
    *out++ = OFFSET(struct part, variation);
    *out++ = OFFSET(struct part, variation_scale);
    *out++ = OFFSET(struct part, stride_max);
    *out++ = OFFSET(struct part, stride_nought);
    *out++ = OFFSET(struct part, silhouette);
    *out++ = OFFSET(struct part, ramps);
    *out++ = sizeof(struct world);
    *out++ = OFFSET(struct world, camera);
    *out++ = OFFSET(struct world, second);
    *out++ = OFFSET(struct world, bounds_low);
    *out++ = OFFSET(struct world, bounds_high);
    *out++ = OFFSET(struct world, background);
    *out++ = OFFSET(struct world, step_mm);
    *out++ = OFFSET(struct world, phase);
    *out++ = OFFSET(struct world, termination);
    *out++ = OFFSET(struct world, origin_bounds);
    *out++ = OFFSET(struct world, width);
    *out++ = OFFSET(struct world, height);
    *out++ = OFFSET(struct world, tiles_x);
    *out++ = OFFSET(struct world, tiles_y);
    *out++ = OFFSET(struct world, part_count);
    *out++ = OFFSET(struct world, whole_width);
    *out++ = OFFSET(struct world, whole_height);
    *out++ = OFFSET(struct world, left);
    *out++ = OFFSET(struct world, top);
    *out++ = OFFSET(struct world, rays_n);
    *out++ = OFFSET(struct world, pattern);
    *out++ = OFFSET(struct world, reconstruction);
    *out++ = OFFSET(struct world, seed);
    *out++ = OFFSET(struct world, contrast);
    *out++ = OFFSET(struct world, lamp_count);
    *out++ = OFFSET(struct world, debug);
    *out++ = OFFSET(struct world, medium_count);
    *out++ = OFFSET(struct world, weave_x);
    *out++ = OFFSET(struct world, weave_y);
    *out++ = OFFSET(struct world, pictures);
    *out++ = OFFSET(struct world, row_px);
    *out++ = OFFSET(struct world, eye_px);
    *out++ = OFFSET(struct world, stride_depth);
    *out++ = OFFSET(struct world, merge_linear);
    *out++ = OFFSET(struct world, merge);
    *out++ = OFFSET(struct world, merged_background);
    *out++ = OFFSET(struct world, nodes);
    *out++ = OFFSET(struct world, shadow_step_mm);
    *out++ = OFFSET(struct world, shadow_length_mm);
    *out++ = OFFSET(struct world, shadow_strength);
    *out++ = OFFSET(struct world, occlusion_step_mm);
    *out++ = OFFSET(struct world, occlusion_radius_mm);
    *out++ = OFFSET(struct world, occlusion_strength);
    *out++ = OFFSET(struct world, occlusion_count);
    *out++ = OFFSET(struct world, directions);
    *out++ = OFFSET(struct world, lamps);
    *out++ = OFFSET(struct world, parts);
    *out++ = OFFSET(struct world, cuts);
    describe_recipe(out);
}
