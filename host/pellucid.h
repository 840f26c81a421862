// pellucid.h - the whole public interface of libpellucid.
//
// Pellucid ray casts up to 32 volumes at once on any OpenCL device. The order of things:
//
//     struct pel_scene *scene = pel_scene_load("head.json", NULL, 0);
//     struct pel_renderer *renderer = pel_renderer_create(NULL);
//     struct pel_image *image = pel_renderer_render(renderer, scene, NULL, NULL);
//     pel_image_save(image, "head.png", NULL);
//
// The sections of this file, and what they are about:
//
//     Errors                     codes, sentences and warnings; the library's version and clock
//     Geometry                   matrices
//     Volumes                    voxels: reading, making, changing, measuring and writing them
//     Transfer functions         from values to colour and opacity
//     Cameras, Stereo            where a scene is seen from, by one eye or by two
//     Rigid transforms           how one volume lies on another: ITK's, FSL's and plain files
//     Volumes in a scene         what a volume looks like: model, filter, material, clips, mask
//     Light                      lamps, shadows, ambient occlusion
//     How a picture is rendered  size, steps, mixing, skipping, supersampling
//     Scenes                     all of the above together: reading, making and writing it
//     Changing scenes            adding, removing, moving and reloading volumes
//     Animations                 frames and keyframes
//     Asking about scenes        bounds, the cameras of two eyes, bricks
//     Devices, Rendering         the renderer, from a scene to a picture
//     Probing a ray              what the ray of one pixel meets
//     Hypertextures              volumes that a recipe makes (Perlin & Hoffert 1989)
//     Images, Videos             writing what was rendered
//
// Rules that hold everywhere:
// - World space is right-handed, in millimetres, RAS+ (x to the patient's right, y anterior, z
//   superior), as NIfTI has it. Voxel (i,j,k) is centred at index (i,j,k).
// - Matrices are row-major `m[row][column]` and act on column vectors: p_world = m * p_voxel.
// - A function that can fail returns false or NULL. pel_error_code() and pel_error_message() then
//   tell this thread why, in one sentence without full stop. Descriptions name the codes that are a
//   function's own, without PEL_ERROR_; MEMORY is possible wherever something is made. The library
//   never prints, exits or aborts.
// - `create`, `load`, `generate` and `copy` return an object the caller owns and gives back to the
//   matching `destroy`. Every destroy function accepts NULL.
// - Options are structs passed by pointer. A member that is zero takes its default, and NULL takes
//   all of them.
// - Files are read and written with a point in their numbers: a program that calls setlocale leaves
//   LC_NUMERIC at "C".
// - An object may be used by one thread at a time; different objects by different threads.
#ifndef PELLUCID_H
#define PELLUCID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define PEL_API __attribute__((visibility("default")))
#define PEL_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define PEL_API
#define PEL_PRINTF(text, first)
#endif

#define PEL_VOLUME_MAX 32

// ---- Errors ------------------------------------------------------------------------------------

// What kind of failure it was. The numbers double as exit statuses of the command line.
enum pel_error {
    PEL_OK = 0,
    PEL_ERROR_ARGUMENT = 2,    // the caller or the command line asked for something impossible
    PEL_ERROR_MEMORY = 3,      // host memory ran out, or a size is beyond what can be addressed
    PEL_ERROR_FILE = 4,        // a file cannot be opened, read, written or renamed
    PEL_ERROR_FORMAT = 5,      // a file's content is not what its format demands
    PEL_ERROR_DEVICE = 6,      // no device, a device that failed, or one that is too small
    PEL_ERROR_BUILD = 7,       // a kernel did not compile
    PEL_ERROR_UNSUPPORTED = 8, // valid, but more than this build or device can do
};

// The code and sentence of this thread's last failure; PEL_OK and "" if there was none. The
// sentence stays valid until the thread's next failure.
PEL_API enum pel_error pel_error_code(void);
PEL_API const char *pel_error_message(void);

// Receives what the library has to say without failing: a value that was clamped, a frame that was
// assumed. `message` is one sentence; `user` is what was registered.
typedef void (*pel_warning_callback)(const char *message, void *user);

// Registers who receives warnings, for the whole process; NULL (the default) drops them. Call it
// before other threads use the library: the callback comes from whichever thread has to say it.
PEL_API void pel_on_warning(pel_warning_callback callback, void *user);

// The library's version, "major.minor.patch".
PEL_API const char *pel_version(void);

// Milliseconds of the clock of all statistics, which only goes forward; only differences mean
// something.
PEL_API double pel_clock_ms(void);

// ---- Geometry ----------------------------------------------------------------------------------

// An affine transform: row-major, column vectors, last row 0 0 0 1.
struct pel_matrix {
    double m[4][4];
};

// ---- Volumes -----------------------------------------------------------------------------------

enum pel_voxel_type {
    PEL_VOXEL_U8,
    PEL_VOXEL_I8,
    PEL_VOXEL_U16,
    PEL_VOXEL_I16,
    PEL_VOXEL_F32,
    PEL_VOXEL_RGB8,  // three bytes a voxel
    PEL_VOXEL_RGBA8, // four bytes a voxel, straight alpha
};

// What a volume without voxels is worked out from: see pel_volume_hypertexture.
struct pel_hypertexture;

// A regular grid of voxels with its place in the world. Read its members freely; change them only
// before the volume is first rendered.
struct pel_volume {
    char *name;               // short name for messages: the file's last path component
    int dims[3];              // voxels along i, j, k; each at least 1
    enum pel_voxel_type type; //
    struct pel_matrix
        world_from_voxel;    // voxel index -> RAS millimetres; may be oblique or mirrored
    double slope, intercept; // value in the file's own unit = slope * raw + intercept
    char unit[16];           // of the values, such as "HU"; "" when unknown
    char space[64];          // where the placement came from, such as "sform (scanner)"
    uint64_t serial;         // set by pel_volume_create and never reused: tells volumes apart
    bool labels;             // values are labels: interpolating them makes no sense
    struct pel_hypertexture *hypertexture; // owned; in place of voxels, or NULL
    void *voxels; // owned; i fastest, then j, then k; no padding. In PEL_VOXEL_F32
                  // an absent voxel (NaN or Inf in the file) is NaN
    int shares;   // how many hold it besides the first: see pel_volume_share
};

// Whether values are labels. By itself, as the file says; a file without a way to say so, such as
// a TIFF, is a label map when its name (a word such as "labels" or "seg") and its values
// (pel_volume_seems_labels) agree. Colours never are.
enum pel_label_choice { PEL_LABELS_AUTO, PEL_LABELS_YES, PEL_LABELS_NO };

// How to read a file. Zero-initialise for the defaults.
struct pel_load_options {
    // Which part of a file with more than three dimensions to take, counted from 0.
    int time, channel;
    // Multi-channel TIFF pages are taken as RGB(A) unless this is set: then `channel` picks one.
    bool split_channels;
    enum pel_label_choice labels;
    // For headerless files (.raw, .bin, .img without header); `raw.dims[0] > 0` says they are given
    // and overrules any sidecar.
    struct {
        int dims[3];
        enum pel_voxel_type type;
        double spacing[3]; // millimetres; 0 = 1
        double origin[3];  // RAS millimetres of the centre of voxel (0,0,0)
        size_t offset;     // bytes to skip at the start of the file
        bool big_endian;   //
    } raw;
};

// Reads a volume. The format is told by content first and by name second: NRRD/NHDR, NIfTI-1/2
// (.nii .nii.gz .hdr/.img), MetaImage (.mhd .mha), TIFF (a stack in one file, a folder of slices,
// or a glob pattern in natural order; OME-TIFF), PVM, DICOM folders through the program dcm2niix
// when it is installed, and raw files with a JSON sidecar `NAME.json` or `options->raw`. Types that
// are not pel_voxel_types are converted, with a warning that says what was lost.
// Returns NULL on failure (FILE, FORMAT, MEMORY, UNSUPPORTED).
PEL_API struct pel_volume *pel_volume_load(const char *path,
                                           const struct pel_load_options *options);

