// Transfer functions from JSON: Pellucid's own, ParaView's, Slicer's, and what is wrong with them.
#include "support/near.h"
#include "support/test.h"

#include <jansson.h>

#include "transfer/transfer.h"
#include "transfer/transfer_file.h"
#include "transfer/vtk_curve.h"

static struct pel_transfer *parse(const char *text, const char **bad_key) {
    json_error_t error;
    json_t *json = json_loads(text, JSON_DECODE_ANY, &error);
    if (!json)
        fail_msg("%s: %s", text, error.text);
    struct pel_transfer *transfer = pel_transfer_parse(json, bad_key);
    json_decref(json);
    return transfer;
}

static struct pel_transfer *parsed(const char *text) {
    const char *bad_key = "";
    struct pel_transfer *transfer = parse(text, &bad_key);
    if (!transfer)
        fail_msg("%s: %s: %s", text, bad_key, pel_error_message());
    return transfer;
}

static void check_at(const struct pel_transfer *transfer, double value, double r, double g,
                     double b, double a, double tolerance) {
    double rgba[4], expected[4] = {r, g, b, a};
    pel_transfer_evaluate(transfer, value, rgba);
    for (int i = 0; i < 4; i++)
        if (!(fabs(rgba[i] - expected[i]) <= tolerance))
            fail_msg("at %g: channel %d is %.9g, not %.9g", value, i, rgba[i], expected[i]);
}

static void test_own_curves(void **state) {
    (void)state;
    struct pel_transfer *transfer =
        parsed("{\"colours\": [[-100, 1, 0, 0], [100, \"#00ff80\"]],"
               " \"opacities\": [[0, 0], [200, 0.5], [200, 1]], \"opacity_unit\": 2.5,"
               " \"interpolation\": \"nearest\", \"entries\": 300}");
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    assert_near(transfer->opacity_unit_mm, 2.5, 0);
    assert_true(transfer->nearest);
    assert_int_equal(transfer->table_entries, 300);
    check_at(transfer, 0, 0.5, 0.5, 64 / 255.0, 0, 1e-12);
    check_at(transfer, 100, 0, 1, 128 / 255.0, 0.25, 1e-12);
    check_at(transfer, 200, 0, 1, 128 / 255.0, 1, 1e-12);
    pel_transfer_destroy(transfer);
}

static void test_own_points_and_scales(void **state) {
    (void)state;
    struct pel_transfer *transfer = parsed(
        "{\"points\": [[0, \"#FF0000\", 0], [0.5, 0, 1, 0, 0.25]], \"scale\": \"relative\"}");
    assert_int_equal(transfer->scale, PEL_VALUES_RELATIVE);
    check_at(transfer, 0.25, 0.5, 0.5, 0, 0.125, 1e-12);
    pel_transfer_destroy(transfer);
    transfer = parsed("{\"opacities\": [[5, 0], [99, 1]], \"scale\": \"percentile\","
                      " \"interpolation\": \"linear\"}");
    assert_int_equal(transfer->scale, PEL_VALUES_PERCENTILE);
    assert_false(transfer->nearest);
    check_at(transfer, 52, 1, 1, 1, 0.5, 1e-12);
    pel_transfer_destroy(transfer);
    // Relative curves, placed.
    transfer = parsed("{\"colors\": [[0, 0, 0, 0], [1, 1, 1, 1]], \"opacities\": [[0, 1]],"
                      " \"scale\": \"relative\", \"range\": [100, 200]}");
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    check_at(transfer, 125, 0.25, 0.25, 0.25, 1, 1e-12);
    pel_transfer_destroy(transfer);
}

