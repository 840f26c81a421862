// file_list.h - the data files that a detached header names, as MetaImage and NRRD write them: one
// name; "LIST" with a name on each line behind; or a pattern "slice%03d.raw 1 40 1".
#ifndef PEL_VOLUME_FILE_LIST_H
#define PEL_VOLUME_FILE_LIST_H

#include <stdbool.h>

struct pel_file_list {
    char **names; // owned
    int count;
};

// Understands `value`; `next_line` is the text behind it, up to a zero byte. Fails (FORMAT,
// MEMORY); finish the list in any case.
bool pel_file_list_parse(struct pel_file_list *list, const char *value, const char *next_line);
void pel_file_list_finish(struct pel_file_list *list);

#endif
