// scene.h - inside the world module: the parts of a scene.
#ifndef PEL_WORLD_SCENE_H
#define PEL_WORLD_SCENE_H

#include "pellucid.h"

// An instance of volume 0 that owns nothing, with every default.
struct pel_instance pel_instance_default(void);

// Copies what an instance owns; false (MEMORY) leaves the copy owning nothing.
bool pel_instance_copy(struct pel_instance *copy, const struct pel_instance *instance);
void pel_instance_finish(struct pel_instance *instance);

// Gives an instance a name, "volume" for NULL or none. One that is too long is cut between
// characters of UTF-8.
void pel_instance_set_name(struct pel_instance *instance, const char *name);

// Copies what a source owns; false (MEMORY) leaves the copy owning nothing.
bool pel_volume_source_copy(struct pel_volume_source *copy, const struct pel_volume_source *source);
void pel_volume_source_finish(struct pel_volume_source *source);

// Loads or generates what the source says. The caller owns it; NULL as pel_volume_load fails.
struct pel_volume *pel_volume_source_open(const struct pel_volume_source *source);

// Points in world millimetres; owned, NULL where there are none.
struct pel_points {
    double (*at)[3];
    size_t count;
};

// Adds points in whose convex hull all lies that an instance's transfer function, which must be
// resolved, shows of it; the corners of its box where that is nothing, or where it has no voxels.
// False (MEMORY).
bool pel_instance_visible_hull(const struct pel_scene *scene, int instance,
                               struct pel_points *points);

#endif