static void test_presets(void **state) {
    (void)state;
    struct pel_transfer *transfer = parsed("\"hot\"");
    assert_int_equal(transfer->scale, PEL_VALUES_RELATIVE);
    pel_transfer_destroy(transfer);
    transfer = parsed("{\"preset\": \"grey\", \"range\": [-50, 150], \"opacity_unit\": 3}");
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    assert_near(transfer->opacity_unit_mm, 3, 0);
    assert_near(transfer->colours[0].value, -50, 1e-9);
    assert_near(transfer->colours[transfer->colour_count - 1].value, 150, 1e-9);
    pel_transfer_destroy(transfer);
    // Opacities of one's own, within the range and in absolute values.
    transfer = parsed("{\"preset\": \"grey\", \"range\": [0, 50], \"opacities\": [[0.5, 1]]}");
    assert_near(transfer->opacities[0].value, 25, 1e-9);
    check_at(transfer, 25, 0.5, 0.5, 0.5, 1, 1e-12);
    pel_transfer_destroy(transfer);
    transfer = parsed("{\"preset\": \"grey\", \"range\": [0, 50], \"scale\": \"absolute\","
                      " \"opacities\": [[10, 0], [20, 1]]}");
    check_at(transfer, 15, 0.3, 0.3, 0.3, 0.5, 1e-12);
    pel_transfer_destroy(transfer);
}

static void refuse(const char *text, enum pel_error code, const char *key, const char *sentence) {
    const char *bad_key = NULL;
    struct pel_transfer *transfer = parse(text, &bad_key);
    if (transfer)
        fail_msg("accepted: %s", text);
    assert_int_equal(pel_error_code(), code);
    assert_string_equal(bad_key, key);
    assert_string_equal(pel_error_message(), sentence);
}

static void test_refusals(void **state) {
    (void)state;
    const enum pel_error format = PEL_ERROR_FORMAT;
    refuse("7", format, "", "expected an object or the name of a preset");
    refuse("{}", format, "", "needs 'opacities', 'points' or 'preset'");
    refuse("{\"opacites\": []}", format, "opacites", "unknown key; did you mean 'opacities'");
    refuse("{\"banana\": 1}", format, "banana", "unknown key");
    refuse("{\"preset\": \"gray\"}", PEL_ERROR_ARGUMENT, "preset",
           "no preset 'gray'; did you mean 'grey'");
    refuse("{\"preset\": 3}", format, "preset", "expected the name of a preset");
    refuse("{\"opacities\": []}", format, "opacities", "expected a list of 1 to 65536 points");
    refuse("{\"opacities\": {\"a\": 1}}", format, "opacities",
           "expected a list of 1 to 65536 points");
    refuse("{\"opacities\": [[0, 0], [1, 2]]}", format, "opacities.1",
           "opacity point 1: opacity 2 is outside 0..1");
    refuse("{\"opacities\": [[0, 0], [1, 1, 1]]}", format, "opacities.1",
           "expected [value, opacity]");
    refuse("{\"opacities\": [[0, \"0\"]]}", format, "opacities.0", "expected a number");
    refuse("{\"opacities\": [[5, 0], [4, 1]]}", format, "opacities.1",
           "opacity point 1: value 4 is less than 5 before it");
    refuse("{\"opacities\": [[0, 1]], \"colours\": [[0, 255, 0, 0]]}", format, "colours.0",
           "colour point 0: red 255 is outside 0..1");
    refuse("{\"opacities\": [[0, 1]], \"colors\": [[0, \"red\"]]}", format, "colors.0",
           "'red' is not a colour as '#rrggbb'");
    refuse("{\"opacities\": [[0, 1]], \"colors\": [[0, \"#12345g\"]]}", format, "colors.0",
           "'#12345g' is not a colour as '#rrggbb'");
    refuse("{\"opacities\": [[0, 1]], \"colours\": [[0, 1, 1]]}", format, "colours.0",
           "expected [value, red, green, blue]");
    refuse("{\"colors\": [[0, 1, 1, 1]], \"colours\": [[0, 1, 1, 1]], \"opacities\": [[0, 1]]}",
           format, "colors", "'colours' is there already");
    refuse("{\"points\": [[0, 1, 1, 1, 1]], \"opacities\": [[0, 1]]}", format, "opacities",
           "'points' gives this already");
    refuse("{\"points\": [[0, \"#ffffff\"]]}", format, "points.0",
           "expected [value, \"#rrggbb\", opacity]");
    refuse("{\"opacities\": [[101, 1]], \"scale\": \"percentile\"}", format, "opacities.0",
           "opacity point 0: percentile 101 is outside 0..100");
    refuse("{\"opacities\": [[0, 1]], \"scale\": \"percentil\"}", format, "scale",
           "unknown word 'percentil'; did you mean 'percentile'");
    refuse("{\"opacities\": [[0, 1]], \"interpolation\": 1}", format, "interpolation",
           "expected one of \"linear\", \"nearest\"");
    refuse("{\"opacities\": [[0, 1]], \"opacity_unit\": -1}", format, "opacity_unit",
           "-1 mm is not a positive length");
    refuse("{\"opacities\": [[0, 1]], \"entries\": 2.5}", format, "entries",
           "expected a whole number in 2..65536");
    refuse("{\"opacities\": [[0, 1]], \"range\": [0, 1]}", format, "range",
           "only relative values take a range, and these are absolute");
    refuse("{\"preset\": \"ct-bone\", \"range\": [0, 1]}", format, "range",
           "only relative values take a range, and these are absolute");
    refuse("{\"preset\": \"hot\", \"range\": [1, 1]}", format, "range", "1 is not below 1");
    refuse("{\"preset\": \"hot\", \"range\": [1]}", format, "range", "expected [low, high]");
    refuse("{\"preset\": \"hot\", \"scale\": \"absolute\"}", format, "scale",
           "the preset's values are relative; 'range' places them");
}

