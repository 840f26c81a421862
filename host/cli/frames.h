// frames.h - which frames of an animation are wanted, and what their files are called.
#ifndef PEL_CLI_FRAMES_H
#define PEL_CLI_FRAMES_H

#include <stdbool.h>
#include <stddef.h>

// first, first + stride, ... below end.
struct frames {
    int first, end, stride;
};

// Reads the value of --frames: "0:120" (the last one not included), "0:120:2", "10" (the first ten)
// or "all", of an animation with `frame_count` frames. False, after a message, when it is none of
// these or asks for frames that are not there.
bool frames_parse(struct frames *frames, const char *text, int frame_count);
int frames_count(const struct frames *frames);

// True when a file name has exactly one %d, which may have a width of up to two digits with zeros
// before it ("%04d"), and each other % is doubled.
bool frames_is_pattern(const char *pattern);

// Writes the name of one frame. What does not fit is cut off.
void frames_name(char *name, size_t bytes, const char *pattern, int frame);

#endif
