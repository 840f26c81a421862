// present.h - brings pictures into a window with OpenGL 3.3 core; nothing is rendered with it.
//
// Pixels travel through a pixel buffer object, which OpenCL may have written, into a texture, and
// the texture is drawn as it is: where sizes agree, a pixel of the picture is a pixel of the
// window. All functions work on the OpenGL context that is current, and a presenter belongs to the
// one it was made in.
#ifndef PEL_VIEWER_PRESENT_H
#define PEL_VIEWER_PRESENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PEL_PRESENT_PICTURES = 4 };

// A part of the window, in pixels from its top left corner.
struct pel_rectangle {
    int x, y, width, height;
};

// NULL, with the reason in `sentence`, when OpenGL is less than it says.
struct pel_present *pel_present_create(char *sentence, size_t bytes);
void pel_present_destroy(struct pel_present *present);

// Makes picture number `slot` from 8-bit RGBA, rows from the top.
void pel_present_upload(struct pel_present *present, int slot, int width, int height,
                        const uint8_t *rgba);

// The same from a buffer of OpenGL that already holds the pixels.
void pel_present_take(struct pel_present *present, int slot, int width, int height,
                      uint32_t buffer);

// Clears the whole window of this size. What is drawn next goes into it.
void pel_present_begin(struct pel_present *present, const int window_px[2]);

// Draws a picture, or the part of it that is given in shares (left and top edge, width and height),
// into a part of the window, stretched to it. A slot without a picture draws nothing.
void pel_present_draw(struct pel_present *present, int slot, const double part[4],
                      const struct pel_rectangle *place);

// Between these two, drawing goes into memory in place of the window, whether it can be seen or
// not; the end gives 8-bit RGB, rows from the top, to be freed. False and NULL when there is no
// memory.
bool pel_present_catch(struct pel_present *present, const int window_px[2]);
uint8_t *pel_present_caught(struct pel_present *present);

#endif
