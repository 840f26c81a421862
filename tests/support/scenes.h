// scenes.h - small scenes made in C, with volumes whose content is known in closed form.
//
// Everything that is added belongs to the scene. Memory that runs out ends the program.
#ifndef PEL_TEST_SCENES_H
#define PEL_TEST_SCENES_H

#include "pellucid.h"

// An empty scene: sum, step 1/2, phase 1/2, no termination, counted from the volumes, a clear
// background, and a camera at (0, 0, 100) looking down at the origin, y up, that sees 40 mm there.
// Give it back to pel_scene_destroy.
struct pel_scene *scene_create(int width, int height);

// Adds an instance of a new or of an old volume. Each takes its transfer function over, the first
// one the volume too. The instance (cell, linear, density 1) may be changed afterwards; the pointer
// stays valid.
struct pel_instance *scene_add(struct pel_scene *scene, struct pel_volume *volume,
                               struct pel_transfer *transfer);
struct pel_instance *scene_add_again(struct pel_scene *scene, int volume,
                                     struct pel_transfer *transfer);

// Makes the camera orthographic and `height_mm` high.
void scene_view_parallel(struct pel_scene *scene, double height_mm);

// ---- Volumes -----------------------------------------------------------------------------------

// A field's raw value at a place in voxel coordinates.
typedef double (*scene_field)(const double p_voxel[3], const void *user);

// A cube of voxels at the world's origin: 1 mm spacing, its middle at (0, 0, 0). Values are rounded
// and clamped to the type; colour types get the field in alpha (RGBA) and three different functions
// of it as colours.
struct pel_volume *scene_volume(const int dims[3], enum pel_voxel_type type, scene_field field,
                                const void *user);
struct pel_volume *scene_volume_constant(const int dims[3], enum pel_voxel_type type, double raw);

// From `ends[0]` at the first voxel to `ends[1]` at the last, along k.
struct pel_volume *scene_volume_ramp(const int dims[3], enum pel_voxel_type type,
                                     const double ends[2]);

// A smooth random field: seven waves of at least `wavelength` voxels. It reaches over
// scene_raw_range of its type.
struct pel_volume *scene_volume_waves(const int dims[3], enum pel_voxel_type type, uint64_t seed,
                                      double wavelength);

// The raw values that fields of a type are made to span: 0..255, -100..100, 0..4000, ...
void scene_raw_range(enum pel_voxel_type type, double range[2]);

// Gives a volume its place: spacing, then a rotation (x, y, z, w), then its middle. `mirrored`
// turns axis i around.
void scene_place(struct pel_volume *volume, const double spacing_mm[3], const double xyzw[4],
                 const double middle[3], bool mirrored);

// ---- Transfer functions ------------------------------------------------------------------------

// One colour and opacity per millimetre for every value.
struct pel_transfer *scene_transfer_constant(const double rgba[4]);

// From rows of value, r, g, b and opacity per millimetre.
struct pel_transfer *scene_transfer(const double (*points)[5], int count);

// A smooth function over a range of values that is nowhere very steep: `opacity` is its greatest,
// per millimetre.
struct pel_transfer *scene_transfer_gentle(const double range[2], double opacity, uint64_t seed);

// ---- Scenes ------------------------------------------------------------------------------------

// One to five random volumes (types, sizes, poses, filters, extents, mixing, clips, masks, camera)
// with gentle transfer functions. The same seed gives the same scene. `small` keeps it cheap.
struct pel_scene *scene_random(uint64_t seed, bool small);

// One volume of waves in a scene of that size, tall and thin, so that it can be cut into slabs.
struct pel_scene *scene_tall(int width, int height);

// One volume of waves in a scene of that size, thin enough to see through.
struct pel_scene *scene_waves(int width, int height);

// A cube of waves for two eyes, smaller where the device is slow, before an opaque background.
struct pel_scene *scene_stereo(enum pel_stereo_kind kind);

// Adds two volumes of waves across each other, each in a pose of its own.
void scene_add_crossing(struct pel_scene *scene);

// Moves everything, camera and lights included, by a rigid transform.
void scene_move(struct pel_scene *scene, const struct pel_matrix *transform);

// Puts the instances in another order: new instance k is old instance order[k].
void scene_permute(struct pel_scene *scene, const int order[]);

// True when the test should be cheap, as under Oclgrind (PELLUCID_TEST_SMALL).
bool scene_is_small(void);

#endif