// Moreland's published table of "cool to warm" has 33 entries; ParaView makes it of two colours.
static void test_paraview_diverging(void **state) {
    (void)state;
    struct pel_transfer *transfer = parsed(
        "[{\"ColorSpace\": \"Diverging\", \"Name\": \"Cool to Warm\", \"NanColor\": [1, 1, 0],"
        " \"RGBPoints\": [0, 0.230, 0.299, 0.754, 1, 0.706, 0.016, 0.150]}]");
    assert_int_equal(transfer->scale, PEL_VALUES_RELATIVE);
    static const int published[][4] = {
        {0, 59, 76, 192},    {1, 68, 90, 204},    {2, 77, 104, 215}, {8, 141, 176, 254},
        {16, 221, 221, 221}, {24, 244, 154, 123}, {31, 192, 40, 47}, {32, 180, 4, 38},
    };
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        const int *row = published[i];
        check_at(transfer, row[0] / 32.0, row[1] / 255.0, row[2] / 255.0, row[3] / 255.0,
                 row[0] / 32.0, 1.01 / 255);
    }
    pel_transfer_destroy(transfer);
}

static void test_paraview_spaces(void **state) {
    (void)state;
    // HSV from red to green goes through yellow; halfway in hue is full yellow.
    struct pel_transfer *transfer =
        parsed("{\"ColorSpace\": \"HSV\", \"RGBPoints\": [10, 1, 0, 0, 20, 0, 1, 0]}");
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    check_at(transfer, 15, 1, 1, 0, 0.5, 1e-9);
    pel_transfer_destroy(transfer);
    // From red to blue it goes through green, or through magenta when the hue may wrap.
    transfer = parsed("{\"ColorSpace\": \"HSV\", \"RGBPoints\": [10, 1, 0, 0, 20, 0, 0, 1]}");
    check_at(transfer, 15, 0, 1, 0, 0.5, 1e-9);
    pel_transfer_destroy(transfer);
    transfer = parsed("{\"ColorSpace\": \"HSV\", \"HSVWrap\": 1,"
                      " \"RGBPoints\": [10, 1, 0, 0, 20, 0, 0, 1]}");
    check_at(transfer, 15, 1, 0, 1, 0.5, 1e-9);
    pel_transfer_destroy(transfer);
    // Black to white in CIELAB: L* = 50 is the grey 118.9 of sRGB.
    transfer = parsed("{\"ColorSpace\": \"Lab\", \"RGBPoints\": [0, 0, 0, 0, 4, 1, 1, 1]}");
    check_at(transfer, 2, 0.4663, 0.4663, 0.4663, 0.5, 2e-3);
    check_at(transfer, 4, 1, 1, 1, 1, 0);
    pel_transfer_destroy(transfer);
    transfer = parsed("{\"ColorSpace\": \"Step\","
                      " \"RGBPoints\": [1, 1, 0, 0, 2, 0, 1, 0, 3, 0, 0, 1]}");
    check_at(transfer, 0.5, 1, 0, 0, 0, 0);
    check_at(transfer, 1.5, 0, 1, 0, 0.25, 0);
    check_at(transfer, 2.5, 0, 0, 1, 0.75, 0);
    pel_transfer_destroy(transfer);
}

