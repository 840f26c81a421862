// preset.c - ready-made transfer functions, as plain data.
//
// A preset is a list of colour stops and a list of opacities. The general ones are relative to the
// volume's range, those for CT count Hounsfield units, those for MRI percentiles, because the
// brightest voxels of an MRI are outliers. Every curve starts fully transparent, stays so over
// what is usually background or noise, and rises late and steeply, so that surfaces and bright
// structures are seen through what surrounds them. Opacities are per millimetre.
//
// viridis, plasma and inferno: Smith & van der Walt 2015 (CC0). cool-warm: Moreland 2009,
// "Diverging color maps for scientific visualization". rainbow: Romero 2009, whose table of nine
// entries is the one of NVIDIA's volumeRender sample, read as a texture.
#include <assert.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "transfer/transfer.h"

struct stop {
    double value;
    unsigned rgb; // 0xrrggbb
};

struct level {
    double value, opacity;
};

static const struct stop grey[] = {{0, 0x000000}, {1, 0xffffff}};

static const struct stop hot[] = {
    {0, 0x0a0000}, {0.375, 0xff0000}, {0.75, 0xffff00}, {1, 0xffffff}};

static const struct stop viridis[] = {
    {0, 0x440154},         {1 / 15.0, 0x481a6c},  {2 / 15.0, 0x472f7d},  {3 / 15.0, 0x414487},
    {4 / 15.0, 0x39568c},  {5 / 15.0, 0x31688e},  {6 / 15.0, 0x2a788e},  {7 / 15.0, 0x23888e},
    {8 / 15.0, 0x1f988b},  {9 / 15.0, 0x22a884},  {10 / 15.0, 0x35b779}, {11 / 15.0, 0x54c568},
    {12 / 15.0, 0x7ad151}, {13 / 15.0, 0xa5db36}, {14 / 15.0, 0xd2e21b}, {1, 0xfde725},
};

static const struct stop plasma[] = {
    {0, 0x0d0887},         {1 / 15.0, 0x330597},  {2 / 15.0, 0x5002a2},  {3 / 15.0, 0x6a00a8},
    {4 / 15.0, 0x8405a7},  {5 / 15.0, 0x9c179e},  {6 / 15.0, 0xb12a90},  {7 / 15.0, 0xc33d80},
    {8 / 15.0, 0xd35171},  {9 / 15.0, 0xe16462},  {10 / 15.0, 0xed7953}, {11 / 15.0, 0xf68f44},
    {12 / 15.0, 0xfca636}, {13 / 15.0, 0xfec029}, {14 / 15.0, 0xf9dc24}, {1, 0xf0f921},
};

static const struct stop inferno[] = {
    {0, 0x000004},         {1 / 15.0, 0x0c0826},  {2 / 15.0, 0x240c4f},  {3 / 15.0, 0x420a68},
    {4 / 15.0, 0x5d126e},  {5 / 15.0, 0x781c6d},  {6 / 15.0, 0x932667},  {7 / 15.0, 0xae305c},
    {8 / 15.0, 0xc73e4c},  {9 / 15.0, 0xdd513a},  {10 / 15.0, 0xed6925}, {11 / 15.0, 0xf8850f},
    {12 / 15.0, 0xfca50a}, {13 / 15.0, 0xfac62d}, {14 / 15.0, 0xf2e661}, {1, 0xfcffa4},
};

static const struct stop cool_warm[] = {
    {0, 0x3b4cc0},         {1 / 16.0, 0x4e68d8},  {2 / 16.0, 0x6282ea},  {3 / 16.0, 0x779af7},
    {4 / 16.0, 0x8db0fe},  {5 / 16.0, 0xa3c2ff},  {6 / 16.0, 0xb8d0f9},  {7 / 16.0, 0xccd9ee},
    {8 / 16.0, 0xdddddd},  {9 / 16.0, 0xecd3c6},  {10 / 16.0, 0xf5c4ad}, {11 / 16.0, 0xf7b194},
    {12 / 16.0, 0xf49a7b}, {13 / 16.0, 0xec7f63}, {14 / 16.0, 0xde614d}, {15 / 16.0, 0xcb3e38},
    {1, 0xb40426},
};

// The centres of a texture's nine texels over 0..1.
static const struct stop rainbow[] = {
    {0.5 / 9, 0x000000}, {1.5 / 9, 0xff0000}, {2.5 / 9, 0xff8000},
    {3.5 / 9, 0xffff00}, {4.5 / 9, 0x00ff00}, {5.5 / 9, 0x00ffff},
    {6.5 / 9, 0x0000ff}, {7.5 / 9, 0xff00ff}, {8.5 / 9, 0x000000},
};