// True for a label map, and for whole numbers that are mostly the same as their neighbours.
PEL_API bool pel_volume_seems_labels(const struct pel_volume *volume);

// Makes a volume of undefined voxels: 1 mm spacing, voxel (0,0,0) at the world's origin, slope 1.
// Fails (FORMAT) unless each of dims is in 1..65536.
PEL_API struct pel_volume *pel_volume_create(const char *name, const int dims[3],
                                             enum pel_voxel_type type);
PEL_API void pel_volume_destroy(struct pel_volume *volume);

// Lets one more hold the volume, and returns it: it is freed when each has destroyed it once. A
// volume that is shared must not be changed any more; its holders may then be different threads.
PEL_API struct pel_volume *pel_volume_share(struct pel_volume *volume);

// Bytes of one voxel (1 to 4), number of voxels, and bytes of all voxels.
PEL_API size_t pel_voxel_bytes(enum pel_voxel_type type);
PEL_API size_t pel_volume_voxel_count(const struct pel_volume *volume);
PEL_API size_t pel_volume_bytes(const struct pel_volume *volume);

// "uint8", "int8", "uint16", "int16", "float32", "rgb8", "rgba8", and back; false (ARGUMENT) for
// other names.
PEL_API const char *pel_voxel_type_name(enum pel_voxel_type type);
PEL_API bool pel_voxel_type_from_name(const char *name, enum pel_voxel_type *type);

// Distance between neighbouring voxel centres along i, j, k, in millimetres.
PEL_API void pel_volume_spacing(const struct pel_volume *volume, double spacing_mm[3]);

// The value of voxel (i,j,k) in the file's own unit; NaN where absent, as in a hypertexture. For
// colour volumes the alpha (RGBA) or the luminance (RGB, Rec. 709 weights), in 0..255.
PEL_API double pel_volume_value(const struct pel_volume *volume, int i, int j, int k);

#define PEL_HISTOGRAM_BINS 256

// What the values of a volume are like, absent voxels left out. In the file's own unit.
struct pel_statistics {
    double min, max, mean, deviation;
    size_t count, absent_count;
    uint64_t histogram[PEL_HISTOGRAM_BINS]; // equal bins over [min, max]
    double percentiles[101];                // percentiles[p]: p percent of the values are <= it
};

// Measures all voxels. A volume without any present voxel has min = max = 0, and a hypertexture
// each value in 0..1 as often.
PEL_API void pel_volume_measure(const struct pel_volume *volume, struct pel_statistics *statistics);

// New volumes from old; the source stays as it is. Values keep their meaning (slope, unit) and
// every voxel keeps its place in the world.
// - crop: voxels first[c] .. first[c] + dims[c] - 1
// - resample: trilinear, to `dims` voxels over the same cell extent
// - downsample: mean over blocks of factor^3 voxels (nearest for labels)
// - convert: to another type; values that do not fit are clamped, with a warning that counts them.
//   From a float type to an integer one slope and intercept are chosen to use the whole range.
// They fail (ARGUMENT) where `first` and `dims` are not inside the source, a number of voxels or
// the factor is below 1, or the source is a hypertexture.
PEL_API struct pel_volume *pel_volume_crop(const struct pel_volume *source, const int first[3],
                                           const int dims[3]);
PEL_API struct pel_volume *pel_volume_resample(const struct pel_volume *source, const int dims[3]);
PEL_API struct pel_volume *pel_volume_downsample(const struct pel_volume *source, int factor);
PEL_API struct pel_volume *pel_volume_convert(const struct pel_volume *source,
                                              enum pel_voxel_type type);

// Writes a volume, as the extension says: .nrrd .nhdr .nii .nii.gz .tif/.tiff .mhd .mha
// .raw (+ sidecar NAME.raw.json). Written to a temporary beside `path` and renamed at the end.
// Fails (ARGUMENT) for another extension and for a hypertexture, and (FILE).
PEL_API bool pel_volume_save(const struct pel_volume *volume, const char *path);

// A synthetic volume. `kind` is one of pel_generator_names.
struct pel_generate_options {
    int size;                 // voxels along the longest side; 0 = 64
    double spacing_mm;        // 0 = as the kind likes it, so that the object has a natural size
    enum pel_voxel_type type; // U8 (the default), U16 or F32
    bool second;              // of a pair ("head-pair"): the moving image instead of the fixed one
};

// Kinds: "sphere" (signed distance field), "box", "shells", "c60" (electron density of a
// buckyball from its 60 atom positions, after Romero 2009), "hydrogen" (an orbital),
// "marschner-lobb" (Marschner & Lobb 1994), "shepp-logan" (the 3-D head), "head-ct" and "head-mri"
// (one synthetic head, the MRI displaced by a known rigid transform), "head-labels" (its tissues: 1
// skin, 2 muscle, 3 bone, 4 marrow, 5 teeth, 6 fluid, 7 grey and 8 white matter, 9 eye, 10 lens),
// "head-pair" (the CT, or with `second` the MRI). The list ends with NULL. `options` may be NULL.
// Fails (ARGUMENT) for an unknown kind, a size beyond 65536, another type, or `second` of a kind
// that is no pair.
PEL_API const char *const *pel_generator_names(void);
PEL_API struct pel_volume *pel_volume_generate(const char *kind,
                                               const struct pel_generate_options *options);

// ---- Transfer functions ------------------------------------------------------------------------

// What the `value` of a control point counts.
enum pel_value_scale {
    PEL_VALUES_ABSOLUTE,   // the file's own unit
    PEL_VALUES_RELATIVE,   // 0..1 from the least to the greatest value of the volume
    PEL_VALUES_PERCENTILE, // 0..100, percentiles of the volume's values
};

struct pel_colour_point {
    double value, rgb[3]; // straight, 0..1
};

struct pel_opacity_point {
    double value, opacity; // 0..1 per `opacity_unit_mm`
};

// Maps a value to colour and opacity: piecewise linear between control points in ascending order
// of value, and constant beyond the outer ones. Two points of one value make a step.
struct pel_transfer {
    struct pel_colour_point *colours;    // owned
    struct pel_opacity_point *opacities; // owned
    int colour_count, opacity_count;     // each at least 1
    enum pel_value_scale scale;          //
    double opacity_unit_mm;              // opacity is reached over this length; > 0
    bool nearest;      // the table is read at its nearest entry, not between entries
    int table_entries; // entries of the table; 0 = 256 for 8-bit data, else 4096
};

// Ready-made transfer functions by name; the list ends with NULL. "grey", "hot", "viridis",
// "rainbow" (Romero 2009), "ct-bone", "ct-soft-tissue", "mri", "green", "magenta", ... Fails
// (ARGUMENT) for another name, with the nearest one.
PEL_API const char *const *pel_transfer_presets(void);
PEL_API struct pel_transfer *pel_transfer_preset(const char *name);

// Reads a transfer function: Pellucid's own JSON, or ParaView's colour-map JSON. Fails (FILE,
// FORMAT; UNSUPPORTED for a colour map without RGBPoints or in an unknown colour space).
PEL_API struct pel_transfer *pel_transfer_load(const char *path);

// Writes one as Pellucid's own JSON, through a temporary that is renamed at the end. Fails (FILE).
PEL_API bool pel_transfer_save(const struct pel_transfer *transfer, const char *path);

PEL_API struct pel_transfer *pel_transfer_copy(const struct pel_transfer *transfer);
PEL_API void pel_transfer_destroy(struct pel_transfer *transfer);

// Turns relative and percentile values into absolute ones, in place.
PEL_API void pel_transfer_resolve(struct pel_transfer *transfer,
                                  const struct pel_statistics *statistics);

// Straight colour and opacity (per opacity unit) at an absolute value. The function must be
// resolved.
PEL_API void pel_transfer_evaluate(const struct pel_transfer *transfer, double value,
                                   double rgba[4]);

// ---- Cameras -----------------------------------------------------------------------------------

// A pin-hole or orthographic camera in world millimetres.
struct pel_camera {
    double eye[3], target[3], up[3];
    double fov_deg;    // vertical field of view, 0 < fov < 180; ignored when orthographic
    double height_mm;  // of the view, when orthographic
    bool orthographic; //
    double shift[2];   // off-axis frustum: moves the picture's window right and up, in pictures'
                       // heights; 0 for an ordinary camera
};

