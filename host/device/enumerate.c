// enumerate.c - every device of every platform, what it can do, and what Pellucid would choose for
// it.
//
// Drivers are the part of the system we trust least: a platform that fails is a warning, a question
// a device does not answer leaves a zero, and a device we cannot use says why.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/opencl.h"

enum { PLATFORM_MAX = 16 };

static const char *status_name(cl_int status) {
    static const struct {
        cl_int status;
        const char *name;
    } names[] = {
        {CL_DEVICE_NOT_FOUND, "no device found"},
        {CL_DEVICE_NOT_AVAILABLE, "device not available"},
        {CL_COMPILER_NOT_AVAILABLE, "no compiler available"},
        {CL_MEM_OBJECT_ALLOCATION_FAILURE, "memory allocation failed"},
        {CL_OUT_OF_RESOURCES, "out of resources"},
        {CL_OUT_OF_HOST_MEMORY, "out of host memory"},
        {CL_BUILD_PROGRAM_FAILURE, "build failed"},
        {CL_INVALID_VALUE, "invalid value"},
        {CL_INVALID_BUFFER_SIZE, "invalid buffer size"},
        {CL_INVALID_IMAGE_SIZE, "invalid image size"},
        {CL_INVALID_IMAGE_FORMAT_DESCRIPTOR, "invalid image format"},
        {CL_IMAGE_FORMAT_NOT_SUPPORTED, "image format not supported"},
        {CL_INVALID_KERNEL_ARGS, "invalid kernel arguments"},
        {CL_INVALID_WORK_GROUP_SIZE, "invalid work-group size"},
        {-1001, "no OpenCL platform is installed"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].status == status)
            return names[i].name;
    return "OpenCL error";
}

bool pel_opencl_fail(cl_int status, const char *what) {
    return pel_fail(PEL_ERROR_DEVICE, "%s: %s (%d)", what, status_name(status), status);
}

static void ask_text(cl_device_id id, cl_device_info key, char *text, size_t bytes) {
    char answer[1024] = "";
    if (clGetDeviceInfo(id, key, sizeof answer - 1, answer, NULL) != CL_SUCCESS)
        answer[0] = '\0';
    const char *start = answer + strspn(answer, " ");
    snprintf(text, bytes, "%s", start);
}

// A number of either 4 or 8 bytes; 0 when the device does not say.
static uint64_t ask_number(cl_device_id id, cl_device_info key) {
    union {
        cl_uint small;
        cl_ulong large;
    } answer = {.large = 0};
    size_t bytes = 0;
    if (clGetDeviceInfo(id, key, sizeof answer, &answer, &bytes) != CL_SUCCESS)
        return 0;
    return bytes == sizeof answer.small ? answer.small : answer.large;
}

