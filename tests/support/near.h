// near.h - comparing doubles, which this cmocka cannot.
#ifndef PEL_TEST_NEAR_H
#define PEL_TEST_NEAR_H

#include <math.h>

// Fails the test, at the place it is used, unless the values are that close.
#define assert_near(actual, expected, tolerance)                                                   \
    do {                                                                                           \
        double actual_ = (actual), expected_ = (expected);                                         \
        if (!(fabs(actual_ - expected_) <= (tolerance)))                                           \
            fail_msg("%s is %.17g, not %.17g", #actual, actual_, expected_);                       \
    } while (0)

#endif
