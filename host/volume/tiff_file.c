// tiff_file.c - a TIFF file's pages: where they are and how they are stored.
//
// libtiff reports through callbacks of its own handle, never on stderr, and may not allocate more
// at once than a multiple of the file's size. Its errors become the sentence of a failure. Its
// warnings about directories tell of oddities of the writer and are dropped; those about pixels
// tell of damage and are passed on. It notices chains of directories that loop; a chain that breaks
// off ends the stack there, with a warning. Sub-directories are not in the chain, so they are never
// seen.
#include "volume/tiff.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

// A sentence is one line, but what libtiff quotes from the file may have several.
static void keep_first(char text[256], const char *format, va_list arguments) {
    if (text[0])
        return;
    vsnprintf(text, 256, format, arguments);
    for (char *c = text; *c; c++)
        if (iscntrl((unsigned char)*c))
            *c = ' ';
}

static int on_error(TIFF *handle, void *user, const char *module, const char *format,
                    va_list arguments) {
    (void)handle, (void)module;
    keep_first(((struct pel_tiff_reports *)user)->error, format, arguments);
    return 1;
}

static int on_warning(TIFF *handle, void *user, const char *module, const char *format,
                      va_list arguments) {
    (void)handle, (void)module;
    keep_first(((struct pel_tiff_reports *)user)->warning, format, arguments);
    return 1;
}

TIFF *pel_tiff_handle(const char *path, const char *mode, size_t limit,
                      struct pel_tiff_reports *reports) {
    *reports = (struct pel_tiff_reports){0};
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();
    if (!options) {
        pel_fail(PEL_ERROR_MEMORY, "cannot open a TIFF file: memory ran out");
        return NULL;
    }
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, (tmsize_t)limit);
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, reports);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, reports);
    TIFF *handle = TIFFOpenExt(path, mode, options);
    TIFFOpenOptionsFree(options);
    if (!handle) {
        // Some of libtiff's sentences begin with the file's name, which callers add anyhow.
        const char *reason = reports->error[0] ? reports->error : "no directory";
        size_t named = strlen(path);
        bool again = strncmp(reason, path, named) == 0 && strncmp(reason + named, ": ", 2) == 0;
        pel_fail(PEL_ERROR_FORMAT, "not a readable TIFF file: %s",
                 again ? reason + named + 2 : reason);
    }
    return handle;
}

bool pel_tiff_fail(const struct pel_tiff_file *file, const char *otherwise) {
    // When whole strips are read libtiff does not know the row, and says so with 2^32 - 1.
    const char *nowhere = strstr(file->reports.error, "4294967295"),
               *rest = strchr(file->reports.error, ';');
    if (nowhere && rest)
        return pel_fail(PEL_ERROR_FORMAT, "read error:%s", rest + 1);
    return pel_fail(PEL_ERROR_FORMAT, "%s",
                    file->reports.error[0] ? file->reports.error : otherwise);
}

// The figures are the most each code can do: deflate 258 bytes from 2 bits, LZW a string of 4096
// from 12 bits, PackBits 128 from 2 bytes, JPEG a block of 64 from 2 bits (progressive ones a
// little less), a fax row of any length from 1 bit. Where no figure is known the fax one is taken.
uint64_t pel_tiff_expansion(uint16_t compression) {
    switch (compression) {
    case COMPRESSION_NONE:
        return 1;
    case COMPRESSION_PACKBITS:
        return 64;
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE:
    case COMPRESSION_PIXARLOG:
        return 1032;
    case COMPRESSION_JPEG:
    case COMPRESSION_OJPEG:
        return 1024;
    case COMPRESSION_LZW:
        return 2731;
    default:
        return 65536;
    }
}

static enum pel_tiff_palette palette_of(TIFF *handle, uint16_t bits) {
    uint16_t *red, *green, *blue;
    if (bits > 16 || !TIFFGetField(handle, TIFFTAG_COLORMAP, &red, &green, &blue))
        return PEL_PALETTE_NONE;
    for (int i = 0; i < 1 << bits; i++)
        if (red[i] != green[i] || red[i] != blue[i])
            return PEL_PALETTE_COLOUR;
    return PEL_PALETTE_GREY;
}

