// present.c - brings pictures into a window with OpenGL 3.3 core.
#include "viewer/present.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct picture {
    GLuint texture;
    int width, height;
};

struct pel_present {
    GLuint program, nothing; // a vertex array without attributes
    GLint part;              // where the program finds it
    GLuint buffers[2];       // used in turns, so that one can still be read while one is written
    int turn;
    struct picture pictures[PEL_PRESENT_PICTURES];
    int window_px[2];
    GLuint frame, colour; // while catching
};

// One triangle that covers the viewport; row 0 of the texture is the picture's top.
static const char vertex_source[] =
    "#version 330 core\n"
    "out vec2 place;\n"
    "uniform vec4 part;\n"
    "void main() {\n"
    "    vec2 corner = vec2(gl_VertexID == 1 ? 2 : 0, gl_VertexID == 2 ? 2 : 0);\n"
    "    place = part.xy + part.zw * vec2(corner.x, 1 - corner.y);\n"
    "    gl_Position = vec4(2 * corner - 1, 0, 1);\n"
    "}\n";

static const char fragment_source[] =
    "#version 330 core\n"
    "in vec2 place;\n"
    "out vec4 colour;\n"
    "uniform sampler2D picture;\n"
    "void main() { colour = vec4(texture(picture, place).rgb, 1); }\n";

static GLuint compile(GLenum kind, const char *source, char *sentence, size_t bytes) {
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    GLint good;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char log[256] = "";
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        snprintf(sentence, bytes, "OpenGL does not compile the presenting shader: %s", log);
    }
    return shader;
}

static bool link_program(struct pel_present *present, char *sentence, size_t bytes) {
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_source, sentence, bytes);
    GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_source, sentence, bytes);
    present->program = glCreateProgram();
    glAttachShader(present->program, vertex);
    glAttachShader(present->program, fragment);
    glLinkProgram(present->program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    GLint good;
    glGetProgramiv(present->program, GL_LINK_STATUS, &good);
    if (!good && !sentence[0])
        snprintf(sentence, bytes, "OpenGL does not link the presenting shader");
    present->part = glGetUniformLocation(present->program, "part");
    return good;
}

struct pel_present *pel_present_create(char *sentence, size_t bytes) {
    struct pel_present *present = calloc(1, sizeof *present);
    if (!present) {
        snprintf(sentence, bytes, "cannot allocate a presenter");
        return NULL;
    }
    sentence[0] = '\0';
    if (epoxy_gl_version() < 33) {
        snprintf(sentence, bytes, "OpenGL is version %d.%d, and 3.3 is needed",
                 epoxy_gl_version() / 10, epoxy_gl_version() % 10);
        free(present);
        return NULL;
    }
    glGenVertexArrays(1, &present->nothing);
    glGenBuffers(2, present->buffers);
    if (!link_program(present, sentence, bytes)) {
        pel_present_destroy(present);
        return NULL;
    }
    return present;
}

void pel_present_destroy(struct pel_present *present) {
    if (!present)
        return;
    for (int i = 0; i < PEL_PRESENT_PICTURES; i++)
        glDeleteTextures(1, &present->pictures[i].texture);
    glDeleteBuffers(2, present->buffers);
    glDeleteVertexArrays(1, &present->nothing);
    glDeleteProgram(present->program);
    free(present);
}

// A texture of this size in the slot, bound.
static void fit_texture(struct picture *picture, int width, int height) {
    if (!picture->texture)
        glGenTextures(1, &picture->texture);
    glBindTexture(GL_TEXTURE_2D, picture->texture);
    if (picture->width == width && picture->height == height)
        return;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    picture->width = width;
    picture->height = height;
}

void pel_present_upload(struct pel_present *present, int slot, int width, int height,
                        const uint8_t *rgba) {
    GLsizeiptr bytes = (GLsizeiptr)width * height * 4;
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, present->buffers[present->turn]);
    present->turn = !present->turn;
    glBufferData(GL_PIXEL_UNPACK_BUFFER, bytes, NULL, GL_STREAM_DRAW);
    void *memory = glMapBufferRange(GL_PIXEL_UNPACK_BUFFER, 0, bytes,
                                    GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (memory) {
        memcpy(memory, rgba, (size_t)bytes);
        glUnmapBuffer(GL_PIXEL_UNPACK_BUFFER);
    }
    // A driver that maps nothing reads the pixels where they are.
    if (!memory)
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    fit_texture(&present->pictures[slot], width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                    memory ? NULL : rgba);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void pel_present_take(struct pel_present *present, int slot, int width, int height,
                      uint32_t buffer) {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    fit_texture(&present->pictures[slot], width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void pel_present_begin(struct pel_present *present, const int window_px[2]) {
    memcpy(present->window_px, window_px, sizeof present->window_px);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, window_px[0], window_px[1]);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

void pel_present_draw(struct pel_present *present, int slot, const double part[4],
                      const struct pel_rectangle *place) {
    const struct picture *picture = &present->pictures[slot];
    if (!picture->texture)
        return;
    bool exact = picture->width == place->width && picture->height == place->height;
    glUseProgram(present->program);
    glUniform4f(present->part, (float)part[0], (float)part[1], (float)part[2], (float)part[3]);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture->texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, exact ? GL_NEAREST : GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, exact ? GL_NEAREST : GL_LINEAR);
    glBindSampler(0, 0);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glViewport(place->x, present->window_px[1] - place->y - place->height, place->width,
               place->height);
    glBindVertexArray(present->nothing);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glViewport(0, 0, present->window_px[0], present->window_px[1]);
}

static void end_catch(struct pel_present *present) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &present->frame);
    glDeleteRenderbuffers(1, &present->colour);
}

bool pel_present_catch(struct pel_present *present, const int window_px[2]) {
    glGenFramebuffers(1, &present->frame);
    glGenRenderbuffers(1, &present->colour);
    glBindRenderbuffer(GL_RENDERBUFFER, present->colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, window_px[0], window_px[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, present->frame);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              present->colour);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return true;
    end_catch(present);
    return false;
}

uint8_t *pel_present_caught(struct pel_present *present) {
    int width = present->window_px[0], height = present->window_px[1];
    size_t row = (size_t)width * 3;
    uint8_t *rgb = malloc(row * (size_t)height), *line = malloc(row);
    if (rgb && line) {
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
        // OpenGL's rows go up.
        for (int y = 0; y < height / 2; y++) {
            uint8_t *upper = rgb + (size_t)y * row, *lower = rgb + (size_t)(height - 1 - y) * row;
            memcpy(line, upper, row);
            memcpy(upper, lower, row);
            memcpy(lower, line, row);
        }
    } else {
        free(rgb);
        rgb = NULL;
    }
    free(line);
    end_catch(present);
    return rgb;
}
