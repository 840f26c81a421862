// probe.cl - follows the ray through one pixel's centre and writes down what it meets.
//
// The ray loop is that of a picture, compiled for one ray; it hands over each sample that it takes.
// Included by render.cl, at its end.
#ifndef PROBE_CL
#define PROBE_CL

#if LANES != 1
#error "a probe is one ray"
#endif

__kernel void probe(__constant struct world *world, TABLE_SPACE const uint *table,
                    __global const uchar *cells, const int x, const int y,
                    __global struct probe *probe, __global struct probe_sample *samples STRIDE_PARAMETER,
                    MEMORY_PARAMETERS) {
    struct ray ray = camera_ray(world, &world->camera, x + 0.5f, y + 0.5f);
#if JITTER
    const uint key = pattern_key(world->seed, x, y);
    ray.phase = (float)(pattern_draw(key, DRAW_PHASE) & 0xffffffu) * 0x1p-24f;
#endif
    struct crossing crossing;
    crossing.log = samples;
    crossing.logged = 0;
    find_crossing(world, cells, &ray, &crossing);
    BEGIN_STRIDES(crossing);
    probe->part_count = crossing.count;
    for (int c = 0; c < crossing.count; c++) {
        const struct cursor *cursor = &crossing.cursors[c];
        __global struct probe_part *part = &probe->parts[c];
        part->part = crossing.parts[c];
        part->first = cursor->first;
        part->end = cursor->end;
        part->first_mm = crossing.t_first;
        part->step_mm = world->step_mm;
    }
    struct light light = {0, 0, 0, 0};
    int taken = 0;
    if (HAS_SAMPLES(&crossing))
        light = follow_rays(world, table, cells, MEMORY_ARGUMENTS, &crossing, &taken);
    probe->sample_count = crossing.logged;
    const float4 behind = world->background;
    const float clear = 1.0f - light.a;
    probe->light = (float4)(light.r + clear * behind.x, light.g + clear * behind.y,
                            light.b + clear * behind.z, light.a + clear * behind.w);
}

#endif
