// window.c - windows on a screen, through GLFW.
#include "viewer/window.h"

// OpenGL's own header is epoxy's, in present.c.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct pel_window {
    GLFWwindow *handle;
    struct pel_event_queue *queue;
    int number;
    int place[4];      // before it went to full screen
    double pointer[2]; // where it was last seen, in screen coordinates
    bool pointed;      // it was seen
};

// ---- Events ------------------------------------------------------------------------------------

static const struct {
    int theirs, ours;
} keys[] = {
    {GLFW_KEY_ESCAPE, PEL_KEY_ESCAPE},
    {GLFW_KEY_ENTER, PEL_KEY_ENTER},
    {GLFW_KEY_KP_ENTER, PEL_KEY_ENTER},
    {GLFW_KEY_TAB, PEL_KEY_TAB},
    {GLFW_KEY_BACKSPACE, PEL_KEY_BACKSPACE},
    {GLFW_KEY_INSERT, PEL_KEY_INSERT},
    {GLFW_KEY_DELETE, PEL_KEY_DELETE},
    {GLFW_KEY_LEFT, PEL_KEY_LEFT},
    {GLFW_KEY_RIGHT, PEL_KEY_RIGHT},
    {GLFW_KEY_UP, PEL_KEY_UP},
    {GLFW_KEY_DOWN, PEL_KEY_DOWN},
    {GLFW_KEY_PAGE_UP, PEL_KEY_PAGE_UP},
    {GLFW_KEY_PAGE_DOWN, PEL_KEY_PAGE_DOWN},
    {GLFW_KEY_HOME, PEL_KEY_HOME},
    {GLFW_KEY_END, PEL_KEY_END},
    {GLFW_KEY_KP_ADD, '+'},
    {GLFW_KEY_KP_SUBTRACT, '-'},
};

// What the key prints on this keyboard, so that 'w' is the key that says so.
static int translate_key(int key, int scancode) {
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
        return PEL_KEY_F1 + key - GLFW_KEY_F1;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i].theirs == key)
            return keys[i].ours;
    if (key == GLFW_KEY_SPACE)
        return ' ';
    const char *name = glfwGetKeyName(key, scancode);
    if (name && name[0] > ' ' && name[0] < 127 && !name[1])
        return name[0];
    return 0;
}

static int translate_modifiers(int modifiers) {
    return (modifiers & GLFW_MOD_SHIFT ? PEL_SHIFT : 0) |
           (modifiers & GLFW_MOD_CONTROL ? PEL_CONTROL : 0) |
           (modifiers & GLFW_MOD_ALT ? PEL_ALT : 0);
}

static void push(GLFWwindow *handle, struct pel_event event) {
    struct pel_window *window = glfwGetWindowUserPointer(handle);
    event.window = window->number;
    if (!pel_event_push(window->queue, &event))
        free(event.path);
}

// Screen coordinates to pixels.
static void place_pointer(GLFWwindow *handle, struct pel_event *event, double x, double y) {
    int width, height, width_px, height_px;
    glfwGetWindowSize(handle, &width, &height);
    glfwGetFramebufferSize(handle, &width_px, &height_px);
    event->x = width > 0 ? x * width_px / width : x;
    event->y = height > 0 ? y * height_px / height : y;
}

// A button went down where the pointer was then; asking would say where it is now, which, after a
// long turn of the event loop, may be far away.
static void place_button(GLFWwindow *handle, struct pel_event *event) {
    struct pel_window *window = glfwGetWindowUserPointer(handle);
    if (!window->pointed)
        glfwGetCursorPos(handle, &window->pointer[0], &window->pointer[1]);
    place_pointer(handle, event, window->pointer[0], window->pointer[1]);
}

static void on_pointer(GLFWwindow *handle, double x, double y) {
    struct pel_window *window = glfwGetWindowUserPointer(handle);
    window->pointer[0] = x;
    window->pointer[1] = y;
    window->pointed = true;
    struct pel_event event = {.kind = PEL_EVENT_POINTER};
    place_pointer(handle, &event, x, y);
    push(handle, event);
}

static void on_button(GLFWwindow *handle, int button, int action, int modifiers) {
    struct pel_event event = {.kind = PEL_EVENT_BUTTON, .down = action == GLFW_PRESS};
    if (button == GLFW_MOUSE_BUTTON_LEFT)
        event.button = PEL_BUTTON_LEFT;
    else if (button == GLFW_MOUSE_BUTTON_RIGHT)
        event.button = PEL_BUTTON_RIGHT;
    else if (button == GLFW_MOUSE_BUTTON_MIDDLE)
        event.button = PEL_BUTTON_MIDDLE;
    else
        return;
    event.modifiers = translate_modifiers(modifiers);
    place_button(handle, &event);
    push(handle, event);
}

static void on_wheel(GLFWwindow *handle, double right, double up) {
    (void)right;
    struct pel_event event = {.kind = PEL_EVENT_WHEEL, .wheel = up};
    place_button(handle, &event);
    push(handle, event);
}

