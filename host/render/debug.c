// debug.c - the numbers of a debug view, painted.
#include "render/debug.h"

#include <math.h>

// Numbers that say which, not how much, are told apart by hues a golden section of the circle from
// each other, so that neighbours never look alike.
static void paint_name(float rgba[4], double number) {
    double hue = fmod(number * 0.61803398874989485, 1) * 6;
    double low = fmod(number, 3) / 6; // and by three brightnesses
    for (int c = 0; c < 3; c++) {
        double distance = fabs(fmod(hue - 2.0 * c + 9, 6) - 3);
        rgba[c] = (float)(low + (1 - low) * fmin(fmax(2 - distance, 0), 1));
    }
}

bool pel_debug_paint(struct pel_image *image, enum pel_debug view, float *numbers,
                     struct pel_debug_range *range) {
    struct pel_transfer *heat = pel_transfer_preset("viridis");
    if (!heat)
        return false;
    size_t pixels = (size_t)image->width * (size_t)image->height;
    double sum = 0;
    *range = (struct pel_debug_range){.min = INFINITY};
    for (size_t i = 0; i < pixels; i++) {
        double number = image->rgba[4 * i];
        range->min = fmin(range->min, number);
        range->max = fmax(range->max, number);
        sum += number;
        if (numbers)
            numbers[i] = (float)number;
    }
    range->mean = sum / (double)pixels;

    // Presets count their values from 0 to 1.
    bool names = view == PEL_DEBUG_WORK_GROUP || view == PEL_DEBUG_WORK_ITEM;
    for (size_t i = 0; i < pixels; i++) {
        float *rgba = &image->rgba[4 * i];
        double number = rgba[0], colour[4] = {0};
        if (number > 0)
            pel_transfer_evaluate(heat, number / range->max, colour);
        for (int c = 0; c < 3; c++)
            rgba[c] = (float)colour[c];
        if (names)
            paint_name(rgba, number);
        rgba[3] = 1;
    }
    pel_transfer_destroy(heat);
    return true;
}
