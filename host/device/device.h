// device.h - an OpenCL device, and what lives on it. The only module that knows OpenCL: everybody
// else sees these opaque types. All calls go to one in-order queue.
#ifndef PEL_DEVICE_DEVICE_H
#define PEL_DEVICE_DEVICE_H

#include "pellucid.h"

struct pel_device;
struct pel_buffer;
struct pel_texture;
struct pel_kernel;

// ---- Devices -----------------------------------------------------------------------------------

// Opens the device that `selector` names, as struct pel_renderer_options says, or of one that can
// be divided only that many compute units; 0: all. Buffers of `gl` can be shared where the device
// can. The caller owns it. NULL (DEVICE, ARGUMENT, UNSUPPORTED) with a sentence that says what
// there is.
struct pel_device *pel_device_open(const char *selector, int compute_units,
                                   const struct pel_gl *gl);
void pel_device_close(struct pel_device *device);

// What the device is like. Borrowed.
const struct pel_device_info *pel_device_describe(const struct pel_device *device);

// Bytes in buffers and textures now, and bytes sent to the device so far.
uint64_t pel_device_allocated_bytes(const struct pel_device *device);
uint64_t pel_device_uploaded_bytes(const struct pel_device *device);

// Why buffers of OpenGL cannot be shared; "" when they can.
const char *pel_device_unshared(const struct pel_device *device);

// Waits for everything that was enqueued; false (DEVICE) if any of it failed.
bool pel_device_finish(struct pel_device *device);

// ---- Memory ------------------------------------------------------------------------------------

// A buffer of at least one byte with undefined content. `purpose` goes into the error's sentence.
struct pel_buffer *pel_buffer_create(struct pel_device *device, size_t bytes, const char *purpose);
void pel_buffer_destroy(struct pel_buffer *buffer);

// Its size; 0 for NULL.
size_t pel_buffer_bytes(const struct pel_buffer *buffer);

// A buffer that is the host's own memory, lent to the device until the buffer is destroyed. After
// the kernels that write it, giving it back waits for them and lets the host see what they wrote.
struct pel_buffer *pel_buffer_lend(struct pel_device *device, void *memory, size_t bytes,
                                   const char *purpose);
bool pel_buffer_give_back(struct pel_buffer *buffer);

// Both wait until the bytes have been copied.
bool pel_buffer_write(struct pel_buffer *buffer, size_t offset, size_t bytes, const void *data);
bool pel_buffer_read(struct pel_buffer *buffer, size_t offset, size_t bytes, void *data);

// A buffer of OpenGL, whose store must stay as it is until this is destroyed. Kernels may use it
// between acquiring and releasing only, and OpenGL at all other times only: it is done with the
// buffer before that is acquired, and releasing waits for everything that was enqueued.
struct pel_buffer *pel_buffer_share(struct pel_device *device, uint32_t gl_buffer);
bool pel_buffer_acquire(struct pel_buffer *buffer);
bool pel_buffer_release(struct pel_buffer *buffer);

// What a texel of a 3-D image holds.
enum pel_texel { PEL_TEXEL_R8, PEL_TEXEL_R16, PEL_TEXEL_R32F, PEL_TEXEL_RGBA8, PEL_TEXEL_COUNT };

// True when the device can read such 3-D images.
bool pel_texture_supported(const struct pel_device *device, enum pel_texel texel);

// A 3-D image of dims[0] x dims[1] x dims[2] texels with undefined content.
struct pel_texture *pel_texture_create(struct pel_device *device, enum pel_texel texel,
                                       const size_t dims[3], const char *purpose);
void pel_texture_destroy(struct pel_texture *texture);

// Copies a tightly packed box of texels to `origin`; waits until it has been.
bool pel_texture_write(struct pel_texture *texture, const size_t origin[3], const size_t dims[3],
                       const void *data);

// ---- Kernels -----------------------------------------------------------------------------------

// Builds one kernel from a file below kernels/ with -D definitions. $PELLUCID_KERNELS names a
// folder to read the files from instead of the embedded ones. NULL (BUILD) with the compiler's
// words.
struct pel_kernel *pel_kernel_build(struct pel_device *device, const char *file, const char *name,
                                    const char *definitions);
void pel_kernel_destroy(struct pel_kernel *kernel);

// Another kernel of the program that `kernel` was built in: that costs no compilation. The caller
// owns it, and it may outlive `kernel`.
struct pel_kernel *pel_kernel_sibling(const struct pel_kernel *kernel, const char *name);

// Arguments, by position.
bool pel_kernel_set_buffer(struct pel_kernel *kernel, int index, const struct pel_buffer *buffer);
bool pel_kernel_set_texture(struct pel_kernel *kernel, int index,
                            const struct pel_texture *texture);
bool pel_kernel_set_u32(struct pel_kernel *kernel, int index, uint32_t value);

// Enqueues `count` work-items in groups of `group` (which divides count).
bool pel_kernel_launch(struct pel_kernel *kernel, size_t count, size_t group);

// The largest work-group this kernel runs in on its device.
size_t pel_kernel_max_group(const struct pel_kernel *kernel);

// What the device says of a kernel; zeros where it does not.
struct pel_kernel_info pel_kernel_describe(const struct pel_kernel *kernel);

#endif
