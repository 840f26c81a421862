// device.c - choosing and opening a device.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/opencl.h"

// What there is, for sentences: "0: name, 1: name".
static void list_devices(const struct pel_device_info *infos, int count, char *text, size_t bytes) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count && used < bytes; i++)
        used += (size_t)snprintf(text + used, bytes - used, "%s%d: %s%s", i ? ", " : "", i,
                                 infos[i].name, infos[i].usable ? "" : " (unusable)");
}

// How well device i answers to the selector: the first with the highest rank is taken; 0 is no
// answer.
static int rank(const struct pel_device_info *info, int i, const char *selector) {
    if (!selector)
        return !info->usable ? 0 : info->gpu ? 2 : 1;
    char *end;
    long index = strtol(selector, &end, 10);
    if (end != selector && *end == '\0')
        return index == i;
    if (strcasecmp(selector, "gpu") == 0)
        return info->gpu;
    if (strcasecmp(selector, "cpu") == 0)
        return info->cpu;
    return strcasestr(info->name, selector) || strcasestr(info->platform, selector) ||
           strcasestr(info->vendor, selector);
}

static int select_device(const struct pel_device_info *infos, int count, const char *selector) {
    int best = -1, best_rank = 0;
    for (int i = 0; i < count; i++) {
        int r = rank(&infos[i], i, selector);
        // A usable device wins over an unusable one that answers as well.
        if (r > 0 && infos[i].usable)
            r += 2;
        if (r > best_rank) {
            best_rank = r;
            best = i;
        }
    }
    char text[1024];
    list_devices(infos, count, text, sizeof text);
    if (best < 0) {
        if (selector)
            pel_fail(PEL_ERROR_DEVICE, "no device answers to '%s'; the devices are %s", selector,
                     text);
        else
            pel_fail(PEL_ERROR_DEVICE, "no usable device; the devices are %s", text);
    } else if (!infos[best].usable) {
        pel_fail(PEL_ERROR_DEVICE, "device %s cannot be used: %s", infos[best].name,
                 infos[best].problem);
        best = -1;
    }
    return best;
}

// Takes some of the device's compute units.
static bool divide(struct pel_device *device, int compute_units) {
    const char *name = device->info.name;
    if (compute_units > device->info.compute_units)
        return pel_fail(PEL_ERROR_ARGUMENT, "%d compute units; device %s has %d", compute_units,
                        name, device->info.compute_units);
    if (compute_units == device->info.compute_units)
        return true;
    const cl_device_partition_property properties[] = {CL_DEVICE_PARTITION_BY_COUNTS, compute_units,
                                                       CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    cl_device_id part;
    cl_uint count;
    if (clCreateSubDevices(device->id, properties, 1, &part, &count) != CL_SUCCESS || count < 1)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "device %s cannot be divided", name);
    device->id = part;
    device->divided = true;
    device->info.compute_units = compute_units;
    return true;
}

struct pel_device *pel_device_open(const char *selector, int compute_units,
                                   const struct pel_gl *gl) {
    if (!selector || !*selector)
        selector = getenv("PELLUCID_DEVICE");
    if (selector && !*selector)
        selector = NULL;

    struct pel_device_info infos[PEL_DEVICE_MAX];
    struct pel_device_place places[PEL_DEVICE_MAX];
    int count = pel_device_enumerate(infos, places);
    int chosen = count > 0 ? select_device(infos, count, selector) : -1;
    if (chosen < 0)
        return NULL;

    struct pel_device *device = pel_allocate(1, sizeof *device);
    if (!device)
        return NULL;
    device->info = infos[chosen];
    device->platform = places[chosen].platform;
    device->id = places[chosen].id;
    if (compute_units > 0 && !divide(device, compute_units)) {
        pel_device_close(device);
        return NULL;
    }
    cl_int status;
    device->context = pel_share_create_context(device, gl, &status);
    if (status == CL_SUCCESS)
        device->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    if (status != CL_SUCCESS) {
        pel_opencl_fail(status, infos[chosen].name);
        pel_device_close(device);
        return NULL;
    }
    return device;
}

void pel_device_close(struct pel_device *device) {
    if (!device)
        return;
    if (device->queue)
        clReleaseCommandQueue(device->queue);
    if (device->context)
        clReleaseContext(device->context);
    if (device->divided)
        clReleaseDevice(device->id);
    free(device);
}

const struct pel_device_info *pel_device_describe(const struct pel_device *device) {
    return &device->info;
}

const char *pel_device_unshared(const struct pel_device *device) {
    return device->unshared;
}

uint64_t pel_device_allocated_bytes(const struct pel_device *device) {
    return device->allocated_bytes;
}

uint64_t pel_device_uploaded_bytes(const struct pel_device *device) {
    return device->uploaded_bytes;
}

static cl_int wait(struct pel_device *device) {
    device->busy = false;
    return clFinish(device->queue);
}

bool pel_device_finish(struct pel_device *device) {
    cl_int status = wait(device);
    return status == CL_SUCCESS || pel_opencl_fail(status, device->info.name);
}

void pel_device_settle(struct pel_device *device) {
    if (device->busy)
        wait(device);
}
