// shading.c - shaded pictures against the reference: reader x lanes, and among them every voxel
// type, both filters, models, kinds of mixing and sides, and all kinds of light; slabs; and that
// what is wrong is refused.
#include <math.h>

#include "base/math.h"
#include "shared/brick.h"
#include "support/judge.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

enum { TYPES = PEL_VOXEL_RGBA8 + 1, CHOICES = TYPES * 4 };

static void add_lights(struct pel_scene *scene) {
    scene->light_count = 4;
    scene->lights[0] = (struct pel_light){.colour = {0.3, 0.3, 0.3}, .intensity = 1};
    scene->lights[1] =
        (struct pel_light){.kind = PEL_LIGHT_CAMERA, .colour = {0, 0.4, 0.2}, .intensity = 0.5};
    scene->lights[2] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                          .direction = {3, -1, -2},
                                          .colour = {0.1, 0.2, 0.7},
                                          .intensity = 1};
    scene->lights[3] = (struct pel_light){.kind = PEL_LIGHT_POINT,
                                          .position = {-15, 22, 30},
                                          .colour = {0.7, 0.4, 0.1},
                                          .intensity = 1};
}

// Two instances of one anisotropic, oblique and mirrored volume: both shaded, each its own way, or
// only one of them.
static struct pel_scene *scene_of(int n) {
    bool small = scene_is_small();
    enum pel_voxel_type type = (enum pel_voxel_type)(n / 4);
    struct pel_scene *scene = scene_create(small ? 8 : 40, small ? 6 : 30);
    scene->render.mixing = n & 1 ? PEL_MIX_OVER : PEL_MIX_SUM;
    scene->render.step = small ? 2 : 1;
    if (n % 3 != 0)
        add_lights(scene);

    int dims[3] = {17, 22, 19};
    struct pel_volume *volume = scene_volume_waves(dims, type, 11, 12);
    scene_place(volume, (double[]){1, 1.2, 1.1}, (double[]){0.31, -0.42, 0.17, 0.83},
                (double[]){-1.3, 2.1, 0.7}, true);
    // Absent voxels here and there.
    for (size_t i = 0; type == PEL_VOXEL_F32 && i < pel_volume_voxel_count(volume); i += 389)
        ((float *)volume->voxels)[i] = NAN;
    if (type == PEL_VOXEL_I16) {
        volume->slope = -0.25;
        volume->intercept = 100;
    }
    double raw[2];
    scene_raw_range(type, raw);
    double ends[2] = {volume->slope * raw[0] + volume->intercept,
                      volume->slope * raw[1] + volume->intercept};
    double range[2] = {fmin(ends[0], ends[1]), fmax(ends[0], ends[1])};
    struct pel_instance *first = scene_add(scene, volume, scene_transfer_gentle(range, 0.08, 21));
    struct pel_instance *second = scene_add_again(scene, 0, scene_transfer_gentle(range, 0.15, 22));
    second->transform =
        pel_matrix_from_quaternion((double[]){0.7, 0.2, -0.3, 0.6}, (double[]){3.3, -2.7, 1.9});
    first->filter = second->filter = n & 2 ? PEL_FILTER_NEAREST : PEL_FILTER_LINEAR;
    first->material =
        (struct pel_material){.shading = n & 1 ? PEL_SHADING_BLINN_PHONG : PEL_SHADING_PHONG,
                              .one_sided = n % 5 == 0,
                              .ambient = 0.2,
                              .diffuse = 0.6,
                              .specular = 0.4,
                              .shininess = n % 2 ? 5 : 7.3};
    // All zero: the usual material.
    second->material.shading = n % 7 == 0 ? PEL_SHADING_NONE : PEL_SHADING_BLINN_PHONG;
    return scene;
}

// Every `stride`th scene, through one variant.
static void check_variant(enum pel_reader reader, int lanes, int start, int stride) {
    struct pel_renderer *renderer = judge_renderer(reader, lanes);
    for (int n = start; n < CHOICES; n += stride) {
        struct pel_scene *scene = scene_of(n);
        char title[64];
        snprintf(title, sizeof title, "%s x %d: shaded scene %d",
                 reader == PEL_READER_IMAGE ? "image" : "buffer", lanes, n);
        if (reader == PEL_READER_BUFFER || judge_has_images(renderer, scene))
            pel_image_destroy(judge_render(renderer, scene, NULL, title));
        pel_scene_destroy(scene);
    }
    pel_renderer_destroy(renderer);
}

// Every variant of the reader sees another few of the scenes: building kernels takes the time here.
// A compiler to which wide packets are a burden sees one scene in one of four.
static void test_variants(void **state) {
    (void)state;
    check_variant(PEL_READER_BUFFER, 1, 1, 14);
    check_variant(PEL_READER_IMAGE, 1, 5, 12);
    check_variant(PEL_READER_BUFFER, 4, 18, 14);
    if (judge_packet_lanes() < 8)
        return;
    check_variant(PEL_READER_BUFFER, 8, 8, 24);
    check_variant(PEL_READER_BUFFER, 16, 24, 24);
    check_variant(PEL_READER_IMAGE, 4, 21, 24);
}

// A volume in slabs has the gradients of a whole one, also where it is cut: in bricks with a
// border, and without one where there is no room for it.
static void test_slabs(void **state) {
    (void)state;
    struct pel_scene *scene = scene_tall(16, 24);
    scene->instances[0].material.shading = PEL_SHADING_BLINN_PHONG;
    for (int border = 0; border <= 1; border++) {
        const struct pel_renderer_options options = {.reader = PEL_READER_BUFFER,
                                                     .max_allocation_bytes =
                                                         2 * BRICK_VOXELS_OF((uint64_t)border)};
        struct pel_renderer *renderer = pel_renderer_create(&options);
        assert_non_null(renderer);
        pel_image_destroy(judge_render(renderer, scene, NULL, border ? "border" : "slabs"));
        pel_renderer_destroy(renderer);
    }
    pel_scene_destroy(scene);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(1);
    scene->lights[2].direction[0] = scene->lights[2].direction[1] = 0;
    scene->lights[2].direction[2] = 0;
    render_refused(renderer, scene, "light 2: the direction 0 0 0 has no length");
    scene->lights[2].direction[2] = 1;
    scene->lights[3].intensity = -1;
    render_refused(renderer, scene, "light 3: colour times intensity is -0.7, outside 0..1000");
    scene->light_count = 9;
    render_refused(renderer, scene, "9 lights, outside 0..8");
    scene->light_count = 0;
    scene->instances[0].material.shininess = 0.5;
    render_refused(renderer, scene, "shininess 0.5, outside 1..1000");
    scene->instances[0].material.diffuse = NAN;
    render_refused(renderer, scene, "diffuse nan");
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_variants),
        cmocka_unit_test(test_slabs),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
