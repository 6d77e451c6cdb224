/* The overlay to OpenGL. */
#include "r_draw_i.h"

bool r_overlayStart(RDraw *d) {
    const RGL *gl = &d->gl;
    const GLsizei stride = sizeof(ROverlayVertex);
    gl->GenTextures(1, &d->fontTexture);
    gl->GenVertexArrays(1, &d->overlayArray);
    gl->GenBuffers(1, &d->overlayBuffer);
    gl->GenBuffers(1, &d->overlayIndices);
    gl->BindVertexArray(d->overlayArray);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->overlayBuffer);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, d->overlayIndices);
    for (GLuint i = 0; i < 3; i++)
        gl->EnableVertexAttribArray(i);
    gl->VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, (const void *)offsetof(ROverlayVertex, x));
    gl->VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, (const void *)offsetof(ROverlayVertex, u));
    gl->VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, (const void *)offsetof(ROverlayVertex, color));
    gl->BindVertexArray(0);
    return d->fontTexture && d->overlayArray && d->overlayBuffer && d->overlayIndices;
}

/* The letters, again when their size has changed: white, and as opaque as the picture says. */
static void updateFont(const RRender *rc, RDraw *d) {
    static const GLint swizzle[4] = {GL_ONE, GL_ONE, GL_ONE, GL_RED};
    const RGL *gl = &d->gl;
    int width, height;
    const uint8_t *alpha;
    const int version = r_panelsFont(rc, &width, &height, &alpha);
    if (version == d->fontVersion)
        return;
    d->fontVersion = version;
    gl->BindTexture(GL_TEXTURE_2D, d->fontTexture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, alpha);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (GLenum i = 0; i < 4; i++)
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R + i, swizzle[i]);
}

static void uploadTriangles(const ROverlay *o, RDraw *d) {
    const RGL *gl = &d->gl;
    gl->BindVertexArray(d->overlayArray);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->overlayBuffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(o->vertices.count * sizeof *o->vertices.items), o->vertices.items,
                   GL_STREAM_DRAW);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(o->indices.count * sizeof *o->indices.items), o->indices.items,
                   GL_STREAM_DRAW);
}

/* OpenGL counts rows from below. */
static void setClip(const RDraw *d, const float clip[4]) {
    const GLint left = (GLint)fmaxf(clip[0], 0), top = (GLint)fmaxf(clip[1], 0);
    const GLint right = (GLint)fmaxf(clip[2], 0), bottom = (GLint)fmaxf(clip[3], 0);
    d->gl.Scissor(left, d->height - bottom, right > left ? right - left : 0, bottom > top ? bottom - top : 0);
}

void r_overlayDraw(RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    const ROverlay *o = &rc->m_pViewer->overlay;
    if (o->indices.count == 0)
        return;
    const GLuint program = d->programs[rProgramOverlay];
    updateFont(rc, d);
    uploadTriangles(o, d);
    gl->UseProgram(program);
    gl->Uniform1i(gl->GetUniformLocation(program, "uTexture"), 0);
    gl->Enable(GL_SCISSOR_TEST);
    for (size_t i = 0; i < o->runs.count; i++) {
        const ROverlayRun *run = &o->runs.items[i];
        const GLuint texture = run->texture < 0 ? d->fontTexture : r_textureObject(rc, d, run->texture);
        gl->BindTexture(GL_TEXTURE_2D, texture);
        setClip(d, run->clip);
        gl->DrawElementsInstanced(GL_TRIANGLES, (GLsizei)run->count, GL_UNSIGNED_INT,
                                  (const void *)(run->first * sizeof(uint32_t)), 1);
    }
    gl->Disable(GL_SCISSOR_TEST);
    gl->BindVertexArray(0);
}
