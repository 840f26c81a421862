// tiff_ome.c - the part of OME-XML that places the pages of an OME-TIFF, read with expat.
//
// https://docs.openmicroscopy.org/ome-model/latest/ome-tiff/specification.html: the first Pixels
// element tells sizes, the order of dimensions and the physical size of a pixel (micrometres unless
// another unit is named); its TiffData children tell which pages hold which planes. A TiffData
// starts at plane (FirstZ, FirstC, FirstT) on page IFD and goes on for PlaneCount planes in the
// order of dimensions; without IFD it means all planes, with IFD alone one. Without any TiffData
// the planes lie on the pages in order.
#include "volume/tiff.h"

#include <expat.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "volume/volume.h"

struct parser {
    struct pel_ome *ome;
    char id[128];     // of this file
    char run_id[128]; // of the file a TiffData is about, as far as it was read
    int pixels;       // how many Pixels elements there were
    int run_capacity; //
    bool in_pixels, in_run, in_id, wrong, memory;
};

static const char *leaf_of(const char *name) {
    const char *colon = strchr(name, ':');
    return colon ? colon + 1 : name;
}

static const char *attribute(const char **attributes, const char *name) {
    for (; attributes[0]; attributes += 2)
        if (strcmp(leaf_of(attributes[0]), name) == 0)
            return attributes[1];
    return NULL;
}

static int read_count(const char **attributes, const char *name, int otherwise) {
    const char *text = attribute(attributes, name);
    if (!text)
        return otherwise;
    char *end;
    long value = strtol(text, &end, 10);
    return end != text && value >= 0 && value <= PEL_TIFF_PAGE_MAX ? (int)value : -1;
}

static double read_length(const char **attributes, char axis) {
    char name[32];
    snprintf(name, sizeof name, "PhysicalSize%c", axis);
    const char *size = attribute(attributes, name);
    snprintf(name, sizeof name, "PhysicalSize%cUnit", axis);
    const char *unit = attribute(attributes, name);
    double mm = 1e-3, value = size ? strtod(size, NULL) : 0;
    if (unit && !pel_tiff_unit_mm(unit, &mm))
        return 0;
    return isfinite(value) && value > 0 ? value * mm : 0;
}

static void start_pixels(struct parser *parser, const char **attributes) {
    struct pel_ome *ome = parser->ome;
    ome->size_z = read_count(attributes, "SizeZ", 1);
    ome->size_c = read_count(attributes, "SizeC", 1);
    ome->size_t_ = read_count(attributes, "SizeT", 1);
    const char *order = attribute(attributes, "DimensionOrder");
    snprintf(ome->order, sizeof ome->order, "%s", order ? order : "XYZCT");
    for (int axis = 0; axis < 3; axis++)
        ome->spacing_mm[axis] = read_length(attributes, "XYZ"[axis]);
    parser->wrong = ome->size_z < 1 || ome->size_c < 1 || ome->size_t_ < 1 ||
                    strncmp(ome->order, "XY", 2) != 0 || !strchr(ome->order, 'Z') ||
                    !strchr(ome->order, 'C') || !strchr(ome->order, 'T');
}

static void start_run(struct parser *parser, const char **attributes) {
    struct pel_ome *ome = parser->ome;
    if (ome->run_count == parser->run_capacity) {
        int capacity = parser->run_capacity ? 2 * parser->run_capacity : 64;
        void *grown = realloc(ome->runs, (size_t)capacity * sizeof *ome->runs);
        if (!grown) {
            parser->memory = true;
            return;
        }
        ome->runs = grown;
        parser->run_capacity = capacity;
    }
    bool has_page = attribute(attributes, "IFD");
    struct pel_ome_run run = {
        .page = read_count(attributes, "IFD", 0),
        .z = read_count(attributes, "FirstZ", 0),
        .c = read_count(attributes, "FirstC", 0),
        .t = read_count(attributes, "FirstT", 0),
        .count = read_count(attributes, "PlaneCount", has_page ? 1 : -1),
    };
    parser->wrong = parser->wrong || run.page < 0 || run.z < 0 || run.c < 0 || run.t < 0;
    ome->runs[ome->run_count++] = run;
    parser->in_run = true;
    parser->run_id[0] = 0;
}

static void on_start(void *user, const char *name, const char **attributes) {
    struct parser *parser = user;
    const char *leaf = leaf_of(name);
    if (strcmp(leaf, "OME") == 0) {
        const char *id = attribute(attributes, "UUID");
        snprintf(parser->id, sizeof parser->id, "%s", id ? id : "");
    } else if (strcmp(leaf, "Pixels") == 0) {
        parser->in_pixels = ++parser->pixels == 1;
        if (parser->in_pixels)
            start_pixels(parser, attributes);
    } else if (parser->in_pixels && strcmp(leaf, "Channel") == 0) {
        int samples = read_count(attributes, "SamplesPerPixel", 1);
        if (samples > parser->ome->samples)
            parser->ome->samples = samples;
    } else if (parser->in_pixels && strcmp(leaf, "TiffData") == 0 && !parser->memory) {
        start_run(parser, attributes);
    } else if (parser->in_run && strcmp(leaf, "UUID") == 0) {
        parser->in_id = true;
    }
}

