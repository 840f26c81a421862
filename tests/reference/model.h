// model.h - docs/picture.md, "Optical models".
#ifndef PEL_TEST_REFERENCE_MODEL_H
#define PEL_TEST_REFERENCE_MODEL_H

#include "reference/path.h"
#include "reference/reference.h"

// The model of body k, its own or the scene's.
enum pel_model reference_model_of(const struct reference *reference, int k);

// True when every sample of a scene is nothing but a mixture of media.
bool reference_is_plain(const struct reference *reference);

// The ray's light, without the background. Every value is taken to be off by what `errors` allow,
// times `sign`; NULL: by nothing.
void reference_gather(double rgba[4], const struct reference *reference,
                      const struct reference_path *path, const struct reference_errors *errors,
                      double sign, uint64_t *taken);

// The same by the exact integrator of model emission.
void reference_emit(double rgba[4], const struct reference *reference,
                    const struct reference_path *path);

#endif
