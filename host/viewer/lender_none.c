// lender_none.c - in place of lender.c in a build without OpenGL: nothing is lent.
#include "viewer/lender.h"

void pel_lender_enter(struct pel_lender *lender, struct pel_gl *gl) {
    (void)lender, (void)gl;
}

void pel_lender_leave(struct pel_lender *lender) {
    (void)lender;
}

struct pel_loan *pel_lender_lend(struct pel_lender *lender, struct pel_renderer *renderer,
                                 size_t bytes) {
    (void)lender, (void)renderer, (void)bytes;
    return NULL;
}

uint32_t pel_loan_name(const struct pel_loan *loan) {
    (void)loan;
    return 0;
}

void pel_loan_return(struct pel_loan *loan) {
    (void)loan;
}
