// gl_layer.c - an OpenCL layer (cl_layer.h; the loader loads what $OPENCL_LAYERS names) that gives
// devices cl_khr_gl_sharing which have none, and watches over how it is used.
//
// A buffer of OpenGL is a plain buffer to the device. OpenGL gets its content when a release has
// been waited for, and not before: what OpenGL has from acquiring until then is poison. So a
// picture that is read too early is wrong, and what OpenGL writes in between is found. Commands
// that use a buffer that is not acquired, a second acquiring or releasing, and buffers that change
// or vanish are written to $GL_LAYER_LOG, each as a line "broken: ...", and the counts of what was
// done at the end. That OpenGL is done with a buffer when it is acquired cannot be seen from here.
//
// $GL_LAYER_FAULT makes something fail: device, context, buffer, acquire, small.
#include <CL/cl_gl.h>
#include <CL/cl_layer.h>
#include <epoxy/gl.h>
#include <epoxy/glx.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char extension[] = " cl_khr_gl_sharing";

enum { OBJECTS = 256, ARGUMENTS = 1024, POISON = 0xA5 };

enum state { OF_OPENGL, OF_OPENCL, RELEASING };

struct object {
    cl_mem memory; // NULL: the place is free
    GLuint name;
    size_t bytes;
    enum state state;
    cl_command_queue queue; // that releases it
};

struct argument {
    cl_kernel kernel; // NULL: the place is free
    cl_uint index;
    cl_mem memory; // of an object
};

static const struct _cl_icd_dispatch *target;
static struct _cl_icd_dispatch layer;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER; // guards all below
static struct object objects[OBJECTS];
static struct argument arguments[ARGUMENTS];
static int acquired_count, released_count, launch_count, broken_count;
static cl_context shared; // the one with OpenGL's
static Display *display;
static GLXContext theirs, ours;

static bool fault(const char *name) {
    const char *wanted = getenv("GL_LAYER_FAULT");
    return wanted && strcmp(wanted, name) == 0;
}

static void write_log(const char *text) {
    const char *path = getenv("GL_LAYER_LOG");
    FILE *file = path ? fopen(path, "a") : NULL;
    if (!file)
        return;
    fprintf(file, "%s\n", text);
    fclose(file);
}

static void complain(const char *what) {
    char line[256];
    snprintf(line, sizeof line, "broken: %s", what);
    write_log(line);
    broken_count++;
}

__attribute__((destructor)) static void report(void) {
    char line[256];
    for (int i = 0; i < OBJECTS; i++)
        if (objects[i].memory)
            complain("an object of OpenGL's buffer is left at the end");
    snprintf(line, sizeof line, "acquired %d, released %d, launched %d, broken %d", acquired_count,
             released_count, launch_count, broken_count);
    write_log(line);
}

// ---- OpenGL, in a context of the layer's own ---------------------------------------------------

struct before {
    Display *display;
    GLXDrawable draw, read;
    GLXContext context;
};

static struct before enter(void) {
    struct before before = {glXGetCurrentDisplay(), glXGetCurrentDrawable(),
                            glXGetCurrentReadDrawable(), glXGetCurrentContext()};
    if (!ours) {
        int id = 0, count = 0;
        glXQueryContext(display, theirs, GLX_FBCONFIG_ID, &id);
        GLXFBConfig *configs = glXChooseFBConfig(display, DefaultScreen(display),
                                                 (int[]){GLX_FBCONFIG_ID, id, None}, &count);
        const int wanted[] = {GLX_CONTEXT_MAJOR_VERSION_ARB,
                              3,
                              GLX_CONTEXT_MINOR_VERSION_ARB,
                              3,
                              GLX_CONTEXT_PROFILE_MASK_ARB,
                              GLX_CONTEXT_CORE_PROFILE_BIT_ARB,
                              None};
        if (count > 0)
            ours = glXCreateContextAttribsARB(display, configs[0], theirs, True, wanted);
        XFree(configs);
    }
    if (!ours || !glXMakeContextCurrent(display, None, None, ours))
        complain("the layer has no OpenGL context");
    return before;
}

static void leave(const struct before *before) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
    glFinish();
    if (before->context)
        glXMakeContextCurrent(before->display, before->draw, before->read, before->context);
    else
        glXMakeContextCurrent(display, None, None, NULL);
}