// Axis-aligned bounds in world millimetres.
struct pel_bounds {
    double low[3], high[3];
};

// Looks at the bounds from a named side so that all of them are in the picture. `view` is one of
// "anterior", "posterior", "left", "right", "superior", "inferior" (the radiologist's names: seen
// *from* there) or "oblique". `aspect` is width / height. The camera keeps its field of view (0: 30
// degrees) and whether it is orthographic. Fails (ARGUMENT) for another name, and for bounds, an
// aspect or a field of view that are none.
PEL_API bool pel_camera_fit(struct pel_camera *camera, const char *view,
                            const struct pel_bounds *bounds, double aspect);

// The camera whose picture is a part of another's: `place` is its left and top edge, width and
// height, in shares of the whole, whose width / height is `aspect`. Rays through the same place of
// both are the same, up to rounding.
PEL_API struct pel_camera pel_camera_part(const struct pel_camera *whole, double aspect,
                                          const double place[4]);

// ---- Stereo ------------------------------------------------------------------------------------

// How the pictures of two eyes become one. docs/stereo.md has the formulae and their sources.
enum pel_stereo_kind {
    PEL_STEREO_NONE, // one eye: the scene's camera
    // Anaglyphs: each lens of the glasses, the left one named first, shows its eye one picture.
    PEL_STEREO_TRUE_RED_CYAN,
    PEL_STEREO_TRUE_GREEN_MAGENTA,
    PEL_STEREO_TRUE_AMBER_BLUE,
    PEL_STEREO_GREY_RED_CYAN,
    PEL_STEREO_GREY_GREEN_MAGENTA,
    PEL_STEREO_GREY_AMBER_BLUE,
    PEL_STEREO_COLOUR_RED_CYAN,
    PEL_STEREO_COLOUR_GREEN_MAGENTA,
    PEL_STEREO_COLOUR_AMBER_BLUE,
    PEL_STEREO_HALF_COLOUR_RED_CYAN,
    PEL_STEREO_HALF_COLOUR_GREEN_MAGENTA,
    PEL_STEREO_HALF_COLOUR_AMBER_BLUE,
    PEL_STEREO_OPTIMISED_RED_CYAN,
    PEL_STEREO_OPTIMISED_GREEN_MAGENTA,
    PEL_STEREO_OPTIMISED_AMBER_BLUE,
    PEL_STEREO_DUBOIS_RED_CYAN,
    PEL_STEREO_DUBOIS_GREEN_MAGENTA,
    PEL_STEREO_DUBOIS_AMBER_BLUE,
    PEL_STEREO_RED_BLUE,
    PEL_STEREO_RED_GREEN,
    PEL_STEREO_THESIS, // Romero's average of a cyan left and a red right picture, half as bright
    PEL_STEREO_MATRIX, // the user's own
    // Both pictures in one, the left eye's first; `swap` gives the other order.
    PEL_STEREO_SIDE_BY_SIDE,      // twice as wide
    PEL_STEREO_SIDE_BY_SIDE_HALF, // each squeezed to half its width
    PEL_STEREO_TOP_BOTTOM,        // twice as high
    PEL_STEREO_TOP_BOTTOM_HALF,   // each squeezed to half its height
    PEL_STEREO_ROW_INTERLACED,    // the left eye has rows 0, 2, 4, ... from the top
    PEL_STEREO_COLUMN_INTERLACED, // ... columns from the left
    PEL_STEREO_CHECKERBOARD,      // ... pixels whose column and row add up to an even number
    PEL_STEREO_TWO_FILES,         // as side by side, for a caller who saves each eye by itself
};

// Two cameras in place of the scene's, left and right of it. Zero-initialised: none.
struct pel_stereo {
    enum pel_stereo_kind kind;
    double separation_mm;  // of the two eyes, >= 0; 0 = automatic
    double convergence_mm; // distance along the view at which both eyes see things in one place of
                           // the picture; 0 = automatic
    bool flat;             // no separation at all: both eyes see the same
    bool toe_in;           // turn the cameras inwards instead of moving their windows
    bool reproject;      // the second eye's picture is the first one's, moved by the depth of what
                         // it shows, and rays only where that leaves holes (docs/stereo.md); not
                         // for interlaced kinds, which need no second picture
    bool swap;           // the left eye's picture goes where the right one's would, and vice versa
    double matrix[3][6]; // of PEL_STEREO_MATRIX: linear red, green and blue from the left eye's
                         // and the right eye's
};

// The names of the kinds, "none" first, in the order of the enum; the list ends with NULL.
PEL_API const char *const *pel_stereo_names(void);

// ---- Rigid transforms --------------------------------------------------------------------------

// Reads a rigid transform from world to world (RAS): an ITK .tfm (text, Euler3D, VersorRigid3D or
// affine; or the binary .mat of ANTs), an FSL FLIRT .mat, or a plain 4x4 of numbers. ITK files map
// points of the fixed image to the moving one in LPS, so the result is their inverse in RAS: it
// moves the moving volume onto the fixed. FSL's .mat maps between scaled voxel spaces and needs
// both volumes (`moving`, `fixed`); ARGUMENT if one is missing, but a .mat given neither is taken
// as a plain 4x4, with a warning. FORMAT if the result is not a rotation and translation; FILE;
// UNSUPPORTED for ITK's other kinds of transforms.
PEL_API bool pel_transform_load(struct pel_matrix *world_from_world, const char *path,
                                const struct pel_volume *moving, const struct pel_volume *fixed);

// Writes one, as the extension says: .tfm (ITK Euler3D), .mat (FSL, needs both volumes), or .txt
// (4x4). Fails (ARGUMENT) when it is no rotation and translation, for another extension, or without
// the volumes that FSL needs; and (FILE).
PEL_API bool pel_transform_save(const struct pel_matrix *world_from_world, const char *path,
                                const struct pel_volume *moving, const struct pel_volume *fixed);

// ---- Volumes in a scene ------------------------------------------------------------------------

// Where a volume's box ends: half a voxel beyond the outer voxel centres, with clamp-to-edge
// interpolation there, or at the centres as VTK and OpenVKL have it.
enum pel_extent { PEL_EXTENT_CELL, PEL_EXTENT_POINT };

// How values between voxels come about. The cubic ones take the 4^3 voxels around: the B-spline
// smooths, Catmull and Rom's spline goes through the voxels' values and may overshoot beyond them.
enum pel_filter {
    PEL_FILTER_LINEAR,
    PEL_FILTER_NEAREST,
    PEL_FILTER_CUBIC_B_SPLINE,
    PEL_FILTER_CATMULL_ROM,
};

// How light is gathered in a volume along a ray. docs/picture.md, "Optical models", has the
// formulae and what they do together.
enum pel_model {
    PEL_MODEL_DEFAULT,    // of a volume: the scene's; of the scene: absorption
    PEL_MODEL_ABSORPTION, // it emits and absorbs
    PEL_MODEL_EMISSION,   // it emits only: colour times the exact length in each voxel (Max 1995)
    PEL_MODEL_MIP,        // its greatest value on the ray
    PEL_MODEL_MINIP,      // its least
    PEL_MODEL_AVERAGE,    // the mean of its values
    PEL_MODEL_ISO,        // its surfaces of given values
    PEL_MODEL_THESIS,     // Romero 2009: opacity per sample, not per length. Wrong by design
};

// The names of the optical models, "default" first, in the order of the enum; the list ends with
// NULL.
PEL_API const char *const *pel_model_names(void);

#define PEL_SURFACE_MAX 4

// A surface of model iso: where a volume has this value.
struct pel_surface {
    double value;   // in the file's own unit
    double opacity; // 0..1
    bool coloured;  // it has a colour of its own; otherwise the transfer function's
    double rgb[3];  // straight, 0..1
};

// How gradients are found: from values one voxel away along the volume's axes, the same smoothed
// across them (Sobel), or as the derivative of the filter itself.
enum pel_gradient { PEL_GRADIENT_CENTRAL, PEL_GRADIENT_SOBEL, PEL_GRADIENT_ANALYTIC };

