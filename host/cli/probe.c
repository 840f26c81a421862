// probe.c - what one ray of a picture meets, printed: `pellucid render --pixel X,Y`.
#include "cli/probe.h"

#include <stdio.h>

#include "cli/options.h"
#include "cli/report.h"

static void print_table(const struct pel_scene *scene, const struct pel_probe *probe) {
    printf("ray      from %.6g, %.6g, %.6g mm along %.6g, %.6g, %.6g\n", probe->origin[0],
           probe->origin[1], probe->origin[2], probe->direction[0], probe->direction[1],
           probe->direction[2]);
    printf("colour   %.6g, %.6g, %.6g, opacity %.6g (premultiplied)\n", probe->rgba[0],
           probe->rgba[1], probe->rgba[2], probe->rgba[3]);
    printf("spans    %d\n", probe->span_count);
    for (int i = 0; i < probe->span_count; i++) {
        const struct pel_probe_span *span = &probe->spans[i];
        printf("  %10.4f to %10.4f mm ", span->from_mm, span->to_mm);
        for (int k = 0; k < scene->instance_count; k++)
            if (span->instances & UINT32_C(1) << k)
                printf(" %s", scene->instances[k].name);
        putchar('\n');
    }
    printf("samples  %d%s\n", probe->sample_count, probe->cut ? ", and more" : "");
    if (probe->sample_count > 0)
        printf("  %7s %10s %27s %12s %8s %21s %8s  %s\n", "number", "mm", "position (RAS mm)",
               "value", "opacity", "colour", "so far", "volume");
    for (int i = 0; i < probe->sample_count; i++) {
        const struct pel_probe_sample *sample = &probe->samples[i];
        printf("  %7d %10.4f %8.3f %9.3f %9.3f %11.6g %8.5f %6.4f %6.4f %6.4f  %8.5f  %s\n",
               sample->number, sample->distance_mm, sample->position[0], sample->position[1],
               sample->position[2], sample->value, sample->opacity, sample->rgb[0], sample->rgb[1],
               sample->rgb[2], sample->accumulated, scene->instances[sample->instance].name);
    }
}

static json_t *describe_spans(const struct pel_scene *scene, const struct pel_probe *probe) {
    json_t *spans = json_array();
    for (int i = 0; i < probe->span_count; i++) {
        json_t *names = json_array(), *object = json_object();
        for (int k = 0; k < scene->instance_count; k++)
            if (probe->spans[i].instances & UINT32_C(1) << k)
                json_array_append_new(names, report_text(scene->instances[k].name));
        json_object_set_new(object, "from_mm", report_number(probe->spans[i].from_mm));
        json_object_set_new(object, "to_mm", report_number(probe->spans[i].to_mm));
        json_object_set_new(object, "volumes", names);
        json_array_append_new(spans, object);
    }
    return spans;
}

static json_t *describe_samples(const struct pel_scene *scene, const struct pel_probe *probe) {
    json_t *samples = json_array();
    for (int i = 0; i < probe->sample_count; i++) {
        const struct pel_probe_sample *sample = &probe->samples[i];
        json_t *object = json_object();
        json_object_set_new(object, "volume", report_text(scene->instances[sample->instance].name));
        json_object_set_new(object, "number", json_integer(sample->number));
        json_object_set_new(object, "distance_mm", report_number(sample->distance_mm));
        json_object_set_new(object, "position", report_numbers(sample->position, 3));
        json_object_set_new(object, "value", report_number(sample->value));
        json_object_set_new(object, "opacity", report_number(sample->opacity));
        json_object_set_new(object, "rgb", report_numbers(sample->rgb, 3));
        json_object_set_new(object, "accumulated", report_number(sample->accumulated));
        json_array_append_new(samples, object);
    }
    return samples;
}

static int print_json(const struct pel_scene *scene, const struct pel_probe *probe,
                      const int pixel[2]) {
    json_t *object = json_object();
    json_object_set_new(object, "pixel", json_pack("[i, i]", pixel[0], pixel[1]));
    json_object_set_new(object, "origin", report_numbers(probe->origin, 3));
    json_object_set_new(object, "direction", report_numbers(probe->direction, 3));
    json_object_set_new(object, "rgba", report_numbers(probe->rgba, 4));
    json_object_set_new(object, "spans", describe_spans(scene, probe));
    json_object_set_new(object, "samples", describe_samples(scene, probe));
    json_object_set_new(object, "cut", json_boolean(probe->cut));
    return report_json(object);
}

int probe_parse(const char *text, int pixel[2]) {
    int end = 0;
    if (sscanf(text, "%9d,%9d%n", &pixel[0], &pixel[1], &end) == 2 && text[end] == '\0')
        return PEL_OK;
    return cli_fail(PEL_ERROR_ARGUMENT, "--pixel: '%s' is not of the form X,Y", text);
}

int probe_print(struct pel_renderer *renderer, const struct pel_scene *scene, const int pixel[2],
                bool json) {
    struct pel_probe probe;
    if (!pel_renderer_probe(renderer, scene, pixel[0], pixel[1], &probe))
        return cli_fail_library();
    int status = PEL_OK;
    if (json)
        status = print_json(scene, &probe, pixel);
    else
        print_table(scene, &probe);
    pel_probe_finish(&probe);
    return report_finish(status);
}
