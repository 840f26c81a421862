// bench_stereo.c - the suite `stereo`: what a second eye costs over one.
//
// A thin fog, whose rays run far and show many depths at once, and a surface; each seen by one eye,
// by two as an anaglyph and side by side, by two of which half the rays are shown, and by a second
// eye that is made from the first one's picture.
#include <stdio.h>

#include "cli/bench.h"
#include "cli/options.h"

enum { BALL_SIZE = 128, USUAL_WIDTH = 640, USUAL_HEIGHT = 480 };

static struct pel_scene *scene_of(struct bench *bench, struct pel_volume *ball, bool surface) {
    struct pel_scene *scene = bench_ball_scene(bench, &ball, 1, false);
    if (!scene)
        return NULL;
    pel_volume_measure(ball, &scene->statistics[0]);
    if (surface)
        scene->instances[0].density = 1000;
    return scene;
}

static bool add_scene(struct bench *bench, struct pel_volume *ball, bool surface) {
    static const struct {
        const char *name;
        enum pel_stereo_kind kind;
        bool reproject;
    } rows[] = {
        {"one eye", PEL_STEREO_NONE, false},
        {"anaglyph", PEL_STEREO_DUBOIS_RED_CYAN, false},
        {"side by side", PEL_STEREO_SIDE_BY_SIDE, false},
        {"interlaced", PEL_STEREO_ROW_INTERLACED, false},
        {"anaglyph, reprojected", PEL_STEREO_DUBOIS_RED_CYAN, true},
    };
    int first = bench->case_count;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "%s, %s", surface ? "surface" : "fog", rows[i].name);
        struct bench_case *added = bench_add(bench, "stereo", name);
        if (!added)
            return false;
        added->width = bench->options.width ? bench->options.width : USUAL_WIDTH;
        added->height = bench->options.width ? bench->options.height : USUAL_HEIGHT;
        added->baseline = i > 0 ? first : -1;
        added->scene = scene_of(bench, ball, surface);
        if (!added->scene || !bench_fit_camera(added->scene, added->width, added->height))
            return false;
        bench_set_skip(added, PEL_SKIP_AUTO);
        added->scene->stereo.kind = rows[i].kind;
        added->scene->stereo.reproject = rows[i].reproject;
    }
    return true;
}

int bench_add_stereo(struct bench *bench) {
    struct pel_volume *ball =
        pel_volume_generate("c60", &(struct pel_generate_options){.size = BALL_SIZE});
    if (!ball)
        return cli_fail_library();
    bool good = bench_keep_volume(bench, ball) && add_scene(bench, ball, false) &&
                add_scene(bench, ball, true);
    return good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
