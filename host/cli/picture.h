// picture.h - where pictures go, and what is written into them.
#ifndef PEL_CLI_PICTURE_H
#define PEL_CLI_PICTURE_H

#include "cli/render_options.h"

enum { PICTURE_NAME_BYTES = 4096 };

// One picture, or those of the left and the right eye. Each may be a pattern for many frames.
struct pictures {
    char names[2][PICTURE_NAME_BYTES];
    int count;
};

// Decides where pictures of the scene go: what the options say, or the scene, or the first input's
// name; for `many` frames that is a pattern or a video. Returns 0, or the exit status after a
// message when they cannot be written there.
int pictures_choose(struct pictures *pictures, const struct pel_scene *scene,
                    const struct render_options *options, bool many);

// Saves a picture that says how it was made, so that it can be made again. False: the library's
// last failure says why.
bool picture_save(const struct pel_image *image, const char *path, const struct pel_scene *scene,
                  const struct pel_render_statistics *statistics);

#endif
