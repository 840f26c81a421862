// layout.c - the structs that host and kernels share have the same sizes and offsets on the device.
#include "device/device.h"
#include "shared/recipe.h"
#include "shared/world.h"
#include "support/test.h"

#define AT(type, member)                                                                           \
    { #type "." #member, offsetof(struct type, member) }
#define SIZE(type)                                                                                 \
    { "sizeof " #type, sizeof(struct type) }

// In the order of kernels/describe.cl.
static const struct {
    const char *name;
    size_t value;
} host[] = {
    SIZE(camera),
    AT(camera, eye),
    AT(camera, eye_right),
    AT(camera, eye_up),
    AT(camera, forward),
    AT(camera, right),
    AT(camera, up),
    SIZE(lamp),
    AT(lamp, place),
    AT(lamp, colour),
    AT(lamp, kind),
    SIZE(part),
    AT(part, voxel_from_world),
    AT(part, box_low),
    AT(part, box_high),
    AT(part, memory_from_voxel),
    AT(part, atlas_from_memory),
    AT(part, memory_high),
    AT(part, material),
    AT(part, table_scale),
    AT(part, table_bias),
    AT(part, table_last),
    AT(part, table),
    AT(part, seen_from),
    AT(part, seen_to),
    AT(part, offset),
    AT(part, brick_row),
    AT(part, brick_slice),
    AT(part, buffer),
    AT(part, voxels),
    AT(part, filter),
    AT(part, table_nearest),
    AT(part, cells),
    AT(part, cell_row),
    AT(part, cell_slice),
    AT(part, ranges),
    AT(part, visible),
    AT(part, normal_scale),
    AT(part, spacing_mm),
    AT(part, shading),
    AT(part, one_sided),
    AT(part, surface_values),
    AT(part, surfaces),
    AT(part, surface_count),
    AT(part, model),
    AT(part, step_mm),
    AT(part, density),
    AT(part, number),
    AT(part, rank),
    AT(part, medium),
    AT(part, recipe),
    AT(part, mask_cuts),
    AT(part, mask_part),
    AT(part, mask_count),
    AT(part, mask_range_count),
    AT(part, mask_inverted),
    AT(part, cuts),
    AT(part, plane_count),
    AT(part, box_count),
    AT(part, hole_count),
    AT(part, gradient),
    AT(part, styled),
    AT(part, ramp_count),
    AT(part, variation),
    AT(part, variation_scale),
    AT(part, stride_max),
    AT(part, stride_nought),
    AT(part, silhouette),
    AT(part, ramps),
    SIZE(world),
    AT(world, camera),
    AT(world, second),
    AT(world, bounds_low),
    AT(world, bounds_high),
    AT(world, background),
    AT(world, step_mm),
    AT(world, phase),
    AT(world, termination),
    AT(world, origin_bounds),
    AT(world, width),
    AT(world, height),
    AT(world, tiles_x),
    AT(world, tiles_y),
    AT(world, part_count),
    AT(world, whole_width),
    AT(world, whole_height),
    AT(world, left),
    AT(world, top),
    AT(world, rays_n),
    AT(world, pattern),
    AT(world, reconstruction),
    AT(world, seed),
    AT(world, contrast),
    AT(world, lamp_count),
    AT(world, debug),
    AT(world, medium_count),
    AT(world, weave_x),
    AT(world, weave_y),
    AT(world, pictures),
    AT(world, row_px),
    AT(world, eye_px),
    AT(world, stride_depth),
    AT(world, merge_linear),
    AT(world, merge),
    AT(world, merged_background),
    AT(world, nodes),
    AT(world, shadow_step_mm),
    AT(world, shadow_length_mm),
    AT(world, shadow_strength),
    AT(world, occlusion_step_mm),
    AT(world, occlusion_radius_mm),
    AT(world, occlusion_strength),
    AT(world, occlusion_count),
    AT(world, directions),
    AT(world, lamps),
    AT(world, parts),
    AT(world, cuts),
    SIZE(instruction),
    SIZE(recipe),
    AT(recipe, gradients),
    AT(recipe, grid_start),
    AT(recipe, grid_step),
    AT(recipe, object_scale),
    AT(recipe, object_bias),
    AT(recipe, grid_dims),
    AT(recipe, object_dims),
    AT(recipe, code),
    AT(recipe, permutation),
    AT(recipe, length),
    AT(recipe, seed),
    AT(recipe, time),
    AT(recipe, object_low),
    AT(recipe, object_span),
    AT(recipe, object_offset),
};

enum { COUNT = sizeof host / sizeof *host };

static void test_layout(void **state) {
    (void)state;
    struct pel_device *device = pel_device_open(NULL, 0, &(struct pel_gl){0});
    if (!device)
        fail_msg("%s", pel_error_message());
    struct pel_kernel *kernel =
        pel_kernel_build(device, "describe.cl", "describe", "-cl-std=CL1.2");
    if (!kernel)
        fail_msg("%s", pel_error_message());
    struct pel_buffer *buffer =
        pel_buffer_create(device, COUNT * sizeof(uint32_t), "a description");
    uint32_t values[COUNT] = {0};
    assert_true(pel_kernel_set_buffer(kernel, 0, buffer));
    assert_true(pel_kernel_launch(kernel, 1, 1));
    assert_true(pel_buffer_read(buffer, 0, sizeof values, values));
    for (int i = 0; i < COUNT; i++)
        if (values[i] != host[i].value)
            fail_msg("%s: %zu on the host, %u on the device", host[i].name, host[i].value,
                     values[i]);
    pel_buffer_destroy(buffer);
    pel_kernel_destroy(kernel);
    pel_device_close(device);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_layout)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
