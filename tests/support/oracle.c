// oracle.c - the scenes of which other systems made pictures, in our terms.
//
// The conventions are those that the README beside the pictures gives for each system, but for
// one: CUDA's picture was made by an early version of the sample, which marched from the far end of
// the box to the near one. Its samples lie at t_far - 0.01 i and no ray ends early. This was found
// from the picture: so all of it agrees within 2 of 255, and otherwise thousands of pixels where
// rays are short do not.
#include "support/oracle.h"

#include <math.h>

#include <jansson.h>
#include <zlib.h>

#include "base/math.h"
#include "reference/ray.h"
#include "support/picture.h"
#include "support/scenes.h"

#define FOLDER "oracle/"

// Surfaces of T2 are a voxel wide: where a ray just misses one or stops before one, correct
// renderers differ more.
const struct oracle_picture oracle_pictures[] = {
    {FOLDER "openvkl_T1_s0_n1_640x480.png", ORACLE_OPENVKL, FOLDER "tf_T1.f32", 1, 2, 0, 0, false},
    {FOLDER "openvkl_T2_s0_n1_640x480.png", ORACLE_OPENVKL, FOLDER "tf_T2.f32", 1, 2, 20, 10,
     false},
    {FOLDER "openvkl_T3_s0_n1_640x480.png", ORACLE_OPENVKL, FOLDER "tf_T3.f32", 1, 2, 0, 0, false},
    {FOLDER "openvkl_T2_s0_n4_640x480.png", ORACLE_OPENVKL, FOLDER "tf_T2.f32", 4, 2, 20, 10,
     false},
    {FOLDER "openvkl_T3_s0_n4_640x480.png", ORACLE_OPENVKL, FOLDER "tf_T3.f32", 4, 2, 0, 0, false},
    {FOLDER "vtkgpu_f32vol_T1_s0_n1_640x480.png", ORACLE_VTK, FOLDER "tf_T1.f32", 1, 2, 0, 0,
     false},
    {FOLDER "vtkgpu_f32vol_T2_s0_n1_640x480.png", ORACLE_VTK, FOLDER "tf_T2.f32", 1, 2, 0, 0,
     false},
    {FOLDER "vtkgpu_f32vol_T3_s0_n1_640x480.png", ORACLE_VTK, FOLDER "tf_T3.f32", 1, 2, 0, 0,
     false},
    {FOLDER "vtkgpu_f32vol_T1_s1_n1_640x480.png", ORACLE_VTK, FOLDER "tf_T1.f32", 1, 2, 0, 0, true},
    {FOLDER "vtkgpu_f32vol_T2_s1_n1_640x480.png", ORACLE_VTK, FOLDER "tf_T2.f32", 1, 2, 0, 0, true},
    {FOLDER "vtkgpu_f32vol_T3_s1_n1_640x480.png", ORACLE_VTK, FOLDER "tf_T3.f32", 1, 2, 0, 0, true},
    {FOLDER "vtkgpu_f32vol_T1_s0_n4_640x480.png", ORACLE_VTK, FOLDER "tf_T1.f32", 4, 4, 0, 0,
     false},
    {FOLDER "vtkgpu_f32vol_T2_s0_n4_640x480.png", ORACLE_VTK, FOLDER "tf_T2.f32", 4, 4, 0, 0,
     false},
    {FOLDER "vtkgpu_f32vol_T3_s0_n4_640x480.png", ORACLE_VTK, FOLDER "tf_T3.f32", 4, 4, 0, 0,
     false},
    {FOLDER "cuda_samples_bucky_ref_512.png", ORACLE_CUDA, NULL, 1, 2, 0, 0, false},
    {0},
};

// Reads exactly `bytes`, unpacking what is packed.
static void read_bytes(void *memory, size_t bytes, const char *relative) {
    gzFile file = gzopen(test_data_path(relative), "rb");
    if (!file || gzread(file, memory, (unsigned)bytes) != (int)bytes)
        fail_msg("%s: not %zu bytes", relative, bytes);
    gzclose(file);
}

static struct pel_volume *read_volume(const char *relative, int size) {
    struct pel_volume *volume =
        pel_volume_create(relative, (int[]){size, size, size}, PEL_VOXEL_U8);
    assert_non_null(volume);
    read_bytes(volume->voxels, pel_volume_bytes(volume), relative);
    return volume;
}

