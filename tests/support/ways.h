// ways.h - the ways to skip empty space, for tests that take each of them or one of them.
#ifndef PEL_TEST_WAYS_H
#define PEL_TEST_WAYS_H

#include "pellucid.h"

// All ways, `none` first. The list ends with a NULL name.
struct way {
    const char *name;
    enum pel_skip skip;
};

extern const struct way ways[];

enum { WAYS = 6 };

// The way that falls to test number n: they take turns.
enum pel_skip way_of(uint64_t n);

#endif
