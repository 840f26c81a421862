// stereo.c - the pictures of two eyes, in one launch.
//
// The kernel takes tiles of either eye in turns, so that the second one finds the voxels in the
// caches, and everything but a camera is prepared and sent once. Of an interlaced picture it
// follows only the rays that are shown: a packet then has rays of both eyes. Of an anaglyph each
// work-item follows a packet of both eyes, one after the other, and leaves the colour that the
// glasses make of them; and pictures beside each other are left where they belong. So there is one
// picture and nothing to be put together.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "output/image.h"
#include "output/stereo.h"
#include "render/frame.h"
#include "render/reproject.h"
#include "world/world.h"

static bool is_debug(const struct pel_scene *scene) {
    return scene->render.debug != PEL_DEBUG_NONE;
}

// Which pixels of an interlaced picture are the second eye's: odd rows, columns, or both. False
// for other kinds, and where a pixel's light depends on its neighbours in the same eye's picture.
static bool find_weave(const struct pel_scene *scene, int weave[2]) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    weave[0] = scene->stereo.kind != PEL_STEREO_ROW_INTERLACED;
    weave[1] = scene->stereo.kind != PEL_STEREO_COLUMN_INTERLACED;
    return (scene->stereo.kind == PEL_STEREO_ROW_INTERLACED ||
            scene->stereo.kind == PEL_STEREO_COLUMN_INTERLACED ||
            scene->stereo.kind == PEL_STEREO_CHECKERBOARD) &&
           !is_debug(scene) && !(supersampling->adaptive > 0) &&
           supersampling->filter == PEL_RECONSTRUCTION_BOX;
}

// Whether rays end as pixels of the picture. With supersampling their mean does, and in a
// reprojected eye and in debug views the host has its hand.
static bool is_direct(const struct pel_scene *scene) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    return !scene->stereo.reproject && !is_debug(scene) && !(supersampling->adaptive > 0) &&
           !pel_world_is_supersampled(supersampling);
}

// The glasses of an anaglyph.
static bool put_on(struct pel_glasses *glasses, const struct pel_scene *scene) {
    float premultiplied[4] = {0, 0, 0, (float)scene->background[3]};
    for (int c = 0; c < 3; c++)
        premultiplied[c] = (float)(scene->background[c] * scene->background[3]);
    const struct pel_image behind = {1, 1, premultiplied};
    struct pel_image *merged = pel_stereo_compose(&scene->stereo, &behind, &behind);
    if (!merged)
        return false;
    memcpy(glasses->background, merged->rgba, sizeof glasses->background);
    pel_image_destroy(merged);
    glasses->linear = pel_anaglyph_matrix(&scene->stereo, glasses->matrix);
    return true;
}

// Progress of one eye, as a share of both.
struct share {
    const struct pel_render_options *options;
    double begin;
};

static bool report_share(double finished, void *user) {
    const struct share *share = user;
    return share->options->progress(share->begin + finished / 2, share->options->user);
}

// What is counted or timed adds up; what was chosen is that of the last eye.
static void add_statistics(struct pel_render_statistics *sum,
                           const struct pel_render_statistics *eye, int i) {
    struct pel_render_statistics both = *eye;
    both.samples += sum->samples;
    both.samples_skipped += sum->samples_skipped;
    both.samples_terminated += sum->samples_terminated;
    both.samples_spared += sum->samples_spared;
    both.boxes_entered += sum->boxes_entered;
    both.rays += sum->rays;
    both.uploaded_bytes += sum->uploaded_bytes;
    both.prepare_ms += sum->prepare_ms;
    both.build_ms += sum->build_ms;
    both.upload_ms += sum->upload_ms;
    both.skip_ms += sum->skip_ms;
    both.render_ms += sum->render_ms;
    both.download_ms += sum->download_ms;
    both.stereo = sum->stereo;
    both.stereo.eye_samples[i] = eye->samples;
    *sum = both;
}

// A debug view's numbers are those of a launch of its own, with a range of its own: so each eye
// has its frame there.
static struct pel_image *render_apart(struct pel_renderer *renderer, struct pel_scene *seen,
                                      const struct pel_camera *second,
                                      const struct pel_render_options *options,
                                      struct pel_render_statistics *statistics) {
    const struct pel_camera first = seen->camera;
    struct pel_image *both = NULL;
    *statistics = (struct pel_render_statistics){0};
    for (int i = 0; i < 2; i++) {
        const struct pel_frame_eyes one = {.second = i == 0 ? second : &first};
        struct share share = {options, i / 2.0};
        struct pel_render_options of_eye = options ? *options : (struct pel_render_options){0};
        if (of_eye.progress) {
            of_eye.progress = report_share;
            of_eye.user = &share;
        }
        struct pel_render_statistics of_frame;
        struct pel_image *eye = pel_frame_render(renderer, seen, &one, &of_eye, &of_frame);
        if (eye && !both)
            both = pel_image_create_undefined(eye->width, 2 * eye->height);
        if (!eye || !both) {
            pel_image_destroy(eye);
            pel_image_destroy(both);
            return NULL;
        }
        size_t floats = (size_t)eye->width * (size_t)eye->height * 4;
        memcpy(both->rgba + (size_t)i * floats, eye->rgba, floats * sizeof *eye->rgba);
        pel_image_destroy(eye);
        add_statistics(statistics, &of_frame, i);
        seen->camera = *second;
    }
    return both;
}

