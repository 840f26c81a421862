// kernel.c - building and launching kernels.
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/object.h"
#include "device/opencl.h"
#include "device/source.h"

struct pel_kernel {
    struct pel_device *device; // borrowed
    cl_program program;
    cl_kernel kernel;
};

// The compiler's words, shortened to what fits a sentence.
static void fail_build(struct pel_device *device, cl_program program, const char *file,
                       const char *definitions, cl_int status) {
    size_t bytes = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &bytes);
    char *log = pel_allocate(bytes + 1, 1);
    if (log && bytes)
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, bytes, log, NULL);
    pel_fail(PEL_ERROR_BUILD, "kernel %s does not compile for %s (%d, %s): %.1500s", file,
             device->info.name, status, definitions, log ? log : "");
    free(log);
}

struct pel_kernel *pel_kernel_build(struct pel_device *device, const char *file, const char *name,
                                    const char *definitions) {
    char *source = pel_kernel_source(file);
    if (!source)
        return NULL;
    struct pel_kernel *kernel = pel_allocate(1, sizeof *kernel);
    if (!kernel) {
        free(source);
        return NULL;
    }
    kernel->device = device;
    cl_int status;
    const char *text = source;
    kernel->program = clCreateProgramWithSource(device->context, 1, &text, NULL, &status);
    free(source);
    if (status != CL_SUCCESS) {
        pel_opencl_fail(status, "creating a program");
        pel_kernel_destroy(kernel);
        return NULL;
    }
    status = clBuildProgram(kernel->program, 1, &device->id, definitions, NULL, NULL);
    if (status == CL_SUCCESS)
        kernel->kernel = clCreateKernel(kernel->program, name, &status);
    if (status != CL_SUCCESS) {
        fail_build(device, kernel->program, file, definitions, status);
        pel_kernel_destroy(kernel);
        return NULL;
    }
    return kernel;
}

struct pel_kernel *pel_kernel_sibling(const struct pel_kernel *kernel, const char *name) {
    struct pel_kernel *sibling = pel_allocate(1, sizeof *sibling);
    if (!sibling)
        return NULL;
    sibling->device = kernel->device;
    cl_int status;
    sibling->kernel = clCreateKernel(kernel->program, name, &status);
    if (status != CL_SUCCESS) {
        pel_opencl_fail(status, name);
        free(sibling);
        return NULL;
    }
    clRetainProgram(kernel->program);
    sibling->program = kernel->program;
    return sibling;
}

void pel_kernel_destroy(struct pel_kernel *kernel) {
    if (!kernel)
        return;
    pel_device_settle(kernel->device);
    if (kernel->kernel)
        clReleaseKernel(kernel->kernel);
    if (kernel->program)
        clReleaseProgram(kernel->program);
    free(kernel);
}

static bool set_argument(struct pel_kernel *kernel, int index, size_t bytes, const void *value) {
    cl_int status = clSetKernelArg(kernel->kernel, (cl_uint)index, bytes, value);
    return status == CL_SUCCESS || pel_opencl_fail(status, "setting a kernel argument");
}

bool pel_kernel_set_buffer(struct pel_kernel *kernel, int index, const struct pel_buffer *buffer) {
    return set_argument(kernel, index, sizeof buffer->memory, &buffer->memory);
}

bool pel_kernel_set_texture(struct pel_kernel *kernel, int index,
                            const struct pel_texture *texture) {
    return set_argument(kernel, index, sizeof texture->memory, &texture->memory);
}

bool pel_kernel_set_u32(struct pel_kernel *kernel, int index, uint32_t value) {
    return set_argument(kernel, index, sizeof value, &value);
}

bool pel_kernel_launch(struct pel_kernel *kernel, size_t count, size_t group) {
    cl_int status = clEnqueueNDRangeKernel(kernel->device->queue, kernel->kernel, 1, NULL, &count,
                                           &group, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return pel_opencl_fail(status, "launching a kernel");
    // Not flushed: rusticl of Mesa 22.3 takes a flushed queue for an empty one, and its clFinish
    // does not wait for it.
    kernel->device->busy = true;
    return true;
}

size_t pel_kernel_max_group(const struct pel_kernel *kernel) {
    size_t group = 1;
    clGetKernelWorkGroupInfo(kernel->kernel, kernel->device->id, CL_KERNEL_WORK_GROUP_SIZE,
                             sizeof group, &group, NULL);
    return group;
}

struct pel_kernel_info pel_kernel_describe(const struct pel_kernel *kernel) {
    size_t multiple = 0;
    cl_ulong private_bytes = 0, local_bytes = 0;
    cl_device_id id = kernel->device->id;
    clGetKernelWorkGroupInfo(kernel->kernel, id, CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE,
                             sizeof multiple, &multiple, NULL);
    clGetKernelWorkGroupInfo(kernel->kernel, id, CL_KERNEL_PRIVATE_MEM_SIZE, sizeof private_bytes,
                             &private_bytes, NULL);
    clGetKernelWorkGroupInfo(kernel->kernel, id, CL_KERNEL_LOCAL_MEM_SIZE, sizeof local_bytes,
                             &local_bytes, NULL);
    return (struct pel_kernel_info){.max_work_group = pel_kernel_max_group(kernel),
                                    .work_group_multiple = multiple,
                                    .private_bytes = private_bytes,
                                    .local_bytes = local_bytes};
}
