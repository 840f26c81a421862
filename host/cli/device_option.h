// device_option.h - the options of commands that render: which device, and how it is used.
#ifndef PEL_CLI_DEVICE_OPTION_H
#define PEL_CLI_DEVICE_OPTION_H

#include "cli/options.h"

// Options --device, --reader, --lanes, --work-group and --compute-units, as `children` of a
// command's argp. The input is a struct pel_renderer_options.
extern const struct argp_child cli_device_children[];

#endif
