// render_frames.h - many frames of an animation, to numbered pictures or to a video.
#ifndef PEL_CLI_RENDER_FRAMES_H
#define PEL_CLI_RENDER_FRAMES_H

#include "cli/picture.h"

// True when the options ask for more than a still: with --frames, or by naming a video or, for an
// animated scene, a pattern.
bool render_frames_wanted(const struct pel_scene *scene, const struct render_options *options);

// Renders them. Returns 0, or the exit status after a message.
int render_frames(struct pel_scene *scene, const struct pictures *pictures,
                  const struct render_options *options);

#endif
