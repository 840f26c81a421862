// world.h - a scene as the bytes that a kernel reads. Knows no device.
#ifndef PEL_WORLD_WORLD_H
#define PEL_WORLD_WORLD_H

#include "accel/bvh.h"
#include "shared/recipe.h"
#include "world/layout.h"
#include "world/memo.h"

// One frame's constant data, and which kernel it needs.
struct pel_world {
    struct world bytes;
    struct pel_memo_words *tables;  // the words of all transfer functions, one after the other
    struct pel_memo_words *visible; // for each table, how many entries before each can be seen
    size_t cell_count;              // of all parts (shared/grid.h)
    int cell_side;                  // voxels along a side of a cell
    bool pool;                      // bricks come from a pool
    bool border;                    // bricks have a border
    // What the kernel must be able to do.
    int voxels;         // classes of voxels, VOXELS_*
    int filters;        // FILTERS_*
    int mixing;         // MIXING_*
    int models;         // MODELS_*
    int eyes;           // EYES_*
    int secondary;      // SECONDARY_*
    int cut_count;      // of bytes.cuts; directions of ambient occlusion come behind them
    bool clipped;       // some part has planes or boxes
    bool masked;        // where some part is shown, another volume decides
    bool table_linear;  // some table must be interpolated
    bool shaded;        // some part needs normals
    bool styled;        // other gradients than central differences, or opacity that follows them
    bool supersampling; // several rays a pixel, or one that does not go through its centre
    bool jitter;        // every ray has a phase of its own
    bool adaptive;      // some samples may stand for others
    bool probe;         // one ray is to write down what it meets
    double centre[3];   // world millimetres of the origin of the kernels' world
    int part_total;     // parts, with those of masks behind the ones that are shown
    struct pel_box boxes[WORLD_PART_MAX]; // around each part, a little too large
    double diagonals_mm[WORLD_PART_MAX];  // the longest line through each part
    int instances[WORLD_PART_MAX];        // which instance of the scene each part is of
    int live[RECIPE_LIVE_MAX]; // volumes that are worked out at every sample, in the order of their
                               // recipes
    int live_count;
    bool depth; // strengths are optical depths: more than one part, and extinctions add
};

// Fills a world from a scene whose volumes lie as `layout` says. Tables that are in `memo` from a
// frame before are not made anew. Fails (MEMORY, ARGUMENT, UNSUPPORTED) on settings that cannot be:
// a camera without direction, a singular placement, more parts than WORLD_PART_MAX.
bool pel_world_build(struct pel_world *world, const struct pel_scene *scene,
                     const struct pel_layout *layout, struct pel_memo *memo);

// The longest way through the box around all volumes.
double pel_world_diagonal_mm(const struct pel_world *world);

// Whether a pixel takes more than the one ray through its centre.
bool pel_world_is_supersampled(const struct pel_supersampling *supersampling);

// Lets the world be seen by the scene's camera. Fails (ARGUMENT) when it has no direction.
bool pel_world_set_eye(struct pel_world *world, const struct pel_scene *scene);

// Lets the world be seen by a second eye, too: EYES_BOTH, EYES_MERGED, or EYES_WOVEN, whose
// picture's pixels are the second one's where weave[0] x + weave[1] y is odd. Fails (ARGUMENT) on a
// camera without direction.
bool pel_world_add_eye(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_camera *second, int eyes, const int weave[2]);

// Lets one pixel be made of both eyes' colours by a matrix: of red, green and blue of the first
// one, then of the second. Where both see the background it is `background`, premultiplied.
void pel_world_merge_eyes(struct pel_world *world, const double matrix[3][6], bool linear,
                          const float background[4]);

// Lets the second one of EYES_BOTH's pictures lie beside the first one, not below it.
void pel_world_lay_beside(struct pel_world *world);

// How many eyes' rays are followed, and counted apart; how many pictures there are for tiles to
// cover; and how many lie beside and above each other, depth counted as one.
int pel_world_eyes(const struct pel_world *world);
int pel_world_pictures(const struct pel_world *world);
int pel_world_across(const struct pel_world *world);
int pel_world_planes(const struct pel_world *world);

// Pixels of all pictures, depth not counted.
size_t pel_world_pixels(const struct pel_world *world);

// How many of the first bytes of world->bytes there are for a kernel to read.
size_t pel_world_bytes(const struct pel_world *world);

// The cells of part p along x, y and z (shared/grid.h).
void pel_world_cells(const struct pel_world *world, int p, size_t cells[3]);

// The value, in the file's own unit, of what a reader gave for an instance's volume.
double pel_world_value(const struct pel_scene *scene, int instance, enum pel_reader reader,
                       double raw);

// The other way round: the stored voxel that stands for a value. The slope must not be 0.
double pel_world_raw(const struct pel_volume *volume, double value);

#endif
