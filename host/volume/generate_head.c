// generate_head.c - one synthetic head as a CT and an MRI scanner see it, and its segmentation.
//
// The head is a list of ellipsoids painted over each other, outside in, each of one tissue; the
// brain's is folded. CT gives each tissue its Hounsfield units, MRI a T1-weighted brightness. Edges
// are 1.5 mm wide, so the field is continuous. Head coordinates are millimetres, RAS: x to the
// right, y forward, z up, the origin between the ears. The CT's world is the head itself. In the
// MRI's the head lies turned and shifted:
//
//     p_head = truth * p_mri_world
//
// and as the scanner knows nothing of that, the MRI's own placement is off by `truth`.
#include "volume/generate.h"

#include <math.h>

#include "base/math.h"

enum tissue { AIR, SKIN, MUSCLE, BONE, MARROW, TEETH, FLUID, GREY, WHITE, EYE, LENS, TISSUE_COUNT };

static const float hounsfield[TISSUE_COUNT] = {
    [AIR] = -1000, [SKIN] = -60, [MUSCLE] = 55, [BONE] = 1200, [MARROW] = 500, [TEETH] = 2200,
    [FLUID] = 8,   [GREY] = 38,  [WHITE] = 28,  [EYE] = 12,    [LENS] = 80,
};

static const float t1_weighted[TISSUE_COUNT] = {
    [AIR] = 0,     [SKIN] = 900, [MUSCLE] = 380, [BONE] = 40, [MARROW] = 260, [TEETH] = 20,
    [FLUID] = 120, [GREY] = 480, [WHITE] = 680,  [EYE] = 150, [LENS] = 330,
};

static const struct part {
    double centre[3], semi_axes[3];
    double turn_deg; // about z
    enum tissue tissue;
    bool paired; // painted at -x, too
    bool folded; // the brain: see paint_brain
} parts[] = {
    // Skin and the muscle under it: cranium, face, chin, neck, nose, ears.
    {{0, -3, 25}, {78, 98, 85}, 0, SKIN, false, false},
    {{0, 32, -40}, {60, 58, 72}, 0, SKIN, false, false},
    {{0, 55, -88}, {32, 34, 24}, 0, SKIN, false, false},
    {{0, -22, -95}, {55, 58, 90}, 0, SKIN, false, false},
    {{0, 90, -28}, {12, 18, 20}, 0, SKIN, false, false},
    {{78, -8, -5}, {7, 18, 30}, 12, SKIN, true, false},
    {{0, -3, 25}, {74, 94, 81}, 0, MUSCLE, false, false},
    {{0, 32, -40}, {55, 53, 67}, 0, MUSCLE, false, false},
    {{0, -22, -95}, {51, 54, 88}, 0, MUSCLE, false, false},
    // Face: upper jaw, cheek bones, lower jaw around the tongue, teeth, orbits, airways.
    {{0, 52, -42}, {42, 34, 26}, 0, MARROW, false, false},
    {{46, 46, -30}, {9, 26, 7}, -10, BONE, true, false},
    {{0, 36, -80}, {44, 46, 13}, 0, BONE, false, false},
    {{0, 28, -78}, {34, 42, 20}, 0, MUSCLE, false, false},
    {{0, 70, -66}, {24, 8, 9}, 0, TEETH, false, false},
    {{32, 58, -18}, {17, 20, 16}, 0, SKIN, true, false},
    {{26, 56, -42}, {11, 14, 13}, 0, AIR, true, false},
    {{0, 66, -42}, {9, 30, 16}, 0, AIR, false, false},
    {{0, 60, -42}, {1.5, 24, 16}, 0, BONE, false, false},
    {{0, 14, -85}, {9, 9, 50}, 0, AIR, false, false},
    // Spine and its canal.
    {{0, -20, -100}, {20, 22, 52}, 0, MARROW, false, false},
    {{0, -27, -95}, {8, 8, 70}, 0, FLUID, false, false},
    {{0, -27, -95}, {5, 5, 75}, 0, WHITE, false, false},
    // Skull: two plates of bone with marrow between, a sinus in the forehead; fluid inside.
    {{0, -3, 25}, {71, 91, 78}, 0, BONE, false, false},
    {{0, -3, 25}, {69, 89, 76}, 0, MARROW, false, false},
    {{0, -3, 25}, {66, 86, 73}, 0, BONE, false, false},
    {{0, 83, 6}, {16, 4, 8}, 0, AIR, false, false},
    {{0, -3, 25}, {64, 84, 71}, 0, FLUID, false, false},
    // Brain, cleft between the hemispheres, callosum, nuclei, cerebellum, stem.
    {{0, -3, 28}, {61, 81, 65}, 0, WHITE, false, true},
    {{0, -3, 46}, {1.6, 74, 44}, 0, FLUID, false, false},
    {{0, -5, 36}, {13, 36, 6}, 0, WHITE, false, false},
    {{11, -14, 20}, {8, 14, 9}, 0, GREY, true, false},
    {{26, 6, 20}, {7, 18, 11}, 12, GREY, true, false},
    {{0, -36, -18}, {44, 28, 18}, 0, FLUID, false, false},
    {{0, -36, -18}, {41, 25, 15.5}, 0, GREY, false, false},
    {{20, -36, -18}, {14, 16, 8}, 0, WHITE, true, false},
    {{0, -14, -30}, {10, 10, 32}, 0, WHITE, false, false},
    // Ventricles: lateral with their horns, third, fourth.
    {{11, 2, 31}, {6, 30, 9}, -8, FLUID, true, false},
    {{24, -40, 26}, {7, 20, 8}, 20, FLUID, true, false},
    {{0, -8, 16}, {2.5, 14, 9}, 0, FLUID, false, false},
    {{0, -26, -14}, {5, 4, 8}, 0, FLUID, false, false},
    // Eyes.
    {{32, 66, -18}, {12, 12, 12}, 0, EYE, true, false},
    {{32, 74.5, -18}, {4.5, 2.2, 4.5}, 0, LENS, true, false},
};