static void on_key(GLFWwindow *handle, int key, int scancode, int action, int modifiers) {
    struct pel_event event = {.kind = PEL_EVENT_KEY,
                              .key = translate_key(key, scancode),
                              .modifiers = translate_modifiers(modifiers),
                              .down = action != GLFW_RELEASE,
                              .repeat = action == GLFW_REPEAT};
    if (event.key)
        push(handle, event);
}

static void on_text(GLFWwindow *handle, unsigned text) {
    push(handle, (struct pel_event){.kind = PEL_EVENT_TEXT, .text = text});
}

static void on_drop(GLFWwindow *handle, int count, const char **paths) {
    for (int i = 0; i < count; i++)
        push(handle, (struct pel_event){.kind = PEL_EVENT_DROP, .path = strdup(paths[i])});
}

static void on_size(GLFWwindow *handle, int width, int height) {
    (void)width, (void)height;
    push(handle, (struct pel_event){.kind = PEL_EVENT_SIZE});
}

static void on_refresh(GLFWwindow *handle) {
    push(handle, (struct pel_event){.kind = PEL_EVENT_SIZE});
}

static void on_close(GLFWwindow *handle) {
    push(handle, (struct pel_event){.kind = PEL_EVENT_CLOSE});
}

// ---- Windows -----------------------------------------------------------------------------------

static bool fail(char *sentence, size_t bytes, const char *what) {
    const char *reason = NULL;
    glfwGetError(&reason);
    snprintf(sentence, bytes, "%s: %s", what, reason ? reason : "no reason was given");
    return false;
}

bool pel_window_start(char *sentence, size_t bytes) {
    // A joystick is none of our business.
    glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
#ifdef GLFW_PLATFORM
    // GLFW 3.4 looks for Wayland first, and where a session has no place for its socket Wayland's
    // library complains on standard error.
    if (getenv("DISPLAY") && !getenv("WAYLAND_DISPLAY") && !getenv("XDG_RUNTIME_DIR"))
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    return glfwInit() || fail(sentence, bytes, "no window can be opened");
}

void pel_window_stop(void) {
    glfwTerminate();
}

static GLFWmonitor *find_monitor(int number) {
    int count;
    GLFWmonitor **monitors = glfwGetMonitors(&count);
    return number >= 1 && number <= count ? monitors[number - 1] : NULL;
}

// Where a window of this size goes on a monitor: into its middle, and not beyond its edges.
static void place_on(GLFWmonitor *monitor, int place[4]) {
    int area[4];
    glfwGetMonitorWorkarea(monitor, &area[0], &area[1], &area[2], &area[3]);
    for (int axis = 0; axis < 2; axis++) {
        if (place[2 + axis] > area[2 + axis])
            place[2 + axis] = area[2 + axis];
        place[axis] = area[axis] + (area[2 + axis] - place[2 + axis]) / 2;
    }
}

// The monitor keeps its mode. Window managers take the monitor that a window is on, so it has to be
// there already.
static void fill_monitor(GLFWwindow *handle, GLFWmonitor *monitor) {
    const GLFWvidmode *mode = glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

// Lets the desktop do it, which answers when it likes, so that the first picture has the right
// size.
static void wait_for_size(GLFWwindow *handle, GLFWmonitor *monitor) {
    const GLFWvidmode *mode = glfwGetVideoMode(monitor);
    int width = 0, height = 0;
    for (int i = 0; i < 50; i++) {
        glfwGetWindowSize(handle, &width, &height);
        if (width == mode->width && height == mode->height)
            return;
        glfwWaitEventsTimeout(0.01);
    }
}

static void listen(GLFWwindow *handle) {
    glfwSetCursorPosCallback(handle, on_pointer);
    glfwSetMouseButtonCallback(handle, on_button);
    glfwSetScrollCallback(handle, on_wheel);
    glfwSetKeyCallback(handle, on_key);
    glfwSetCharCallback(handle, on_text);
    glfwSetDropCallback(handle, on_drop);
    glfwSetFramebufferSizeCallback(handle, on_size);
    glfwSetWindowRefreshCallback(handle, on_refresh);
    glfwSetWindowCloseCallback(handle, on_close);
}

// What is asked of every context.
static void hint(void) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
}

struct pel_window *pel_window_create(const struct pel_window_options *options,
                                     struct pel_event_queue *queue, char *sentence, size_t bytes) {
    struct pel_window *window = calloc(1, sizeof *window);
    if (!window) {
        snprintf(sentence, bytes, "cannot allocate a window");
        return NULL;
    }
    window->queue = queue;
    window->number = options->number;
    memcpy(window->place, options->place, sizeof window->place);
    GLFWmonitor *monitor = find_monitor(options->monitor);
    bool placed = options->placed || monitor;
    if (monitor)
        place_on(monitor, window->place);
    hint();
    // The picture stays where it is while the hand is on another monitor, or in another window of a
    // wall.
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHint(GLFW_DECORATED, !options->unadorned);
    glfwWindowHint(GLFW_VISIBLE, !placed);
    window->handle = glfwCreateWindow(window->place[2], window->place[3], options->title, NULL,
                                      options->shares ? options->shares->handle : NULL);
    if (!window->handle) {
        fail(sentence, bytes, "no window with OpenGL 3.3 can be opened");
        free(window);
        return NULL;
    }
    if (placed) {
        glfwSetWindowPos(window->handle, window->place[0], window->place[1]);
        glfwShowWindow(window->handle);
    }
    glfwSetWindowUserPointer(window->handle, window);
    listen(window->handle);
    if (monitor) {
        fill_monitor(window->handle, monitor);
        wait_for_size(window->handle, monitor);
    }
    glfwMakeContextCurrent(window->handle);
    glfwSwapInterval(options->follows ? 0 : 1);
    return window;
}

