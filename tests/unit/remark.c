// remark.c - what a scene asks for in vain is told, and nothing else.
#include "support/test.h"

// The warnings of one load, in their order.
struct heard {
    int count;
    char last[512];
};

static void hear(const char *message, void *user) {
    struct heard *heard = user;
    heard->count++;
    snprintf(heard->last, sizeof heard->last, "%s", message);
}

static struct heard load(const char *leaf, const char *const *overrides, int count) {
    char path[1024];
    struct heard heard = {0};
    snprintf(path, sizeof path, "%s/scenes/%s", TEST_SOURCE, leaf);
    pel_on_warning(hear, &heard);
    struct pel_scene *scene = pel_scene_load(path, overrides, count);
    pel_on_warning(NULL, NULL);
    if (!scene)
        fail_msg("%s", pel_error_message());
    pel_scene_destroy(scene);
    return heard;
}

// A scene of one unshaded ball ("c60", values 0 to 255), with a slip or with what mends it.
static void test_slips(void **state) {
    (void)state;
    static const struct {
        const char *overrides[3], *said; // NULL: nothing
    } cases[] = {
        {{"render.shadows=true"}, "shadows fall on shaded volumes only, and none is shaded"},
        {{"render.shadows=true", "volumes.0.shading=true"}, NULL},
        {{"render.shadows=true", "volumes.0.shading=true", "volumes.0.visible=false"},
         "shadows fall on shaded volumes only, and none is shaded"},
        {{"render.ambient_occlusion=true"},
         "ambient occlusion darkens shaded volumes only, and none is shaded"},
        {{"lights=[{}]"}, "lights shine on shaded volumes only, and none is shaded"},
        {{"render.gradient=sobel"},
         "gradients are chosen, but neither light nor opacity follows one"},
        {{"render.gradient=sobel", "volumes.0.silhouette={}"}, NULL},
        {{"volumes.0.shading=true", "render.model=mip"}, "volume 'c60': model mip is not shaded"},
        {{"volumes.0.shading=true", "render.model=iso"}, NULL},
        {{"volumes.0.silhouette={}", "render.model=average"},
         "volume 'c60': with model average opacity does not follow the gradient"},
        {{"volumes.0.gradient_opacity=[1,2]", "render.preintegration=true"},
         "volume 'c60': pre-integrated, its opacity does not follow the gradient"},
        {{"volumes.0.iso=100"},
         "volume 'c60': 'iso' says where its surfaces are, but its model is absorption"},
        {{"volumes.0.iso=1", "render.model=iso"}, NULL},
        {{"volumes.0.iso=300", "render.model=iso"}, "there is no surface at 300, as its values"},
        {{"render.preintegration=true", "render.model=thesis"},
         "only volumes of model absorption are pre-integrated, and there is none"},
        {{"render.preintegration=true"}, NULL},
        {{"render.mixing=max", "render.model=thesis"},
         "only volumes of model absorption are mixed by max, and there is none"},
        {{"render.mixing=over", "render.model=thesis"}, NULL},
        {{"render.emission_scale=0.1"}, "an emission scale is of model emission"},
        {{"render.emission_scale=0.1", "render.model=emission"}, NULL},
        {{"render.supersampling.adaptive=0.1"},
         "adaptive supersampling chooses between one ray and n x n, and n is 1"},
        {{"render.supersampling.adaptive=0.1", "render.supersampling.n=2"}, NULL},
        {{"stereo.separation=20"},
         "stereo has settings but no kind, so the picture is for one eye"},
        {{"stereo.separation=20", "stereo.kind=side-by-side"}, NULL},
        {{"clip=[{\"plane\": {\"point\": [-1000, 0, 0], \"normal\": [-1, 0, 0]}}]"},
         "the scene's clips leave nothing of any volume"},
        {{"clip=[{\"plane\": {\"point\": [-1000, 0, 0], \"normal\": [1, 0, 0]}}]"}, NULL},
        {{"clip=[{\"plane\": {\"point\": [0, 0, 0], \"normal\": [1, 1, 0]}}]"}, NULL},
        {{"clip=[{\"plane\": {\"point\": [0, -1000, 0], \"normal\": [0, 1, 0]}, \"keep\": "
          "\"outside\"}]"},
         "the scene's clips leave nothing of any volume"},
        {{"clip=[{\"box\": {\"centre\": [0, 0, 500], \"size\": [10, 10, 10]}}]"},
         "the scene's clips leave nothing of any volume"},
        {{"clip=[{\"box\": {\"centre\": [0, 0, 500], \"size\": [10, 10, 10]}, \"keep\": "
          "\"outside\"}]"},
         NULL},
        {{"clip=[{\"box\": {\"size\": [10, 10, 10]}}]"}, NULL},
        // Other frames may use it.
        {{"render.shadows=true", "animation.frames=3"}, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int count = 0;
        while (count < 3 && cases[i].overrides[count])
            count++;
        struct heard heard = load("buckyball.json", cases[i].overrides, count);
        int expected = cases[i].said ? 1 : 0;
        // A hidden volume alone is a black picture, which is another warning, and comes first.
        expected += strstr(count == 3 ? cases[i].overrides[2] : "", "visible") ? 1 : 0;
        if (heard.count != expected || (cases[i].said && !strstr(heard.last, cases[i].said)))
            fail_msg("%s: %d warnings, the last: %s", cases[i].overrides[0], heard.count,
                     heard.last);
    }
}

// A mask that selects nothing shows nothing, or all; one that selects anything is left alone.
static void test_masks(void **state) {
    (void)state;
    static const struct {
        const char *mask, *said;
    } cases[] = {
        {"{\"volume\": 1, \"labels\": [300]}", "': nothing of it is shown, as no value of '"},
        {"{\"volume\": 1, \"labels\": [300], \"invert\": true}", "': all of it is shown, as no"},
        {"{\"volume\": 1, \"labels\": [300, 1]}", NULL},
        {"{\"volume\": 1, \"threshold\": 0.5}", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[128];
        snprintf(text, sizeof text, "volumes.0.mask=%s", cases[i].mask);
        struct heard heard = load("two-overlapping.json", (const char *const[]){text}, 1);
        if (heard.count != (cases[i].said ? 1 : 0) ||
            (cases[i].said && !strstr(heard.last, cases[i].said)))
            fail_msg("%s: %d warnings, the last: %s", text, heard.count, heard.last);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slips),
        cmocka_unit_test(test_masks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