#define PEL_GRADIENT_POINT_MAX 4
#define PEL_OPACITY_FACTOR_MAX 1000.0
#define PEL_SILHOUETTE_EXPONENT_MIN 0.25
#define PEL_SILHOUETTE_EXPONENT_MAX 1000.0

// A volume's extinction is multiplied by a function of its gradient's length (after Levoy 1988):
// linear between points, constant beyond the outer ones.
struct pel_gradient_point {
    double gradient; // in the file's unit per millimetre, ascending
    double factor;   // 0..PEL_OPACITY_FACTOR_MAX
};

// And by base + strength (1 - |n.v|)^exponent, so that surfaces seen from the side stand out (Ebert
// & Rheingans 2000). All zero: not at all.
struct pel_silhouette {
    double base, strength, exponent;
};

// How a volume is shaded: not at all, or with highlights where the half-way vector between light
// and viewer (Blinn 1977) or the mirrored light (Phong 1975) is near the normal.
enum pel_shading { PEL_SHADING_NONE, PEL_SHADING_BLINN_PHONG, PEL_SHADING_PHONG };

#define PEL_LIGHT_AMOUNT_MAX 1000.0 // of ambient, diffuse, specular, and light
#define PEL_SHININESS_MAX 1000.0

// How light changes a volume's colours: c' = c (ambient + diffuse |n.l|) + specular |n.h|^shininess
// (docs/picture.md, "Shading"). Opacity stays. When all four numbers are zero they are those of
// pel_material_default.
struct pel_material {
    enum pel_shading shading;
    bool one_sided; // light that comes from the side of greater values does not count
    double ambient, diffuse, specular; // 0..PEL_LIGHT_AMOUNT_MAX
    double shininess;                  // 1..PEL_SHININESS_MAX
};

// VTK's and ours: ambient 0.1, diffuse 0.7, specular 0.2, shininess 10, two-sided.
PEL_API struct pel_material pel_material_default(enum pel_shading shading);

#define PEL_CLIP_MAX 8

enum pel_clip_kind { PEL_CLIP_PLANE, PEL_CLIP_BOX };

// What is kept of a volume, or of all: one side of a plane, or the inside or outside of a box
// (docs/mixing.md, "Clipping"). Of several all must hold. Gradients are those of the whole volume.
struct pel_clip {
    enum pel_clip_kind kind;
    bool outside;     // keep what is behind the plane, or cut the box's inside away
    bool in_world;    // of a volume's: stays where it is when `transform` moves the volume
    double point[3];  // of the plane, or the middle of the box; millimetres
    double normal[3]; // of the plane, towards what is kept; any length but zero
    double size[3];   // of the box
    double xyzw[4];   // rotation of the box about its middle; all zero for none
};

#define PEL_MASK_RANGE_MAX 32

// Values from low to high, both included, in the file's own unit. A label is a range of its own.
struct pel_value_range {
    double low, high;
};

// An instance is shown only where another one's volume, a label map for example, has a value in one
// of the ranges, taken from the nearest voxel; or only elsewhere. Whether the other one is hidden,
// clipped or masked itself makes no difference. docs/mixing.md, "Masks".
struct pel_mask {
    int instance;    // whose values decide; not its own, and not one that it decides about in turn
    int range_count; // 0: there is no mask
    struct pel_value_range ranges[PEL_MASK_RANGE_MAX];
    bool inverted;
};

// The values of a mask as text: numbers, ranges such as 3..5, and >=0.5, with commas between them.
// Reading fails (ARGUMENT) and leaves the mask alone when the text is none of these; writing cuts
// what has no room in `bytes`.
PEL_API bool pel_mask_read_values(struct pel_mask *mask, const char *text);
PEL_API void pel_mask_write_values(const struct pel_mask *mask, char *text, size_t bytes);

// One volume as it stands in a scene. Several instances may show one volume.
struct pel_instance {
    char name[64];
    int volume;                  // index into the scene's volumes
    bool hidden;                 //
    struct pel_matrix transform; // rigid, world from world: applied after the file's own placement
    double density;              // multiplies the extinction; >= 0
    enum pel_extent extent;      //
    enum pel_filter filter;      //
    struct pel_transfer *transfer; // owned, resolved
    struct pel_material material;  //
    enum pel_gradient gradient;    //
    int gradient_opacity_count;    // 0: opacity does not depend on the gradient
    struct pel_gradient_point gradient_opacity[PEL_GRADIENT_POINT_MAX];
    struct pel_silhouette silhouette;
    double step;          // of its samples, in its own finest voxels; 0 = the scene's
    double step_mm;       // the same in millimetres, instead of `step`; 0 = as `step` says
    enum pel_model model; //
    bool preintegration;  // of absorption: what lies between two samples counts
    int surface_count;    // of model iso; 0: one of the middle value, opaque
    struct pel_surface surfaces[PEL_SURFACE_MAX];
    int clip_count;
    struct pel_clip clips[PEL_CLIP_MAX];
    double priority; // of PEL_MIX_PRIORITY: the greater one wins, of equals the first in the list
    struct pel_mask mask;
};

// ---- Light -------------------------------------------------------------------------------------

#define PEL_LIGHT_MAX 8

enum pel_light_kind {
    PEL_LIGHT_HEADLIGHT,   // shines along each ray
    PEL_LIGHT_CAMERA,      // shines along the camera's forward axis
    PEL_LIGHT_DIRECTIONAL, // shines along `direction`
    PEL_LIGHT_POINT,       // shines from `position`, equally bright at every distance
};

// What shaded volumes are lit by. Shadows are a setting of the picture (pel_shadows).
struct pel_light {
    enum pel_light_kind kind;
    double direction[3], position[3]; // in the world; a direction has any length but zero
    double colour[3], intensity;      // their product is in 0..PEL_LIGHT_AMOUNT_MAX
};

#define PEL_SECONDARY_STEP_MIN 0.25
#define PEL_SECONDARY_STEP_MAX 64.0

// Light on shaded volumes has come through all volumes on its way (docs/picture.md, "Shadows and
// ambient occlusion"). Costs a ray for every light of every sample: for stills.
struct pel_shadows {
    bool on;
    double length_mm; // how far away what casts a shadow may be; 0 = anywhere
    double step;      // of these rays, in steps of the picture; 0 = 2
    double strength;  // share of the light that shadows take, up to 1; 0 = 1
};

#define PEL_OCCLUSION_DIRECTION_MAX 64

// Shaded volumes are darker where much of what is around is hidden by something near.
struct pel_ambient_occlusion {
    bool on;
    int directions;   // rays from every sample, up to PEL_OCCLUSION_DIRECTION_MAX; 0 = 16
    double radius_mm; // how far they look; 0 = a tenth of the diagonal of all volumes
    double step;      // of these rays, in steps of the picture; 0 = 2
    double strength;  // share of the light that is taken, up to 1; 0 = 1
};

// ---- How a picture is rendered -----------------------------------------------------------------

// How overlapping volumes share one sample. docs/mixing.md has formulae, pictures and sources.
enum pel_mixing {
    PEL_MIX_SUM,  // extinctions add, colour is the extinction-weighted mean; order does not matter
    PEL_MIX_OVER, // blended front to back at each sample in the order of the list
    PEL_MIX_ORDERED,  // each volume keeps its own step; samples are blended as they come on the ray
    PEL_MIX_MAX,      // the volume of the greatest extinction hides the others
    PEL_MIX_PRIORITY, // the volume of the greatest `priority` that shows anything hides the others
    // Of constructive solid geometry, on extinctions; colours are means as in sum, of difference
    // the first volume's.
    PEL_MIX_UNION,        // the greatest
    PEL_MIX_INTERSECTION, // the least, of all visible volumes
    PEL_MIX_DIFFERENCE,   // the first visible volume's less all others'
};

// The names of the kinds of mixing in the order of the enum; the list ends with NULL.
PEL_API const char *const *pel_mixing_names(void);

