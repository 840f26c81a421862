// panel_quality.c - how well and how quickly rays are followed.
#include "viewer/names.h"
#include "viewer/panel.h"

static void draw_march(struct pel_state *state) {
    struct pel_render_settings *render = &state->scene->render;
    bool in_mm = render->step_mm > 0;
    if (in_mm)
        pel_panel_slide_log(state, "step", &render->step_mm, 0.01, 20, "%.3g mm");
    else
        pel_panel_slide_log(state, "step", &render->step, 0.1, 4, "%.2f voxels");
    pel_panel_slide(state, "longer where it varies by", &render->adaptive_step, 0, 0.2, "%.3f");
    pel_panel_slide(state, "first sample at", &render->phase, 0, 1, "%.2f steps");
    if (pel_widget_check("jitter", &render->jitter))
        pel_panel_changed(state, "jitter");
    pel_panel_slide(state, "ray ends at", &render->termination, 0.5, 1, "%.3f opacity");
    int order = (int)render->order;
    if (pel_widget_choose("order", pel_names_order(), &order)) {
        render->order = (enum pel_order)order;
        pel_panel_changed(state, "order");
    }
    if (pel_widget_check("what lies between samples counts", &render->preintegration))
        pel_panel_changed(state, "pre-integration");
}

static void draw_rays(struct pel_state *state) {
    struct pel_supersampling *rays = &state->scene->render.supersampling;
    int n = rays->n > 1 ? rays->n : 1;
    if (pel_widget_slide_int("n x n rays", &n, 1, PEL_SUPERSAMPLING_MAX)) {
        rays->n = n;
        pel_panel_changed(state, "supersampling");
    }
    pel_panel_settle(state);
    if (n == 1)
        return;
    int pattern = (int)rays->pattern, filter = (int)rays->filter;
    if (pel_widget_choose("pattern", pel_names_pattern(), &pattern)) {
        rays->pattern = (enum pel_pattern)pattern;
        pel_panel_changed(state, "pattern");
    }
    if (pel_widget_choose("reconstruction", pel_names_reconstruction(), &filter)) {
        rays->filter = (enum pel_reconstruction)filter;
        pel_panel_changed(state, "reconstruction");
    }
    pel_panel_slide(state, "adaptive beyond", &rays->adaptive, 0, 0.5, "%.3f");
}

static void draw_brick(struct pel_state *state, const char *label, bool *value) {
    if (pel_widget_check(label, value))
        pel_panel_changed(state, "bricks");
}

static void draw_bricks(struct pel_state *state) {
    struct pel_render_settings *render = &state->scene->render;
    struct pel_brick_settings *bricks = &render->bricks;
    bool blocks = render->skip == PEL_SKIP_BLOCKS;
    int voxels = bricks->size ? bricks->size : blocks ? 8 : 16, size = 0;
    while (size < 4 && voxels != 8 << size)
        size++;
    if (pel_widget_choose("bricks", pel_names_brick(), &size)) {
        bricks->size = 8 << size;
        pel_panel_changed(state, "bricks");
    }
    if (blocks) {
        draw_brick(state, "search for every next one", &bricks->stay);
        draw_brick(state, "cull none", &bricks->keep);
    } else {
        draw_brick(state, "each brick by itself", &bricks->apart);
    }
}

static void draw_skipping(struct pel_state *state) {
    struct pel_render_settings *render = &state->scene->render;
    int skip = (int)render->skip, pool = (int)render->bricks.pool;
    if (pel_widget_choose("skip", pel_names_skip(), &skip)) {
        render->skip = (enum pel_skip)skip;
        pel_panel_changed(state, "skip");
    }
    if (pel_widget_choose("brick pool", pel_names_pool(), &pool)) {
        render->bricks.pool = (enum pel_pool_use)pool;
        pel_panel_changed(state, "brick pool");
    }
    if (render->skip == PEL_SKIP_BVH || render->skip == PEL_SKIP_BLOCKS)
        draw_bricks(state);
}

static void draw_lod(struct pel_state *state) {
    struct pel_render_settings *render = &state->scene->render;
    int lod = (int)render->lod;
    if (pel_widget_choose("level of detail", pel_names_lod(), &lod)) {
        render->lod = (enum pel_lod)lod;
        pel_panel_changed(state, "level of detail");
    }
    if (render->lod == PEL_LOD_LEVEL && pel_widget_slide_int("level", &render->lod_level, 0, 8))
        pel_panel_changed(state, "level of detail");
    pel_panel_settle(state);
}

void pel_panel_quality(struct pel_state *state) {
    struct pel_render_settings *render = &state->scene->render;
    draw_march(state);
    draw_rays(state);
    draw_skipping(state);
    draw_lod(state);
    int debug = (int)render->debug;
    if (pel_widget_choose("debug view", pel_names_debug(), &debug)) {
        render->debug = (enum pel_debug)debug;
        pel_panel_changed(state, "debug view");
    }
}
