/* The overlay to OpenGL. */
#include "r_draw_i.h"

#include "r_font_i.h"

static GLuint fontTexture(const RGL *gl) {
    GLuint texture;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, r_font.width, r_font.height, 0, GL_RED, GL_UNSIGNED_BYTE, r_font.distance);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

bool r_overlayStart(RDraw *d) {
    const RGL *gl = &d->gl;
    static const GLint sizes[4] = {2, 2, 4, 4};
    static const size_t offsets[4] = {offsetof(ROverlayVertex, x), offsetof(ROverlayVertex, u),
                                      offsetof(ROverlayVertex, color), offsetof(ROverlayVertex, a)};
    d->fontTexture = fontTexture(gl);
    gl->GenVertexArrays(1, &d->overlayArray);
    gl->GenBuffers(1, &d->overlayBuffer);
    gl->BindVertexArray(d->overlayArray);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->overlayBuffer);
    for (GLuint i = 0; i < 4; i++) {
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(ROverlayVertex), (const void *)offsets[i]);
    }
    gl->BindVertexArray(0);
    return d->fontTexture && d->overlayArray && d->overlayBuffer;
}

static void useProgram(RDraw *d) {
    const RGL *gl = &d->gl;
    const GLuint program = d->programs[rProgramOverlay];
    gl->UseProgram(program);
    gl->Uniform1i(gl->GetUniformLocation(program, "uTexture"), 0);
    gl->Uniform1i(gl->GetUniformLocation(program, "uFont"), 1);
    gl->Uniform2f(gl->GetUniformLocation(program, "uFontScale"), r_font.pixelsPerEm, 255.0f / 127 * r_font.spread);
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D, d->fontTexture);
    gl->ActiveTexture(GL_TEXTURE0);
}

void r_overlayDraw(RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    const ROverlay *o = &rc->m_pViewer->overlay;
    if (o->vertices.count == 0)
        return;
    gl->BindVertexArray(d->overlayArray);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->overlayBuffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(o->vertices.count * sizeof(ROverlayVertex)), o->vertices.items,
                   GL_STREAM_DRAW);
    useProgram(d);
    for (size_t i = 0; i < o->runs.count; i++) {
        const ROverlayRun *run = &o->runs.items[i];
        gl->BindTexture(GL_TEXTURE_2D, r_textureObject(rc, d, run->texture));
        gl->DrawArrays(GL_TRIANGLES, (GLint)run->first, (GLsizei)run->count);
    }
    gl->BindVertexArray(0);
}