// From which end the samples of a ray are put together.
enum pel_order { PEL_ORDER_FRONT_TO_BACK, PEL_ORDER_BACK_TO_FRONT };

// Where the samples of a ray are counted from.
enum pel_sample_origin {
    PEL_ORIGIN_VOLUMES, // the nearest entry into any visible volume's own box
    PEL_ORIGIN_BOUNDS,  // the entry into the world-axis-aligned bounds of all visible volumes, as
                        // VTK
};

// How empty space is skipped. The picture is the same with each.
enum pel_skip {
    PEL_SKIP_AUTO,     // what is fastest as a rule (docs/skipping.md): mostly distance
    PEL_SKIP_NONE,     // every sample is taken
    PEL_SKIP_GRID,     // empty cells of 4^3 voxels are left one by one
    PEL_SKIP_DISTANCE, // and many at once, by the distance to the nearest cell that is not empty
    PEL_SKIP_OCTREE,   // empty nodes of an octree over the same cells are left one by one
    PEL_SKIP_BVH,      // from cluster to cluster of bricks, by a bounding volume hierarchy
    PEL_SKIP_BLOCKS,   // from block to block beside it, and by the sub-blocks in them
};

// Room for the reason of a choice.
enum { PEL_SKIP_REASON_BYTES = 64 };

// Whether only those bricks of 16^3 voxels are on the device in which something can be seen. They
// are read through a table; the picture is the same.
enum pel_pool_use {
    PEL_POOL_AUTO, // where the volumes do not fit otherwise
    PEL_POOL_OFF,
    PEL_POOL_ON,
};

// The cubes of voxels in which PEL_SKIP_BVH (Ganter & Manzke 2019) and PEL_SKIP_BLOCKS (Derin et
// al. 2021; its sub-blocks) look for what is visible.
struct pel_brick_settings {
    int size;   // voxels along a side: 8, 16, 32, 64 or 128; 0 = 16, or 8 for blocks; with a pool
                // at least 16
    bool apart; // of bvh: each active brick is a cluster of its own
    bool stay;  // of blocks: every next one is searched for, instead of walking to the one beside
    bool keep;  // of blocks: none are culled by what the transfer function shows
    enum pel_pool_use pool;
};

// Where the n x n rays of a pixel go through it. See docs/picture.md for the sources.
enum pel_pattern {
    PEL_PATTERN_REGULAR,        // in the middles of n x n cells
    PEL_PATTERN_JITTERED,       // anywhere in each of n x n cells
    PEL_PATTERN_ROOKS,          // one in each of n^2 columns and of n^2 rows
    PEL_PATTERN_MULTI_JITTERED, // both of the former two
    PEL_PATTERN_HAMMERSLEY,     // evenly spaced along x, by the radical inverse along y
};

// How the rays become a pixel.
enum pel_reconstruction {
    PEL_RECONSTRUCTION_BOX,      // the mean of its own
    PEL_RECONSTRUCTION_GAUSSIAN, // weighted by distance, with those of its eight neighbours
};

#define PEL_SUPERSAMPLING_MAX 8

// More than one ray per pixel. All-zero is one ray through its centre.
struct pel_supersampling {
    int n;                          // n x n rays, up to PEL_SUPERSAMPLING_MAX; 0 = 1
    enum pel_pattern pattern;       //
    enum pel_reconstruction filter; //
    uint32_t seed;   // of patterns and of jitter: the same seed gives the same picture
    double adaptive; // when above 0, only pixels that differ from a neighbour by more than this in
                     // any channel, 0..1, get n x n rays, and the others one; 0 = all pixels do
};

// Whether volumes are shown coarser than they are, where the picture does not show the difference
// (docs/picture.md, "Level of detail"). A renderer makes levels when they are first needed and
// keeps them while their volumes stay in the scene; where a frame needs other levels than the one
// before, all voxels are sent to the device anew.
enum pel_lod {
    PEL_LOD_OFF,   // as they are
    PEL_LOD_AUTO,  // each at the level at which its voxels are about as large as a pixel
    PEL_LOD_LEVEL, // all at `lod_level`
};

#define PEL_LOD_LEVEL_MAX 15

// What a picture shows of each pixel's ray instead of its light: a number, as a heat map. One ray
// goes through each pixel's centre, whatever the supersampling.
enum pel_debug {
    PEL_DEBUG_NONE,
    PEL_DEBUG_SAMPLES,    // samples taken
    PEL_DEBUG_SPANS,      // spans of the ray with a constant set of volumes
    PEL_DEBUG_VOLUMES,    // volumes crossed in which something may be visible: depth complexity
    PEL_DEBUG_WORK_GROUP, // which work-group made the pixel, a colour each
    PEL_DEBUG_WORK_ITEM,  // which work-item of its group
    PEL_DEBUG_TIME,       // milliseconds that the pixel's tile took, each launched on its own
    PEL_DEBUG_CLUSTERS,   // of skip bvh: clusters that the ray crosses; of blocks: blocks
    PEL_DEBUG_NODES,      // and nodes of the hierarchy over them
};

// Everything about a picture that is neither a volume's nor a camera's. pel_scene_create has the
// defaults.
struct pel_render_settings {
    int width, height;      // pixels
    int region[4];          // the part of it that is rendered: left and top edge, width and height
                            // in pixels; all zero: all of it
    enum pel_mixing mixing; //
    double step;            // in voxels of the finest visible volume; > 0
    double step_mm;         // the same in millimetres, instead of `step`; 0 = as `step` says
    // Where volumes are locally thin or smooth, one sample stands for a run of two or four: as long
    // as what lies in the run cannot vary by more than this optical depth. 0 = samples are evenly
    // spaced. docs/picture.md, "Adaptive steps", has the rule and docs/quality.md the errors.
    double adaptive_step;
    enum pel_model model;  // of volumes that have none of their own
    bool preintegration;   // of all volumes: see pel_instance
    enum pel_order order;  // back to front no ray ends early
    double emission_scale; // of model emission, per mm; 0 = 1 over the longest way through a volume
    double phase;          // of the first sample, in steps; 0..1
    double termination;    // a ray ends once its opacity exceeds this; 1 = never
    enum pel_sample_origin origin;
    enum pel_skip skip; //
    struct pel_brick_settings bricks;
    struct pel_supersampling supersampling;
    bool jitter;          // every ray has a random phase of its own in place of `phase`
    enum pel_debug debug; //
    struct pel_shadows shadows;
    struct pel_ambient_occlusion ambient_occlusion; // its directions follow the seed
    enum pel_lod lod; // labels, and volumes of filter nearest, stay as they are
    int lod_level;    // 0..PEL_LOD_LEVEL_MAX: voxels of 2^level times their shortest side
};

// ---- Scenes ------------------------------------------------------------------------------------

#define PEL_WALL_MAX 32

// One window or monitor of a display wall.
struct pel_wall_region {
    double place[4]; // left and top edge, width and height, in shares of the whole picture
    int monitor;     // which one it fills, counted from 0; -1: none, it is a window
    char device[64]; // what renders it, as pel_renderer_options has it; "" = what renders the rest
};

// One picture over several windows or monitors; what lies between the regions is hidden by bezels.
struct pel_wall {
    int region_count; // 0: no wall
    struct pel_wall_region regions[PEL_WALL_MAX];
};

// Where a scene says that its picture goes.
struct pel_output_settings {
    char path[1024];    // "" when the scene names none
    int depth;          // of PNG: 8 or 16
    bool premultiplied; // PNG alpha as computed instead of straight
};

// How long a scene's animation is, and which of its frames the scene shows.
struct pel_timeline {
    int frame_count; // 0: there is no animation
    double fps;      // frames per second
    double frame;    // 0..frame_count
};

// What a scene was made of, for pel_scene_set_frame.
struct pel_scene_source;

// Where a volume's voxels came from, so that a scene file can say it. All-zero: from the program.
struct pel_volume_source {
    char *file; // owned by the scene; as pel_volume_load takes it
    struct pel_load_options load;
    const char *kind; // one of pel_generator_names, when there is no file
    struct pel_generate_options generate;
    double spacing[3]; // replaces the file's; 0 = does not
    char *recipe;      // owned by the scene; of a hypertexture, as pel_renderer_bake takes it
    struct {
        int size;
        enum pel_voxel_type type;
        uint32_t seed;
        double time;
        bool live, wrap;
    } hypertexture;
    struct pel_volume *object; // that it grows on; shared
};

