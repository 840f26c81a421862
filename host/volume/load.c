// load.c - which reader and which writer a file is for.
//
// A file is told by its content first, because names lie (".img" is three formats, ".nrrd" may hold
// a detached header), and by its name only when the content says nothing, as in raw files.
#include "volume/volume.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/locale.h"
#include "base/math.h"
#include "volume/label_map.h"
#include "volume/source.h"

typedef struct pel_volume *load_function(const char *path, const struct pel_load_options *options);
typedef bool save_function(const struct pel_volume *volume, const char *path);

// Bytes looked at; DICOM's mark is the furthest behind.
enum { HEAD_BYTES = 512, DICOM_MARK = 128 };

static bool starts_with(const char *head, const char *magic, size_t bytes) {
    return memcmp(head, magic, bytes) == 0;
}

static bool is_tiff(const char *head) {
    // Little and big endian, classic (42) and BigTIFF (43).
    return starts_with(head, "II*\0", 4) || starts_with(head, "MM\0*", 4) ||
           starts_with(head, "II+\0", 4) || starts_with(head, "MM\0+", 4);
}

static bool is_nifti(const char *head) {
    uint32_t size;
    memcpy(&size, head, sizeof size);
    return size == 348 || size == 540 || __builtin_bswap32(size) == 348 ||
           __builtin_bswap32(size) == 540;
}

static bool is_pvm(const char *head) {
    return starts_with(head, "PVM\n", 4) || starts_with(head, "PVM2\n", 5) ||
           starts_with(head, "PVM3\n", 5) || starts_with(head, "DDS v3", 6);
}

// MetaImage has no magic: its first line is one of its keys, "=" and a value.
static bool is_metaimage(const char *head) {
    static const char *const keys[] = {"ObjectType", "NDims",       "Comment",       "DimSize",
                                       "BinaryData", "ElementType", "ObjectSubType", "Name"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        size_t length = strlen(keys[i]);
        if (strncmp(head, keys[i], length) == 0)
            return head[length + strspn(head + length, " \t")] == '=';
    }
    return false;
}

static load_function *reader_from_content(const char *head) {
    if (starts_with(head, "NRRD000", 7))
        return pel_nrrd_load;
    if (is_tiff(head))
        return pel_tiff_load;
    if (is_pvm(head))
        return pel_pvm_load;
    if (starts_with(head + DICOM_MARK, "DICM", 4))
        return pel_dicom_load;
    if (is_nifti(head))
        return pel_nifti_load;
    return is_metaimage(head) ? pel_metaimage_load : NULL;
}

static const struct {
    const char *extension;
    load_function *load;
    save_function *save;
} formats[] = {
    {".nrrd", pel_nrrd_load, pel_nrrd_save},
    {".nhdr", pel_nrrd_load, pel_nrrd_save},
    {".nii", pel_nifti_load, pel_nifti_save},
    {".nii.gz", pel_nifti_load, pel_nifti_save},
    {".hdr", pel_nifti_load, NULL},
    {".hdr.gz", pel_nifti_load, NULL},
    {".tif", pel_tiff_load, pel_tiff_save},
    {".tiff", pel_tiff_load, pel_tiff_save},
    {".mhd", pel_metaimage_load, pel_metaimage_save},
    {".mha", pel_metaimage_load, pel_metaimage_save},
    {".pvm", pel_pvm_load, NULL},
    {".dcm", pel_dicom_load, NULL},
    {".raw", pel_raw_load, pel_raw_save},
    {".bin", pel_raw_load, NULL},
};

enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

// Files people have that are no volumes here, and the way around.
static const struct {
    const char *extension, *advice;
} foreign[] = {
    {".par", "Philips PAR/REC is not read, dcm2niix turns it into NIfTI"},
    {".rec", "Philips PAR/REC is not read, dcm2niix turns it into NIfTI"},
    {".mgh", "FreeSurfer MGH is not read, mri_convert turns it into NIfTI"},
    {".mgz", "FreeSurfer MGH is not read, mri_convert turns it into NIfTI"},
    {".mnc", "MINC is not read, mnc2nii turns it into NIfTI"},
    {".head", "AFNI is not read, 3dAFNItoNIFTI turns it into NIfTI"},
    {".brik", "AFNI is not read, 3dAFNItoNIFTI turns it into NIfTI"},
    {".brik.gz", "AFNI is not read, 3dAFNItoNIFTI turns it into NIfTI"},
    {".mif", "MRtrix is not read, mrconvert turns it into NIfTI"},
    {".mif.gz", "MRtrix is not read, mrconvert turns it into NIfTI"},
    {".vti", "VTK XML is not read, ParaView saves it as MetaImage"},
};

static bool has_header_beside(const char *path) {
    static const char *const endings[] = {".hdr", ".hdr.gz"};
    size_t length = strlen(path) - (pel_path_has_extension(path, ".gz") ? 3 : 0) - 4;
    for (int i = 0; i < 2; i++) {
        char *header = NULL;
        if (asprintf(&header, "%.*s%s", (int)length, path, endings[i]) < 0)
            return false;
        bool there = access(header, R_OK) == 0;
        free(header);
        if (there)
            return true;
    }
    return false;
}

