// scene_file.h - scenes written as text, for tests of their reader.
#ifndef PEL_TEST_SCENE_FILE_H
#define PEL_TEST_SCENE_FILE_H

#include "support/test.h"

// Members of a scene: a volume of 2 x 3 x 4 voxels with the values 0..23, and a list of it.
#define TEST_VOLUME "'file': 'a.raw', 'raw': {'dims': [2, 3, 4]}"
#define TEST_VOLUMES "'volumes': [{" TEST_VOLUME "}]"

// Writes a file into the test's folder, with " for every ', and returns its path.
const char *test_write_scene(const char *leaf, const char *quoted);

// Writes a scene like that and loads it; fails the test when it cannot be. `override` may be NULL.
struct pel_scene *test_load_scene(const char *leaf, const char *quoted, const char *override);

// A setup function for cmocka: writes a.raw, and the same as b.raw, beside the scenes.
int test_write_volumes(void **state);

#endif
