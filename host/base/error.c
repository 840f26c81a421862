// error.c - one error slot per thread and one warning callback per process. These two are the
// library's only mutable globals.
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MESSAGE_BYTES = 4096 };

static _Thread_local enum pel_error last_code;
static _Thread_local char last_message[MESSAGE_BYTES];

static pel_warning_callback warning_callback;
static void *warning_user;

// Sentences quote what stands in files; a line break or an escape sequence in there must not reach
// a terminal. UTF-8 passes.
static void make_printable(char *message) {
    for (; *message; message++)
        if ((unsigned char)*message < ' ' || *message == 0x7f)
            *message = strchr("\t\n\r", *message) ? ' ' : '?';
}

bool pel_fail(enum pel_error code, const char *format, ...) {
    // The sentence is made aside, because an argument may be the old message itself.
    char message[MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    make_printable(message);
    last_code = code;
    memcpy(last_message, message, sizeof message);
    return false;
}

bool pel_fail_in(const char *format, ...) {
    char context[MESSAGE_BYTES / 2];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context, sizeof context, format, arguments);
    va_end(arguments);
    make_printable(context);
    char message[MESSAGE_BYTES];
    snprintf(message, sizeof message, "%s: %.*s", context, MESSAGE_BYTES / 2 - 4, last_message);
    memcpy(last_message, message, sizeof message);
    return false;
}

void pel_warn(const char *format, ...) {
    if (!warning_callback)
        return;
    char message[MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    make_printable(message);
    warning_callback(message, warning_user);
}

void pel_error_clear(void) {
    last_code = PEL_OK;
    last_message[0] = '\0';
}

enum pel_error pel_error_code(void) {
    return last_code;
}

const char *pel_error_message(void) {
    return last_message;
}

void pel_on_warning(pel_warning_callback callback, void *user) {
    warning_callback = callback;
    warning_user = user;
}

const char *pel_version(void) {
    return PEL_VERSION;
}