static load_function *reader_from_name(const char *path) {
    bool image = pel_path_has_extension(path, ".img") || pel_path_has_extension(path, ".img.gz");
    if (image && has_header_beside(path))
        return pel_nifti_load;
    char *sidecar = pel_raw_sidecar(path);
    free(sidecar);
    if (sidecar || image)
        return pel_raw_load;
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (pel_path_has_extension(path, formats[i].extension))
            return formats[i].load;
    return NULL;
}

// The first bytes, inflated if need be, and zeros where the file is shorter.
static bool read_head(const char *path, char head[HEAD_BYTES]) {
    struct pel_source source;
    memset(head, 0, HEAD_BYTES);
    bool good = pel_source_open(&source, path);
    if (good)
        pel_source_read_some(&source, head, HEAD_BYTES - 1);
    pel_source_close(&source);
    return good;
}

// A folder holds DICOM when one of its files says so by name or content; else slices.
static bool folder_is_dicom(const char *path) {
    DIR *folder = opendir(path);
    if (!folder)
        return false;
    bool dicom = false;
    for (struct dirent *entry; !dicom && (entry = readdir(folder));) {
        char *file = NULL, head[HEAD_BYTES];
        size_t bytes;
        if (entry->d_name[0] == '.' || asprintf(&file, "%s/%s", path, entry->d_name) < 0)
            continue;
        dicom = pel_file_size(file, &bytes) &&
                (pel_path_has_extension(file, ".dcm") ||
                 (read_head(file, head) && starts_with(head + DICOM_MARK, "DICM", 4)));
        free(file);
    }
    closedir(folder);
    pel_error_clear();
    return dicom;
}

static load_function *choose_reader(const char *path, const struct pel_load_options *options) {
    struct stat status;
    if (stat(path, &status) != 0 && strpbrk(path, "*?["))
        return pel_tiff_load;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode))
        return folder_is_dicom(path) ? pel_dicom_load : pel_tiff_load;
    if (options->raw.dims[0] > 0)
        return pel_raw_load;
    char head[HEAD_BYTES];
    if (!read_head(path, head))
        return NULL;
    load_function *load = reader_from_content(head);
    if (!load)
        load = reader_from_name(path);
    if (load)
        return load;
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        if (pel_path_has_extension(path, foreign[i].extension)) {
            pel_fail(PEL_ERROR_UNSUPPORTED, "%s", foreign[i].advice);
            return NULL;
        }
    }
    pel_fail(PEL_ERROR_FORMAT, "neither its content nor its name is that of a volume: NRRD, NIfTI, "
                               "MetaImage, TIFF, PVM, DICOM, or raw with NAME.json");
    return NULL;
}

// Whatever a header says, its volume has a place in the world and its values are numbers.
static bool check_volume(const struct pel_volume *volume) {
    struct pel_matrix inverse;
    if (!pel_matrix_invert(&inverse, &volume->world_from_voxel))
        return pel_fail(PEL_ERROR_FORMAT, "its placement is not finite, or flat");
    if (!isfinite(volume->slope) || !isfinite(volume->intercept))
        return pel_fail(PEL_ERROR_FORMAT, "its slope %g or intercept %g is not finite",
                        volume->slope, volume->intercept);
    return true;
}

// Colours are no labels, whoever says so.
static void settle_labels(struct pel_volume *volume, const char *path,
                          const struct pel_load_options *options) {
    bool colour = volume->type == PEL_VOXEL_RGB8 || volume->type == PEL_VOXEL_RGBA8;
    if (colour && options->labels == PEL_LABELS_YES)
        pel_warn("%s: its voxels are colours, not labels", volume->name);
    else if (options->labels == PEL_LABELS_YES)
        volume->labels = true;
    else if (options->labels == PEL_LABELS_NO)
        volume->labels = false;
    else if (!volume->labels && pel_path_names_labels(path))
        volume->labels = pel_volume_seems_labels(volume);
}

struct pel_volume *pel_volume_load(const char *path, const struct pel_load_options *options) {
    static const struct pel_load_options defaults;
    if (!options)
        options = &defaults;
    struct pel_locale locale;
    pel_locale_begin(&locale);
    load_function *load = choose_reader(path, options);
    struct pel_volume *volume = load ? load(path, options) : NULL;
    pel_locale_finish(&locale);
    if (volume && !check_volume(volume)) {
        pel_volume_destroy(volume);
        volume = NULL;
    }
    if (volume)
        settle_labels(volume, path, options);
    // What base/file.h says about a file begins with its path already.
    if (!volume && strncmp(pel_error_message(), path, strlen(path)) != 0)
        pel_fail_in("%s", path);
    return volume;
}

bool pel_volume_save(const struct pel_volume *volume, const char *path) {
    for (int i = 0; i < FORMAT_COUNT; i++) {
        if (!formats[i].save || !pel_path_has_extension(path, formats[i].extension))
            continue;
        struct pel_locale locale;
        pel_locale_begin(&locale);
        bool good = pel_volume_check_voxels(volume) && formats[i].save(volume, path);
        pel_locale_finish(&locale);
        if (!good && strncmp(pel_error_message(), path, strlen(path)) != 0)
            pel_fail_in("%s", path);
        return good;
    }
    return pel_fail(PEL_ERROR_ARGUMENT,
                    "%s: no volume format has this extension, there are .nrrd .nhdr .nii .nii.gz "
                    ".tif .tiff .mhd .mha .raw",
                    path);
}