// A scene in memory. Instances are drawn in any order but listed in the user's; `over` follows it.
struct pel_scene {
    struct pel_camera camera;
    double background[4];                             // straight RGBA, 0..1
    int volume_count;                                 // distinct volumes in memory
    struct pel_volume *volumes[PEL_VOLUME_MAX];       // owned, perhaps shared
    struct pel_statistics statistics[PEL_VOLUME_MAX]; // of each volume
    struct pel_volume_source sources[PEL_VOLUME_MAX]; // of each volume
    int instance_count;
    struct pel_instance instances[PEL_VOLUME_MAX];
    int light_count; // 0: one white headlight
    struct pel_light lights[PEL_LIGHT_MAX];
    int clip_count; // of all volumes, in the world
    struct pel_clip clips[PEL_CLIP_MAX];
    struct pel_render_settings render;
    struct pel_stereo stereo;
    struct pel_wall wall; // of the viewer; pictures are rendered whole
    struct pel_output_settings output;
    struct pel_timeline timeline;
    char *text; // owned; the scene as JSON after all overrides, as it goes into the picture
    struct pel_scene_source *source; // owned, perhaps shared; NULL unless it was loaded
};

// Reads a scene file, or one or more volume files in place of a scene (then: a percentile window,
// a fitted camera, and a colour each). `overrides` are "key=value" strings such as
// "camera.fov=40" or "volumes.0.density=0.2", applied to the JSON before it is checked; values are
// JSON, or plain words. Paths in a file are relative to it, others to the working directory. Errors
// read FILE:LINE:COLUMN: KEY: what is wrong, with the nearest known key for an unknown one.
PEL_API struct pel_scene *pel_scene_load(const char *path, const char *const *overrides,
                                         int override_count);
PEL_API struct pel_scene *pel_scene_from_files(const char *const *paths, int path_count,
                                               const char *const *overrides, int override_count);
PEL_API void pel_scene_destroy(struct pel_scene *scene);

// An empty scene with every default, to be filled by a program. NULL: MEMORY.
PEL_API struct pel_scene *pel_scene_create(void);

// A scene that can be changed without changing this one. Both share their volumes, so it is cheap:
// a viewer can keep one for each step that may be undone. NULL: MEMORY.
PEL_API struct pel_scene *pel_scene_copy(const struct pel_scene *scene);

// The scene as JSON: what pel_scene_save writes to `path`, whose folder the files in it are
// relative to. NULL gives it compact, with absolute paths, as for the text in a picture. Memory to
// free(), or NULL on failure (MEMORY; ARGUMENT when a volume came from no file).
PEL_API char *pel_scene_text(const struct pel_scene *scene, const char *path);

// Writes a scene file, through a temporary that is renamed at the end. Loading it gives a scene
// that renders to the same picture.
PEL_API bool pel_scene_save(const struct pel_scene *scene, const char *path);

// ---- Changing scenes ---------------------------------------------------------------------------

// Puts a volume at the end of the list, with an automatic transfer function, as for files given in
// place of a scene. The scene shares the volume, so the caller still destroys it. `source`, which
// may be NULL, is copied; without one the scene cannot be saved. The first volume of a scene whose
// camera was never set brings an oblique view of it. Returns the new instance's index, or -1 when
// there are PEL_VOLUME_MAX already (ARGUMENT) or memory ran out; the scene is then as before.
PEL_API int pel_scene_add_volume(struct pel_scene *scene, struct pel_volume *volume,
                                 const struct pel_volume_source *source);

// Loads a file and adds it. Returns the new instance's index, or -1 with the scene as before.
// `options` may be NULL.
PEL_API int pel_scene_add_file(struct pel_scene *scene, const char *path,
                               const struct pel_load_options *options);

// Adds the copy of an instance behind the others; both show one volume. Returns its index or -1.
PEL_API int pel_scene_add_copy(struct pel_scene *scene, int instance);

// Takes one instance out of the list, and its volume out of memory when nothing else shows it. What
// it was the mask of is then shown whole. The last one cannot be removed (ARGUMENT): a scene
// without volumes is none.
PEL_API bool pel_scene_remove(struct pel_scene *scene, int instance);

// Takes an instance out of its place in the list and puts it at `to`; those between move up.
PEL_API bool pel_scene_move(struct pel_scene *scene, int instance, int to);

// Reads the file of a volume again, which may have changed on disk. Transfer functions and
// transforms stay. Fails as pel_volume_load does, and ARGUMENT for a volume without a source; the
// scene is then as before.
PEL_API bool pel_scene_reload(struct pel_scene *scene, int volume);

// Chooses steps, termination and supersampling for a quality of 0 (a draft) to 1 (the best there
// is; 0.5 is near the defaults). Volumes get steps of their own, by their spacing and by the
// greatest opacity of their transfer functions. docs/picture.md, "Quality", has the rule and the
// errors.
PEL_API void pel_scene_set_quality(struct pel_scene *scene, double quality);

// ---- Animations --------------------------------------------------------------------------------

// Makes a scene with an animation show another frame, whole or between two: it is as if it had been
// loaded with the values of that frame, but volumes that stay are not loaded again, so that nothing
// of them is sent to a device anew. What the caller changed in the scene since is lost. Fails
// (ARGUMENT) when there is no animation or no such frame, and like pel_scene_load when a value
// cannot be; the scene then stays as it was.
PEL_API bool pel_scene_set_frame(struct pel_scene *scene, double frame);

// A viewpoint and when the camera is there.
struct pel_keyframe {
    double time_s; // from the first frame
    struct pel_camera camera;
};

// Makes recorded viewpoints, in the order of their times, the way of the scene's camera, in place
// of what moved it before; none takes its motion away. Other tracks stay. What was changed in the
// scene since it was loaded is now what its animation acts upon, and no longer lost in
// pel_scene_set_frame. Fails (ARGUMENT) when times do not ascend or a volume came from no file; the
// scene then stays as it was.
PEL_API bool pel_scene_set_keyframes(struct pel_scene *scene, const struct pel_keyframe *keyframes,
                                     int count, double fps);

// Reads back the viewpoints of the way of the scene's camera, as pel_scene_set_keyframes or a file
// put them there: `most` of them at most. Returns how many there are; 0 when the camera moves by
// other tracks (orbits, named views, single members), or not at all.
PEL_API int pel_scene_keyframes(const struct pel_scene *scene, struct pel_keyframe *keyframes,
                                int most);

// What was changed in the scene since it was loaded becomes what its animation acts upon, so that
// pel_scene_set_frame does not lose it. Fails like pel_scene_set_keyframes, with the scene as it
// was.
PEL_API bool pel_scene_rebase(struct pel_scene *scene);

// ---- Asking about scenes -----------------------------------------------------------------------

// The world bounds of one instance's box, and of all visible instances (false if there is none).
PEL_API void pel_instance_bounds(const struct pel_scene *scene, int instance,
                                 struct pel_bounds *bounds);
PEL_API bool pel_scene_bounds(const struct pel_scene *scene, struct pel_bounds *bounds);

// The cameras whose pictures go into the left and the right eye's place (`swap` exchanges them),
// and the separation and convergence they were made with, which are chosen from the depth of the
// visible volumes where the scene leaves them open. `used` may be NULL. Cameras are moved half the
// separation to either side and keep their direction; their windows shift so that they agree at the
// convergence distance. With `toe_in`, or when orthographic, they turn to the point at that
// distance instead. Fails (ARGUMENT) when the scene's camera or a length is no such thing.
PEL_API bool pel_stereo_cameras(const struct pel_scene *scene, struct pel_camera cameras[2],
                                struct pel_stereo *used);

