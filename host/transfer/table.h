// table.h - a transfer function as the table that docs/picture.md, "Classification", defines.
#ifndef PEL_TRANSFER_TABLE_H
#define PEL_TRANSFER_TABLE_H

#include "pellucid.h"

// Entry j is for the value low + j (high - low) / (entry_count - 1); low < high always.
struct pel_table {
    int entry_count;  // at least 2
    double low, high; // in the file's unit
    bool nearest;     // read at the nearest entry, not between entries
    float (*rgba)[4]; // owned; straight colour, and opacity per the function's opacity unit
};

// Makes the table of a resolved transfer function for the values of a volume. False (MEMORY, or
// FORMAT when the function is not a valid one).
bool pel_table_build(struct pel_table *table, const struct pel_transfer *resolved,
                     const struct pel_volume *volume);
void pel_table_finish(struct pel_table *table);

#endif