static const struct stop green[] = {{0, 0x001a00}, {0.7, 0x00ff00}, {1, 0xb3ffb3}};
static const struct stop magenta[] = {{0, 0x1a001a}, {0.7, 0xff00ff}, {1, 0xffb3ff}};
static const struct stop cyan[] = {{0, 0x001a1a}, {0.7, 0x00ffff}, {1, 0xb3ffff}};
static const struct stop red[] = {{0, 0x1a0000}, {0.7, 0xff0000}, {1, 0xffb3b3}};
static const struct stop blue[] = {{0, 0x00001a}, {0.7, 0x2040ff}, {1, 0xb3c0ff}};
static const struct stop yellow[] = {{0, 0x1a1a00}, {0.7, 0xffff00}, {1, 0xffffb3}};

static const struct stop ct_bone[] = {
    {150, 0x7a3320}, {250, 0xb5693f}, {450, 0xe0c094}, {900, 0xf7ecd4}, {2000, 0xffffff}};

static const struct stop ct_soft_tissue[] = {
    {-150, 0xd9a066}, {-60, 0xe8c48a}, {0, 0xc9765c},   {60, 0xb0413a},
    {150, 0xc75a48},  {300, 0xe6cfa8}, {900, 0xf7ecd4}, {2000, 0xffffff},
};

static const struct stop ct_lung[] = {
    {-1000, 0x1c2b4a}, {-850, 0x3a6ea5}, {-600, 0x8fc1e3}, {-400, 0xf2d0c9}, {-150, 0xd9604f}};

static const struct stop ct_angio[] = {{120, 0x5c0a0a}, {200, 0xc01818},  {400, 0xff5a3c},
                                       {600, 0xf2d9b0}, {1000, 0xf7ecd4}, {2000, 0xffffff}};

static const struct stop mri[] = {
    {0, 0x000000}, {60, 0x4a2a20}, {85, 0xb98868}, {97, 0xf0d9c0}, {99.9, 0xffffff}};

static const struct stop mri_brain[] = {
    {0, 0x000000}, {80, 0x6e3a34}, {90, 0xc98878}, {97, 0xf2cdb8}, {99.9, 0xfff6ec}};

static const struct level rise[] = {{0, 0},       {0.12, 0},   {0.25, 0.006},
                                    {0.45, 0.03}, {0.7, 0.12}, {1, 0.4}};

static const struct level rainbow_rise[] = {
    {0.5 / 9, 0}, {1.5 / 9, 0.1}, {7.5 / 9, 0.1}, {8.5 / 9, 0}};

static const struct level both_ends[] = {{0, 0.4},  {0.2, 0.12},  {0.35, 0.02}, {0.45, 0},
                                         {0.55, 0}, {0.65, 0.02}, {0.8, 0.12},  {1, 0.4}};

static const struct level ct_bone_rise[] = {
    {150, 0}, {220, 0.03}, {350, 0.3}, {700, 0.6}, {2000, 0.85}};

static const struct level ct_soft_tissue_rise[] = {
    {-150, 0},  {-80, 0.012}, {-20, 0.012}, {20, 0.06},
    {80, 0.15}, {150, 0.15},  {250, 0.35},  {1000, 0.7},
};

static const struct level ct_lung_rise[] = {
    {-960, 0}, {-880, 0.004}, {-700, 0.012}, {-500, 0.05}, {-350, 0.12}, {-200, 0.05}, {-120, 0}};

static const struct level ct_angio_rise[] = {{120, 0},   {170, 0.02}, {250, 0.3},
                                             {500, 0.5}, {700, 0.25}, {2000, 0.4}};

static const struct level mri_rise[] = {{0, 0},     {65, 0},    {80, 0.02},
                                        {92, 0.06}, {98, 0.15}, {99.9, 0.3}};

static const struct level mri_brain_rise[] = {{0, 0}, {80, 0}, {88, 0.08}, {96, 0.2}, {99.9, 0.4}};

