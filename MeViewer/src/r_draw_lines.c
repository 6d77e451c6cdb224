/* Lines to OpenGL. */
#include "r_draw_i.h"

bool r_linesStart(RDraw *d) {
    const RGL *gl = &d->gl;
    static const GLint sizes[3] = {3, 3, 4};
    static const size_t offsets[3] = {offsetof(RLineSegment, a), offsetof(RLineSegment, b),
                                      offsetof(RLineSegment, color)};
    gl->GenVertexArrays(1, &d->lineArray);
    gl->GenBuffers(1, &d->lineBuffer);
    gl->BindVertexArray(d->lineArray);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->lineBuffer);
    for (GLuint i = 0; i < 3; i++) {
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(RLineSegment), (const void *)offsets[i]);
        gl->VertexAttribDivisor(i, 1);
    }
    gl->BindVertexArray(0);
    return d->lineArray && d->lineBuffer;
}

void r_linesDraw(RDraw *d) {
    const RGL *gl = &d->gl;
    RLineSegments *lines = &d->scene.lines;
    if (lines->count == 0)
        return;
    for (size_t i = 0; i < lines->count; i++)
        if (lines->items[i].color[3] == 0)
            lines->items[i].color[3] = 1;
    gl->BindVertexArray(d->lineArray);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->lineBuffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(lines->count * sizeof(RLineSegment)), lines->items, GL_STREAM_DRAW);
    gl->UseProgram(d->programs[rProgramLine]);
    gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)lines->count);
    gl->BindVertexArray(0);
}
