// tiff_shape.c - what a TIFF page becomes: its size, number type and components.
//
// - Grey: unsigned integers up to 8 and 16 bits become uint8 and uint16, signed ones int8 and
//   int16, half floats float32; wider numbers go through widen.h. 1, 2 and 4-bit greys are
//   expanded to 0..255 (times 255, 85, 17); other depths keep their numbers.
// - RGB with 3 samples becomes RGB8, with an alpha channel RGBA8 (straight). Deeper colours are
//   scaled to 8 bits by their type's range, floats from 0..1.
// - A palette of greys becomes grey, any other RGB8. In ImageJ's files the palette is a way to
//   look at the data, so the indices are the values.
// - Several samples that are no RGB colour are channels, of which one is chosen.
// - CMYK becomes RGB8 as (1 - ink) (1 - black): colour profiles are not looked at.
// - YCbCr, Lab and logarithmic colours become RGB8 through libtiff's RGBA interface.
#include "volume/tiff.h"

#include "base/error.h"

static bool needs_rendering(const struct pel_tiff_page *page) {
    switch (page->photometric) {
    case PHOTOMETRIC_SEPARATED:
        return page->samples < 4;
    case PHOTOMETRIC_YCBCR:
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
        return true;
    default:
        return page->compression == COMPRESSION_OJPEG;
    }
}

static bool element_of(const struct pel_tiff_page *page, enum pel_element *element) {
    int bits = page->bits;
    bool integer = page->format != SAMPLEFORMAT_IEEEFP,
         is_signed = page->format == SAMPLEFORMAT_INT;
    if (page->format == SAMPLEFORMAT_COMPLEXINT || page->format == SAMPLEFORMAT_COMPLEXIEEEFP)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "complex numbers");
    if (integer ? bits < 1 || (bits > 32 && bits != 64)
                : bits != 16 && bits != 24 && bits != 32 && bits != 64)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "%s of %d bits",
                        integer ? "integers" : "floating-point numbers", bits);
    if (!integer)
        *element = bits == 64 ? PEL_ELEMENT_F64 : PEL_ELEMENT_F32;
    else if (bits <= 8)
        *element = is_signed ? PEL_ELEMENT_I8 : PEL_ELEMENT_U8;
    else if (bits <= 16)
        *element = is_signed ? PEL_ELEMENT_I16 : PEL_ELEMENT_U16;
    else if (bits <= 32)
        *element = is_signed ? PEL_ELEMENT_I32 : PEL_ELEMENT_U32;
    else
        *element = is_signed ? PEL_ELEMENT_I64 : PEL_ELEMENT_U64;
    return true;
}

static void shape_colour(struct pel_tiff_shape *shape, int components) {
    shape->element = PEL_ELEMENT_U8;
    shape->components = components;
}

bool pel_tiff_shape_of(struct pel_tiff_shape *shape, int *channel_count,
                       const struct pel_tiff_page *page, bool split, bool indices) {
    bool turned = page->orientation >= ORIENTATION_LEFTTOP;
    *shape = (struct pel_tiff_shape){
        .width = turned ? page->height : page->width,
        .height = turned ? page->width : page->height,
        .components = 1,
        .indices = indices || page->palette == PEL_PALETTE_NONE,
    };
    *channel_count = 1;
    if (!TIFFIsCODECConfigured(page->compression)) {
        const TIFFCodec *codec = TIFFFindCODEC(page->compression);
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "compression %d (%s) is not in this build of libtiff", page->compression,
                        codec ? codec->name : "unknown");
    }
    if (needs_rendering(page)) {
        shape->rendered = true;
        shape_colour(shape, split ? 1 : 3);
        *channel_count = split ? 3 : 1;
        return true;
    }
    if (!element_of(page, &shape->element))
        return false;
    if (page->photometric == PHOTOMETRIC_PALETTE && !shape->indices) {
        shape_colour(shape, page->palette == PEL_PALETTE_GREY ? 1 : 3);
        return true;
    }
    if (page->photometric == PHOTOMETRIC_SEPARATED && !split) {
        shape->cmyk = true;
        shape_colour(shape, 3);
        return true;
    }
    bool colour =
        page->photometric == PHOTOMETRIC_RGB && (page->samples == 3 || page->samples == 4);
    if (colour && !split) {
        bool alpha = page->samples == 4 && page->alpha != EXTRASAMPLE_UNSPECIFIED;
        shape_colour(shape, alpha ? 4 : 3);
        return true;
    }
    // The alpha behind a grey is no channel.
    bool alpha = page->samples == 2 &&
                 (page->alpha == EXTRASAMPLE_ASSOCALPHA || page->alpha == EXTRASAMPLE_UNASSALPHA);
    *channel_count = alpha && !split ? 1 : page->samples;
    return true;
}
