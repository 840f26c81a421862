// label_map.h - whether a file is a label map by its name.
#ifndef PEL_VOLUME_LABEL_MAP_H
#define PEL_VOLUME_LABEL_MAP_H

#include "pellucid.h"

// True when a word of the file's name says label or segmentation, as in "scan_label.tif".
bool pel_path_names_labels(const char *path);

#endif
