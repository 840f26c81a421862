// wall.h - where the windows of a display wall lie, in whole pixels of one picture. Pure functions.
#ifndef PEL_VIEWER_WALL_H
#define PEL_VIEWER_WALL_H

#include "pellucid.h"

// What a window shows: `region`, its left and top edge, width and height, of a picture of
// `whole[0]` x `whole[1]` pixels.
struct pel_wall_part {
    int whole[2], region[4];
};

// A region of a wall of so many pixels. Regions that touch in the layout touch in pixels, so that
// nothing is missing between them and nothing is there twice.
struct pel_wall_part pel_wall_place(const struct pel_wall *wall, int number, const int wall_px[2]);

// What a window of `pixels` shows, which need not be those of pel_wall_place: a monitor has as many
// as it has. The picture is then that of a wall that is made of such windows.
struct pel_wall_part pel_wall_fit(const struct pel_wall *wall, int number, const int wall_px[2],
                                  const int pixels[2]);

#endif