// Bytes of the buffer; 0 when there is none of that name.
static size_t ask_size(GLuint name) {
    GLint bytes = 0;
    struct before before = enter();
    if (glIsBuffer(name)) {
        glBindBuffer(GL_COPY_WRITE_BUFFER, name);
        glGetBufferParameteriv(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &bytes);
    }
    leave(&before);
    return (size_t)bytes;
}

// Fills the buffer with `content`, or with poison; `poisoned` is what it should hold until then.
static void fill(const struct object *object, const void *content, bool poisoned) {
    unsigned char *bytes = malloc(object->bytes);
    struct before before = enter();
    GLint size = 0;
    bool exists = glIsBuffer(object->name);
    if (exists) {
        glBindBuffer(GL_COPY_WRITE_BUFFER, object->name);
        glGetBufferParameteriv(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &size);
    }
    if (!bytes || !exists || (size_t)size != object->bytes) {
        complain("OpenGL's buffer changed its size or was deleted");
    } else {
        glGetBufferSubData(GL_COPY_WRITE_BUFFER, 0, size, bytes);
        bool same = true;
        for (size_t i = 0; poisoned && i < object->bytes; i++)
            same = same && bytes[i] == POISON;
        if (!same)
            complain("OpenGL wrote the buffer while OpenCL had it");
        memset(bytes, POISON, object->bytes);
        glBufferSubData(GL_COPY_WRITE_BUFFER, 0, size, content ? content : bytes);
    }
    leave(&before);
    free(bytes);
}

// ---- Objects -----------------------------------------------------------------------------------

static struct object *find(cl_mem memory) {
    for (int i = 0; memory && i < OBJECTS; i++)
        if (objects[i].memory == memory)
            return &objects[i];
    return NULL;
}

static void check_use(cl_mem memory, const char *what) {
    const struct object *object = find(memory);
    if (object && object->state != OF_OPENCL)
        complain(what);
}

// What was released is OpenGL's once the queue is empty.
static void settle(cl_command_queue queue) {
    for (int i = 0; i < OBJECTS; i++) {
        struct object *object = &objects[i];
        bool done = object->memory && object->state == RELEASING && object->queue == queue;
        void *content = done ? malloc(object->bytes) : NULL;
        if (!content)
            continue;
        if (target->clEnqueueReadBuffer(queue, object->memory, CL_TRUE, 0, object->bytes, content,
                                        0, NULL, NULL) != CL_SUCCESS)
            complain("the content cannot be read");
        fill(object, content, true);
        free(content);
        object->state = OF_OPENGL;
    }
}

static cl_mem CL_API_CALL create_from_buffer(cl_context context, cl_mem_flags flags, cl_GLuint name,
                                             cl_int *status) {
    pthread_mutex_lock(&mutex);
    size_t bytes = context == shared && !fault("buffer") ? ask_size(name) : 0;
    pthread_mutex_unlock(&mutex);
    cl_int result = bytes > 0 ? CL_SUCCESS : CL_INVALID_GL_OBJECT;
    if (fault("small"))
        bytes = 16;
    cl_mem memory = bytes > 0 ? target->clCreateBuffer(context, flags, bytes, NULL, &result) : NULL;
    pthread_mutex_lock(&mutex);
    int i = 0;
    while (memory && i < OBJECTS && objects[i].memory)
        i++;
    if (memory && i < OBJECTS)
        objects[i] = (struct object){.memory = memory, .name = name, .bytes = bytes};
    pthread_mutex_unlock(&mutex);
    if (status)
        *status = result;
    return memory;
}

static cl_int CL_API_CALL acquire(cl_command_queue queue, cl_uint count, const cl_mem *memories,
                                  cl_uint wait_count, const cl_event *waits, cl_event *event) {
    if (fault("acquire"))
        return CL_INVALID_GL_OBJECT;
    pthread_mutex_lock(&mutex);
    for (cl_uint i = 0; i < count; i++) {
        struct object *object = find(memories[i]);
        if (!object || object->state != OF_OPENGL) {
            complain("what is acquired is not OpenGL's");
            continue;
        }
        fill(object, NULL, false);
        object->state = OF_OPENCL;
        acquired_count++;
    }
    pthread_mutex_unlock(&mutex);
    return target->clEnqueueMarkerWithWaitList(queue, wait_count, waits, event);
}

