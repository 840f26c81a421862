// judge.h - is a picture that a device made the right one?
//
// Read through buffers it has to agree with the reference within 1/255 everywhere. Read through
// images, the device's texture unit interpolates, and OpenCL does not say how exactly. Hardware
// keeps 8 fractional bits of each weight, so a weight is off by less than 2^-8, and units that
// interpolate 8-bit voxels in 8 bits round once along each axis: three steps of the type at most.
// What that may do to a ray is worked out along the ray (reference_cast_bound): where the transfer
// function is flat nothing, where it is steep much. Devices known to interpolate in floats have no
// such excuse.
//
// Either way, where a sample lies within rounding of the end of a volume's span or of the face
// between two voxels (`nearest`), it may be taken or left.
#ifndef PEL_TEST_JUDGE_H
#define PEL_TEST_JUDGE_H

#include "pellucid.h"

// A scene with its right picture. Borrows the scene, which must not change meanwhile.
struct judge *judge_create(const struct pel_scene *scene);
void judge_destroy(struct judge *judge);

// Fails the test when the picture is missing or not right, and prints its worst pixel.
void judge_check(const struct judge *judge, const struct pel_image *picture,
                 const struct pel_render_statistics *statistics, const char *title);

// The same for a scene used once: renders it, judges, and gives the picture back.
struct pel_image *judge_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                               struct pel_render_statistics *statistics, const char *title);

// A renderer of the device under test; fails the test when there is none.
struct pel_renderer *judge_renderer(enum pel_reader reader, int lanes);

// True when the renderer, made for PEL_READER_IMAGE, finds 3-D images on its device; says so if
// not. Renders the scene for that.
bool judge_has_images(struct pel_renderer *renderer, const struct pel_scene *scene);

// The lanes of a packet that its compiler takes in its stride: 16, or what PELLUCID_TEST_LANES says
// (support/on).
int judge_packet_lanes(void);

// Those lanes, or as many as its compiler takes in its stride.
int judge_lanes(int lanes);

// Fails the test unless a picture of both eyes is the one that pel_stereo_compose has made of them:
// bit for bit, and as an anaglyph, which the device works out, within 1e-5.
void judge_composed(const struct pel_image *picture, const struct pel_image *composed,
                    enum pel_stereo_kind kind, const char *title);

#endif