// OpenVKL looks up the nearest of 256 entries, which are our table's own.
static struct pel_transfer *openvkl_transfer(const float (*entries)[4]) {
    double points[256][5];
    for (int i = 0; i < 256; i++) {
        points[i][0] = i;
        for (int c = 0; c < 4; c++)
            points[i][1 + c] = entries[i][c];
    }
    struct pel_transfer *transfer = scene_transfer((const double(*)[5])points, 256);
    transfer->nearest = true;
    return transfer;
}

// VTK resamples the 256 entries to the 1024 texels of a texture over [0, 255], which it filters
// linearly between their centres. Every second entry of a table of 2049 is a texel's centre.
static struct pel_transfer *vtk_transfer(const float (*entries)[4]) {
    double points[1024][5];
    for (int j = 0; j < 1024; j++) {
        double u = j * 255 / 1023.0;
        int i = j < 1023 ? (int)u : 254;
        points[j][0] = (j + 0.5) * 255 / 1024;
        for (int c = 0; c < 4; c++)
            points[j][1 + c] = entries[i][c] + (u - i) * (entries[i + 1][c] - entries[i][c]);
    }
    struct pel_transfer *transfer = scene_transfer((const double(*)[5])points, 1024);
    transfer->table_entries = 2049;
    return transfer;
}

// Nine texels of full colours, alpha times 0.05 for each sample of 0.01. Every second entry of a
// table of 19 is a texel's centre.
static struct pel_transfer *cuda_transfer(void) {
    static const double colours[9][4] = {{0, 0, 0, 0}, {1, 0, 0, 1}, {1, 0.5, 0, 1},
                                         {1, 1, 0, 1}, {0, 1, 0, 1}, {0, 1, 1, 1},
                                         {0, 0, 1, 1}, {1, 0, 1, 1}, {0, 0, 0, 0}};
    double points[9][5];
    for (int i = 0; i < 9; i++) {
        points[i][0] = 255 * (i + 0.5) / 9;
        for (int c = 0; c < 3; c++)
            points[i][1 + c] = colours[i][c];
        points[i][4] = 0.05 * colours[i][3];
    }
    struct pel_transfer *transfer = scene_transfer((const double(*)[5])points, 9);
    transfer->opacity_unit_mm = 0.01;
    transfer->table_entries = 19;
    return transfer;
}

static void read_camera(struct pel_camera *camera) {
    json_error_t error;
    json_t *json = json_load_file(test_data_path(FOLDER "camera.json"), 0, &error);
    if (!json)
        fail_msg("camera.json: %s", error.text);
    *camera = (struct pel_camera){0};
    int status =
        json_unpack_ex(json, &error, 0, "{s:[FFF], s:[FFF], s:[FFF], s:F}", "eye", &camera->eye[0],
                       &camera->eye[1], &camera->eye[2], "center", &camera->target[0],
                       &camera->target[1], &camera->target[2], "up", &camera->up[0], &camera->up[1],
                       &camera->up[2], "fovy_deg", &camera->fov_deg);
    if (status != 0)
        fail_msg("camera.json: %s", error.text);
    json_decref(json);
}

// One millimetre is one voxel, and voxel (0, 0, 0) lies at the origin.
static struct pel_scene *task_scene(const struct oracle_picture *picture) {
    struct pel_scene *scene = scene_create(640, 480);
    read_camera(&scene->camera);
    bool vtk = picture->system == ORACLE_VTK;
    scene->render.mixing = PEL_MIX_OVER;
    scene->render.phase = vtk ? 1 : 0.5;
    scene->render.origin = vtk ? PEL_ORIGIN_BOUNDS : PEL_ORIGIN_VOLUMES;
    scene->render.termination = vtk ? 1 - 1 / 255.0 : 0.95;

