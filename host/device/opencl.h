// opencl.h - inside the device module: the OpenCL behind the opaque types.
#ifndef PEL_DEVICE_OPENCL_H
#define PEL_DEVICE_OPENCL_H

#include <CL/cl.h>

#include "device/device.h"

struct pel_device {
    struct pel_device_info info;
    cl_platform_id platform;
    cl_device_id id;
    bool divided; // the id is of a part of a device, and ours to release
    cl_context context;
    cl_command_queue queue;
    uint64_t allocated_bytes, uploaded_bytes;
    bool busy;                          // a kernel was launched and not waited for
    char unshared[PEL_GL_REASON_BYTES]; // why buffers of OpenGL cannot be written; "": they can
};

// One device of one platform, as enumeration finds it.
struct pel_device_place {
    cl_platform_id platform;
    cl_device_id id;
};

// Finds all devices with their descriptions, in the order users count them.
int pel_device_enumerate(struct pel_device_info *infos, struct pel_device_place *places);

// Waits for kernels that may use what is about to be released. OpenCL keeps an object until they
// end, but not the host's memory behind a lent one.
void pel_device_settle(struct pel_device *device);

// A context for the device and, if there is one to share with and the device can, OpenGL's context;
// device->unshared says why not.
cl_context pel_share_create_context(struct pel_device *device, const struct pel_gl *gl,
                                    cl_int *status);

// Records a failed OpenCL call; always false (DEVICE; MEMORY is the device's, too).
bool pel_opencl_fail(cl_int status, const char *what);

#endif
