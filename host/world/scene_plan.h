// scene_plan.h - a scene between its file and its volumes.
//
// Reading a scene goes in two passes. The first checks the whole file and writes down in a plan
// what has to be loaded, so that a slip in the last line is reported before gigabytes are read. The
// second loads the volumes and settles what depends on them: transfer functions, transforms that
// turn about a volume's centre or come from FSL, and the fitted camera.
#ifndef PEL_WORLD_SCENE_PLAN_H
#define PEL_WORLD_SCENE_PLAN_H

#include "pellucid.h"
#include "world/scene_node.h"

// A camera as the file gives it: members of `given` that are absent are NaN.
struct pel_camera_plan {
    struct pel_scene_node node;
    const char *view; // borrowed; NULL takes the default
    int fit;          // the instance to fit into the picture; -1 = all that are not hidden
    bool fit_visible; // only what can be seen of them
    struct pel_camera given;
};

// A transform, p' = matrix * (p - about) + about, or what is in `file`.
struct pel_pose_plan {
    struct pel_matrix matrix;
    double about[3];
    bool about_centre; // `about` becomes the centre of the volume's box
    char *file;        // owned
    int fixed;         // the other instance an FSL matrix refers to; -1 = none
    const char *fixed_name;
};

struct pel_volume_plan {
    struct pel_scene_node node;
    char *file; // owned; NULL for a generated volume
    const char *kind;
    struct pel_load_options load;
    struct pel_generate_options generate;
    double spacing[3];            // replaces the file's; 0 = does not
    char *recipe;                 // owned; of a hypertexture
    struct pel_bake_options bake; // likewise
    bool live;
    const char *object_name; // of the volume it grows on, or NULL
    int object;              // its index; -1 = none
    struct pel_pose_plan pose;
    bool filter_given;
    double opacity_unit_mm;       // replaces the transfer function's; 0 = does not
    struct pel_transfer *towards; // owned; the transfer function is on its way there, or NULL,
    double towards_share;         // and how far it got
    const char *palette; // preset whose colours an automatic transfer function takes, or NULL
};

struct pel_scene_plan {
    struct pel_scene_node scene, volumes; // parents of the nodes below
    struct pel_camera_plan camera;
    struct pel_volume_plan volume[PEL_VOLUME_MAX]; // one per instance
};

// First pass, in parts; the camera comes after the volumes. All fail like the functions of
// scene_node.h.
bool pel_scene_read_settings(struct pel_scene *scene, const struct pel_scene_node *node);
bool pel_scene_read_wall(struct pel_scene *scene, const struct pel_scene_node *node);
bool pel_scene_read_stereo(struct pel_scene *scene, const struct pel_scene_node *node);
bool pel_scene_read_volumes(struct pel_scene *scene, struct pel_scene_plan *plan);
bool pel_scene_read_camera(struct pel_camera_plan *plan, const struct pel_scene_node *root,
                           const struct pel_scene *scene);
bool pel_scene_read_pose(struct pel_pose_plan *pose, const struct pel_scene_node *node);
bool pel_scene_read_source(struct pel_volume_plan *plan, const struct pel_scene_node *node);
bool pel_scene_read_transfer(struct pel_transfer **transfer, const struct pel_scene_node *node);
bool pel_scene_read_transfer_value(struct pel_transfer **transfer,
                                   const struct pel_scene_node *node);

bool pel_scene_read_secondary(struct pel_render_settings *render,
                              const struct pel_scene_node *node);
bool pel_scene_read_lights(struct pel_scene *scene, const struct pel_scene_node *node);
bool pel_scene_read_gradient(enum pel_gradient *gradient, const struct pel_scene_node *object);
bool pel_scene_read_style(struct pel_instance *instance, const struct pel_scene_node *volume);
bool pel_scene_read_material(struct pel_material *material, const struct pel_scene_node *volume);

// Up to PEL_CLIP_MAX planes and boxes, in the world unless they are a volume's.
bool pel_scene_read_clips(const struct pel_scene_node *object, bool of_scene, int *count,
                          struct pel_clip clips[PEL_CLIP_MAX]);

// What another volume's values leave of one: first which values, then, when all names are known,
// which volume, and at last that no mask depends on itself.
bool pel_scene_read_mask(struct pel_mask *mask, const struct pel_scene_node *volume);
bool pel_scene_find_mask(struct pel_scene *scene, const struct pel_scene_plan *plan, int self);
bool pel_scene_check_masks(const struct pel_scene *scene, const struct pel_scene_plan *plan);

// A colour by name, as #rrggbb[aa] or as 3 or 4 numbers; without an alpha, rgba[3] stays.
bool pel_scene_read_colour(double rgba[4], const struct pel_scene_node *object, const char *key);

// `step` or `step_mm` of a scene's settings or of a volume, but not both.
bool pel_scene_read_step(const struct pel_scene_node *object, double *step, double *step_mm);

// How light is gathered: the scene's settings, and what a volume has of its own.
bool pel_scene_read_march(struct pel_render_settings *render, const struct pel_scene_node *node);
bool pel_scene_read_quality(const struct pel_scene_node *render, double *quality);
bool pel_scene_read_model(struct pel_instance *instance, const struct pel_scene_node *volume);

// The one instance of that name; fails about `node` when there is none, or several.
bool pel_scene_find_instance(const struct pel_scene *scene, const struct pel_scene_node *node,
                             const char *name, int *instance);

// Second pass. `scene` owns what was loaded even when it fails. Volumes that the scene `before`
// (which may be NULL) has too are shared with it instead of being loaded again.
bool pel_scene_load_volumes(struct pel_scene *scene, struct pel_scene_plan *plan,
                            const struct pel_scene *before);
bool pel_scene_place_camera(struct pel_scene *scene, const struct pel_camera_plan *plan);

// What a scene's quality leaves to be chosen, once the volumes are there.
bool pel_scene_settle_quality(struct pel_scene *scene, const struct pel_scene_plan *plan);

// A transfer function that shows what is in a volume nobody has described: see scene_auto.c. The
// caller owns it; NULL (MEMORY).
struct pel_transfer *pel_scene_auto_transfer(const struct pel_volume *volume,
                                             const struct pel_statistics *statistics,
                                             const char *palette);

void pel_scene_plan_finish(struct pel_scene_plan *plan);

#endif
