// box.h - boxes along the axes, and how hierarchies over them are judged.
#ifndef PEL_ACCEL_BOX_H
#define PEL_ACCEL_BOX_H

struct pel_box {
    float low[3], high[3];
};

// Lets a box hold another one, too. By comparisons, because fminf and fmaxf have to care for NaN
// and are calls of libm, which were half of the time that a hierarchy took.
static inline void pel_box_widen(struct pel_box *box, const struct pel_box *by) {
    for (int c = 0; c < 3; c++) {
        box->low[c] = by->low[c] < box->low[c] ? by->low[c] : box->low[c];
        box->high[c] = by->high[c] > box->high[c] ? by->high[c] : box->high[c];
    }
}

// Half of a box's surface, to which the number of rays that meet it is proportional.
static inline double pel_box_area(const struct pel_box *box) {
    double x = (double)box->high[0] - (double)box->low[0],
           y = (double)box->high[1] - (double)box->low[1],
           z = (double)box->high[2] - (double)box->low[2];
    return x * y + y * z + z * x;
}

#endif
