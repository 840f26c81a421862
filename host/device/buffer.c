// buffer.c - plain memory on the device.
#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/opencl.h"
#include "device/object.h"

// A buffer of the device's memory, or of the host's.
static struct pel_buffer *create(struct pel_device *device, void *memory, size_t bytes,
                                 const char *purpose) {
    struct pel_buffer *buffer = pel_allocate(1, sizeof *buffer);
    if (!buffer)
        return NULL;
    *buffer = (struct pel_buffer){.device = device, .bytes = bytes ? bytes : 1};
    cl_int status;
    buffer->memory =
        clCreateBuffer(device->context, CL_MEM_READ_WRITE | (memory ? CL_MEM_USE_HOST_PTR : 0),
                       buffer->bytes, memory, &status);
    if (status != CL_SUCCESS) {
        pel_opencl_fail(status, device->info.name);
        pel_fail_in("%zu bytes for %s", buffer->bytes, purpose);
        free(buffer);
        return NULL;
    }
    device->allocated_bytes += buffer->bytes;
    return buffer;
}

struct pel_buffer *pel_buffer_create(struct pel_device *device, size_t bytes, const char *purpose) {
    return create(device, NULL, bytes, purpose);
}

struct pel_buffer *pel_buffer_lend(struct pel_device *device, void *memory, size_t bytes,
                                   const char *purpose) {
    return create(device, memory, bytes, purpose);
}

bool pel_buffer_give_back(struct pel_buffer *buffer) {
    cl_command_queue queue = buffer->device->queue;
    cl_int status;
    void *memory = clEnqueueMapBuffer(queue, buffer->memory, CL_TRUE, CL_MAP_READ, 0, buffer->bytes,
                                      0, NULL, NULL, &status);
    if (status == CL_SUCCESS)
        status = clEnqueueUnmapMemObject(queue, buffer->memory, memory, 0, NULL, NULL);
    if (status == CL_SUCCESS)
        status = clFinish(queue);
    return status == CL_SUCCESS || pel_opencl_fail(status, "reading a buffer");
}

void pel_buffer_destroy(struct pel_buffer *buffer) {
    if (!buffer)
        return;
    pel_device_settle(buffer->device);
    buffer->device->allocated_bytes -= buffer->bytes;
    clReleaseMemObject(buffer->memory);
    free(buffer);
}

size_t pel_buffer_bytes(const struct pel_buffer *buffer) {
    return buffer ? buffer->bytes : 0;
}

bool pel_buffer_write(struct pel_buffer *buffer, size_t offset, size_t bytes, const void *data) {
    if (bytes == 0)
        return true;
    cl_int status = clEnqueueWriteBuffer(buffer->device->queue, buffer->memory, CL_TRUE, offset,
                                         bytes, data, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return pel_opencl_fail(status, "writing a buffer");
    buffer->device->uploaded_bytes += bytes;
    return true;
}

bool pel_buffer_read(struct pel_buffer *buffer, size_t offset, size_t bytes, void *data) {
    cl_int status = clEnqueueReadBuffer(buffer->device->queue, buffer->memory, CL_TRUE, offset,
                                        bytes, data, 0, NULL, NULL);
    return status == CL_SUCCESS || pel_opencl_fail(status, "reading a buffer");
}
