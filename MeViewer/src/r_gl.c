/* The table of OpenGL functions, and programs made of shaders. */
#include "r_draw_i.h"

#include <stdio.h>

static bool isNewEnough(const RGL *gl, char *reason, size_t size) {
    int major = 0, minor = 0;
    const char *version = (const char *)gl->GetString(GL_VERSION);
    if (version && sscanf(version, "%d.%d", &major, &minor) == 2 && (major > 3 || (major == 3 && minor >= 3)))
        return true;
    snprintf(reason, size, "OpenGL 3.3 is needed, and here is %s", version ? version : "none");
    return false;
}

bool r_glLoad(RGL *gl, RProc (*proc)(const char *name), char *reason, size_t size) {
#define X(type, name)                                                                                                  \
    gl->name = (PFNGL##type##PROC)proc("gl" #name);                                                                    \
    if (!gl->name) {                                                                                                   \
        snprintf(reason, size, "OpenGL has no function gl%s here", #name);                                             \
        return false;                                                                                                  \
    }
    R_GL_FUNCTIONS(X)
#undef X
    return isNewEnough(gl, reason, size);
}

static GLuint compile(const RGL *gl, GLenum type, const char *const pieces[], char *reason, size_t size) {
    GLsizei n = 0;
    GLint good = 0;
    while (pieces[n])
        n++;
    const GLuint shader = gl->CreateShader(type);
    gl->ShaderSource(shader, n, pieces, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good)
        return shader;
    char log[160] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    snprintf(reason, size, "a shader does not compile: %s", log);
    gl->DeleteShader(shader);
    return 0;
}

GLuint r_glProgram(const RGL *gl, const RProgramSource *source, char *reason, size_t size) {
    GLint good = 0;
    const GLuint vertex = compile(gl, GL_VERTEX_SHADER, source->vertex, reason, size);
    const GLuint fragment = vertex ? compile(gl, GL_FRAGMENT_SHADER, source->fragment, reason, size) : 0;
    GLuint program = 0;
    if (fragment) {
        program = gl->CreateProgram();
        gl->AttachShader(program, vertex);
        gl->AttachShader(program, fragment);
        gl->LinkProgram(program);
        gl->GetProgramiv(program, GL_LINK_STATUS, &good);
    }
    if (program && !good) {
        char log[160] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        snprintf(reason, size, "the shaders do not fit together: %s", log);
        gl->DeleteProgram(program);
        program = 0;
    }
    gl->DeleteShader(vertex); /* 0 is ignored. */
    gl->DeleteShader(fragment);
    return program;
}
