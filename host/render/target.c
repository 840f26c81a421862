// target.c - where the kernel leaves the picture.
#include "render/target.h"

static size_t image_bytes(const struct pel_image *image) {
    return (size_t)image->width * (size_t)image->height * 4 * sizeof *image->rgba;
}

bool pel_target_begin(struct pel_target *target, struct pel_device *device,
                      struct pel_image *image) {
    size_t bytes = image_bytes(image);
    bool lent = image->rgba && pel_device_describe(device)->cpu;
    if (!lent && bytes <= target->bytes)
        return true;
    pel_target_finish(target);
    target->buffer = lent ? pel_buffer_lend(device, image->rgba, bytes, "the picture")
                          : pel_buffer_create(device, bytes, "the picture");
    target->bytes = lent || !target->buffer ? 0 : bytes;
    return target->buffer != NULL;
}

bool pel_target_end(struct pel_target *target, struct pel_image *image, bool good) {
    if (!image->rgba)
        return good;
    if (target->bytes > 0)
        return good && pel_buffer_read(target->buffer, 0, image_bytes(image), image->rgba);
    good = good && pel_buffer_give_back(target->buffer);
    pel_target_finish(target);
    return good;
}

void pel_target_finish(struct pel_target *target) {
    pel_buffer_destroy(target->buffer);
    *target = (struct pel_target){0};
}
