// scene_read_clip.c - the `clip` of a scene file and of its volumes, read and written.
#include "world/scene_plan.h"
#include "world/scene_write.h"

#include <string.h>

static const char *const clip_keys[] = {"comment", "plane", "box", "keep", "frame", NULL};
static const char *const plane_keys[] = {"comment", "point", "normal", NULL};
static const char *const box_keys[] = {"comment", "centre", "size", "quaternion", NULL};

static const char *const keep_names[] = {"inside", "outside", NULL};
static const char *const frame_names[] = {"volume", "world", NULL};

static bool is_zero(const double v[3]) {
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static bool read_plane(struct pel_clip *clip, const struct pel_scene_node *node) {
    clip->kind = PEL_CLIP_PLANE;
    if (!pel_node_check_object(node, plane_keys) ||
        !pel_node_get_numbers(node, "point", 3, &pel_any_number, clip->point) ||
        !pel_node_get_numbers(node, "normal", 3, &pel_any_number, clip->normal))
        return false;
    struct pel_scene_node normal;
    if (!pel_node_member(&normal, node, "normal"))
        return pel_node_fail(node, "needs 'normal'");
    return !is_zero(clip->normal) || pel_node_fail(&normal, "has no direction");
}

static bool read_box(struct pel_clip *clip, const struct pel_scene_node *node) {
    clip->kind = PEL_CLIP_BOX;
    struct pel_scene_node member;
    if (!pel_node_check_object(node, box_keys) ||
        !pel_node_get_numbers(node, "centre", 3, &pel_any_number, clip->point) ||
        !pel_node_get_numbers(node, "size", 3, &pel_positive_number, clip->size) ||
        !pel_node_get_numbers(node, "quaternion", 4, &pel_any_number, clip->xyzw))
        return false;
    if (pel_node_member(&member, node, "quaternion") && is_zero(clip->xyzw) && clip->xyzw[3] == 0)
        return pel_node_fail(&member, "has no length");
    return pel_node_member(&member, node, "size") || pel_node_fail(node, "needs 'size'");
}

static bool read_clip(struct pel_clip *clip, const struct pel_scene_node *node, bool of_scene) {
    struct pel_scene_node plane, box, frame;
    int keep = 0, which = of_scene;
    *clip = (struct pel_clip){0};
    if (!pel_node_check_object(node, clip_keys) ||
        !pel_node_get_name(node, "keep", keep_names, &keep) ||
        !pel_node_get_name(node, "frame", frame_names, &which))
        return false;
    clip->outside = keep == 1;
    clip->in_world = which == 1;
    if (of_scene && !clip->in_world && pel_node_member(&frame, node, "frame"))
        return pel_node_fail(&frame, "of the scene must be world");
    bool has_plane = pel_node_member(&plane, node, "plane");
    bool has_box = pel_node_member(&box, node, "box");
    if (has_plane == has_box)
        return pel_node_fail(node, "needs 'plane' or 'box', and not both");
    return has_plane ? read_plane(clip, &plane) : read_box(clip, &box);
}

bool pel_scene_read_clips(const struct pel_scene_node *object, bool of_scene, int *count,
                          struct pel_clip clips[PEL_CLIP_MAX]) {
    struct pel_scene_node list;
    if (!pel_node_member(&list, object, "clip"))
        return true;
    if (!pel_node_check_list(&list, 1, PEL_CLIP_MAX))
        return false;
    *count = (int)json_array_size(list.value);
    for (int n = 0; n < *count; n++) {
        struct pel_scene_node clip = pel_node_element(&list, (size_t)n);
        if (!read_clip(&clips[n], &clip, of_scene))
            return false;
    }
    return true;
}

void pel_scene_write_clips(struct pel_scene_writer *writer, json_t *object, bool of_scene,
                           int count, const struct pel_clip *clips) {
    if (count == 0)
        return;
    json_t *list = json_array();
    pel_write_value(writer, object, "clip", list);
    for (int n = 0; n < count && !writer->failed; n++) {
        const struct pel_clip *clip = &clips[n];
        json_t *written = json_object();
        json_array_append_new(list, written);
        bool plane = clip->kind == PEL_CLIP_PLANE;
        json_t *shape = pel_write_object(writer, written, plane ? "plane" : "box");
        pel_write_numbers(writer, shape, plane ? "point" : "centre", 3, clip->point);
        pel_write_numbers(writer, shape, plane ? "normal" : "size", 3,
                          plane ? clip->normal : clip->size);
        if (!plane && !(is_zero(clip->xyzw) && clip->xyzw[3] == 0))
            pel_write_numbers(writer, shape, "quaternion", 4, clip->xyzw);
        pel_write_name(writer, written, "keep", keep_names, clip->outside, 0);
        if (!of_scene)
            pel_write_name(writer, written, "frame", frame_names, clip->in_world, 0);
    }
}