static void test_paraview_opacities(void **state) {
    (void)state;
    struct pel_transfer *transfer =
        parsed("[{\"RGBPoints\": [0, 0, 0, 0, 40, 1, 1, 1], \"Points\": [0, 0, 0.25, 0,"
               " 10, 1, 0.5, 1, 20, 0, 0.5, 0.5, 30, 1, 0.5, 0, 40, 0, 0.5, 0]}]");
    // The midpoint lies at a quarter of the first segment.
    check_at(transfer, 2.5, 0.0625, 0.0625, 0.0625, 0.5, 1e-9);
    check_at(transfer, 6.25, 0.15625, 0.15625, 0.15625, 0.75, 1e-9);
    // The second is a step in its middle.
    check_at(transfer, 14.9, 0.3725, 0.3725, 0.3725, 1, 1e-9);
    check_at(transfer, 15, 0.375, 0.375, 0.375, 0, 1e-9);
    // The third is bent, point-symmetric, and steeper in the middle than a line.
    double low[4], high[4];
    pel_transfer_evaluate(transfer, 23, low);
    pel_transfer_evaluate(transfer, 27, high);
    assert_near(low[3] + high[3], 1, 1e-9);
    assert_true(low[3] < 0.1);
    check_at(transfer, 25, 0.625, 0.625, 0.625, 0.5, 1e-9);
    check_at(transfer, 35, 0.875, 0.875, 0.875, 0.5, 1e-9);
    pel_transfer_destroy(transfer);
}

// By hand, for sharpness 1/2 at a quarter: s = (1/2)^6 / 2 = 1/128; the Hermite curve's
// -2 s^3 + 3 s^2 plus half its tangents' (2 s^3 - 3 s^2 + s).
static void test_vtk_sharpness(void **state) {
    (void)state;
    double s = 1 / 128.0, ss = s * s, sss = ss * s;
    double expected = 3 * ss - 2 * sss + 0.5 * (2 * sss - 3 * ss + s);
    assert_near(pel_vtk_opacity(0, 1, 0.5, 0.5, 0.25), expected, 1e-15);
    assert_near(pel_vtk_opacity(0.2, 0.2, 0.3, 0.7, 0.6), 0.2, 1e-15);
    assert_near(pel_vtk_opacity(1, 0, 0, 0, 1e-5), 0.5, 1e-9);
}

