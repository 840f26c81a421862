// render.c - pictures, and refusals, of scenes that nobody judges.
#include "support/render.h"

#include "shared/brick.h"
#include "support/test.h"

struct pel_image *render_picture(struct pel_renderer *renderer, const struct pel_scene *scene,
                                 struct pel_render_statistics *statistics) {
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, statistics);
    if (!picture)
        fail_msg("%s", pel_error_message());
    return picture;
}

void render_refused(struct pel_renderer *renderer, const struct pel_scene *scene, const char *why) {
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    if (!strstr(pel_error_message(), why))
        fail_msg("'%s' does not say '%s'", pel_error_message(), why);
}

struct pel_renderer *render_in_slabs(int lanes) {
    const struct pel_renderer_options options = {
        .reader = PEL_READER_BUFFER, .lanes = lanes, .max_allocation_bytes = 2 * BRICK_VOXELS};
    struct pel_renderer *renderer = pel_renderer_create(&options);
    if (!renderer)
        fail_msg("no renderer: %s", pel_error_message());
    return renderer;
}
