// animation.h - the `animation` of a scene file: which keys change from frame to frame, and how.
//
// A frame is the scene with the values of that frame put in its JSON, read like any other scene. So
// every key can be animated, means the same as in a still, and is checked as strictly. Three kinds
// of tracks say more than JSON can: transfer functions, which may be presets or files, named
// viewpoints, which depend on the volumes, and orbits.
#ifndef PEL_WORLD_ANIMATION_H
#define PEL_WORLD_ANIMATION_H

#include "world/scene_plan.h"

enum pel_track_kind {
    PEL_TRACK_VALUE,    // of any key
    PEL_TRACK_TRANSFER, // of a volume
    PEL_TRACK_VIEW,     // whole cameras
    PEL_TRACK_ORBIT,    // about the camera's target
};

enum pel_interpolation {
    PEL_INTERPOLATION_LINEAR,
    PEL_INTERPOLATION_SMOOTH, // slowly away from a keyframe and slowly towards the next
    PEL_INTERPOLATION_STEP,   // a keyframe's value until the next
    PEL_INTERPOLATION_WHOLE,  // linear, rounded down
};

enum { PEL_TRACK_KEY_BYTES = 256 };

struct pel_track {
    struct pel_scene_node node;    // its parents are the animation's
    char key[PEL_TRACK_KEY_BYTES]; // with volumes by index; "" for an orbit
    enum pel_track_kind kind;
    enum pel_interpolation interpolation;
    json_t *values; // borrowed; NULL for an orbit
    double *frames; // owned; ascending
    int count;
    int volume; // of a transfer function; -1 = all
    struct {
        double axis[3], radians;
        bool camera_up; // the axis is the camera's
    } orbit;
};

struct pel_animation {
    struct pel_scene_node scene, node, list; // the scene, its animation, and its tracks
    struct pel_timeline timeline;            // frame_count = 0: there is no animation
    struct pel_track *tracks;                // owned
    int track_count;
    json_t *towards;      // owned; the viewpoint that the camera is on its way to, or NULL,
    double towards_share; // and how far it got
};

// Reads and checks the animation of a scene. Zero-initialise; pel_animation_finish in any case.
// `animation` must not move afterwards.
bool pel_animation_read(struct pel_animation *animation, const struct pel_scene_node *scene);
void pel_animation_finish(struct pel_animation *animation);

// Puts the values at timeline.frame into `root`, the copy of the scene that is going to be read.
bool pel_animation_apply(struct pel_animation *animation, json_t *root);

// What remains: the transfer functions that others are on their way to, after the volumes were
// read, and the camera, after they were loaded. It is placed as `plan` says and then moved.
bool pel_animation_read_transfers(const struct pel_animation *animation,
                                  struct pel_scene_plan *plan, int volume_count);
bool pel_animation_place_camera(const struct pel_animation *animation, struct pel_scene *scene,
                                const struct pel_scene_plan *plan);

#endif
