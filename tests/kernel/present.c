// present.c - the kernel that rounds a picture to 8 bits for a window rounds as a file does, at
// every border between two levels and for what is no colour, and takes the part that is asked for.
#include <math.h>
#include <string.h>

#include "device/device.h"
#include "output/image.h"
#include "support/test.h"

enum { ROW = 40, ROWS = 45, LEFT = 3, TOP = 2, WIDTH = 31, HEIGHT = 41 };

// The borders between levels, and the floats on either side, then what is no colour.
static float value_at(int i) {
    static const float others[] = {-1,      -0.0f, 0,   1e-40f,   0.5f,
                                   1.0001f, 1e30f, NAN, INFINITY, -INFINITY};
    int border = i / 5;
    if (border >= 255)
        return others[i % (int)(sizeof others / sizeof *others)];
    float value = (float)((border + 0.5) / 255);
    for (int k = i % 5; k > 2; k--)
        value = nextafterf(value, 2);
    for (int k = i % 5; k < 2; k++)
        value = nextafterf(value, -2);
    return value;
}

static void test_present(void **state) {
    (void)state;
    static float picture[ROWS * ROW][4];
    static uint8_t pixels[HEIGHT * WIDTH][4];
    for (int i = 0; i < ROWS * ROW * 4; i++)
        picture[i / 4][i % 4] = NAN;
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        int pixel = i / 4, x = LEFT + pixel % WIDTH, y = TOP + pixel / WIDTH;
        picture[y * ROW + x][i % 4] = value_at(i);
    }
    struct pel_device *device = pel_device_open(NULL, 0, &(struct pel_gl){0});
    assert_non_null(device);
    struct pel_kernel *kernel = pel_kernel_build(device, "present.cl", "present", "");
    if (!kernel)
        fail_msg("%s", pel_error_message());
    struct pel_buffer *from = pel_buffer_create(device, sizeof picture, "the picture");
    struct pel_buffer *to = pel_buffer_create(device, sizeof pixels, "the pixels");
    assert_true(pel_buffer_write(from, 0, sizeof picture, picture));
    assert_true(pel_kernel_set_buffer(kernel, 0, from) && pel_kernel_set_buffer(kernel, 1, to));
    const uint32_t numbers[] = {WIDTH, HEIGHT, ROW, TOP * ROW + LEFT};
    for (int i = 0; i < 4; i++)
        assert_true(pel_kernel_set_u32(kernel, 2 + i, numbers[i]));
    assert_true(pel_kernel_launch(kernel, (WIDTH * HEIGHT + 15) / 16 * 16, 16));
    assert_true(pel_buffer_read(to, 0, sizeof pixels, pixels));
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        if (pixels[i / 4][i % 4] != pel_image_quantise((double)value_at(i), 255))
            fail_msg("%.9g gives %d, not %u", (double)value_at(i), pixels[i / 4][i % 4],
                     pel_image_quantise((double)value_at(i), 255));
    pel_buffer_destroy(from);
    pel_buffer_destroy(to);
    pel_kernel_destroy(kernel);
    pel_device_close(device);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_present)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
