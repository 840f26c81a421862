// secondary.c - shadows and ambient occlusion as kernels read them: docs/picture.md, "Shadows and
// ambient occlusion".
//
// The directions lie evenly on half a sphere, on the spiral of the golden angle (Vogel 1979;
// Swinbank & Purser 2006), which a random rotation turns (Shoemake 1992).
#include "world/secondary.h"

#include <float.h>
#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "shared/pattern.h"
#include "world/narrow.h"

static const double step_usual = 2;
static const int directions_usual = 16;
static const double radius_share = 0.1; // of the diagonal of all volumes

static bool check(const char *what, double length_mm, double step, double strength) {
    if (!(length_mm >= 0))
        return pel_fail(PEL_ERROR_ARGUMENT, "%s over %g mm", what, length_mm);
    if (step != 0 && !(step >= PEL_SECONDARY_STEP_MIN && step <= PEL_SECONDARY_STEP_MAX))
        return pel_fail(PEL_ERROR_ARGUMENT, "%s in steps of %g, outside %g..%g", what, step,
                        PEL_SECONDARY_STEP_MIN, PEL_SECONDARY_STEP_MAX);
    if (!(strength >= 0 && strength <= 1))
        return pel_fail(PEL_ERROR_ARGUMENT, "%s of strength %g, outside 0..1", what, strength);
    return true;
}

// Members that are zero take their defaults.
static float or_usual(double value, double usual) {
    return (float)(value != 0 ? value : usual);
}

static bool fill_shadows(struct pel_world *world, const struct pel_shadows *shadows) {
    if (!shadows->on)
        return true;
    if (!check("shadows", shadows->length_mm, shadows->step, shadows->strength))
        return false;
    struct world *bytes = &world->bytes;
    bytes->shadow_step_mm = or_usual(shadows->step, step_usual) * bytes->step_mm;
    bytes->shadow_length_mm = or_usual(shadows->length_mm, FLT_MAX);
    bytes->shadow_strength = or_usual(shadows->strength, 1);
    world->secondary |= SECONDARY_SHADOWS;
    return true;
}

// A random number in 0..1.
static double draw(u32 seed, u32 number) {
    return (pattern_draw(pattern_key(seed, 0, 0), DRAW_TURN + number) & 0xffffff) * 0x1p-24;
}

static void fill_directions(struct pel_world *world, int count, u32 seed) {
    double inner = sqrt(1 - draw(seed, 0)), outer = sqrt(draw(seed, 0));
    double first = 2 * PEL_PI * draw(seed, 1), second = 2 * PEL_PI * draw(seed, 2);
    const double xyzw[4] = {inner * sin(first), inner * cos(first), outer * sin(second),
                            outer * cos(second)};
    struct pel_matrix turn = pel_matrix_from_quaternion(xyzw, (double[3]){0});
    double golden = PEL_PI * (3 - sqrt(5));
    world->bytes.directions = world->cut_count;
    for (int k = 0; k < count; k++) {
        double z = 1 - (k + 0.5) / count, r = sqrt(1 - z * z);
        double d[3] = {r * cos(golden * k), r * sin(golden * k), z};
        pel_matrix_direction(d, &turn, d);
        world->bytes.cuts[world->cut_count + k] = pel_narrow(d, 0);
    }
    world->bytes.occlusion_count = count;
}

static bool fill_occlusion(struct pel_world *world, const struct pel_ambient_occlusion *occlusion,
                           u32 seed) {
    _Static_assert(OCCLUSION_MAX == PEL_OCCLUSION_DIRECTION_MAX, "a row for each direction");
    if (!occlusion->on)
        return true;
    if (!check("ambient occlusion", occlusion->radius_mm, occlusion->step, occlusion->strength))
        return false;
    int count = occlusion->directions ? occlusion->directions : directions_usual;
    if (count < 1 || count > PEL_OCCLUSION_DIRECTION_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "ambient occlusion in %d directions, outside 1..%d",
                        count, PEL_OCCLUSION_DIRECTION_MAX);
    struct world *bytes = &world->bytes;
    bytes->occlusion_step_mm = or_usual(occlusion->step, step_usual) * bytes->step_mm;
    bytes->occlusion_radius_mm =
        or_usual(occlusion->radius_mm, radius_share * pel_world_diagonal_mm(world));
    bytes->occlusion_strength = or_usual(occlusion->strength, 1);
    fill_directions(world, count, seed);
    world->secondary |= SECONDARY_OCCLUSION;
    return true;
}

bool pel_secondary_fill(struct pel_world *world, const struct pel_scene *scene) {
    const struct pel_render_settings *render = &scene->render;
    if (!fill_shadows(world, &render->shadows) ||
        !fill_occlusion(world, &render->ambient_occlusion, render->supersampling.seed))
        return false;
    // Only what is lit can be darker.
    bool lit = false;
    for (int p = 0; p < world->bytes.part_count; p++)
        lit |= world->bytes.parts[p].shading != SHADING_NONE;
    if (!lit || world->models & MODELS_EMISSION)
        world->secondary = world->bytes.occlusion_count = 0;
    return true;
}
