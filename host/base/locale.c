// locale.c - numbers in files have decimal points, whatever the user's language puts there.
#include "base/locale.h"

void pel_locale_begin(struct pel_locale *locale) {
    locale_t copy = duplocale(uselocale((locale_t)0));
    locale->plain = newlocale(LC_NUMERIC_MASK, "C", copy);
    if (!locale->plain && copy)
        freelocale(copy);
    locale->before = locale->plain ? uselocale(locale->plain) : (locale_t)0;
}

void pel_locale_finish(struct pel_locale *locale) {
    if (!locale->plain)
        return;
    uselocale(locale->before);
    freelocale(locale->plain);
}
