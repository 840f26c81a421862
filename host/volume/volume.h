// volume.h - inside the volume module: one load and one save function per format.
#ifndef PEL_VOLUME_VOLUME_H
#define PEL_VOLUME_VOLUME_H

#include "pellucid.h"

// The largest number of voxels along one axis that is taken for real.
#define PEL_DIMENSION_MAX 65536

// Fails (FORMAT, MEMORY) unless every dimension is in 1..PEL_DIMENSION_MAX and the voxels of `type`
// fit into memory and into `available_bytes` - what the file could hold, after decompression, at
// most; SIZE_MAX when it cannot be told. On success `*bytes` is the size of all voxels.
bool pel_volume_check_size(const int64_t dims[3], enum pel_voxel_type type, size_t available_bytes,
                           size_t *bytes);

// False (ARGUMENT) for a hypertexture, which has no voxels until a renderer bakes it.
bool pel_volume_check_voxels(const struct pel_volume *volume);

// A volume like `source`, of other dimensions and type, whose voxels lie at scale * q + offset of
// its indices. NULL: MEMORY, and ARGUMENT for a hypertexture.
struct pel_volume *pel_volume_create_like(const struct pel_volume *source, const int dims[3],
                                          enum pel_voxel_type type, const double scale[3],
                                          const double offset[3]);

// Replaces Inf by NaN in a float volume: both are absent.
void pel_volume_mark_absent(struct pel_volume *volume);

// The readers. Options are never NULL here. Their sentences leave the path out, because
// pel_volume_load puts it before them.
struct pel_volume *pel_raw_load(const char *path, const struct pel_load_options *options);
struct pel_volume *pel_nrrd_load(const char *path, const struct pel_load_options *options);
struct pel_volume *pel_nifti_load(const char *path, const struct pel_load_options *options);
struct pel_volume *pel_metaimage_load(const char *path, const struct pel_load_options *options);
struct pel_volume *pel_tiff_load(const char *path, const struct pel_load_options *options);
struct pel_volume *pel_pvm_load(const char *path, const struct pel_load_options *options);
struct pel_volume *pel_dicom_load(const char *path, const struct pel_load_options *options);

// The path of the JSON file that describes a raw file, to free(); NULL, without a sentence, when
// there is none.
char *pel_raw_sidecar(const char *path);

bool pel_raw_save(const struct pel_volume *volume, const char *path);
bool pel_nrrd_save(const struct pel_volume *volume, const char *path);
bool pel_nifti_save(const struct pel_volume *volume, const char *path);
bool pel_metaimage_save(const struct pel_volume *volume, const char *path);
bool pel_tiff_save(const struct pel_volume *volume, const char *path);

#endif