// Reprojection moves colours along rows, from one ray of each pixel: toed-in cameras of perspective
// move them out of their rows, and the mean of several rays has no one depth.
static bool check_reproject(const struct pel_scene *scene) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    if (scene->stereo.toe_in && !scene->camera.orthographic)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "stereo.reproject needs parallel cameras, not toe_in");
    if (supersampling->n > 1)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "stereo.reproject goes with one ray a pixel, not with %d x %d",
                        supersampling->n, supersampling->n);
    if (supersampling->pattern != PEL_PATTERN_REGULAR ||
        supersampling->filter != PEL_RECONSTRUCTION_BOX)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "stereo.reproject goes with rays through the middles of pixels only");
    return true;
}

// Renders the pixels of the second eye that the first one's picture does not tell.
static bool fill_holes(struct pel_renderer *renderer, const struct pel_scene *seen,
                       const struct pel_camera *first, const uint8_t *holes,
                       struct pel_image *second, const struct pel_render_options *options,
                       struct pel_render_statistics *statistics) {
    struct pel_render_statistics of_holes;
    struct pel_image *cast =
        pel_frame_render(renderer, seen, &(struct pel_frame_eyes){.second = first, .only = holes},
                         options, &of_holes);
    if (!cast)
        return false;
    size_t pixels = (size_t)second->width * (size_t)second->height;
    for (size_t i = 0; i < pixels; i++)
        if (holes[i])
            memcpy(&second->rgba[4 * i], &cast->rgba[4 * i], 4 * sizeof *cast->rgba);
    pel_image_destroy(cast);
    add_statistics(statistics, &of_holes, 1);
    return true;
}

// Puts the second eye's picture in the place of the depth below the first one's.
static bool make_second(struct pel_renderer *renderer, struct pel_scene *seen,
                        const struct pel_camera cameras[2], struct pel_image *both,
                        const struct pel_render_options *options,
                        struct pel_render_statistics *statistics) {
    int width = both->width, height = both->height / 2;
    size_t pixels = (size_t)width * (size_t)height, hole_count = 0;
    float *depth = pel_allocate(pixels, sizeof *depth);
    uint8_t *holes = pel_allocate(pixels, sizeof *holes);
    bool good = depth && holes;
    double begin_ms = pel_clock_ms();
    const struct pel_image first = {width, height, both->rgba};
    struct pel_image second = {width, height, both->rgba + 4 * pixels};
    for (size_t i = 0; good && i < pixels; i++)
        depth[i] = second.rgba[4 * i];
    if (good) {
        const struct pel_parallax parallax = pel_parallax_between(cameras, &seen->render);
        pel_depth_from_distance(depth, &cameras[0], &seen->render);
        good = pel_reproject(&second, holes, &first, depth, &parallax);
    }
    for (size_t i = 0; good && i < pixels; i++)
        hole_count += holes[i];
    statistics->stereo.reproject_ms = pel_clock_ms() - begin_ms;
    statistics->stereo.reprojected = 1 - (double)hole_count / (double)pixels;
    seen->camera = cameras[1];
    good = good && (hole_count == 0 ||
                    fill_holes(renderer, seen, &cameras[0], holes, &second, options, statistics));
    free(depth);
    free(holes);
    return good;
}

// The first eye's picture, and from it the second one's.
static struct pel_image *render_reprojected(struct pel_renderer *renderer, struct pel_scene *seen,
                                            const struct pel_camera cameras[2],
                                            const struct pel_render_options *options,
                                            struct pel_render_statistics *statistics) {
    if (!check_reproject(seen))
        return NULL;
    struct share share = {options, 0};
    struct pel_render_options of_eye = options ? *options : (struct pel_render_options){0};
    if (of_eye.progress) {
        of_eye.progress = report_share;
        of_eye.user = &share;
    }
    const struct pel_frame_eyes with_depth = {.eyes = EYES_DEPTH, .second = &cameras[1]};
    struct pel_image *both = pel_frame_render(renderer, seen, &with_depth, &of_eye, statistics);
    share.begin = 0.5;
    if (both && make_second(renderer, seen, cameras, both, &of_eye, statistics))
        return both;
    pel_image_destroy(both);
    return NULL;
}