struct pel_window *pel_window_create_unseen(struct pel_window *other, char *sentence,
                                            size_t bytes) {
    struct pel_window *window = calloc(1, sizeof *window);
    if (!window) {
        snprintf(sentence, bytes, "cannot allocate a window");
        return NULL;
    }
    hint();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    window->handle = glfwCreateWindow(1, 1, "Pellucid", NULL, other->handle);
    if (!window->handle) {
        fail(sentence, bytes, "OpenGL shares no objects");
        free(window);
        return NULL;
    }
    return window;
}

void pel_window_destroy(struct pel_window *window) {
    if (!window)
        return;
    glfwDestroyWindow(window->handle);
    free(window);
}

void pel_window_wait(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void pel_window_wake(void) {
    glfwPostEmptyEvent();
}

void pel_window_pixels(struct pel_window *window, int pixels[2], double *scale) {
    float scale_x, scale_y;
    glfwGetFramebufferSize(window->handle, &pixels[0], &pixels[1]);
    glfwGetWindowContentScale(window->handle, &scale_x, &scale_y);
    *scale = scale_x > 0.5f ? scale_x : 1;
}

void pel_window_draw_on(struct pel_window *window) {
    glfwMakeContextCurrent(window ? window->handle : NULL);
}

// GLFW's own functions for this exist only where it was built for X. So the platform's library is
// asked, if GLFW has loaded it; its own way to find functions makes some up.
void pel_window_tell_context(struct pel_gl *gl) {
    static const struct {
        enum pel_gl_platform platform;
        const char *library, *context, *display;
    } platforms[] = {
        {PEL_GL_GLX, "libGLX.so.0", "glXGetCurrentContext", "glXGetCurrentDisplay"},
        {PEL_GL_GLX, "libGL.so.1", "glXGetCurrentContext", "glXGetCurrentDisplay"},
        {PEL_GL_EGL, "libEGL.so.1", "eglGetCurrentContext", "eglGetCurrentDisplay"},
    };
    *gl = (struct pel_gl){0};
    for (size_t i = 0; i < sizeof platforms / sizeof *platforms && !gl->context; i++) {
        void *library = dlopen(platforms[i].library, RTLD_LAZY | RTLD_NOLOAD);
        if (!library)
            continue;
        void *(*context)(void) = (void *(*)(void))dlsym(library, platforms[i].context);
        void *(*display)(void) = (void *(*)(void))dlsym(library, platforms[i].display);
        if (context && display && context())
            *gl = (struct pel_gl){platforms[i].platform, context(), display()};
        dlclose(library);
    }
}

void pel_window_show(struct pel_window *window) {
    glfwMakeContextCurrent(window->handle);
    glfwSwapBuffers(window->handle);
}

int pel_window_monitor_count(void) {
    int count;
    return glfwGetMonitors(&count) ? count : 0;
}

// The monitor that shares most area with the window.
int pel_window_monitor(struct pel_window *window) {
    int x, y, width, height, count, best = 0;
    glfwGetWindowPos(window->handle, &x, &y);
    glfwGetWindowSize(window->handle, &width, &height);
    GLFWmonitor **monitors = glfwGetMonitors(&count);
    long most = -1;
    for (int i = 0; i < count; i++) {
        int left, top;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode *mode = glfwGetVideoMode(monitors[i]);
        int right = left + mode->width, bottom = top + mode->height;
        int wide = (x + width < right ? x + width : right) - (x > left ? x : left);
        int high = (y + height < bottom ? y + height : bottom) - (y > top ? y : top);
        long area = wide > 0 && high > 0 ? (long)wide * high : 0;
        if (area > most) {
            most = area;
            best = i + 1;
        }
    }
    return best;
}

void pel_window_toggle_full_screen(struct pel_window *window) {
    GLFWwindow *handle = window->handle;
    int *place = window->place;
    if (glfwGetWindowMonitor(handle)) {
        glfwSetWindowMonitor(handle, NULL, place[0], place[1], place[2], place[3], GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor *monitor = find_monitor(pel_window_monitor(window));
    if (!monitor)
        return;
    glfwGetWindowPos(handle, &place[0], &place[1]);
    glfwGetWindowSize(handle, &place[2], &place[3]);
    fill_monitor(handle, monitor);
}

void pel_window_name(struct pel_window *window, const char *title) {
    glfwSetWindowTitle(window->handle, title);
}
