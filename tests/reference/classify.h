// classify.h - the table of a transfer function, and what it makes of a value.
#ifndef PEL_TEST_REFERENCE_CLASSIFY_H
#define PEL_TEST_REFERENCE_CLASSIFY_H

#include "reference/sample.h"

struct reference_table {
    int count;
    double low, high;     // values of the first and the last entry
    bool nearest;         //
    double (*entries)[4]; // owned; straight colour, and opacity per opacity unit
};

// What a medium does to light: extinction per millimetre, and straight colour.
struct reference_medium {
    double extinction, rgb[3];
    double priority; // of the instance
    int body;        // the instance among those that are mixed, 0 the first
    double step_mm;  // the length that its sample stands for
};

void reference_table_init(struct reference_table *table, const struct pel_transfer *transfer,
                          const struct pel_volume *volume);
void reference_table_finish(struct reference_table *table);

void reference_table_look_up(double rgba[4], const struct reference_table *table, double value);

struct reference_medium reference_classify(const struct pel_instance *instance,
                                           const struct reference_table *table,
                                           const struct reference_sample *sample);

#endif
