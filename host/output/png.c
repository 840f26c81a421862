// png.c - writes a picture as PNG: 8 or 16 bits a channel, RGBA, with text chunks.
//
// PNG's alpha is straight (PNG specification, third edition, section 6.2), so colours are divided
// by alpha first. What was computed can be written undivided on request, for programs that
// composite it themselves. Nothing that depends on the time is written: the same picture gives the
// same bytes.
#include "output/image.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

// Longer texts are compressed.
enum { TEXT_PLAIN_BYTES = 1024 };

// libpng never returns from its error callback; setjmp catches it in write_png.
static void on_error(png_structp png, png_const_charp message) {
    pel_fail(PEL_ERROR_FILE, "PNG: %s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    pel_warn("PNG: %s", message);
}

static bool is_ascii(const char *text) {
    for (; *text; text++)
        if ((unsigned char)*text >= 0x80)
            return false;
    return true;
}

// tEXt and zTXt hold Latin-1; what is beyond ASCII goes into iTXt, which holds UTF-8.
static png_text *make_texts(const struct pel_image_options *options) {
    png_text *texts = pel_allocate((size_t)options->text_count, sizeof *texts);
    if (!texts)
        return NULL;
    for (int i = 0; i < options->text_count; i++) {
        const char *keyword = options->texts[i][0], *text = options->texts[i][1];
        size_t length = strlen(text);
        bool compressed = length > TEXT_PLAIN_BYTES;
        texts[i] = (png_text){.key = (png_charp)keyword, .text = (png_charp)text};
        if (is_ascii(text)) {
            texts[i].compression =
                compressed ? PNG_TEXT_COMPRESSION_zTXt : PNG_TEXT_COMPRESSION_NONE;
            texts[i].text_length = length;
        } else {
            texts[i].compression =
                compressed ? PNG_ITXT_COMPRESSION_zTXt : PNG_ITXT_COMPRESSION_NONE;
            texts[i].itxt_length = length;
            texts[i].lang = texts[i].lang_key = (png_charp) "";
        }
    }
    return texts;
}

// Fills one row of big-endian samples.
static void fill_row(png_bytep row, const float *rgba, int width,
                     const struct pel_image_options *options) {
    unsigned max = options->depth == 16 ? 65535 : 255;
    for (int x = 0; x < width; x++, rgba += 4) {
        // Where nothing was hit there is no colour to recover.
        double divisor = options->premultiplied ? 1 : rgba[3];
        for (int c = 0; c < 4; c++) {
            double value = c == 3 ? rgba[3] : divisor > 0 ? rgba[c] / divisor : 0;
            unsigned sample = pel_image_quantise(value, max);
            if (options->depth == 16)
                *row++ = (png_byte)(sample >> 8);
            *row++ = (png_byte)(sample & 255);
        }
    }
}

// The only function that libpng jumps back into. It owns nothing and changes no local variable
// after setjmp but the row counter, which is not read after a jump.
static bool write_png(png_structp png, png_infop info, const struct pel_image *image,
                      const struct pel_image_options *options, const png_text *texts, png_bytep row,
                      FILE *stream) {
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_init_io(png, stream);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, options->depth,
                 PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (texts)
        png_set_text(png, info, texts, options->text_count);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++) {
        fill_row(row, image->rgba + (size_t)y * (size_t)image->width * 4, image->width, options);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    return true;
}

static bool encode(const struct pel_image *image, const struct pel_image_options *options,
                   FILE *stream) {
    bool good = false;
    png_infop info = NULL;
    png_text *texts = NULL;
    png_bytep row = pel_allocate((size_t)image->width * 4, (size_t)options->depth / 8);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning);
    if (!row)
        goto done;
    if (png)
        info = png_create_info_struct(png);
    if (!info) {
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a PNG encoder");
        goto done;
    }
    if (options->texts && options->text_count > 0 && !(texts = make_texts(options)))
        goto done;
    good = write_png(png, info, image, options, texts, row, stream);
done:
    png_destroy_write_struct(&png, &info);
    free(texts);
    free(row);
    return good;
}

bool pel_png_save(const struct pel_image *image, const char *path,
                  const struct pel_image_options *options) {
    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    if (!encode(image, options, output.stream)) {
        pel_output_abandon(&output);
        return pel_fail_in("%s", path);
    }
    return pel_output_commit(&output);
}
