// scene_read_wall.c - the `wall` of a scene file, read and written: one picture over several
// windows or monitors. A grid becomes its regions, bezels between them, when it is read.
#include "world/scene_plan.h"

#include <string.h>

#include "world/scene_write.h"

static const char *const wall_keys[] = {"comment", "columns", "rows", "bezel", "regions", NULL};
static const char *const region_keys[] = {"comment", "place", "monitor", "device", NULL};

// Rows and columns of equal pictures; a bezel is what is missing between two of them, in shares of
// a picture's width and height.
static bool read_grid(struct pel_wall *wall, const struct pel_scene_node *node) {
    const struct pel_range bezel_range = {.high = 10};
    int columns = 1, rows = 1;
    double bezel[2] = {0};
    if (!pel_node_get_integer(node, "columns", 1, PEL_WALL_MAX, &columns) ||
        !pel_node_get_integer(node, "rows", 1, PEL_WALL_MAX, &rows) ||
        !pel_node_get_numbers(node, "bezel", 2, &bezel_range, bezel))
        return false;
    if (columns * rows > PEL_WALL_MAX)
        return pel_node_fail(node, "has %d x %d regions, more than %d", columns, rows,
                             PEL_WALL_MAX);
    double width = 1 / (columns + (columns - 1) * bezel[0]);
    double height = 1 / (rows + (rows - 1) * bezel[1]);
    wall->region_count = columns * rows;
    for (int i = 0; i < wall->region_count; i++)
        wall->regions[i] = (struct pel_wall_region){.place = {i % columns * width * (1 + bezel[0]),
                                                              i / columns * height * (1 + bezel[1]),
                                                              width, height},
                                                    .monitor = -1};
    return true;
}

static bool read_region(struct pel_wall_region *region, const struct pel_scene_node *node) {
    struct pel_scene_node place, device;
    const char *text = "";
    *region = (struct pel_wall_region){.monitor = -1};
    if (!pel_node_check_object(node, region_keys))
        return false;
    if (!pel_node_member(&place, node, "place"))
        return pel_node_fail(node, "needs 'place'");
    if (!pel_node_check_numbers(&place, 4, &pel_unit_number, region->place) ||
        !pel_node_get_integer(node, "monitor", 0, PEL_WALL_MAX - 1, &region->monitor) ||
        !pel_node_get_text(node, "device", &text))
        return false;
    if (!(region->place[2] > 0 && region->place[3] > 0))
        return pel_node_fail(&place, "has no size");
    pel_node_member(&device, node, "device");
    if (strlen(text) >= sizeof region->device)
        return pel_node_fail(&device, "is longer than %zu bytes", sizeof region->device - 1);
    strcpy(region->device, text);
    return true;
}

bool pel_scene_read_wall(struct pel_scene *scene, const struct pel_scene_node *root) {
    static const char *const of_grids[] = {"columns", "rows", "bezel", NULL};
    struct pel_scene_node node, regions, member;
    struct pel_wall *wall = &scene->wall;
    if (!pel_node_member(&node, root, "wall"))
        return true;
    if (!pel_node_check_object(&node, wall_keys))
        return false;
    if (!pel_node_member(&regions, &node, "regions"))
        return read_grid(wall, &node);
    for (int i = 0; of_grids[i]; i++)
        if (pel_node_member(&member, &node, of_grids[i]))
            return pel_node_fail(&member, "there are 'regions' already");
    if (!pel_node_check_list(&regions, 1, PEL_WALL_MAX))
        return false;
    wall->region_count = (int)json_array_size(regions.value);
    for (int i = 0; i < wall->region_count; i++) {
        struct pel_scene_node region = pel_node_element(&regions, (size_t)i);
        if (!read_region(&wall->regions[i], &region))
            return false;
    }
    return true;
}

void pel_scene_write_wall(struct pel_scene_writer *writer, json_t *root) {
    const struct pel_wall *wall = &writer->scene->wall;
    if (wall->region_count == 0)
        return;
    json_t *regions = json_array();
    pel_write_value(writer, pel_write_object(writer, root, "wall"), "regions", regions);
    for (int i = 0; i < wall->region_count && !writer->failed; i++) {
        const struct pel_wall_region *region = &wall->regions[i];
        json_t *object = json_object();
        json_array_append_new(regions, object);
        pel_write_numbers(writer, object, "place", 4, region->place);
        pel_write_number(writer, object, "monitor", region->monitor, -1);
        if (*region->device)
            pel_write_text(writer, object, "device", region->device);
    }
}
