// save.h - a picture of a scene into a file, as `pellucid render` writes it.
#ifndef PEL_VIEWER_SAVE_H
#define PEL_VIEWER_SAVE_H

#include "pellucid.h"

// Renders the scene at its own size and quality and saves it, with the scene as JSON in a PNG's
// text; both eyes as NAME_left and NAME_right when the scene's stereo is two files. False with the
// library's error set.
bool pel_save_picture(struct pel_renderer *renderer, const struct pel_scene *scene,
                      const char *path, const struct pel_render_options *options);

#endif
