// save.c - a text header and the voxels it describes, in one file or in two.
#include "volume/save.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "volume/volume.h"

static bool write_voxels(FILE *stream, const struct pel_volume *volume) {
    size_t bytes = pel_volume_bytes(volume);
    return fwrite(volume->voxels, 1, bytes, stream) == bytes ||
           pel_fail(PEL_ERROR_FILE, "cannot write: %s", strerror(errno));
}

static bool save_one_file(const struct pel_volume *volume, const char *path,
                          pel_header_writer *write_header) {
    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    if (!write_header(output.stream, volume, NULL) || !write_voxels(output.stream, volume)) {
        pel_output_abandon(&output);
        return false;
    }
    return pel_output_commit(&output);
}

bool pel_save_check_data(const char *header_path, const char *data_path) {
    if (access(data_path, F_OK) != 0 || access(header_path, F_OK) == 0)
        return true;
    return pel_fail(PEL_ERROR_FILE,
                    "its voxels would overwrite %s, which is there already; remove that or choose "
                    "another name",
                    data_path);
}

bool pel_save_with_header(const struct pel_volume *volume, const char *header_path,
                          const char *data_path, pel_header_writer *write_header) {
    if (!data_path)
        return save_one_file(volume, header_path, write_header);
    struct pel_output header, voxels;
    if (!pel_output_open(&voxels, data_path))
        return false;
    if (!pel_output_open(&header, header_path)) {
        pel_output_abandon(&voxels);
        return false;
    }
    if (!write_header(header.stream, volume, pel_path_leaf(data_path)) ||
        !write_voxels(voxels.stream, volume)) {
        pel_output_abandon(&voxels);
        pel_output_abandon(&header);
        return false;
    }
    if (!pel_output_commit(&voxels)) {
        pel_output_abandon(&header);
        return false;
    }
    return pel_output_commit(&header);
}
