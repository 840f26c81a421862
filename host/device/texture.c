// texture.c - 3-D images on the device.
#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/object.h"
#include "device/opencl.h"

static const struct {
    cl_image_format format;
    size_t bytes;
} texels[PEL_TEXEL_COUNT] = {
    [PEL_TEXEL_R8] = {{CL_R, CL_UNORM_INT8}, 1},
    [PEL_TEXEL_R16] = {{CL_R, CL_UNORM_INT16}, 2},
    [PEL_TEXEL_R32F] = {{CL_R, CL_FLOAT}, 4},
    [PEL_TEXEL_RGBA8] = {{CL_RGBA, CL_UNORM_INT8}, 4},
};

bool pel_texture_supported(const struct pel_device *device, enum pel_texel texel) {
    cl_image_format formats[256];
    cl_uint count = 0;
    if (!device->info.images ||
        clGetSupportedImageFormats(device->context, CL_MEM_READ_ONLY, CL_MEM_OBJECT_IMAGE3D, 256,
                                   formats, &count) != CL_SUCCESS)
        return false;
    for (cl_uint i = 0; i < count && i < 256; i++)
        if (formats[i].image_channel_order == texels[texel].format.image_channel_order &&
            formats[i].image_channel_data_type == texels[texel].format.image_channel_data_type)
            return true;
    return false;
}

struct pel_texture *pel_texture_create(struct pel_device *device, enum pel_texel texel,
                                       const size_t dims[3], const char *purpose) {
    struct pel_texture *texture = pel_allocate(1, sizeof *texture);
    if (!texture)
        return NULL;
    texture->device = device;
    texture->texel_bytes = texels[texel].bytes;
    if (!pel_size_multiply(&texture->bytes, 4,
                           (size_t[]){dims[0], dims[1], dims[2], texels[texel].bytes})) {
        free(texture);
        return NULL;
    }
    cl_image_desc description = {.image_type = CL_MEM_OBJECT_IMAGE3D,
                                 .image_width = dims[0],
                                 .image_height = dims[1],
                                 .image_depth = dims[2]};
    cl_int status;
    texture->memory = clCreateImage(device->context, CL_MEM_READ_ONLY, &texels[texel].format,
                                    &description, NULL, &status);
    if (status != CL_SUCCESS) {
        pel_opencl_fail(status, device->info.name);
        pel_fail_in("a %zu x %zu x %zu image for %s", dims[0], dims[1], dims[2], purpose);
        free(texture);
        return NULL;
    }
    device->allocated_bytes += texture->bytes;
    return texture;
}

void pel_texture_destroy(struct pel_texture *texture) {
    if (!texture)
        return;
    pel_device_settle(texture->device);
    texture->device->allocated_bytes -= texture->bytes;
    clReleaseMemObject(texture->memory);
    free(texture);
}

bool pel_texture_write(struct pel_texture *texture, const size_t origin[3], const size_t dims[3],
                       const void *data) {
    cl_int status = clEnqueueWriteImage(texture->device->queue, texture->memory, CL_TRUE, origin,
                                        dims, 0, 0, data, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return pel_opencl_fail(status, "writing an image");
    texture->device->uploaded_bytes += dims[0] * dims[1] * dims[2] * texture->texel_bytes;
    return true;
}