static void on_text(void *user, const char *text, int length) {
    struct parser *parser = user;
    size_t used = strlen(parser->run_id);
    if (parser->in_id && length > 0 && used + (size_t)length < sizeof parser->run_id)
        memcpy(memset(parser->run_id + used, 0, (size_t)length + 1), text, (size_t)length);
}

static void on_end(void *user, const char *name) {
    struct parser *parser = user;
    const char *leaf = leaf_of(name);
    if (strcmp(leaf, "Pixels") == 0) {
        parser->in_pixels = false;
    } else if (strcmp(leaf, "UUID") == 0) {
        parser->in_id = false;
    } else if (parser->in_run && strcmp(leaf, "TiffData") == 0) {
        parser->in_run = false;
        if (parser->id[0] && parser->run_id[0])
            parser->ome->runs[parser->ome->run_count - 1].elsewhere =
                strcmp(parser->id, parser->run_id) != 0;
    }
}

bool pel_ome_init(struct pel_ome *ome, const char *xml) {
    *ome = (struct pel_ome){.samples = 1};
    struct parser parser = {.ome = ome};
    XML_Parser expat = XML_ParserCreate(NULL);
    if (!expat)
        return pel_fail(PEL_ERROR_MEMORY, "cannot read OME-XML: memory ran out");
    XML_SetUserData(expat, &parser);
    XML_SetElementHandler(expat, on_start, on_end);
    XML_SetCharacterDataHandler(expat, on_text);
    size_t length = strlen(xml);
    bool parsed = length < INT32_MAX && XML_Parse(expat, xml, (int)length, 1) == XML_STATUS_OK;
    if (!parsed)
        pel_fail(PEL_ERROR_FORMAT, "OME-XML, line %lu: %s",
                 (unsigned long)XML_GetCurrentLineNumber(expat),
                 XML_ErrorString(XML_GetErrorCode(expat)));
    else if (parser.memory)
        parsed = pel_fail(PEL_ERROR_MEMORY, "cannot allocate the planes of OME-XML");
    else if (parser.pixels == 0 || parser.wrong || ome->samples > ome->size_c)
        parsed = pel_fail(PEL_ERROR_FORMAT, "OME-XML without sensible sizes");
    XML_ParserFree(expat);
    if (!parsed)
        pel_ome_finish(ome);
    return parsed;
}

void pel_ome_finish(struct pel_ome *ome) {
    free(ome->runs);
    *ome = (struct pel_ome){0};
}

// Moves on by one plane in the order of dimensions; false behind the last.
static bool next_plane(const struct pel_ome *ome, int channels, int *z, int *c, int *t) {
    for (const char *axis = ome->order + 2; *axis; axis++) {
        int *index = *axis == 'Z' ? z : *axis == 'C' ? c : t;
        int size = *axis == 'Z' ? ome->size_z : *axis == 'C' ? channels : ome->size_t_;
        if (++*index < size)
            return true;
        *index = 0;
    }
    return false;
}

bool pel_ome_planes(const struct pel_ome *ome, int page_count, int channel, int time, int *planes) {
    enum { MISSING = -1, ELSEWHERE = -2 };
    int channels = ome->size_c / ome->samples;
    for (int z = 0; z < ome->size_z; z++)
        planes[z] = MISSING;
    const struct pel_ome_run all = {.count = -1};
    const struct pel_ome_run *runs = ome->run_count ? ome->runs : &all;
    int run_count = ome->run_count ? ome->run_count : 1;
    // A sane file names each of its pages once; the bound keeps others from taking forever.
    int64_t left = 4 * (int64_t)page_count + run_count;
    for (int i = 0; i < run_count && left > 0; i++) {
        int z = runs[i].z, c = runs[i].c / ome->samples, t = runs[i].t, page = runs[i].page;
        bool inside = z < ome->size_z && c < channels && t < ome->size_t_;
        for (int n = 0; inside && n != runs[i].count && page < page_count && left > 0;
             n++, left--) {
            if (c == channel && t == time)
                planes[z] = runs[i].elsewhere ? ELSEWHERE : page;
            page++;
            inside = next_plane(ome, channels, &z, &c, &t);
        }
    }
    for (int z = 0; z < ome->size_z; z++) {
        if (planes[z] == ELSEWHERE)
            return pel_fail(PEL_ERROR_UNSUPPORTED,
                            "slice %d of channel %d at time %d lies in another file of its set; a "
                            "folder can be read as one file per slice",
                            z, channel, time);
        if (planes[z] == MISSING)
            return pel_fail(PEL_ERROR_FORMAT, "no page holds slice %d of channel %d at time %d", z,
                            channel, time);
    }
    return true;
}
