// describe.h - what `pellucid info` says about one volume.
#ifndef PEL_CLI_DESCRIBE_H
#define PEL_CLI_DESCRIBE_H

#include <jansson.h>

#include "pellucid.h"

// As aligned lines on standard output, each beginning with `indent` spaces.
void describe_print(const struct pel_volume *volume, const struct pel_statistics *statistics,
                    int indent);

// As a JSON object.
json_t *describe_json(const struct pel_volume *volume, const struct pel_statistics *statistics);

#endif
