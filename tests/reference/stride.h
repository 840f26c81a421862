// stride.h - how long the runs of samples are that one sample stands for.
#ifndef PEL_TEST_REFERENCE_STRIDE_H
#define PEL_TEST_REFERENCE_STRIDE_H

#include "reference/path.h"

// Makes room for what is found out about a body's cells, in body->runs.
void reference_run_prepare(struct reference_body *body);

// The length of the run that begins at sample i of the common grid, where one does: 1, 2 or 4.
int reference_run(const struct reference *reference, const struct reference_path *path, double i);

#endif