// Colours of labels 0..255; neighbours differ much. Label 0 is transparent.
static const unsigned label_colours[] = {
    0x000000, 0xe6194b, 0x3cb44b, 0x4363d8, 0xffe119, 0xf58231, 0x911eb4, 0x42d4f4, 0xf032e6,
    0xbfef45, 0xfabed4, 0x469990, 0xdcbeff, 0x9a6324, 0xfffac8, 0x800000, 0xaaffc3, 0xf2ac24,
    0x8c66cc, 0x2e9936, 0xff2655, 0x79b7f2, 0xafcc3d, 0x8d1799, 0x80ffce, 0xf28049, 0x241fcc,
    0x60994c, 0xff4daf, 0x24d2f2, 0xccbe66, 0x6b2e99, 0x26ff64, 0xf2797a, 0x3d68cc, 0x649917,
    0xff80f0, 0x49f2d4, 0xcc7b1f, 0x5f4c99, 0x56ff4d, 0xf2246b, 0x66a7cc, 0x91992e, 0xd026ff,
    0x79f2b4, 0xcc593d, 0x172399, 0xb1ff80, 0xf249bc, 0x1fc7cc, 0x99854c, 0x9c4dff, 0x24f244,
    0xcc6674, 0x2e5c99, 0xc2ff26, 0xf179f2, 0x3dcca1, 0x994c17, 0x8e80ff, 0x67f249, 0xcc1f70,
    0x4c8799, 0xfff54d, 0xab24f2, 0x66cc8b, 0x99352e, 0x2656ff, 0xb7f279, 0xcc3db0, 0x17998c,
    0xffcd80, 0x7f49f2, 0x1fcc23, 0x994c61, 0x4db0ff, 0xd3f224, 0xbe66cc, 0x2e996b, 0xff6226,
    0x797bf2, 0x69cc3d, 0x991765, 0x80f1ff, 0xf2d349, 0x7a1fcc, 0x4c995e, 0xff4d57, 0x246cf2,
    0xa7cc66, 0x992e92, 0x26ffce, 0xf2b479, 0x593dcc, 0x249917, 0xff80b1, 0x49bdf2, 0xc8cc1f,
    0x854c99, 0x4dff9b, 0xf24324, 0x6675cc, 0x5c992e, 0xff26c4, 0x79f2f0, 0xcca03d, 0x4b1799,
    0x80ff8d, 0xf24968, 0x1f71cc, 0x87994c, 0xf44dff, 0x24f2aa, 0xcc8a66, 0x352e99, 0x58ff26,
    0xf279b8, 0x3db1cc, 0x998c17, 0xcd80ff, 0x49f27e, 0xcc221f, 0x4c6199, 0xb1ff4d, 0xf224d4,
    0x66ccbd, 0x996a2e, 0x6126ff, 0x7cf279, 0xcc3d6a, 0x176699, 0xf2ff80, 0xd249f2, 0x1fcc79,
    0x995e4c, 0x4d58ff, 0x6ef224, 0xcc66a8, 0x2e9299, 0xffcd26, 0xb379f2, 0x3dcc58, 0x991725,
    0x80b2ff, 0xbef249, 0xcc1fc9, 0x4c9984, 0xff9a4d, 0x4224f2, 0x75cc66, 0x992e5d, 0x26c5ff,
    0xf2ef79, 0x9f3dcc, 0x17994a, 0xff8c80, 0x4969f2, 0x72cc1f, 0x994c88, 0x4dfff3, 0xf2a824,
    0x8a66cc, 0x2e9934, 0xff2659, 0x79b9f2, 0xb2cc3d, 0x8b1799, 0x80ffcc, 0xf27d49, 0x211fcc,
    0x62994c, 0xff4db2, 0x24d5f2, 0xccbc66, 0x692e99, 0x26ff60, 0xf2797c, 0x3d6bcc, 0x669917,
    0xff80f3, 0x49f2d1, 0xcc781f, 0x5d4c99, 0x59ff4d, 0xf2246f, 0x66a9cc, 0x93992e, 0xcc26ff,
    0x79f2b2, 0xcc573d, 0x172699, 0xb3ff80, 0xf249bf, 0x1fcacc, 0x99844c, 0x994dff, 0x24f240,
    0xcc6676, 0x2e5e99, 0xc6ff26, 0xef79f2, 0x3dcc9e, 0x994917, 0x8c80ff, 0x6af249, 0xcc1f73,
    0x4c8899, 0xfff24d, 0xa724f2, 0x66cc89, 0x99332e, 0x265aff, 0xbaf279, 0xcc3db3, 0x17998a,
    0xffcb80, 0x7c49f2, 0x1fcc20, 0x994c62, 0x4db3ff, 0xd7f224, 0xbc66cc, 0x2e9969, 0xff5e26,
    0x797df2, 0x6ccc3d, 0x991767, 0x80f3ff, 0xf2d049, 0x771fcc, 0x4c995d, 0xff4d5a, 0x2470f2,
    0xa9cc66, 0x992e94, 0x26ffca, 0xf2b179, 0x563dcc, 0x269917, 0xff80b4, 0x49c0f2, 0xcbcc1f,
    0x834c99, 0x4dff98, 0xf23f24, 0x6676cc, 0x5e992e, 0xff26c8, 0x79f2ee, 0xcc9d3d, 0x481799,
    0x80ff8b, 0xf2496b, 0x1f75cc, 0x89994c,
};

enum { label_count = sizeof label_colours / sizeof *label_colours };

static const struct level label_step[] = {{0, 0}, {1, 0.5}};

#define POINTS(array) (array), sizeof(array) / sizeof *(array)