    float entries[256][4];
    read_bytes(entries, sizeof entries, picture->transfer);
    for (int k = 0; k < picture->copies; k++) {
        struct pel_transfer *transfer = vtk ? vtk_transfer((const float(*)[4])entries)
                                            : openvkl_transfer((const float(*)[4])entries);
        struct pel_instance *instance =
            k == 0 ? scene_add(scene, read_volume(FOLDER "task256.raw.gz", 256), transfer)
                   : scene_add_again(scene, 0, transfer);
        instance->extent = PEL_EXTENT_POINT;
        // VTK's default light shines along each ray.
        if (picture->shaded)
            instance->material = pel_material_default(PEL_SHADING_BLINN_PHONG);

        // Copy k is turned by 15 k degrees about the y axis through the middle.
        double half_angle = 15 * k * PEL_PI / 360, middle[3] = {127.5, 127.5, 127.5}, turned[3];
        double xyzw[4] = {0, sin(half_angle), 0, cos(half_angle)};
        struct pel_matrix turn = pel_matrix_from_quaternion(xyzw, (double[]){0, 0, 0});
        pel_matrix_point(turned, &turn, middle);
        for (int c = 0; c < 3; c++)
            turn.m[c][3] = middle[c] - turned[c];
        instance->transform = turn;
    }
    return scene;
}

// The box [-1, 1]^3 from (0, 0, 4). Rays go through the pixels' corners at y counted from below:
// the lower left one is half a pixel to the left of and below its centre.
static struct pel_scene *cuda_scene(void) {
    struct pel_scene *scene = scene_create(512, 512);
    scene->camera = (struct pel_camera){
        .eye = {0, 0, 4},
        .up = {0, 1, 0},
        .fov_deg = 2 * atan(0.5) * 180 / PEL_PI,
        .shift = {-0.5 / 512, -0.5 / 512},
    };
    struct pel_volume *volume = read_volume("data/bucky32/Bucky.raw", 32);
    scene_place(volume, (double[]){2 / 32.0, 2 / 32.0, 2 / 32.0}, (double[]){0, 0, 0, 1},
                (double[]){0, 0, 0}, false);
    scene_add(scene, volume, cuda_transfer());
    scene->render.step = 0.01 / (2 / 32.0);
    scene->render.phase = 0;
    return scene;
}

int oracle_run(const char *name, CMUnitTestFunction test) {
    test_need_data(FOLDER "camera.json");
    test_need_data("data/bucky32/Bucky.raw");
    struct CMUnitTest tests[sizeof oracle_pictures / sizeof *oracle_pictures];
    size_t count = 0;
    for (const struct oracle_picture *picture = oracle_pictures; picture->file; picture++)
        tests[count++] = (struct CMUnitTest){
            .name = picture->file, .test_func = test, .initial_state = (void *)picture};
    return _cmocka_run_group_tests(name, tests, count, NULL, NULL);
}

struct pel_scene *oracle_scene(const struct oracle_picture *picture) {
    struct pel_scene *scene = picture->system == ORACLE_CUDA ? cuda_scene() : task_scene(picture);
    scene->background[3] = 1;
    return scene;
}

struct pel_image *oracle_read(const struct oracle_picture *picture) {
    struct pel_image *image = picture_read_png(test_data_path(picture->file));
    if (picture->system != ORACLE_CUDA)
        return image;
    // The first row of CUDA's picture is its lowest.
    size_t row = 4 * (size_t)image->width;
    for (int y = 0; y < image->height / 2; y++) {
        float *upper = image->rgba + (size_t)y * row;
        float *lower = image->rgba + (size_t)(image->height - 1 - y) * row;
        for (size_t i = 0; i < row; i++) {
            float swapped = upper[i];
            upper[i] = lower[i];
            lower[i] = swapped;
        }
    }
    return image;
}

double oracle_stored(const struct oracle_picture *picture, double channel) {
    double clamped = 255 * fmin(fmax(channel, 0), 1);
    // CUDA's sample cuts off what others round.
    return floor(picture->system == ORACLE_CUDA ? clamped : clamped + 0.5) / 255;
}

double oracle_phase(const struct oracle_picture *picture, const struct pel_scene *scene, int x,
                    int y) {
    if (picture->system != ORACLE_CUDA)
        return scene->render.phase;
    struct reference_ray ray =
        reference_camera_ray(&scene->camera, scene->render.width, scene->render.height, x, y);
    struct reference_span span = reference_clip(&ray, (double[]){-1, -1, -1}, (double[]){1, 1, 1});
    double steps = (span.t_out - span.t_in) / 0.01;
    return steps > 0 ? fmax(0, steps - floor(steps) - 1e-7) : 0;
}
