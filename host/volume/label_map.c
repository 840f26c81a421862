// label_map.c - label maps whose format has no way to say that they are one, such as TIFF and NRRD.
//
// In a label map neighbours have the same number, but for the borders of what is labelled; in a
// picture hardly two do. Counted along rows, among pairs of which neither is background: 0, or the
// least value. Names are what 3D Slicer goes by; a name alone may lie, and so may values, but not
// often both.
#include "volume/label_map.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/file.h"
#include "base/memory.h"
#include "volume/row.h"

// The share of pairs that are the same in the least compact of atlases.
static const double LABEL_SHARE = 0.7;

struct count {
    double least;
    size_t pairs, same;
    bool whole; // only whole numbers so far
};

static void count_row(struct count *count, const double *row, int length) {
    for (int i = 0; i < length; i++)
        count->whole = count->whole && row[i] == rint(row[i]);
    for (int i = 1; i < length; i++) {
        if (row[i] == 0 || row[i - 1] == 0 || row[i] == count->least || row[i - 1] == count->least)
            continue;
        count->pairs++;
        count->same += row[i] == row[i - 1];
    }
}

static double least_of(const struct pel_volume *volume, double *row) {
    double least = INFINITY;
    for (int k = 0; k < volume->dims[2]; k++) {
        for (int j = 0; j < volume->dims[1]; j++) {
            pel_row_read(volume, j, k, row);
            for (int i = 0; i < volume->dims[0]; i++)
                least = row[i] < least ? row[i] : least;
        }
    }
    return least;
}

bool pel_volume_seems_labels(const struct pel_volume *volume) {
    if (volume->labels)
        return true;
    if (volume->hypertexture || pel_row_channels(volume->type) > 1 || volume->slope != 1 ||
        volume->intercept != 0 || volume->unit[0])
        return false;
    double *row = pel_allocate((size_t)volume->dims[0], sizeof *row);
    if (!row)
        return false;
    struct count count = {.least = least_of(volume, row), .whole = true};
    for (int k = 0; k < volume->dims[2]; k++) {
        for (int j = 0; count.whole && j < volume->dims[1]; j++) {
            pel_row_read(volume, j, k, row);
            count_row(&count, row, volume->dims[0]);
        }
    }
    free(row);
    return count.whole && count.pairs > 0 &&
           (double)count.same >= LABEL_SHARE * (double)count.pairs;
}

// Whether `text` begins with one of the words for labels, which then ends.
static bool begins_with_word(const char *text) {
    static const char *const words[] = {"label",         "labels",       "labelmap",
                                        "seg",           "aseg",         "segmentation",
                                        "segmentations", "parcellation", NULL};
    for (int i = 0; words[i]; i++) {
        size_t length = strlen(words[i]);
        if (strncasecmp(text, words[i], length) == 0 && !isalpha((unsigned char)text[length]))
            return true;
    }
    return false;
}

bool pel_path_names_labels(const char *path) {
    const char *leaf = pel_path_leaf(path);
    for (const char *at = leaf; *at; at++)
        if ((at == leaf || !isalpha((unsigned char)at[-1])) && begins_with_word(at))
            return true;
    return false;
}
