// crossing.cl - which parts a packet of rays crosses, and the cursors that it has in them.
//
// Samples are numbered from where a ray enters its first part, so that is found first. Then parts
// are asked one after the other as the rays come to them (LATE_PARTS), or all of them at once.
// Included by span.cl.
#ifndef CROSSING_CL
#define CROSSING_CL

#if MIXING == MIXING_ORDERED
// Where the rays enter the instance whose first part is p.
INLINE real enter_instance(__constant struct world *world, const struct ray *ray, int p) {
    const int medium = world->parts[p].medium;
    real near = (real)(FLT_MAX);
    for (int q = p; q < world->part_count && world->parts[q].medium == medium; q++) {
        const struct span span = part_span(&world->parts[q], ray);
        near = CHOOSE(near, fmin(near, span.near), MASK(span.near < span.far));
    }
    return near;
}
#endif

// Gives part p a cursor if some ray has a sample in it. Sample 0 is `phase` steps behind t_near.
INLINE void cross_part(__constant struct world *world, __global const uchar *cells,
                       const struct ray *ray, real t_near, float step_mm, int p,
                       struct crossing *crossing) {
    __constant struct part *part = &world->parts[p];
    const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
    struct span span = box_span(&ray_voxel, part->box_low, part->box_high);
#if CLIP
    clip_span(world, part, ray, &span);
#endif
    struct cursor cursor = cursor_begin(world, part, &ray_voxel, &span, t_near, step_mm);
#if MODELS & MODELS_BACKWARD
    cursor_mirror(&cursor, crossing->mirror);
#endif
    crossing->possible +=
        CHOOSE((integer)(0), cursor.end - cursor.first, MASK(cursor.first < cursor.end));
#if !LATE_CURSORS
    cursor.next = cursor_leap(part, cells, &cursor, cursor.first, (mask)(-1));
#endif
    // With runs of samples all parts count, so that these are the same whatever is skipped.
    const integer seen = ADAPTIVE ? cursor.first : cursor.next;
    if (!any_lane(MASK(seen < cursor.end)))
        return;
    const int c = CAPACITY == 1 ? 0 : crossing->count;
    crossing->cursors[c] = cursor;
    crossing->parts[c] = p;
#if JOINS
    put_ahead(&crossing->ahead, least_lane(cursor.first), -1 - c);
#endif
#if LATE_PARTS
    crossing->end = max(crossing->end, cursor.end);
#endif
    crossing->count++;
}

#if LATE_PARTS
// Puts a node ahead if one of the rays that ask meets its box. Rounding may make its sample the one
// behind its parts' first.
INLINE void approach_node(__constant struct world *world, struct crossing *crossing, int n,
                          mask asks) {
    const struct span span = meet_box(&world->nodes[n], &crossing->approach);
    const mask meets = asks & MASK(span.near <= span.far);
    if (!any_lane(meets))
        return;
    const integer first = sample_at(span.near, crossing->t_near, RAY_PHASE(world, &crossing->ray),
                                    1.0f / world->step_mm);
    put_ahead(&crossing->ahead, least_lane(CHOOSE((integer)(SAMPLE_NEVER), first, meets)) - 1, n);
}

INLINE void approach_children(__constant struct world *world, struct crossing *crossing, int n,
                              int link, mask asks) {
    for (int child = 0; child < 2; child++)
        approach_node(world, crossing, child ? link : n + 1, asks);
}

// Looks what there is below a node that rays have come to.
INLINE void enter_node(__constant struct world *world, __global const uchar *cells,
                       struct crossing *crossing, int n, mask asks) {
    const int link = world->nodes[n].link;
    if (link < 0)
        cross_part(world, cells, &crossing->ray, crossing->t_near, world->step_mm, -1 - link, crossing);
    else
        approach_children(world, crossing, n, link, asks);
}
#endif