// Renders what two cameras see. The caller owns the picture.
static struct pel_image *render_pair(struct pel_renderer *renderer, const struct pel_scene *scene,
                                     const struct pel_frame_eyes *eyes,
                                     const struct pel_render_options *options,
                                     struct pel_render_statistics *statistics) {
    struct pel_camera cameras[2];
    struct pel_stereo used;
    if (!pel_stereo_cameras(scene, cameras, &used))
        return NULL;
    // Two pictures become one on the host.
    struct pel_render_options here = options ? *options : (struct pel_render_options){0};
    bool brought = here.gl_buffer && eyes->eyes == EYES_BOTH;
    if (brought)
        here.gl_buffer = 0;
    options = &here;
    // The copy borrows everything the scene owns.
    struct pel_scene seen = *scene;
    seen.camera = cameras[0];
    struct pel_frame_eyes both = *eyes;
    both.second = &cameras[1];
    struct pel_image *image;
    if (is_debug(scene))
        image = render_apart(renderer, &seen, &cameras[1], options, statistics);
    else if (scene->stereo.reproject && eyes->eyes == EYES_BOTH)
        image = render_reprojected(renderer, &seen, cameras, options, statistics);
    else
        image = pel_frame_render(renderer, &seen, &both, options, statistics);
    if (brought)
        snprintf(statistics->gl_reason, sizeof statistics->gl_reason,
                 "two eyes are put together on the host");
    statistics->stereo.separation_mm = used.separation_mm;
    statistics->stereo.convergence_mm = used.convergence_mm;
    return image;
}

bool pel_renderer_render_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                              const struct pel_render_options *options,
                              struct pel_render_statistics *statistics, struct pel_image *eyes[2]) {
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    *statistics = (struct pel_render_statistics){0};
    eyes[0] = eyes[1] = NULL;
    const struct pel_frame_eyes both = {.eyes = EYES_BOTH};
    struct pel_image *image = render_pair(renderer, scene, &both, options, statistics);
    for (int i = 0; image && i < 2; i++)
        eyes[i] = pel_image_create_undefined(image->width, image->height / 2);
    bool good = eyes[0] && eyes[1];
    size_t floats = good ? (size_t)image->width * (size_t)eyes[0]->height * 4 : 0;
    for (int i = 0; good && i < 2; i++)
        memcpy(eyes[i]->rgba, image->rgba + (size_t)i * floats, floats * sizeof *image->rgba);
    for (int i = 0; !good && i < 2; i++) {
        pel_image_destroy(eyes[i]);
        eyes[i] = NULL;
    }
    pel_image_destroy(image);
    return good;
}

// Rows and columns are counted in the whole picture.
static bool begins_with_the_other_eye(const struct pel_scene *scene) {
    const int *region = scene->render.region;
    switch (scene->stereo.kind) {
    case PEL_STEREO_ROW_INTERLACED:
        return region[1] % 2 != 0;
    case PEL_STEREO_COLUMN_INTERLACED:
        return region[0] % 2 != 0;
    case PEL_STEREO_CHECKERBOARD:
        return (region[0] + region[1]) % 2 != 0;
    default:
        return false;
    }
}

struct pel_image *pel_renderer_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                      const struct pel_render_options *options,
                                      struct pel_render_statistics *statistics) {
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    *statistics = (struct pel_render_statistics){0};
    struct pel_frame_eyes eyes = {.eyes = EYES_ONE};
    if (scene->stereo.kind == PEL_STEREO_NONE)
        return pel_frame_render(renderer, scene, &eyes, options, statistics);
    struct pel_glasses glasses;
    eyes.eyes = EYES_BOTH;
    if (find_weave(scene, eyes.weave))
        eyes.eyes = EYES_WOVEN;
    else if (is_direct(scene) && pel_stereo_is_anaglyph(scene->stereo.kind))
        eyes.eyes = EYES_MERGED;
    eyes.beside = is_direct(scene) && scene->stereo.kind == PEL_STEREO_SIDE_BY_SIDE;
    eyes.glasses = &glasses;
    if (eyes.eyes == EYES_MERGED && !put_on(&glasses, scene))
        return NULL;
    struct pel_image *image = render_pair(renderer, scene, &eyes, options, statistics);
    if (!image || eyes.eyes != EYES_BOTH || eyes.beside ||
        scene->stereo.kind == PEL_STEREO_TOP_BOTTOM)
        return image;
    double begin_ms = pel_clock_ms();
    int height = image->height / 2;
    size_t floats = (size_t)image->width * (size_t)height * 4;
    const struct pel_image pictures[2] = {{image->width, height, image->rgba},
                                          {image->width, height, image->rgba + floats}};
    bool odd = begins_with_the_other_eye(scene);
    struct pel_image *composed =
        pel_stereo_compose(&scene->stereo, &pictures[odd], &pictures[!odd]);
    statistics->stereo.compose_ms = pel_clock_ms() - begin_ms;
    pel_image_destroy(image);
    return composed;
}
