// power.cl - powers and reciprocal roots, for packets.
//
// The built-in functions are right to the last bit or two and for every number, which costs a fifth
// of a shaded frame through PoCL. What shading asks for needs to be right to a few millionths, for
// numbers that are neither zero nor absent. Powers by polynomials through the Chebyshev nodes:
// log2(1 + f) on [sqrt(1/2) - 1, sqrt(2) - 1] to 1e-7, 2^f on [-1, 0] to 1e-7 of its value. Roots
// by a first guess from the exponent and Newton's steps, to 5e-6 of their value (Lomont 2003).
#ifndef POWER_CL
#define POWER_CL

#include "lanes.h"

#if LANES > 1
INLINE real fast_log2(real x) {
    const integer bits = AS_INTEGER(x);
    // The exponent of the power of two nearest in ratio, so that what is left is around 1.
    const integer exponent = (bits - 0x3f3504f3) >> 23;
    const real f = AS_REAL(bits - (exponent << 23)) - 1.0f;
    real sum = f * -0.14275973f + 0.23265258f;
    sum = sum * f - 0.24927182f;
    sum = sum * f + 0.28728888f;
    sum = sum * f - 0.36022518f;
    sum = sum * f + 0.48091671f;
    sum = sum * f - 0.72135293f;
    sum = sum * f + 1.44269499f;
    return TO_REAL(exponent) + f * sum;
}

// Of numbers up to 126; less than -126 is as good as nothing.
INLINE real fast_exp2(real x) {
    x = AT_LEAST(x, (real)(-126.0f));
    // Conversions cut towards 0, which is upwards here, so that the rest lies in (-1, 0].
    const integer whole = TO_INTEGER(x + 127.0f) - 126;
    const real f = x - TO_REAL(whole);
    real sum = f * 9.4687703e-4f + 9.20918036e-3f;
    sum = sum * f + 5.52981197e-2f;
    sum = sum * f + 0.240178956f;
    sum = sum * f + 0.693143135f;
    sum = sum * f + 0.999999944f;
    return sum * AS_REAL((whole + 127) << 23);
}

INLINE real fast_rsqrt(real x) {
    const real half_x = 0.5f * x;
    real root = AS_REAL(0x5f375a86 - (AS_INTEGER(x) >> 1));
    root = root * (1.5f - half_x * root * root);
    return root * (1.5f - half_x * root * root);
}
#else
#define fast_rsqrt rsqrt
#define fast_log2 log2
#define fast_exp2 exp2
#endif

// base^exponent, for bases from 1e-37 to 2 and exponents that keep the power below 2^126.
INLINE real power(real base, real exponent) {
    return fast_exp2(exponent * fast_log2(base));
}

#define WHOLE_POWER_MAX 120

// The same for an exponent of all lanes, and bases down to nothing. Whole numbers take a few
// products, of which none comes near the least of floats, where processors are slow: a base is at
// least what makes 2^-120 of the power.
INLINE real power_of_all(real base, float exponent) {
#if LANES > 1
    int left = (int)exponent;
    if ((float)left == exponent && left >= 1 && left <= WHOLE_POWER_MAX) {
        base = AT_LEAST(base, (real)(as_float((127 - WHOLE_POWER_MAX / left) << 23)));
        real product = left & 1 ? base : (real)(1.0f);
        for (left >>= 1; left > 0; left >>= 1) {
            base *= base;
            if (left & 1)
                product *= base;
        }
        return product;
    }
#endif
    return power(AT_LEAST(base, (real)(1e-30f)), (real)(exponent));
}

#endif
