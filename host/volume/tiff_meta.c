// tiff_meta.c - spacing and order of the pages of a TIFF stack, from what its writer left in tags.
//
// Three dialects, told apart by the first page's ImageDescription:
//
// - OME-TIFF: OME-XML (tiff_ome.c).
// - ImageJ: lines of key=value, the first "ImageJ=VERSION". The pages run through channels first,
//   then slices, then frames. Resolution tags are pixels per `unit`, `spacing` is the distance of
//   slices in it (1 when missing, as in ImageJ). A linear calibration (cf=0) is value = c0 + c1
//   raw, its unit `vunit`. ImageJ writes stacks beyond 4 GB as one page whose planes follow each
//   other.
// - Any other: pages are slices; resolution tags count if they are per inch or centimetre. The
//   distance of slices is not told, and is taken to be the width of a pixel.
//
// 1, 72 and 96 pixels per inch are what programs write when they know nothing: no volume has voxels
// of a screen's size, so the spacing counts as unknown then (ImageJ does the same with 72). An
// unknown spacing is 1 mm.
#include "volume/tiff.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "volume/volume.h"

bool pel_tiff_unit_mm(const char *unit, double *mm) {
    static const struct {
        const char *name;
        double mm;
    } units[] = {
        {"\302\265m", 1e-3}, // U+00B5 MICRO SIGN
        {"\316\274m", 1e-3}, // U+03BC GREEK SMALL LETTER MU
        {"\265m", 1e-3},     // the same in Latin-1
        {"\\u00B5m", 1e-3},  // as ImageJ escapes it
        {"\\u03BCm", 1e-3},  {"um", 1e-3},         {"micron", 1e-3},
        {"microns", 1e-3},   {"micrometer", 1e-3}, {"nm", 1e-6},
        {"pm", 1e-9},        {"\303\205", 1e-7}, // angstrom
        {"mm", 1},           {"cm", 10},           {"dm", 100},
        {"m", 1000},         {"meter", 1000},      {"in", 25.4},
        {"inch", 25.4},
    };
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcasecmp(unit, units[i].name) == 0) {
            *mm = units[i].mm;
            return true;
        }
    }
    return false;
}

bool pel_tiff_is_imagej(const struct pel_tiff_file *file) {
    return strncmp(file->description, "ImageJ=", 7) == 0;
}

bool pel_tiff_is_ome(const struct pel_tiff_file *file) {
    return strstr(file->description, "<OME") || strstr(file->description, ":OME ");
}

// ---- ImageJ's description ----------------------------------------------------------------------

// Copies the value of "key=value" from its own line; false when there is none.
static bool find_value(const char *description, const char *key, char value[64]) {
    size_t length = strlen(key);
    for (const char *line = description; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, key, length) == 0 && line[length] == '=') {
            size_t end = strcspn(line + length + 1, "\r\n");
            snprintf(value, 64, "%.*s", (int)(end < 63 ? end : 63), line + length + 1);
            for (char *c = value; *c; c++)
                if (iscntrl((unsigned char)*c))
                    *c = ' ';
            return true;
        }
    }
    return false;
}

static double find_number(const char *description, const char *key, double otherwise) {
    char value[64];
    if (!find_value(description, key, value))
        return otherwise;
    char *end;
    double number = strtod(value, &end);
    return end != value && isfinite(number) ? number : otherwise;
}

// A count of 1..PEL_TIFF_PAGE_MAX; 0 when missing or senseless.
static int find_count(const char *description, const char *key) {
    double number = find_number(description, key, 0);
    return number >= 1 && number <= PEL_TIFF_PAGE_MAX ? (int)number : 0;
}

bool pel_tiff_is_composite(const struct pel_tiff_file *file) {
    char mode[64];
    return pel_tiff_is_imagej(file) && find_value(file->description, "mode", mode) &&
           strcmp(mode, "composite") == 0 &&
           find_count(file->description, "channels") == file->pages[0].samples;
}

// ---- Spacing -----------------------------------------------------------------------------------

// From far below an atom to far beyond a planet; products of such numbers stay finite.
static bool is_sensible(double spacing_mm) {
    return spacing_mm > 1e-12 && spacing_mm < 1e12;
}