#if CAPACITY > 1 && !LATE_PARTS
// The parts that some ray crosses, as bits, and the distance at which each ray enters the first
// one.
INLINE ulong find_parts(__constant struct world *world, const struct ray *ray, real *t_near) {
    ulong crossed = 0;
    *t_near = (real)(FLT_MAX);
    for (ulong near = find_boxes(world, ray, (real)(FLT_MAX)); near != 0; near &= near - 1) {
        const int p = first_part(near);
        const struct span span = part_span(&world->parts[p], ray);
        const mask hit = MASK(span.near < span.far);
        *t_near = CHOOSE(*t_near, span.near, hit & MASK(span.near < *t_near));
        crossed |= any_lane(hit) ? (ulong)1 << p : 0;
    }
    return crossed;
}

// Gives the parts their cursors.
INLINE void cross_parts(__constant struct world *world, __global const uchar *cells,
                        const struct ray *ray, real t_near, ulong parts,
                        struct crossing *crossing) {
#if MIXING == MIXING_ORDERED
    real t_own = t_near;
    int entered = -1; // the instance's first part that t_own is of
#endif
    for (; parts != 0; parts &= parts - 1) {
        const int p = first_part(parts);
#if MIXING == MIXING_ORDERED
        int start = p;
        while (start > 0 && world->parts[start - 1].medium == world->parts[p].medium)
            start--;
        if (!world->origin_bounds && start != entered)
            t_own = enter_instance(world, ray, start);
        entered = start;
        const float step_mm = world->parts[p].step_mm, stride = step_mm / world->step_mm;
        const ray_phase phase = RAY_PHASE(world, ray);
        crossing->strides[crossing->count] = stride;
        crossing->starts[crossing->count] =
            (t_own - t_near) / world->step_mm + phase * stride - phase;
        cross_part(world, cells, ray, t_own, step_mm, p, crossing);
#else
        cross_part(world, cells, ray, t_near, world->step_mm, p, crossing);
#endif
    }
}
#endif

// Finds the parts that the packet crosses and where each ray's samples begin.
INLINE void find_crossing(__constant struct world *world, __global const uchar *cells,
                          const struct ray *ray, struct crossing *crossing) {
    const struct span bounds = box_span(ray, world->bounds_low, world->bounds_high);
    crossing->count = 0;
    crossing->possible = crossing->behind = (integer)(0);
#if JOINS
    crossing->ahead.count = 0;
#endif
#if LATE_PARTS
    crossing->approach = approach_boxes(ray);
    real t_near = find_first_entry(world, ray, &crossing->approach);
    const mask crosses = RAY_RUNS(ray) & MASK(t_near < FLT_MAX);
#elif CAPACITY > 1
    real t_near;
    const ulong parts = find_parts(world, ray, &t_near);
#else
    real t_near = find_first_entry(world, ray);
    const bool crosses = any_lane(MASK(t_near < FLT_MAX));
#endif
    if (world->origin_bounds)
        t_near = bounds.near;
#if SHADING || CLIP || LATE_PARTS
    crossing->ray = *ray;
#endif
#if SHADING || PROBE || CLIP || EYES == EYES_DEPTH
    crossing->t_first = fmin(t_near, 1e9f) + RAY_PHASE(world, ray) * world->step_mm;
#endif
#if MODELS & MODELS_BACKWARD
    const float samples_per_mm = 1.0f / world->step_mm;
    crossing->mirror = sample_at(bounds.far, t_near, RAY_PHASE(world, ray), samples_per_mm) + 1;
#endif
#if EYES == EYES_DEPTH
    crossing->depth = crossing->depth_weight = (real)(0.0f);
#endif
#if LATE_PARTS
    crossing->runs = crosses;
    crossing->t_near = t_near;
    crossing->end = (integer)(0);
    if (any_lane(crosses))
        approach_children(world, crossing, 0, world->nodes[0].link, crosses);
#elif CAPACITY > 1
    cross_parts(world, cells, ray, t_near, parts, crossing);
#else
    if (crosses)
        cross_part(world, cells, ray, t_near, world->step_mm, 0, crossing);
#endif
}

#endif
