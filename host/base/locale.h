// locale.h - numbers in files have decimal points, whatever the user's language puts there.
#ifndef PEL_BASE_LOCALE_H
#define PEL_BASE_LOCALE_H

#include <locale.h>

// This thread's locale while a file is read or written.
struct pel_locale {
    locale_t before, plain;
};

// Lets strtod, printf and the libraries that call them read and write numbers as C does, for this
// thread alone, until pel_locale_finish brings back what was before. Pairs may nest.
void pel_locale_begin(struct pel_locale *locale);
void pel_locale_finish(struct pel_locale *locale);

#endif