// Pixels per unit from the tags; false when they are missing or senseless. `*unit` is 0 for a
// missing tag.
static bool read_resolution(TIFF *handle, double per_unit[2], uint16_t *unit) {
    float x = 0, y = 0;
    *unit = 0;
    TIFFGetField(handle, TIFFTAG_RESOLUTIONUNIT, unit);
    if (!TIFFGetField(handle, TIFFTAG_XRESOLUTION, &x) ||
        !TIFFGetField(handle, TIFFTAG_YRESOLUTION, &y))
        return false;
    per_unit[0] = x, per_unit[1] = y;
    return is_sensible(1.0 / per_unit[0]) && is_sensible(1.0 / per_unit[1]);
}

static void plain_spacing(struct pel_tiff_stack *stack, const struct pel_tiff_file *file) {
    double per_unit[2];
    uint16_t unit;
    if (!read_resolution(file->handle, per_unit, &unit))
        return;
    bool inch = unit == RESUNIT_INCH;
    bool nothing =
        per_unit[0] == per_unit[1] && (per_unit[0] == 1 || per_unit[0] == 72 || per_unit[0] == 96);
    if ((!inch && unit != RESUNIT_CENTIMETER) || (inch && nothing))
        return;
    for (int axis = 0; axis < 2; axis++)
        stack->spacing_mm[axis] = (inch ? 25.4 : 10) / per_unit[axis];
    stack->spacing_mm[2] = stack->spacing_mm[0];
    stack->space = "TIFF resolution";
}

static void imagej_spacing(struct pel_tiff_stack *stack, const struct pel_tiff_file *file,
                           const char *name) {
    double per_unit[2], mm = 1;
    uint16_t tag;
    char unit[64] = "";
    bool named = find_value(file->description, "unit", unit);
    bool metric = named && pel_tiff_unit_mm(unit, &mm);
    bool resolved = read_resolution(file->handle, per_unit, &tag);
    if (!named && resolved && (tag == RESUNIT_INCH || tag == RESUNIT_CENTIMETER)) {
        plain_spacing(stack, file);
        metric = stack->space[0] == 'T';
        mm = metric ? (tag == RESUNIT_INCH ? 25.4 : 10) : 1;
        resolved = metric;
    }
    for (int axis = 0; resolved && axis < 2; axis++)
        stack->spacing_mm[axis] = mm / per_unit[axis];
    double slices = fabs(find_number(file->description, "spacing", 1)) * mm;
    if (is_sensible(slices))
        stack->spacing_mm[2] = slices;
    if (metric)
        stack->space = "ImageJ calibration";
    else if (named && strncmp(unit, "pixel", 5) != 0)
        pel_warn("%s: lengths are in '%s', which is no unit known here; taken as mm", name, unit);
}

// The linear calibration of values, if there is one.
static void imagej_values(struct pel_tiff_stack *stack, const char *description) {
    double intercept = find_number(description, "c0", 0);
    double slope = find_number(description, "c1", 1);
    if (find_number(description, "cf", -1) != 0 || fabs(intercept) > 1e30 || fabs(slope) > 1e30 ||
        fabs(slope) < 1e-30)
        return;
    stack->intercept = intercept;
    stack->slope = slope;
    char unit[64] = "";
    find_value(description, "vunit", unit);
    snprintf(stack->unit, sizeof stack->unit, "%.15s", unit);
}

static void ome_spacing(struct pel_tiff_stack *stack, const struct pel_ome *ome) {
    bool known[3];
    for (int axis = 0; axis < 3; axis++) {
        known[axis] = is_sensible(ome->spacing_mm[axis]);
        if (known[axis])
            stack->spacing_mm[axis] = ome->spacing_mm[axis];
    }
    if (known[0] && !known[1])
        stack->spacing_mm[1] = stack->spacing_mm[0];
    if (known[0] && !known[2])
        stack->spacing_mm[2] = stack->spacing_mm[0];
    if (known[0] || known[2])
        stack->space = "OME-XML physical size";
}

// ---- Order of the pages ------------------------------------------------------------------------

// Checks options->time and options->channel against what there is, and says what is left out.
static bool choose(const struct pel_load_options *options, const char *name, int channels,
                   int times) {
    if (options->channel < 0 || options->channel >= channels)
        return pel_fail(PEL_ERROR_ARGUMENT, "no channel %d, the file has %d", options->channel,
                        channels);
    if (options->time < 0 || options->time >= times)
        return pel_fail(PEL_ERROR_ARGUMENT, "no time step %d, the file has %d", options->time,
                        times);
    if (channels > 1 && options->channel == 0 && !options->split_channels)
        pel_warn("%s: %d channels, only the first is read; 'channel' chooses another", name,
                 channels);
    if (times > 1 && options->time == 0)
        pel_warn("%s: %d time steps, only the first is read; 'time' chooses another", name, times);
    return true;
}

