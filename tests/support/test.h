// test.h - what every test file includes: cmocka, the library, and where the optional data lies.
#ifndef PEL_TEST_H
#define PEL_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pellucid.h"

// cmocka 2 has a name for each kind of number, and warns of this one, which is all that cmocka 1
// has.
#ifdef assert_int_in_range
#undef assert_in_range
#define assert_in_range assert_int_in_range
#endif

// The path of a file below $PELLUCID_TEST_DATA (default: ../shared beside the repository). The text
// is overwritten by the eighth call after this one.
const char *test_data_path(const char *relative);

// Ends the whole program with status 77 and the reason when `relative` does not exist there.
void test_need_data(const char *relative);

// A path for a file this test may write, in a folder of this process that is removed at its end.
const char *test_temporary_path(const char *leaf);

// A reproducible random number in [0, 1); the state starts at any value.
double test_random(uint64_t *state);

#endif