enum { PART_COUNT = sizeof parts / sizeof *parts };

static const double edge_mm = 1.5;

// A segmentation has the number of each tissue.
static const float label[TISSUE_COUNT] = {
    [AIR] = 0,   [SKIN] = 1, [MUSCLE] = 2, [BONE] = 3, [MARROW] = 4, [TEETH] = 5,
    [FLUID] = 6, [GREY] = 7, [WHITE] = 8,  [EYE] = 9,  [LENS] = 10,
};

// Samples along a line in head coordinates, and what this scanner makes of each tissue.
struct line {
    double start[3], step[3];
    int count;
    const float *brightness;
    bool whole; // a sample is of one tissue alone
    float *values;
};

// 0 below -width/2, 1 above width/2, linear between.
static float ramp(double x, double width) {
    return (float)fmin(fmax(0.5 + x / width, 0), 1);
}

static void blend(const struct line *line, float *value, float target, float weight) {
    if (line->whole)
        weight = weight >= 0.5F ? 1 : 0;
    *value += weight * (target - *value);
}

// Blends one sample of the brain, `depth` millimetres below its surface: white matter under a grey
// cortex, both folded along the gyroid sin x cos y + sin y cos z + sin z cos x = 0, whose sheets
// hold fluid as the sulci do.
static void paint_brain(const struct line *line, int i, double depth) {
    const double wavelength_mm = 24;
    double s[3], c[3];
    for (int axis = 0; axis < 3; axis++) {
        double p = line->start[axis] + i * line->step[axis];
        double phase = 2 * PEL_PI / wavelength_mm * (axis == 0 ? fabs(p) : p);
        s[axis] = sin(phase);
        c[axis] = cos(phase);
    }
    double fold = fabs(s[0] * c[1] + s[1] * c[2] + s[2] * c[0]);
    float grey = fmaxf(ramp(4 - depth, 2), ramp(0.7 - fold, 0.2) * ramp(19 - depth, 4));
    float fluid = ramp(0.18 - fold, 0.15) * ramp(14 - depth, 6);
    float value = line->brightness[WHITE];
    blend(line, &value, line->brightness[GREY], grey);
    blend(line, &value, line->brightness[FLUID], fluid);
    blend(line, &line->values[i], value, ramp(depth, edge_mm));
}