static bool allocate_planes(struct pel_tiff_stack *stack, int count) {
    stack->planes = pel_allocate((size_t)count, sizeof *stack->planes);
    stack->plane_count = count;
    return stack->planes;
}

static bool plain_order(struct pel_tiff_stack *stack, const struct pel_tiff_file *file,
                        const char *name, int channel_count,
                        const struct pel_load_options *options) {
    if (!choose(options, name, channel_count, 1) || !allocate_planes(stack, file->page_count))
        return false;
    stack->sample = channel_count > 1 ? options->channel : 0;
    for (int z = 0; z < stack->plane_count; z++)
        stack->planes[z] = z;
    return true;
}

static bool imagej_order(struct pel_tiff_stack *stack, const struct pel_tiff_file *file,
                         const char *name, int channel_count,
                         const struct pel_load_options *options) {
    const char *text = file->description;
    int images = find_count(text, "images"), z = find_count(text, "slices");
    int c = find_count(text, "channels"), t = find_count(text, "frames");
    bool follow = file->page_count == 1 && images > 1 &&
                  file->pages[0].compression == COMPRESSION_NONE && !TIFFIsTiled(file->handle) &&
                  file->pages[0].planar == PLANARCONFIG_CONTIG;
    int64_t count = follow ? images : file->page_count;
    c = c ? c : 1, t = t ? t : 1;
    // Channels may lie within the pages instead (composites of 16 bits are RGB).
    if (c == file->pages[0].samples && (int64_t)(z ? z : 1) * t == count)
        c = 1;
    if (z == 0)
        z = (int64_t)c * t <= count ? (int)(count / ((int64_t)c * t)) : 1;
    if ((int64_t)z * c * t != count) {
        pel_warn("%s: %d slices x %d channels x %d frames are not %lld pages; all pages are taken "
                 "as slices",
                 name, z, c, t, (long long)count);
        z = (int)count, c = 1, t = 1;
    }
    stack->follow = follow;
    if (!choose(options, name, c * channel_count, t) || !allocate_planes(stack, z))
        return false;
    stack->sample = channel_count > 1 ? options->channel % channel_count : 0;
    int channel = options->channel / channel_count;
    for (int i = 0; i < z; i++)
        stack->planes[i] = channel + c * (i + z * options->time);
    return true;
}

static bool ome_order(struct pel_tiff_stack *stack, const struct pel_tiff_file *file,
                      const char *name, const struct pel_ome *ome, int channel_count,
                      const struct pel_load_options *options) {
    int planes_of_channels = ome->size_c / ome->samples;
    if (!choose(options, name, planes_of_channels * channel_count, ome->size_t_) ||
        !allocate_planes(stack, ome->size_z))
        return false;
    stack->sample = channel_count > 1 ? options->channel % channel_count : 0;
    return pel_ome_planes(ome, file->page_count, options->channel / channel_count, options->time,
                          stack->planes);
}

// ---- All together ------------------------------------------------------------------------------

bool pel_tiff_stack_init(struct pel_tiff_stack *stack, const struct pel_tiff_file *file,
                         const char *name, int channel_count, bool alone,
                         const struct pel_load_options *options) {
    *stack = (struct pel_tiff_stack){
        .spacing_mm = {1, 1, 1}, .slope = 1, .space = "no resolution, 1 mm assumed"};
    struct pel_ome ome;
    bool done;
    if (pel_tiff_is_ome(file) && pel_ome_init(&ome, file->description)) {
        ome_spacing(stack, &ome);
        done = alone ? ome_order(stack, file, name, &ome, channel_count, options)
                     : plain_order(stack, file, name, channel_count, options);
        pel_ome_finish(&ome);
    } else if (pel_tiff_is_imagej(file)) {
        imagej_spacing(stack, file, name);
        imagej_values(stack, file->description);
        done = imagej_order(stack, file, name, channel_count, options);
    } else {
        if (pel_tiff_is_ome(file))
            pel_warn("%s: %s; read as an ordinary stack", name, pel_error_message());
        plain_spacing(stack, file);
        done = plain_order(stack, file, name, channel_count, options);
        if (done && stack->plane_count > 1 && stack->space[0] == 'T')
            pel_warn("%s: the distance of slices is not told; taken as that of pixels, %g mm", name,
                     stack->spacing_mm[2]);
    }
    if (!done)
        pel_tiff_stack_finish(stack);
    return done;
}

void pel_tiff_stack_finish(struct pel_tiff_stack *stack) {
    free(stack->planes);
    stack->planes = NULL;
}
