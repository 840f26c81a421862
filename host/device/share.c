// share.c - buffers of OpenGL that kernels write (cl_khr_gl_sharing, OpenCL extension
// specification, sec. "Sharing Memory Objects with OpenGL").
//
// A context is shared only when the device says that it can and OpenGL's context is of this very
// device. What is missing is no failure: there are other ways to bring a picture into a window.
// clGetGLContextInfoKHR is asked for by name, as the extension demands; the others have been in
// every loader since OpenCL 1.0. cl_khr_gl_event would order commands without waiting, but we wait
// in any case, for a picture that is handed over to another thread has to be complete.
#include <CL/cl_gl.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "device/object.h"
#include "device/opencl.h"

enum { DEVICES = 64 };

// Whether OpenGL's context, in the properties, is of this device.
static bool is_device_of(const struct pel_device *device, const cl_context_properties *properties) {
    clGetGLContextInfoKHR_fn ask =
        (clGetGLContextInfoKHR_fn)(uintptr_t)clGetExtensionFunctionAddressForPlatform(
            device->platform, "clGetGLContextInfoKHR");
    static const cl_gl_context_info keys[] = {CL_CURRENT_DEVICE_FOR_GL_CONTEXT_KHR,
                                              CL_DEVICES_FOR_GL_CONTEXT_KHR};
    for (int i = 0; ask && i < 2; i++) {
        cl_device_id ids[DEVICES];
        size_t bytes = 0;
        if (ask(properties, keys[i], sizeof ids, ids, &bytes) != CL_SUCCESS)
            continue;
        for (size_t k = 0; k < bytes / sizeof(cl_device_id) && k < DEVICES; k++)
            if (ids[k] == device->id)
                return true;
    }
    return false;
}

static const char *find_obstacle(const struct pel_device *device, const struct pel_gl *gl,
                                 const cl_context_properties *properties) {
    if (gl->platform == PEL_GL_NONE)
        return "there is no OpenGL context to share with";
    if (!device->info.gl_sharing)
        return "the device does not have cl_khr_gl_sharing";
    if (device->divided)
        return "a part of a device shares nothing";
    if (!is_device_of(device, properties))
        return "OpenGL runs on another device";
    return NULL;
}

cl_context pel_share_create_context(struct pel_device *device, const struct pel_gl *gl,
                                    cl_int *status) {
    const cl_context_properties platform = (cl_context_properties)device->platform;
    const cl_context_properties shared[] = {CL_CONTEXT_PLATFORM,
                                            platform,
                                            CL_GL_CONTEXT_KHR,
                                            (cl_context_properties)gl->context,
                                            gl->platform == PEL_GL_EGL ? CL_EGL_DISPLAY_KHR
                                                                       : CL_GLX_DISPLAY_KHR,
                                            (cl_context_properties)gl->display,
                                            0};
    const char *obstacle = find_obstacle(device, gl, shared);
    snprintf(device->unshared, sizeof device->unshared, "%s", obstacle ? obstacle : "");
    if (!obstacle) {
        cl_context context = clCreateContext(shared, 1, &device->id, NULL, NULL, status);
        if (*status == CL_SUCCESS)
            return context;
        snprintf(device->unshared, sizeof device->unshared,
                 "OpenCL takes no context of OpenGL's (%d)", *status);
    }
    return clCreateContext((cl_context_properties[]){CL_CONTEXT_PLATFORM, platform, 0}, 1,
                           &device->id, NULL, NULL, status);
}

struct pel_buffer *pel_buffer_share(struct pel_device *device, uint32_t gl_buffer) {
    struct pel_buffer *buffer = pel_allocate(1, sizeof *buffer);
    if (!buffer)
        return NULL;
    buffer->device = device;
    cl_int status;
    buffer->memory = clCreateFromGLBuffer(device->context, CL_MEM_WRITE_ONLY, gl_buffer, &status);
    if (status == CL_SUCCESS)
        status = clGetMemObjectInfo(buffer->memory, CL_MEM_SIZE, sizeof buffer->bytes,
                                    &buffer->bytes, NULL);
    if (status != CL_SUCCESS) {
        if (buffer->memory)
            clReleaseMemObject(buffer->memory);
        free(buffer);
        pel_opencl_fail(status, "sharing a buffer of OpenGL");
        return NULL;
    }
    device->allocated_bytes += buffer->bytes;
    return buffer;
}

bool pel_buffer_acquire(struct pel_buffer *buffer) {
    cl_int status =
        clEnqueueAcquireGLObjects(buffer->device->queue, 1, &buffer->memory, 0, NULL, NULL);
    return status == CL_SUCCESS || pel_opencl_fail(status, "acquiring a buffer of OpenGL");
}

bool pel_buffer_release(struct pel_buffer *buffer) {
    cl_int status =
        clEnqueueReleaseGLObjects(buffer->device->queue, 1, &buffer->memory, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return pel_opencl_fail(status, "releasing a buffer of OpenGL");
    return pel_device_finish(buffer->device);
}