static void test_paraview_refusals(void **state) {
    (void)state;
    refuse("[]", PEL_ERROR_UNSUPPORTED, "", "the colour map has no RGBPoints");
    refuse("[{\"RGBPoints\": [0, 1, 1]}]", PEL_ERROR_FORMAT, "0.RGBPoints",
           "expected a list of 1 to 2048 nodes");
    refuse("{\"RGBPoints\": [0, 1, 1, \"1\"]}", PEL_ERROR_FORMAT, "RGBPoints.3",
           "expected a number");
    refuse("{\"RGBPoints\": [0, 1, 1, 255]}", PEL_ERROR_FORMAT, "RGBPoints.3",
           "255 is outside 0..1");
    refuse("{\"RGBPoints\": [0, 1, 1, 1, -1, 0, 0, 0]}", PEL_ERROR_FORMAT, "RGBPoints.4",
           "value -1 is less than 0 before it");
    refuse("{\"ColorSpace\": \"Munsell\", \"RGBPoints\": [0, 1, 1, 1]}", PEL_ERROR_UNSUPPORTED,
           "ColorSpace", "unknown colour space 'Munsell'");
}

static void test_slicer(void **state) {
    (void)state;
    struct pel_transfer *transfer = parsed(
        "{\"@schema\": \"volume-property-schema-v1.0.0.json#\", \"volumeProperties\": [{"
        "\"interpolationType\": \"linear\", \"components\": [{\"shade\": true,"
        "\"rgbTransferFunction\": {\"type\": \"colorTransferFunction\", \"points\": ["
        "{\"x\": 0, \"color\": [0, 0, 0]}, {\"x\": 100, \"color\": [1, 0.5, 0]}]},"
        "\"scalarOpacityUnitDistance\": 0.5,"
        "\"scalarOpacity\": {\"type\": \"piecewiseLinearFunction\", \"points\": ["
        "{\"x\": 0, \"y\": 0}, {\"x\": 120, \"y\": 0.3, \"midpoint\": 0.5, \"sharpness\": 0}]},"
        "\"gradientOpacity\": {\"points\": [{\"x\": 0, \"y\": 1}]}}]}]}");
    check_at(transfer, 60, 0.6, 0.3, 0, 0.15, 1e-12);
    assert_near(transfer->opacity_unit_mm, 0.5, 0);
    pel_transfer_destroy(transfer);
    refuse("{\"volumeProperties\": [{\"components\": [{}]}]}", PEL_ERROR_FORMAT,
           "volumeProperties.0.components.0.rgbTransferFunction.points",
           "expected a list of 1 to 2048 nodes");
}

static const char *write_file(const char *leaf, const char *text) {
    const char *path = test_temporary_path(leaf);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    return path;
}

static void refuse_file(const char *text, const char *ending) {
    const char *path = write_file("wrong.json", text);
    assert_null(pel_transfer_load(path));
    char expected[512];
    snprintf(expected, sizeof expected, "%s:%s", path, ending);
    assert_string_equal(pel_error_message(), expected);
}

static void test_files(void **state) {
    (void)state;
    struct pel_transfer *transfer =
        pel_transfer_load(write_file("right.json", "{\n  \"opacities\": [[0, 0], [1, 1]]\n}\n"));
    assert_non_null(transfer);
    check_at(transfer, 0.5, 1, 1, 1, 0.5, 1e-12);
    pel_transfer_destroy(transfer);
    refuse_file("{\n  \"opacities\": [[0, 0],\n    [1, 2]]\n}\n",
                "3:5: opacities.1: opacity point 1: opacity 2 is outside 0..1");
    refuse_file("{\n  \"opacites\": []\n}", "2:3: opacites: unknown key; did you mean 'opacities'");
    refuse_file("{}", "1:1: needs 'opacities', 'points' or 'preset'");
    refuse_file("{\"opacities\": [[0, 1]],\n \"opacities\": [[0, 1]]}",
                "2:12: duplicate object key near '\"opacities\"'");
    assert_null(pel_transfer_load(test_temporary_path("missing.json")));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_own_curves),
        cmocka_unit_test(test_own_points_and_scales),
        cmocka_unit_test(test_presets),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_paraview_diverging),
        cmocka_unit_test(test_paraview_spaces),
        cmocka_unit_test(test_paraview_opacities),
        cmocka_unit_test(test_vtk_sharpness),
        cmocka_unit_test(test_paraview_refusals),
        cmocka_unit_test(test_slicer),
        cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
