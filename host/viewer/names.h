// names.h - what the scene's choices are called in menus, in the order of their enums; each list
// ends with NULL.
#ifndef PEL_VIEWER_NAMES_H
#define PEL_VIEWER_NAMES_H

const char *const *pel_names_model(void);
const char *const *pel_names_scene_model(void);
const char *const *pel_names_gradient(void);
const char *const *pel_names_order(void);
const char *const *pel_names_pool(void);
const char *const *pel_names_brick(void);
const char *const *pel_names_filter(void);
const char *const *pel_names_shading(void);
const char *const *pel_names_light(void);
const char *const *pel_names_lod(void);
const char *const *pel_names_skip(void);
const char *const *pel_names_pattern(void);
const char *const *pel_names_reconstruction(void);
const char *const *pel_names_debug(void);

int pel_names_count(const char *const *names);

#endif