// Whether an extension is in the device's list, which may be of any length.
static bool has_extension(cl_device_id id, const char *name) {
    size_t bytes = 0, length = strlen(name);
    if (clGetDeviceInfo(id, CL_DEVICE_EXTENSIONS, 0, NULL, &bytes) != CL_SUCCESS)
        return false;
    char *list = pel_allocate(bytes + 1, 1);
    bool found = false;
    if (list && clGetDeviceInfo(id, CL_DEVICE_EXTENSIONS, bytes, list, NULL) == CL_SUCCESS)
        for (const char *at = list; !found && (at = strstr(at, name)); at += length)
            found = (at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0');
    free(list);
    return found;
}

// Lanes for a CPU are its native vector's, but at least 4: narrower packets cost nothing there.
// PoCL profits from packets; other CPU implementations vectorise across work-items themselves, and
// packets only stand in their way.
static int choose_lanes(const struct pel_device_info *info) {
    if (!info->cpu || !strstr(info->platform, "Portable Computing Language"))
        return 1;
    return info->native_float_width >= 16 ? 16 : info->native_float_width >= 8 ? 8 : 4;
}

static void choose(struct pel_device_info *info) {
    info->lanes = choose_lanes(info);
    // Through PoCL read_imagef is a scalar switch per sample; hardware has it for nothing.
    info->reader = info->gpu && info->images ? PEL_READER_IMAGE : PEL_READER_BUFFER;
    int wanted = info->gpu ? 64 : info->lanes > 1 ? 4 : 16;
    while (wanted > 1 && (size_t)wanted > info->max_work_group)
        wanted /= 2;
    info->work_group = wanted;
}

static void find_problem(cl_device_id id, struct pel_device_info *info) {
    const char *problem = NULL;
    int major = 0, minor = 0;
    sscanf(info->version, "OpenCL %d.%d", &major, &minor);
    if (!ask_number(id, CL_DEVICE_AVAILABLE))
        problem = "the device is not available";
    else if (!ask_number(id, CL_DEVICE_COMPILER_AVAILABLE))
        problem = "it has no compiler for kernels";
    else if (!ask_number(id, CL_DEVICE_ENDIAN_LITTLE))
        problem = "it is big-endian";
    else if (major < 1 || (major == 1 && minor < 2))
        problem = "it is older than OpenCL 1.2";
    else if (info->max_constant_bytes < 16384)
        problem = "it has less than 16 KiB of constant memory";
    info->usable = problem == NULL;
    snprintf(info->problem, sizeof info->problem, "%s", problem ? problem : "");
}

static void describe(const struct pel_device_place *place, struct pel_device_info *info) {
    cl_device_id id = place->id;
    *info = (struct pel_device_info){0};
    ask_text(id, CL_DEVICE_NAME, info->name, sizeof info->name);
    ask_text(id, CL_DEVICE_VENDOR, info->vendor, sizeof info->vendor);
    ask_text(id, CL_DRIVER_VERSION, info->driver, sizeof info->driver);
    ask_text(id, CL_DEVICE_VERSION, info->version, sizeof info->version);
    clGetPlatformInfo(place->platform, CL_PLATFORM_NAME, sizeof info->platform - 1, info->platform,
                      NULL);
    cl_device_type type = ask_number(id, CL_DEVICE_TYPE);
    info->cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    info->gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
    // llvmpipe calls itself what it stands in for, but it is this machine's CPU.
    if (strstr(info->name, "llvmpipe")) {
        info->cpu = true;
        info->gpu = false;
    }
    info->compute_units = (int)ask_number(id, CL_DEVICE_MAX_COMPUTE_UNITS);
    info->memory_bytes = ask_number(id, CL_DEVICE_GLOBAL_MEM_SIZE);
    info->max_allocation_bytes = ask_number(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    info->max_constant_bytes = ask_number(id, CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE);
    info->local_bytes = ask_number(id, CL_DEVICE_LOCAL_MEM_SIZE);
    info->native_float_width = (int)ask_number(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT);
    info->max_work_group = ask_number(id, CL_DEVICE_MAX_WORK_GROUP_SIZE);
    info->max_image[0] = ask_number(id, CL_DEVICE_IMAGE3D_MAX_WIDTH);
    info->max_image[1] = ask_number(id, CL_DEVICE_IMAGE3D_MAX_HEIGHT);
    info->max_image[2] = ask_number(id, CL_DEVICE_IMAGE3D_MAX_DEPTH);
    info->images = ask_number(id, CL_DEVICE_IMAGE_SUPPORT) && info->max_image[2] > 1;
    info->gl_sharing = has_extension(id, "cl_khr_gl_sharing");
    find_problem(id, info);
    choose(info);
}

static int enumerate_platform(cl_platform_id platform, int count, struct pel_device_info *infos,
                              struct pel_device_place *places) {
    cl_device_id ids[PEL_DEVICE_MAX];
    cl_uint found = 0;
    cl_int status = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, PEL_DEVICE_MAX, ids, &found);
    if (status != CL_SUCCESS && status != CL_DEVICE_NOT_FOUND) {
        char name[128] = "an unnamed platform";
        clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name - 1, name, NULL);
        pel_warn("OpenCL platform %s is left out: %s (%d)", name, status_name(status), status);
        return count;
    }
    for (cl_uint i = 0; status == CL_SUCCESS && i < found && count < PEL_DEVICE_MAX; i++) {
        places[count] = (struct pel_device_place){platform, ids[i]};
        describe(&places[count], &infos[count]);
        count++;
    }
    return count;
}

int pel_device_enumerate(struct pel_device_info *infos, struct pel_device_place *places) {
    cl_platform_id platforms[PLATFORM_MAX];
    cl_uint platform_count = 0;
    cl_int status = clGetPlatformIDs(PLATFORM_MAX, platforms, &platform_count);
    if (status != CL_SUCCESS || platform_count == 0) {
        pel_fail(PEL_ERROR_DEVICE, "no OpenCL platform is installed; pocl-opencl-icd gives one for "
                                   "the CPU");
        return 0;
    }
    int count = 0;
    for (cl_uint i = 0; i < platform_count && i < PLATFORM_MAX; i++)
        count = enumerate_platform(platforms[i], count, infos, places);
    if (count == 0)
        pel_fail(PEL_ERROR_DEVICE, "%u OpenCL platforms, but none has a device", platform_count);
    return count;
}

int pel_device_list(struct pel_device_info *devices) {
    struct pel_device_place places[PEL_DEVICE_MAX];
    return pel_device_enumerate(devices, places);
}
