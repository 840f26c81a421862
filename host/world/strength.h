// strength.h - a transfer function's table as a kernel reads it.
#ifndef PEL_WORLD_STRENGTH_H
#define PEL_WORLD_STRENGTH_H

#include "transfer/table.h"

#include "shared/types.h"

// What a table's strengths are, and how it may be read.
struct pel_strength_rule {
    double step_mm;         // the length that one sample stands for
    double density;         //
    double opacity_unit_mm; //
    bool depth;             // optical depths of a step instead of opacities
    int model;              // one of MODEL_*
    double emission;        // of model emission: brightness per millimetre
};

// The most entries a table can have on the device, and the words of one entry.
enum { PEL_STRENGTH_ENTRIES = 4096, PEL_STRENGTH_WORDS = 2 };

// How many entries on the device stand for one interval of the table: as many as fit, or a few
// where the kernel interpolates (`linear`). 1 for a table that is read at its nearest entry.
int pel_strength_refinement(const struct pel_table *table, bool linear);

// Writes (entry_count - 1) * refinement + 1 entries of two words: strength, and colour as 10 bits
// each.
void pel_strength_write(u32 *words, const struct pel_table *table, int refinement,
                        const struct pel_strength_rule *rule);

// True when the table, refined for reading at the nearest entry, is smooth enough for that: then no
// sample is off by more than a fraction of what a picture of 8 bits shows.
bool pel_strength_is_gentle(const struct pel_table *table, const struct pel_strength_rule *rule);

#endif
