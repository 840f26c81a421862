// scene_write.h - a scene as JSON again. What reads a key and what writes it stand side by side in
// scene_read_*.c and scene_camera.c; these are the pieces they write with.
//
// What has its usual value is left out, so that a saved scene reads like one somebody wrote. A
// failure is noted in the writer, with its sentence, and makes everything after it futile.
#ifndef PEL_WORLD_SCENE_WRITE_H
#define PEL_WORLD_SCENE_WRITE_H

#include <jansson.h>

#include "pellucid.h"

struct pel_scene_writer {
    const struct pel_scene *scene;
    const struct pel_scene *usual; // with every default
    const char *folder;            // what paths are relative to; NULL leaves them absolute
    bool failed;
};

// Members of an object. `value` is taken; NULL is a failure.
void pel_write_value(struct pel_scene_writer *writer, json_t *object, const char *key,
                     json_t *value);
json_t *pel_write_object(struct pel_scene_writer *writer, json_t *object, const char *key);
void pel_write_number(struct pel_scene_writer *writer, json_t *object, const char *key,
                      double value, double usual);
void pel_write_numbers(struct pel_scene_writer *writer, json_t *object, const char *key, int count,
                       const double values[]);
void pel_write_bool(struct pel_scene_writer *writer, json_t *object, const char *key, bool value,
                    bool usual);
void pel_write_name(struct pel_scene_writer *writer, json_t *object, const char *key,
                    const char *const *names, int which, int usual);
void pel_write_text(struct pel_scene_writer *writer, json_t *object, const char *key,
                    const char *text);
void pel_write_path(struct pel_scene_writer *writer, json_t *object, const char *key,
                    const char *path);

// A whole number where it is one: people do not write 320.0. And a list of them.
json_t *pel_write_make_number(double value);
json_t *pel_write_make_numbers(int count, const double values[]);

// #rrggbb where that says it exactly, otherwise 3 or (`with_alpha`) 4 numbers.
void pel_write_colour(struct pel_scene_writer *writer, json_t *object, const char *key,
                      const double rgba[4], bool with_alpha);

// The parts of a scene, each beside what reads it.
void pel_scene_write_settings(struct pel_scene_writer *writer, json_t *root);
void pel_scene_write_camera(struct pel_scene_writer *writer, json_t *root);
void pel_scene_write_viewpoint(struct pel_scene_writer *writer, json_t *object,
                               const struct pel_camera *camera); // with nothing left out
void pel_scene_write_secondary(struct pel_scene_writer *writer, json_t *render);
void pel_scene_write_lights(struct pel_scene_writer *writer, json_t *root);
void pel_scene_write_wall(struct pel_scene_writer *writer, json_t *root);
void pel_scene_write_stereo(struct pel_scene_writer *writer, json_t *root);
void pel_scene_write_volumes(struct pel_scene_writer *writer, json_t *root);
void pel_scene_write_animation(struct pel_scene_writer *writer, json_t *root); // after all others
void pel_scene_write_source(struct pel_scene_writer *writer, json_t *volume,
                            const struct pel_volume_source *source);
void pel_scene_write_pose(struct pel_scene_writer *writer, json_t *volume,
                          const struct pel_matrix *transform);
void pel_scene_write_march(struct pel_scene_writer *writer, json_t *render);
void pel_scene_write_model(struct pel_scene_writer *writer, json_t *volume,
                           const struct pel_instance *instance);
void pel_scene_write_style(struct pel_scene_writer *writer, json_t *volume,
                           const struct pel_instance *instance);
void pel_scene_write_clips(struct pel_scene_writer *writer, json_t *object, bool of_scene,
                           int count, const struct pel_clip *clips);
void pel_scene_write_mask(struct pel_scene_writer *writer, json_t *volume,
                          const struct pel_mask *mask);
void pel_scene_write_material(struct pel_scene_writer *writer, json_t *volume,
                              const struct pel_material *material);

#endif
