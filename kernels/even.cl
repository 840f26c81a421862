// even.cl - what the ray loop makes of stride.cl where samples are evenly spaced: every run is one
// sample.
// Included by march.cl.
#ifndef EVEN_CL
#define EVEN_CL

#define STRIDE_PARAMETER
#define STRIDE_ARGUMENT
#define BEGIN_STRIDES(crossing)
#define COUNT_SPARED(crossing, length, present) (void)(length)
#define SPARED(crossing) 0u
#define RUN_LAST(i, length) (i)
#define RUN_NEXT(i, length, alive) ((i) - (alive))
#define RUN_MIDDLE(i, length) TO_REAL((i) - 1)
#define RUN_PLACE(t, length, present) (t)
#define RUN_STRENGTH(strength, length) (strength)

struct runs {
    char none;
};

INLINE struct runs runs_begin(void) {
    const struct runs runs = {0};
    return runs;
}

INLINE integer find_run(__constant struct world *world, const struct crossing *crossing,
                        struct runs *runs, integer *i, mask asks) {
    return (integer)(1);
}

#endif