static bool page_describe(struct pel_tiff_page *page, TIFF *handle) {
    *page = (struct pel_tiff_page){.offset = TIFFCurrentDirOffset(handle)};
    uint32_t subfile = 0;
    uint16_t old_subfile = 0, extra_count = 0, *extras = NULL;
    TIFFGetField(handle, TIFFTAG_IMAGEWIDTH, &page->width);
    TIFFGetField(handle, TIFFTAG_IMAGELENGTH, &page->height);
    TIFFGetFieldDefaulted(handle, TIFFTAG_BITSPERSAMPLE, &page->bits);
    TIFFGetFieldDefaulted(handle, TIFFTAG_SAMPLEFORMAT, &page->format);
    TIFFGetFieldDefaulted(handle, TIFFTAG_SAMPLESPERPIXEL, &page->samples);
    TIFFGetFieldDefaulted(handle, TIFFTAG_PLANARCONFIG, &page->planar);
    TIFFGetFieldDefaulted(handle, TIFFTAG_COMPRESSION, &page->compression);
    TIFFGetFieldDefaulted(handle, TIFFTAG_ORIENTATION, &page->orientation);
    if (!TIFFGetField(handle, TIFFTAG_PHOTOMETRIC, &page->photometric))
        page->photometric = page->samples >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
    TIFFGetFieldDefaulted(handle, TIFFTAG_EXTRASAMPLES, &extra_count, &extras);
    page->alpha = extra_count > 0 ? extras[0] : PEL_ALPHA_UNTOLD;
    TIFFGetField(handle, TIFFTAG_SUBFILETYPE, &subfile);
    TIFFGetField(handle, TIFFTAG_OSUBFILETYPE, &old_subfile);
    page->reduced = (subfile & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) ||
                    old_subfile == OFILETYPE_REDUCEDIMAGE;
    if (page->photometric == PHOTOMETRIC_PALETTE)
        page->palette = palette_of(handle, page->bits);
    if (page->orientation < ORIENTATION_TOPLEFT || page->orientation > ORIENTATION_LEFTBOT)
        page->orientation = ORIENTATION_TOPLEFT;
    if (page->width == 0 || page->height == 0 || page->samples == 0)
        return pel_fail(PEL_ERROR_FORMAT, "%u x %u pixels of %d samples", page->width, page->height,
                        page->samples);
    uint64_t blocks = TIFFIsTiled(handle) ? TIFFNumberOfTiles(handle) : TIFFNumberOfStrips(handle);
    uint64_t bytes = TIFFIsTiled(handle) ? TIFFTileSize64(handle) : TIFFStripSize64(handle);
    // The last strip may be shorter; rows count, so that a strip "of all rows" is not taken for one
    // of 2^32 - 1 rows.
    if (!TIFFIsTiled(handle)) {
        bytes = TIFFScanlineSize64(handle);
        blocks = page->height;
        if (page->planar == PLANARCONFIG_SEPARATE)
            blocks *= page->samples;
    }
    if (__builtin_mul_overflow(blocks, bytes, &page->decoded_bytes))
        return pel_fail(PEL_ERROR_FORMAT, "%u x %u pixels are beyond what can be addressed",
                        page->width, page->height);
    return true;
}

// Lists the pages. Returns false when memory ran out, or the first page is not readable.
static bool list_pages(struct pel_tiff_file *file, const char *path) {
    int capacity = 0;
    for (;;) {
        if (file->page_count == capacity) {
            capacity = capacity ? 2 * capacity : 64;
            void *grown = realloc(file->pages, (size_t)capacity * sizeof *file->pages);
            if (!grown)
                return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %d pages", capacity);
            file->pages = grown;
        }
        if (!page_describe(&file->pages[file->page_count], file->handle))
            return pel_fail_in("page %d", file->page_count);
        file->page_count++;
        if (TIFFLastDirectory(file->handle))
            return true;
        file->reports = (struct pel_tiff_reports){0};
        if (file->page_count < PEL_TIFF_PAGE_MAX && TIFFReadDirectory(file->handle))
            continue;
        const struct pel_tiff_reports *reports = &file->reports;
        pel_warn("%s: the stack ends after page %d: %s", path, file->page_count - 1,
                 reports->error[0]     ? reports->error
                 : reports->warning[0] ? reports->warning
                                       : "the next one cannot be read");
        return true;
    }
}

// Drops thumbnails, overviews and masks, unless there is nothing else. The pages of OME-TIFF are
// counted with them.
static void drop_reduced(struct pel_tiff_file *file) {
    int kept = 0;
    for (int i = 0; i < file->page_count; i++)
        if (!file->pages[i].reduced)
            file->pages[kept++] = file->pages[i];
    if (kept > 0)
        file->page_count = kept;
}

bool pel_tiff_open(struct pel_tiff_file *file, const char *path) {
    *file = (struct pel_tiff_file){0};
    if (!pel_file_size(path, &file->bytes))
        return false;
    // No buffer libtiff needs at once is larger than a strip or tile, and these are justified by
    // the file's size; the constant is for the working memory of its codecs.
    size_t limit = file->bytes < (SIZE_MAX >> 16) ? file->bytes * 2731 : SIZE_MAX >> 4;
    // "m": no memory map, which would end the program when the file is cut short meanwhile.
    file->handle = pel_tiff_handle(path, "rm", limit + ((size_t)64 << 20), &file->reports);
    if (!file->handle)
        return pel_fail_in("%s", path);
    const char *description = NULL;
    TIFFGetField(file->handle, TIFFTAG_IMAGEDESCRIPTION, &description);
    file->description = pel_copy_text(description ? description : "");
    if (!file->description || !list_pages(file, path)) {
        pel_tiff_close(file);
        return pel_fail_in("%s", path);
    }
    if (!pel_tiff_is_ome(file))
        drop_reduced(file);
    return true;
}

void pel_tiff_close(struct pel_tiff_file *file) {
    if (file->handle)
        TIFFClose(file->handle);
    free(file->pages);
    free(file->description);
    *file = (struct pel_tiff_file){0};
}
