// object.h - inside the device module: memory objects.
#ifndef PEL_DEVICE_OBJECT_H
#define PEL_DEVICE_OBJECT_H

#include <CL/cl.h>

#include "device/device.h"

struct pel_buffer {
    struct pel_device *device; // borrowed
    cl_mem memory;
    size_t bytes;
};

struct pel_texture {
    struct pel_device *device; // borrowed
    cl_mem memory;
    size_t bytes, texel_bytes;
};

#endif