static const struct preset {
    const char *name;
    enum pel_value_scale scale;
    const struct stop *stops; // NULL for labels
    int stop_count;
    const struct level *levels;
    int level_count;
} presets[] = {
    {"grey", PEL_VALUES_RELATIVE, POINTS(grey), POINTS(rise)},
    {"hot", PEL_VALUES_RELATIVE, POINTS(hot), POINTS(rise)},
    {"viridis", PEL_VALUES_RELATIVE, POINTS(viridis), POINTS(rise)},
    {"plasma", PEL_VALUES_RELATIVE, POINTS(plasma), POINTS(rise)},
    {"inferno", PEL_VALUES_RELATIVE, POINTS(inferno), POINTS(rise)},
    {"cool-warm", PEL_VALUES_RELATIVE, POINTS(cool_warm), POINTS(both_ends)},
    {"rainbow", PEL_VALUES_RELATIVE, POINTS(rainbow), POINTS(rainbow_rise)},
    {"ct-bone", PEL_VALUES_ABSOLUTE, POINTS(ct_bone), POINTS(ct_bone_rise)},
    {"ct-soft-tissue", PEL_VALUES_ABSOLUTE, POINTS(ct_soft_tissue), POINTS(ct_soft_tissue_rise)},
    {"ct-lung", PEL_VALUES_ABSOLUTE, POINTS(ct_lung), POINTS(ct_lung_rise)},
    {"ct-angio", PEL_VALUES_ABSOLUTE, POINTS(ct_angio), POINTS(ct_angio_rise)},
    {"mri", PEL_VALUES_PERCENTILE, POINTS(mri), POINTS(mri_rise)},
    {"mri-brain", PEL_VALUES_PERCENTILE, POINTS(mri_brain), POINTS(mri_brain_rise)},
    {"green", PEL_VALUES_RELATIVE, POINTS(green), POINTS(rise)},
    {"magenta", PEL_VALUES_RELATIVE, POINTS(magenta), POINTS(rise)},
    {"cyan", PEL_VALUES_RELATIVE, POINTS(cyan), POINTS(rise)},
    {"red", PEL_VALUES_RELATIVE, POINTS(red), POINTS(rise)},
    {"blue", PEL_VALUES_RELATIVE, POINTS(blue), POINTS(rise)},
    {"yellow", PEL_VALUES_RELATIVE, POINTS(yellow), POINTS(rise)},
    {"labels", PEL_VALUES_ABSOLUTE, NULL, label_count, POINTS(label_step)},
};

static const char *const names[] = {
    "grey",      "hot",     "viridis",   "plasma",         "inferno",
    "cool-warm", "rainbow", "ct-bone",   "ct-soft-tissue", "ct-lung",
    "ct-angio",  "mri",     "mri-brain", "green",          "magenta",
    "cyan",      "red",     "blue",      "yellow",         "labels",
    NULL};

enum { preset_count = sizeof presets / sizeof *presets };

static_assert(sizeof names / sizeof *names == preset_count + 1, "every preset has its name listed");

static struct pel_transfer *make(const struct preset *preset) {
    struct pel_transfer *transfer = pel_transfer_create(preset->stop_count, preset->level_count);
    if (!transfer)
        return NULL;
    transfer->scale = preset->scale;
    for (int i = 0; i < preset->stop_count; i++) {
        struct pel_colour_point *point = &transfer->colours[i];
        point->value = preset->stops ? preset->stops[i].value : i;
        unsigned rgb = preset->stops ? preset->stops[i].rgb : label_colours[i];
        for (int channel = 0; channel < 3; channel++)
            point->rgb[channel] = (rgb >> (16 - 8 * channel) & 0xff) / 255.0;
    }
    for (int i = 0; i < preset->level_count; i++)
        transfer->opacities[i] =
            (struct pel_opacity_point){preset->levels[i].value, preset->levels[i].opacity};
    // One table entry for each label, in 8-bit data and wider.
    if (!preset->stops) {
        transfer->nearest = true;
        transfer->table_entries = label_count;
    }
    return transfer;
}

const char *const *pel_transfer_presets(void) {
    return names;
}

struct pel_transfer *pel_transfer_preset(const char *name) {
    for (int i = 0; i < preset_count; i++)
        if (strcmp(name, presets[i].name) == 0)
            return make(&presets[i]);
    const char *nearest = pel_text_nearest(name, names);
    char list[512];
    pel_text_list(list, sizeof list, names, preset_count, " and ");
    if (nearest)
        pel_fail(PEL_ERROR_ARGUMENT, "no preset '%.64s'; did you mean '%s'", name, nearest);
    else
        pel_fail(PEL_ERROR_ARGUMENT, "no preset '%.64s'; there are %s", name, list);
    return NULL;
}