// Bricks of one volume, or of all together. The times are those of the last change of what is
// visible.
struct pel_brick_statistics {
    int size;                                // voxels along a side; 0: there are none
    uint64_t total, active, clusters;        // of blocks: sub-blocks, those stored, blocks
    uint64_t resident;                       // of the pool, on the device; 0 without one
    double activity_ms, cluster_ms, tree_ms; // finding the active bricks, clusters, hierarchy
};

// How the bricks of a volume cluster (Ganter & Manzke 2019, table 1).
struct pel_brick_report {
    struct pel_brick_statistics bricks;
    // Clusters that a ray of the scene's camera crosses, the mean over 64 x 64 rays that cover the
    // picture, of those that cross any; and the same with every brick a cluster of its own.
    double depth, depth_apart;
};

#define PEL_BRICK_SIZES 5 // of 8, 16, 32, 64 and 128 voxels

// Measures an instance with its transfer function, for every size of bricks, on the host. False:
// ARGUMENT, also for a hypertexture, MEMORY.
PEL_API bool pel_scene_measure_bricks(const struct pel_scene *scene, int instance,
                                      struct pel_brick_report reports[PEL_BRICK_SIZES]);

// Which way to skip PEL_SKIP_AUTO takes for a scene on a device that has room for all its volumes,
// and why in a few words. False: ARGUMENT, MEMORY.
PEL_API bool pel_scene_choose_skip(const struct pel_scene *scene, enum pel_skip *skip,
                                   char reason[PEL_SKIP_REASON_BYTES]);

// ---- Devices -----------------------------------------------------------------------------------

// How kernels read voxels.
enum pel_reader {
    PEL_READER_AUTO,   // as the device likes it
    PEL_READER_BUFFER, // from buffers, interpolated by the kernel
    PEL_READER_IMAGE,  // from 3-D images, interpolated by the device, to its precision
};

#define PEL_DEVICE_MAX 32

// What a device is, and what Pellucid can do with it.
struct pel_device_info {
    char name[128], vendor[128], platform[128], driver[128], version[128];
    bool gpu, cpu; // neither: an accelerator
    bool usable;   // false: `problem` says why Pellucid cannot use it
    char problem[160];
    int compute_units;
    uint64_t memory_bytes, max_allocation_bytes, max_constant_bytes, local_bytes;
    bool images;            // 3-D images exist
    bool gl_sharing;        // it can write buffers of OpenGL (cl_khr_gl_sharing)
    size_t max_image[3];    // voxels
    int native_float_width; // lanes of the device's vectors
    size_t max_work_group;
    // What Pellucid would choose for it.
    enum pel_reader reader;
    int lanes, work_group;
};

// Finds every device of every platform, in the order `--device N` counts them. A platform that
// fails is reported as a warning and left out. Returns how many were written (at most
// PEL_DEVICE_MAX); 0 with an error set (DEVICE) when there is no platform at all.
PEL_API int pel_device_list(struct pel_device_info *devices);

// ---- Rendering ---------------------------------------------------------------------------------

// An OpenGL context whose buffers a renderer is to write, so that pictures come to a window without
// the host's memory. The handles are OpenCL's CL_GL_CONTEXT_KHR and CL_GLX_DISPLAY_KHR or
// CL_EGL_DISPLAY_KHR; the library itself calls no OpenGL. The context must live longer than the
// renderer and be current in the thread that uses the renderer, creating and destroying included,
// whenever pel_render_options.gl_buffer is used; drivers differ in when they need that.
enum pel_gl_platform { PEL_GL_NONE, PEL_GL_GLX, PEL_GL_EGL };
struct pel_gl {
    enum pel_gl_platform platform;
    void *context; // GLXContext or EGLContext
    void *display; // Display * or EGLDisplay
};

// Which device to render on, and how. Zero-initialise for the defaults.
struct pel_renderer_options {
    const char *device; // an index into pel_device_list ("0"), a type ("gpu", "cpu") or part of a
                        // name; NULL = $PELLUCID_DEVICE, else the first usable GPU, else the first
                        // usable device
    enum pel_reader reader;
    int lanes;                     // rays per work-item: 1, 4, 8 or 16; 0 = as the device likes it
    int work_group;                // work-items per work-group; 0 = as the device likes it
    int work_group_rows;           // packets of rays above each other in one; 0 = 1
    uint64_t max_allocation_bytes; // lowers the device's own limit (for tests); 0 = the device's
    int compute_units;             // of a device that can be divided; 0 = all
    struct pel_gl gl;              // to share buffers with, where the device can; else ignored
};

// A picture. Four floats a pixel: red, green and blue multiplied by alpha, then alpha, which is in
// 0..1.
struct pel_image {
    int width, height;
    float *rgba; // owned; rows from the top, without padding. NULL: the picture is in a buffer of
                 // OpenGL, which only pel_render_options.gl_buffer asks for
};

// The numbers of a debug view over the picture's pixels.
struct pel_debug_range {
    double min, max, mean;
};

// What the device says of the kernel that rendered a frame.
struct pel_kernel_info {
    size_t max_work_group;               // work-items
    size_t work_group_multiple;          // that it likes work-groups to be of
    uint64_t private_bytes, local_bytes; // of each work-item, and of each work-group
};

// The levels of detail of one frame.
struct pel_lod_statistics {
    int levels[PEL_VOLUME_MAX]; // of each instance; 0: its volume as it is
    uint64_t bytes;             // of all voxels that are shown; 0 when lod is off
    double ms;                  // for making levels that were not there yet
};

// Room for the reason why a picture is not in OpenGL's buffer.
enum { PEL_GL_REASON_BYTES = 128 };

// What one frame took.
struct pel_render_statistics {
    char device[128], driver[128];
    enum pel_reader reader;
    int lanes, work_group;
    uint64_t samples;            // taken inside volumes, all rays together
    uint64_t samples_skipped;    // others, where skipping has found nothing to see
    uint64_t samples_terminated; // and those behind the end of a ray that ended early
    uint64_t samples_spared;     // and those that others stand for, by adaptive steps
    uint64_t boxes_entered;      // boxes of volumes that packets of rays came to, all together
    uint64_t rays;               //
    double refined;              // share of the pixels that got all their rays: 1 unless adaptive
    uint64_t device_bytes;       // allocated on the device at the end of the frame
    uint64_t uploaded_bytes;     // sent to the device for this frame
    struct pel_kernel_info kernel;
    enum pel_skip skip;
    char skip_reason[PEL_SKIP_REASON_BYTES]; // of auto: why this one; "": it was asked for
    uint64_t skip_bytes;                     // of device_bytes, those for skipping
    struct pel_brick_statistics bricks;
    double prepare_ms, build_ms, upload_ms, skip_ms, render_ms, download_ms;
    struct pel_debug_range debug; // of the scene's debug view, zeros without one
    struct pel_lod_statistics lod;
    // Of two eyes; all of the above is then their sum.
    struct {
        double separation_mm, convergence_mm; // as they were used
        double compose_ms;                    // putting the pictures together
        double reprojected;                   // share of the second eye's pixels that no ray was
                                              // cast for; 0 without reprojection
        double reproject_ms;                  // of render_ms's frame, moving them
        uint64_t eye_samples[2];              // of the first eye, and of the second; an interlaced
                                              // picture's are all counted as the first one's
    } stereo;
    char gl_reason[PEL_GL_REASON_BYTES]; // why the picture is not in gl_buffer; "": it is, or was
                                         // not asked to be
};

// Called between batches of tiles with the finished share, 0..1. Return false to abandon the frame:
// pel_renderer_render then fails (ARGUMENT), and the next frame is as if nothing had been.
typedef bool (*pel_progress_callback)(double finished, void *user);

// What a call for a picture may ask for. Zero-initialise for the defaults.
struct pel_render_options {
    pel_progress_callback progress;
    void *user;
    double batch_ms; // what a batch should take: how soon a frame can be abandoned; 0 = 150
    float *numbers;  // receives a debug view's number of each pixel, rows from the top; may be NULL
    // The name of a buffer of OpenGL, of 4 bytes a pixel and more, in which the picture is wanted
    // as 8-bit RGBA, rows from the top, rounded as in a file; 0 = none. OpenGL must be done with
    // the buffer (glFinish) before the call; OpenCL is when it returns. Where the picture cannot be
    // left there, because it is put together on the host or the device does not share buffers, the
    // image has its pixels as always, and the statistics say why.
    uint32_t gl_buffer;
};