// Paints one ellipsoid, mirrored at x = 0 if `side` is -1.
static void paint(const struct part *part, double side, const struct line *line) {
    double turn = side * part->turn_deg * PEL_PI / 180, cosine = cos(turn), sine = sin(turn);
    const double *semi = part->semi_axes;
    double p[3] = {line->start[0] - side * part->centre[0], line->start[1] - part->centre[1],
                   line->start[2] - part->centre[2]};
    const double *d = line->step;
    // In units of the semi-axes the ellipsoid is the unit sphere and the line is q + i * e.
    double q[3] = {(cosine * p[0] + sine * p[1]) / semi[0], (cosine * p[1] - sine * p[0]) / semi[1],
                   p[2] / semi[2]};
    double e[3] = {(cosine * d[0] + sine * d[1]) / semi[0], (cosine * d[1] - sine * d[0]) / semi[1],
                   d[2] / semi[2]};

    // The samples in a sphere that is larger by the soft edge.
    double reach = 1 + edge_mm / 2 / fmin(fmin(semi[0], semi[1]), semi[2]);
    double a = pel_dot(e, e), b = pel_dot(q, e);
    double discriminant = b * b - a * (pel_dot(q, q) - reach * reach);
    if (discriminant < 0)
        return;
    double half = sqrt(discriminant) / a;
    int first = (int)fmax(ceil(-b / a - half), 0);
    int last = (int)fmin(floor(-b / a + half), line->count - 1);
    for (int i = first; i <= last; i++) {
        // First-order distance to the surface: (1 - |x|) over the gradient of |x|.
        double x[3] = {q[0] + i * e[0], q[1] + i * e[1], q[2] + i * e[2]};
        double radius = pel_length(x);
        double slope = pel_length((double[]){x[0] / semi[0], x[1] / semi[1], x[2] / semi[2]});
        double depth = slope > 0 ? (1 - radius) * radius / slope : semi[0];
        if (part->folded)
            paint_brain(line, i, depth);
        else
            blend(line, &line->values[i], line->brightness[part->tissue], ramp(depth, edge_mm));
    }
}

static void paint_head(const struct line *line) {
    for (int i = 0; i < line->count; i++)
        line->values[i] = line->brightness[AIR];
    for (int i = 0; i < PART_COUNT; i++) {
        paint(&parts[i], 1, line);
        if (parts[i].paired)
            paint(&parts[i], -1, line);
    }
}

void pel_generate_head_ct(const struct pel_generate_row *row, float *values) {
    paint_head(&(struct line){
        .start = {row->start[0], row->start[1], row->start[2]},
        .step = {row->spacing[0], 0, 0},
        .count = row->count,
        .brightness = hounsfield,
        .values = values,
    });
}

void pel_generate_head_labels(const struct pel_generate_row *row, float *values) {
    paint_head(&(struct line){
        .start = {row->start[0], row->start[1], row->start[2]},
        .step = {row->spacing[0], 0, 0},
        .count = row->count,
        .brightness = label,
        .whole = true,
        .values = values,
    });
}

// Turned by 12.3 degrees about the axis (3, -2, 4), then shifted by (7, -5, 9) mm.
struct pel_matrix pel_generate_head_pair_truth(void) {
    return pel_matrix_from_quaternion((double[]){0.06, -0.04, 0.08, 1}, (double[]){7, -5, 9});
}

void pel_generate_head_mri(const struct pel_generate_row *row, float *values) {
    struct pel_matrix truth = pel_generate_head_pair_truth();
    struct line line = {.count = row->count, .brightness = t1_weighted, .values = values};
    pel_matrix_point(line.start, &truth, row->start);
    pel_matrix_direction(line.step, &truth, (double[]){row->spacing[0], 0, 0});
    paint_head(&line);
}
