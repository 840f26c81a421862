// region.c - a part of a picture.
//
// A pixel of the whole has the same rays and the same random numbers in any region (kernels/ray.cl,
// pixel.cl). What it takes from its neighbours, it finds in a margin that is cut off at the end.
#include "render/region.h"

#include <string.h>

#include "base/error.h"
#include "output/image.h"
#include "world/world.h"

bool pel_region_check(const struct pel_render_settings *settings) {
    const int *region = settings->region;
    if (!region[0] && !region[1] && !region[2] && !region[3])
        return true;
    if (region[0] >= 0 && region[1] >= 0 && region[2] > 0 && region[3] > 0 &&
        region[0] < settings->width && region[1] < settings->height &&
        region[2] <= settings->width - region[0] && region[3] <= settings->height - region[1])
        return true;
    return pel_fail(PEL_ERROR_ARGUMENT, "region %d,%d,%d,%d is not inside the picture of %d x %d",
                    region[0], region[1], region[2], region[3], settings->width, settings->height);
}

// How far from a pixel lie those that it depends on: its contrast to the next ones decides on its
// rays, and its light is theirs, too.
static int margin_px(const struct pel_render_settings *settings) {
    const struct pel_supersampling *rays = &settings->supersampling;
    if (settings->debug != PEL_DEBUG_NONE || !pel_world_is_supersampled(rays))
        return 0;
    return (rays->adaptive > 0) + (rays->filter == PEL_RECONSTRUCTION_GAUSSIAN);
}

void pel_region_widen(struct pel_render_settings *settings) {
    const int whole[2] = {settings->width, settings->height};
    int *region = settings->region, margin = margin_px(settings);
    for (int axis = 0; axis < 2 && region[2] > 0; axis++) {
        int low = region[axis] - margin, high = region[axis] + region[2 + axis] + margin;
        region[axis] = low > 0 ? low : 0;
        region[2 + axis] = (high < whole[axis] ? high : whole[axis]) - region[axis];
    }
}

struct pel_image *pel_region_cut(struct pel_image *image, const struct pel_render_settings *widened,
                                 const struct pel_render_settings *settings) {
    const int *from = widened->region, *to = settings->region;
    if (!image || !image->rgba || memcmp(from, to, sizeof settings->region) == 0)
        return image;
    int planes = image->height / from[3]; // pictures above each other
    struct pel_image *part = pel_image_create_undefined(to[2], planes * to[3]);
    for (int y = 0; part && y < part->height; y++) {
        int row = y / to[3] * from[3] + y % to[3] + to[1] - from[1];
        size_t first = (size_t)row * (size_t)from[2] + (size_t)(to[0] - from[0]);
        memcpy(&part->rgba[4 * (size_t)y * (size_t)to[2]], &image->rgba[4 * first],
               4 * sizeof *part->rgba * (size_t)to[2]);
    }
    pel_image_destroy(image);
    return part;
}