// Opens a device. Fails (DEVICE, ARGUMENT) with a sentence that lists what was found.
PEL_API struct pel_renderer *pel_renderer_create(const struct pel_renderer_options *options);
PEL_API void pel_renderer_destroy(struct pel_renderer *renderer);

// Renders one picture of the scene, background included; of a scene in stereo both eyes composed.
// Voxels, tables and kernels stay on the device for the next call, which uploads only what changed.
// Refuses (DEVICE, with needed and available bytes) before anything is allocated on it when the
// scene fits nowhere, settings that make no sense (ARGUMENT), and images on a device without them
// (UNSUPPORTED). `options` and `statistics` may be NULL. The caller owns the image.
PEL_API struct pel_image *pel_renderer_render(struct pel_renderer *renderer,
                                              const struct pel_scene *scene,
                                              const struct pel_render_options *options,
                                              struct pel_render_statistics *statistics);

// Lets go of a buffer of OpenGL that pictures were left in: before its store is made anew or it is
// deleted. It may be one that the renderer never saw.
PEL_API void pel_renderer_forget_gl(struct pel_renderer *renderer, uint32_t gl_buffer);

// Renders the pictures of both eyes, each of the scene's size, in one go. A scene without stereo
// gives the same picture twice. The caller owns both; on failure there is neither.
PEL_API bool pel_renderer_render_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                                      const struct pel_render_options *options,
                                      struct pel_render_statistics *statistics,
                                      struct pel_image *eyes[2]);

// Makes one picture of two of the same size, as `stereo->kind` says (`swap` is the cameras'
// matter). ARGUMENT when the sizes differ, when a squeezed side is odd, or when a matrix is not
// finite. With PEL_STEREO_NONE it is a copy of the left one.
PEL_API struct pel_image *pel_stereo_compose(const struct pel_stereo *stereo,
                                             const struct pel_image *left,
                                             const struct pel_image *right);

// ---- Probing a ray -----------------------------------------------------------------------------

// A stretch of a ray with a constant set of volumes, at least one.
struct pel_probe_span {
    double from_mm, to_mm; // from the ray's origin: the first sample, and a step behind the last
    uint32_t instances;    // bit k: instance k of the scene is there
};

// A sample of one volume. Between those listed, the others were skipped.
struct pel_probe_sample {
    int instance, number; // of the sample along the ray, 0 the first one
    int steps;            // that it stands for; above 1 it lies in the middle of them
    double distance_mm;   // from the ray's origin
    double position[3];   // in the world
    double value;         // in the file's own unit; NaN where absent
    double opacity;       // that one step of this volume has here; 0: nothing to be seen
    double rgb[3];        // straight, shaded; 0 where nothing is to be seen
    double accumulated;   // opacity that the ray had gathered before it
};

#define PEL_PROBE_SAMPLE_MAX 65536

// What the ray through one pixel's centre meets.
struct pel_probe {
    double origin[3], direction[3]; // in the world; the direction has length 1
    int span_count, sample_count;
    struct pel_probe_span *spans;     // owned
    struct pel_probe_sample *samples; // owned; PEL_PROBE_SAMPLE_MAX at most
    bool cut;                         // there were more samples than that
    double rgba[4];                   // premultiplied, background included
};

// Follows the ray through the centre of pixel (x, y), counted from the top left, as a picture does,
// and tells what it met. Supersampling, stereo and debug views are not looked at. Fails as
// pel_renderer_render does, and (ARGUMENT) for a pixel outside the picture.
PEL_API bool pel_renderer_probe(struct pel_renderer *renderer, const struct pel_scene *scene, int x,
                                int y, struct pel_probe *probe);
PEL_API void pel_probe_finish(struct pel_probe *probe);

// ---- Hypertextures -----------------------------------------------------------------------------

// How to bake a hypertexture (docs/hypertexture.md). Zero-initialise for the defaults.
struct pel_bake_options {
    int size;                        // voxels along the longest side; 0 = 64
    enum pel_voxel_type type;        // U8 (the default), U16 or F32
    uint32_t seed;                   // of all noises; 0 = the permutation Perlin published
    double time;                     // the recipe's `time`
    bool wrap;                       // integers keep their low bits where they would be clamped
    const struct pel_volume *object; // what the recipe's `object` reads, borrowed; the result lies
                                     // where this does, otherwise in a cube of 100 mm
    pel_progress_callback progress;  // may be NULL
    void *user;
};

// Ready-made recipes by name; the list ends with NULL. "noisy-sphere", "fireball", "marble",
// "tribble", "eroded-cube", "cloud", "wood", "smoke".
PEL_API const char *const *pel_recipe_presets(void);

// Works out a recipe at every voxel of a new volume, on the renderer's device. `recipe` is a
// preset, the path of a file (it has a '/' or ends in .json), or the JSON text itself (it begins
// with '{'). Densities 0..1 become 0..255 or 0..65535 in integers. The same recipe, options, device
// give the same bytes. NULL on failure (ARGUMENT, FILE, FORMAT with FILE:LINE:COLUMN: KEY, DEVICE,
// MEMORY).
PEL_API struct pel_volume *pel_renderer_bake(struct pel_renderer *renderer, const char *recipe,
                                             const struct pel_bake_options *options);

// A hypertexture as a volume of a scene, without any voxels here. A renderer bakes it to the grid
// that `options` describe before it first renders it or, when `live`, works it out at every sample,
// and the grid only says where it lies and how far samples are apart. Densities 0..1 are its values
// whatever the type, and 0..1 its statistics. `object` is shared. NULL as pel_renderer_bake fails.
PEL_API struct pel_volume *
pel_volume_hypertexture(const char *recipe, const struct pel_bake_options *options, bool live);

// ---- Images ------------------------------------------------------------------------------------

// How to write a picture. Zero-initialise for the defaults.
struct pel_image_options {
    int depth;          // PNG: 8 (default) or 16 bits
    bool premultiplied; // write alpha as computed; the default is straight
    // Text chunks for PNG, `text_count` pairs of keyword and text; may be NULL.
    const char *const (*texts)[2];
    int text_count;
};

// A transparent picture. Fails (ARGUMENT) for a width or height below 1.
PEL_API struct pel_image *pel_image_create(int width, int height);
PEL_API void pel_image_destroy(struct pel_image *image);

// Writes .png, .tif/.tiff (32-bit float RGBA) or .ppm, through a temporary that is renamed at the
// end. The path "-" writes PPM to the standard output. `options` may be NULL. Fails as
// pel_image_check_path does, and (FILE) when writing fails.
PEL_API bool pel_image_save(const struct pel_image *image, const char *path,
                            const struct pel_image_options *options);

// Tells before a long computation whether a picture could be saved there: ARGUMENT when the
// extension is none of those above, FILE when the folder does not exist or cannot be written.
PEL_API bool pel_image_check_path(const char *path);

// ---- Videos ------------------------------------------------------------------------------------

// A video being written, by the program ffmpeg: .mp4 (H.264), .mkv (likewise), .webm (VP9) or .gif.
struct pel_video;

// True when a path's extension is one of those.
PEL_API bool pel_video_is_path(const char *path);

// Starts ffmpeg, which writes to a temporary that takes the place of `path` in pel_video_finish.
// NULL on failure (ARGUMENT; UNSUPPORTED when ffmpeg is not installed; FILE).
PEL_API struct pel_video *pel_video_create(const char *path, int width, int height, double fps);

// Appends a picture of that size as it is over black. Fails (FILE) with ffmpeg's last words.
PEL_API bool pel_video_add(struct pel_video *video, const struct pel_image *image);

// Ends the video and destroys it, in any case: FILE with ffmpeg's last words. Without this,
// pel_video_destroy leaves no file behind.
PEL_API bool pel_video_finish(struct pel_video *video);
PEL_API void pel_video_destroy(struct pel_video *video);

#ifdef __cplusplus
}
#endif

#endif