static cl_int CL_API_CALL release(cl_command_queue queue, cl_uint count, const cl_mem *memories,
                                  cl_uint wait_count, const cl_event *waits, cl_event *event) {
    pthread_mutex_lock(&mutex);
    for (cl_uint i = 0; i < count; i++) {
        struct object *object = find(memories[i]);
        if (!object || object->state != OF_OPENCL) {
            complain("what is released was not acquired");
            continue;
        }
        object->state = RELEASING;
        object->queue = queue;
        released_count++;
    }
    pthread_mutex_unlock(&mutex);
    return target->clEnqueueMarkerWithWaitList(queue, wait_count, waits, event);
}

static cl_int CL_API_CALL release_memory(cl_mem memory) {
    pthread_mutex_lock(&mutex);
    struct object *object = find(memory);
    if (object && object->state != OF_OPENGL)
        complain("an object is destroyed that was not released and waited for");
    if (object)
        object->memory = NULL;
    for (int i = 0; object && i < ARGUMENTS; i++)
        if (arguments[i].memory == memory)
            arguments[i].kernel = NULL;
    pthread_mutex_unlock(&mutex);
    return target->clReleaseMemObject(memory);
}

// ---- Commands ----------------------------------------------------------------------------------

static cl_int CL_API_CALL set_argument(cl_kernel kernel, cl_uint index, size_t bytes,
                                       const void *value) {
    pthread_mutex_lock(&mutex);
    cl_mem memory = NULL;
    if (value && bytes == sizeof(cl_mem))
        memcpy(&memory, value, sizeof(cl_mem));
    struct argument *place = NULL;
    for (int i = 0; i < ARGUMENTS; i++) {
        if (arguments[i].kernel == kernel && arguments[i].index == index)
            arguments[i].kernel = NULL;
        if (!arguments[i].kernel && !place)
            place = &arguments[i];
    }
    if (find(memory) && place)
        *place = (struct argument){kernel, index, memory};
    pthread_mutex_unlock(&mutex);
    return target->clSetKernelArg(kernel, index, bytes, value);
}

static cl_int CL_API_CALL launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                 const size_t *offset, const size_t *size, const size_t *group,
                                 cl_uint wait_count, const cl_event *waits, cl_event *event) {
    pthread_mutex_lock(&mutex);
    for (int i = 0; i < ARGUMENTS; i++)
        if (arguments[i].kernel == kernel) {
            check_use(arguments[i].memory, "a kernel is launched on what is not acquired");
            launch_count++;
        }
    pthread_mutex_unlock(&mutex);
    return target->clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, size, group,
                                          wait_count, waits, event);
}

static cl_int CL_API_CALL read_buffer(cl_command_queue queue, cl_mem memory, cl_bool wait,
                                      size_t offset, size_t bytes, void *data, cl_uint wait_count,
                                      const cl_event *waits, cl_event *event) {
    pthread_mutex_lock(&mutex);
    check_use(memory, "what is not acquired is read");
    pthread_mutex_unlock(&mutex);
    return target->clEnqueueReadBuffer(queue, memory, wait, offset, bytes, data, wait_count, waits,
                                       event);
}

static cl_int CL_API_CALL finish(cl_command_queue queue) {
    cl_int status = target->clFinish(queue);
    pthread_mutex_lock(&mutex);
    settle(queue);
    pthread_mutex_unlock(&mutex);
    return status;
}

// ---- Devices and contexts ----------------------------------------------------------------------

static cl_int CL_API_CALL get_device_info(cl_device_id device, cl_device_info key, size_t bytes,
                                          void *value, size_t *used) {
    if (key != CL_DEVICE_EXTENSIONS || fault("extension"))
        return target->clGetDeviceInfo(device, key, bytes, value, used);
    size_t length = 0;
    cl_int status = target->clGetDeviceInfo(device, key, 0, NULL, &length);
    if (status != CL_SUCCESS)
        return status;
    char *list = calloc(1, length + sizeof extension);
    if (!list)
        return CL_OUT_OF_HOST_MEMORY;
    target->clGetDeviceInfo(device, key, length, list, NULL);
    memcpy(list + strlen(list), extension, sizeof extension);
    length = strlen(list) + 1;
    if (used)
        *used = length;
    if (value && bytes < length)
        status = CL_INVALID_VALUE;
    else if (value)
        memcpy(value, list, length);
    free(list);
    return status;
}

static cl_context_properties find_property(const cl_context_properties *properties,
                                           cl_context_properties key) {
    for (; properties && *properties; properties += 2)
        if (properties[0] == key)
            return properties[1];
    return 0;
}

