// tiff.h - inside the TIFF reader and writer: what tiff*.c share.
//
// Reading a stack goes through these steps, one file each:
//
//     tiff_folder    a path            -> the files, in natural order
//     tiff_file      a file            -> its pages: where they are, and how they are stored
//     tiff_meta      the first page    -> spacing, unit, and which page is which z, channel, time
//     tiff_ome                            (the same out of OME-XML)
//     tiff_shape     a page            -> the width, height, number type and components it yields
//     tiff_page      a page of a shape -> its pixels
//     tiff           all of them       -> a volume
#ifndef PEL_VOLUME_TIFF_H
#define PEL_VOLUME_TIFF_H

#include <tiffio.h>

#include "pellucid.h"
#include "volume/widen.h"

// More pages than this are not believed; libtiff's time to list them grows with the square.
#define PEL_TIFF_PAGE_MAX 200000

enum pel_tiff_palette {
    PEL_PALETTE_NONE,
    PEL_PALETTE_GREY,   // every entry is a grey
    PEL_PALETTE_COLOUR, //
};

// How a page is stored: its tags.
struct pel_tiff_page {
    uint64_t offset;        // of its directory
    uint32_t width, height; // as stored, before the orientation
    uint16_t bits, format, samples, photometric, planar, compression, orientation;
    uint16_t alpha; // EXTRASAMPLE_... of the first sample behind grey or colour; ALPHA_UNTOLD
    bool reduced;   // a thumbnail, an overview or a mask
    enum pel_tiff_palette palette;
    uint64_t decoded_bytes; // of all its strips or tiles, decompressed
};

// The alpha member where the tag is missing.
#define PEL_ALPHA_UNTOLD UINT16_MAX

// libtiff's first error and first warning since they were emptied; "" when there is none.
struct pel_tiff_reports {
    char error[256], warning[256];
};

struct pel_tiff_file {
    TIFF *handle;
    size_t bytes; // of the file
    struct pel_tiff_page *pages;
    int page_count;    // at least 1
    char *description; // ImageDescription of the first page; "" when there is none
    struct pel_tiff_reports reports;
};

// Opens a file and lists its pages. Afterwards close it.
bool pel_tiff_open(struct pel_tiff_file *file, const char *path);
void pel_tiff_close(struct pel_tiff_file *file);

// Records libtiff's complaint, or `otherwise` when it did not say anything (FORMAT). Returns false.
bool pel_tiff_fail(const struct pel_tiff_file *file, const char *otherwise);

// A libtiff handle that reports into `reports`, `mode` as in TIFFOpen. At most `limit` bytes are
// allocated at once; 0 is no limit. NULL (FORMAT, MEMORY).
TIFF *pel_tiff_handle(const char *path, const char *mode, size_t limit,
                      struct pel_tiff_reports *reports);

// The most bytes a compressed byte can become, per compression scheme; 1 for no compression.
uint64_t pel_tiff_expansion(uint16_t compression);

// What a page becomes.
struct pel_tiff_shape {
    uint32_t width, height; // after the orientation
    enum pel_element element;
    int components;   // 1, or 3 and 4 of bytes: RGB, and RGB with alpha
    int first_sample; // the stored sample of component 0
    bool rendered;    // through libtiff's RGBA interface, which knows odd colour spaces
    bool cmyk;        // four inks become RGB
    bool indices;     // palette indices are the values
};

// What `sample` of a page, or its colour, becomes (UNSUPPORTED). `channel_count` is the number of
// samples one can choose from: 1 when they are taken together as a colour.
bool pel_tiff_shape_of(struct pel_tiff_shape *shape, int *channel_count,
                       const struct pel_tiff_page *page, bool split, bool indices);

// Decodes a page to shape->width * height * components elements at `out`. What libtiff found odd
// about the pixels, such as damage it has gone over, is in file->reports.warning then.
bool pel_tiff_read_page(struct pel_tiff_file *file, const struct pel_tiff_page *page,
                        const struct pel_tiff_shape *shape, void *out);

// What the metadata of a file say about its stack.
struct pel_tiff_stack {
    int *planes;          // owned: the page of each z
    int plane_count;      //
    bool follow;          // one page only: the planes are raw data, one behind the other (ImageJ)
    int sample;           // of the channel within its page
    double spacing_mm[3]; //
    double slope, intercept;
    char unit[16];     // of the values
    const char *space; // where the spacing came from
};

// Reads metadata, and picks options->time and options->channel. `channel_count` samples of a page
// can be chosen from (pel_tiff_shape_of). A file that is `alone` is the whole stack; otherwise it
// is one slice of it, whatever its metadata say.
bool pel_tiff_stack_init(struct pel_tiff_stack *stack, const struct pel_tiff_file *file,
                         const char *name, int channel_count, bool alone,
                         const struct pel_load_options *options);
void pel_tiff_stack_finish(struct pel_tiff_stack *stack);

bool pel_tiff_is_imagej(const struct pel_tiff_file *file);
// An ImageJ composite stores the channels of a microscope as if they were red, green and blue.
bool pel_tiff_is_composite(const struct pel_tiff_file *file);
bool pel_tiff_is_ome(const struct pel_tiff_file *file);

// Millimetres per unit of length, as OME-XML and ImageJ write it: "µm", "micron", "nm", "mm" ...
// False for "pixel" and everything unknown.
bool pel_tiff_unit_mm(const char *unit, double *mm);

// What the first Pixels element of OME-XML says.
struct pel_ome {
    int size_z, size_c, size_t_; // each at least 1
    int samples;                 // channels that share a page
    char order[6];               // "XYZCT": the fastest first
    double spacing_mm[3];        // 0 when not told
    struct pel_ome_run *runs;    // owned: TiffData elements, in their order
    int run_count;
};

// Planes that lie on pages one behind the other.
struct pel_ome_run {
    int page, z, c, t;
    int count;      // -1: all there are
    bool elsewhere; // in another file
};

// FORMAT when the text is not OME-XML with a Pixels element.
bool pel_ome_init(struct pel_ome *ome, const char *xml);
void pel_ome_finish(struct pel_ome *ome);

// Fills planes[size_z] with the pages of one channel (of pages) and time. FORMAT, UNSUPPORTED.
bool pel_ome_planes(const struct pel_ome *ome, int page_count, int channel, int time, int *planes);

// The files a path stands for: itself, the .tif files of a folder, or what a glob pattern matches.
struct pel_tiff_list {
    char **paths; // owned
    int count;    // at least 1
};
bool pel_tiff_list_init(struct pel_tiff_list *list, const char *path);
void pel_tiff_list_finish(struct pel_tiff_list *list);

#endif
