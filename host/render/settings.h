// settings.h - inside the render module: whether a scene's settings make sense.
#ifndef PEL_RENDER_SETTINGS_H
#define PEL_RENDER_SETTINGS_H

#include "pellucid.h"

// False (ARGUMENT), with the setting and its value, for what no frame can be made of. Scene files
// are checked when they are read; this is for scenes made or changed by a program.
bool pel_settings_check(const struct pel_scene *scene);

// The same for what a renderer is made with.
bool pel_settings_check_options(const struct pel_renderer_options *options);

#endif