static cl_int CL_API_CALL get_gl_context_info(const cl_context_properties *properties,
                                              cl_gl_context_info key, size_t bytes, void *value,
                                              size_t *used) {
    (void)key;
    cl_platform_id platform = (cl_platform_id)find_property(properties, CL_CONTEXT_PLATFORM);
    cl_uint count = 0;
    cl_device_id ids[16];
    if (!find_property(properties, CL_GL_CONTEXT_KHR) ||
        !find_property(properties, CL_GLX_DISPLAY_KHR))
        return CL_INVALID_GL_SHAREGROUP_REFERENCE_KHR;
    if (!fault("device"))
        target->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 16, ids, &count);
    if (used)
        *used = count * sizeof(cl_device_id);
    if (value && bytes < count * sizeof(cl_device_id))
        return CL_INVALID_VALUE;
    if (value)
        memcpy(value, ids, count * sizeof(cl_device_id));
    return CL_SUCCESS;
}

static cl_context CL_API_CALL create_context(const cl_context_properties *properties, cl_uint count,
                                             const cl_device_id *devices,
                                             void(CL_CALLBACK *notify)(const char *, const void *,
                                                                       size_t, void *),
                                             void *user, cl_int *status) {
    GLXContext context = (GLXContext)find_property(properties, CL_GL_CONTEXT_KHR);
    if (!context)
        return target->clCreateContext(properties, count, devices, notify, user, status);
    if (fault("context")) {
        *status = CL_INVALID_GL_SHAREGROUP_REFERENCE_KHR;
        return NULL;
    }
    const cl_context_properties plain[] = {CL_CONTEXT_PLATFORM,
                                           find_property(properties, CL_CONTEXT_PLATFORM), 0};
    cl_context made = target->clCreateContext(plain, count, devices, notify, user, status);
    pthread_mutex_lock(&mutex);
    shared = made;
    theirs = context;
    display = (Display *)find_property(properties, CL_GLX_DISPLAY_KHR);
    pthread_mutex_unlock(&mutex);
    return made;
}

// The loader asks the platform itself what OpenGL's context is of, and no layer.
static void *CL_API_CALL get_address(cl_platform_id platform, const char *name) {
    if (strcmp(name, "clGetGLContextInfoKHR") == 0)
        return (void *)(uintptr_t)get_gl_context_info;
    return target->clGetExtensionFunctionAddressForPlatform(platform, name);
}

CL_API_ENTRY __attribute__((visibility("default"))) cl_int CL_API_CALL
clGetLayerInfo(cl_layer_info key, size_t bytes, void *value, size_t *used) {
    static const cl_layer_api_version version = CL_LAYER_API_VERSION_100;
    static const char name[] = "OpenGL sharing, for tests";
    const void *answer = key == CL_LAYER_API_VERSION ? (const void *)&version : name;
    size_t length = key == CL_LAYER_API_VERSION ? sizeof version : sizeof name;
    if ((key != CL_LAYER_API_VERSION && key != CL_LAYER_NAME) || (value && bytes < length))
        return CL_INVALID_VALUE;
    if (value)
        memcpy(value, answer, length);
    if (used)
        *used = length;
    return CL_SUCCESS;
}

CL_API_ENTRY __attribute__((visibility("default"))) cl_int CL_API_CALL
clInitLayer(cl_uint count, const cl_icd_dispatch *dispatch, cl_uint *count_out,
            const cl_icd_dispatch **layer_out) {
    (void)count;
    target = dispatch;
    layer.clGetDeviceInfo = get_device_info;
    layer.clGetExtensionFunctionAddressForPlatform = get_address;
    layer.clGetGLContextInfoKHR = get_gl_context_info;
    layer.clCreateContext = create_context;
    layer.clCreateFromGLBuffer = create_from_buffer;
    layer.clEnqueueAcquireGLObjects = acquire;
    layer.clEnqueueReleaseGLObjects = release;
    layer.clReleaseMemObject = release_memory;
    layer.clSetKernelArg = set_argument;
    layer.clEnqueueNDRangeKernel = launch;
    layer.clEnqueueReadBuffer = read_buffer;
    layer.clFinish = finish;
    *layer_out = &layer;
    *count_out = sizeof layer / sizeof layer.clGetPlatformIDs;
    return CL_SUCCESS;
}
