/* A frame's drawing, from the lists to a picture that can be shown or read. */
#include "r_draw_i.h"

#include <stdio.h>
#include <string.h>

/* ---- Beginning and end ---- */

static bool makePrograms(RDraw *d, char *reason, size_t size) {
    const RGL *gl = &d->gl;
    for (int i = 0; i < R_PROGRAMS; i++) {
        d->programs[i] = r_glProgram(gl, &r_programSources[i], reason, size);
        if (!d->programs[i])
            return false;
        const GLuint block = gl->GetUniformBlockIndex(d->programs[i], "Frame");
        if (block != GL_INVALID_INDEX)
            gl->UniformBlockBinding(d->programs[i], block, 0);
    }
    return true;
}

/* Which texture unit each map is on: 0 a graphic's own, 1 the shadow, 2 the occlusion, 3 ambient, 4 the depth. */
static void setSamplers(RDraw *d) {
    static const RProgram programs[] = {rProgramSolid, rProgramGround, rProgramSolidExtra, rProgramGroundExtra};
    const RGL *gl = &d->gl;
    for (size_t i = 0; i < sizeof programs / sizeof programs[0]; i++) {
        const GLuint program = d->programs[programs[i]];
        gl->UseProgram(program);
        gl->Uniform1i(gl->GetUniformLocation(program, "uTexture"), 0);
        gl->Uniform1i(gl->GetUniformLocation(program, "uShadow"), 1);
        gl->Uniform1i(gl->GetUniformLocation(program, "uOcclusion"), 2);
    }
    gl->UseProgram(d->programs[rProgramAmbient]);
    gl->Uniform1i(gl->GetUniformLocation(d->programs[rProgramAmbient], "uDepth"), 4);
    gl->UseProgram(d->programs[rProgramAmbientMean]);
    gl->Uniform1i(gl->GetUniformLocation(d->programs[rProgramAmbientMean], "uAmbient"), 3);
    gl->UseProgram(d->programs[rProgramResolve]);
    gl->Uniform1i(gl->GetUniformLocation(d->programs[rProgramResolve], "uTexture"), 0);
    gl->Uniform1i(gl->GetUniformLocation(d->programs[rProgramResolve], "uAmbient"), 3);
}

static bool makeObjects(RDraw *d) {
    const RGL *gl = &d->gl;
    gl->GenBuffers(1, &d->frameBlock);
    gl->GenBuffers(1, &d->instanceBuffer);
    gl->GenBuffers(1, &d->skyBuffer);
    gl->GenVertexArrays(1, &d->emptyArray);
    r_targetsStart(d);
    return r_linesStart(d) && r_overlayStart(d);
}

bool r_drawStart(RRender *rc, char *reason, size_t size) {
    RDraw *d = r_alloc(sizeof *d);
    if (!d) {
        snprintf(reason, size, "there is no memory");
        return false;
    }
    rc->m_pViewer->draw = d;
    bool good = r_glLoad(&d->gl, rc->m_pViewer->backend->proc, reason, size);
    if (!good) {
        r_free(d);
        rc->m_pViewer->draw = NULL;
        return false;
    }
    good = makePrograms(d, reason, size);
    if (good && !makeObjects(d)) {
        snprintf(reason, size, "OpenGL cannot make the buffers that are needed");
        good = false;
    }
    if (good)
        setSamplers(d);
    else
        r_drawStop(rc);
    return good;
}

static void deleteObjects(RDraw *d) {
    const RGL *gl = &d->gl;
    const GLuint arrays[] = {d->emptyArray, d->lineArray, d->overlayArray};
    const GLuint buffers[] = {d->frameBlock, d->instanceBuffer, d->skyBuffer,
                              d->lineBuffer, d->overlayBuffer,  d->overlayIndices};
    r_targetsStop(d);
    gl->DeleteVertexArrays(3, arrays);
    gl->DeleteBuffers(6, buffers);
    gl->DeleteTextures(1, &d->fontTexture);
    gl->DeleteTextures(R_MAX_TEXTURES, d->textures);
    for (int i = 0; i < R_PROGRAMS; i++)
        if (d->programs[i])
            gl->DeleteProgram(d->programs[i]);
}

void r_drawStop(RRender *rc) {
    RDraw *d = rc->m_pViewer->draw;
    if (!d)
        return;
    /* With a closed window, OpenGL's objects have gone already. */
    const bool current = rc->m_pViewer->backend->makeCurrent(rc);
    r_meshesFree(d, current);
    if (current)
        deleteObjects(d);
    r_sceneFree(&d->scene);
    r_free(d);
    rc->m_pViewer->draw = NULL;
}

/* ---- A frame ---- */

static void uploadBlock(RDraw *d) {
    d->gl.BindBuffer(GL_UNIFORM_BUFFER, d->frameBlock);
    d->gl.BufferData(GL_UNIFORM_BUFFER, sizeof d->block, &d->block, GL_STREAM_DRAW);
    d->gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, d->frameBlock);
}

static void bindMaps(const RDraw *d) {
    d->gl.ActiveTexture(GL_TEXTURE1);
    d->gl.BindTexture(GL_TEXTURE_2D, d->shadow.depth);
    d->gl.ActiveTexture(GL_TEXTURE2);
    d->gl.BindTexture(GL_TEXTURE_2D, d->occlusion.color);
    d->gl.ActiveTexture(GL_TEXTURE0);
}

static void drawFull(const RDraw *d, RProgram program) {
    d->gl.UseProgram(d->programs[program]);
    d->gl.BindVertexArray(d->emptyArray);
    d->gl.DrawArrays(GL_TRIANGLES, 0, 3);
    d->gl.BindVertexArray(0);
}

static void blend(const RGL *gl, bool on) {
    if (on)
        gl->Enable(GL_BLEND);
    else
        gl->Disable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

/* The world, several samples per pixel: background, opaque things, the ground, lines, see-through things. */
static void drawWorld(RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->samples.frame);
    gl->Viewport(0, 0, d->drawnWidth, d->drawnHeight);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LEQUAL);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    blend(gl, false);
    gl->Disable(GL_DEPTH_TEST);
    drawFull(d, rProgramBackground);
    gl->Enable(GL_DEPTH_TEST);
    bindMaps(d);
    gl->DepthMask(GL_FALSE);
    r_drawSky(rc, d);
    gl->DepthMask(GL_TRUE);
    r_drawItems(rc, d, rOpaque);
    blend(gl, true);
    r_drawItems(rc, d, rFloor);
    gl->DepthMask(GL_FALSE);
    r_linesDraw(d);
    r_drawItems(rc, d, rBlended);
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_DEPTH_TEST);
    blend(gl, false);
}

/* Corners between things get less of the sky. With shadows, and lights at all; not without perspective. */
static bool hasAmbient(const RRender *rc, const RDraw *d) {
    return r_qualityLevels[d->level].ambient && rc->m_pViewer->shadows && d->block.quality[0] > 0.5f &&
           d->block.eye[3] > 0.5f;
}

/* The depth on the screen is x + y / distance: what is so far along the line of sight has -1 or 1 times that as its z
 * in the camera's frame, which the projection turns to (z P22 + P32) / (z P23). */
static void setProjection(const RRender *rc, const RDraw *d) {
    const MeVector4 *p = rc->m_ProjectionMatrix;
    d->gl.UseProgram(d->programs[rProgramAmbient]);
    d->gl.Uniform2f(d->gl.GetUniformLocation(d->programs[rProgramAmbient], "uProjection"), (float)(p[2][2] / p[2][3]),
                    (float)p[3][2]);
}

static void bindTo(const RGL *gl, GLenum unit, GLuint texture) {
    gl->ActiveTexture(unit);
    gl->BindTexture(GL_TEXTURE_2D, texture);
}

/* A target's texture is bound nowhere while it is drawn into. */
static void drawAmbient(const RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->ambient.frame);
    gl->Viewport(0, 0, (d->drawnWidth + 1) / 2, (d->drawnHeight + 1) / 2);
    bindTo(gl, GL_TEXTURE3, 0);
    bindTo(gl, GL_TEXTURE4, d->linear.depth);
    setProjection(rc, d);
    drawFull(d, rProgramAmbient);
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->ambientMean.frame);
    bindTo(gl, GL_TEXTURE3, d->ambient.color);
    drawFull(d, rProgramAmbientMean);
    bindTo(gl, GL_TEXTURE3, d->ambientMean.color);
    gl->ActiveTexture(GL_TEXTURE0);
}

/* One sample per pixel, then a screen's colours, then what is laid over it. */
static void drawPicture(RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, d->samples.frame);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, d->linear.frame);
    const bool ambient = hasAmbient(rc, d);
    gl->BlitFramebuffer(0, 0, d->drawnWidth, d->drawnHeight, 0, 0, d->drawnWidth, d->drawnHeight,
                        GL_COLOR_BUFFER_BIT | (ambient ? GL_DEPTH_BUFFER_BIT : 0u), GL_NEAREST);
    if (ambient)
        drawAmbient(rc, d);
    gl->UseProgram(d->programs[rProgramResolve]);
    gl->Uniform1f(gl->GetUniformLocation(d->programs[rProgramResolve], "uHasAmbient"), ambient ? 1 : 0);
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->picture.frame);
    gl->Viewport(0, 0, d->sceneWidth, d->height);
    gl->BindTexture(GL_TEXTURE_2D, d->linear.color);
    drawFull(d, rProgramResolve);
    gl->Viewport(0, 0, d->width, d->height);
    blend(gl, true);
    r_overlayDraw(rc, d);
    blend(gl, false);
}

/* To the window, if there is one. */
static void showPicture(RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    if (!rc->m_pViewer->backend->window)
        return;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, d->picture.frame);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl->BlitFramebuffer(0, 0, d->width, d->height, 0, 0, d->width, d->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void r_drawFrame(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    RDraw *d = v->draw;
    if (!v->backend->makeCurrent(rc)) /* There may be another context. */
        return;
    if (!r_targetsResize(d, v->width, v->height, r_sceneWidth(rc), r_qualityLevel(rc))) {
        if (!d->warned)
            MeWarning(1, "MeViewer: OpenGL has no room for a picture of %dx%d", v->width, v->height);
        d->warned = true;
        return;
    }
    d->frame++;
    r_lightsUpdate(rc);
    r_sceneGather(rc, d);
    RRenderUpdateProjectionMatrices(rc);
    r_blockFill(rc, d);
    r_shadowFit(rc, d);
    uploadBlock(d);
    r_shadowDraw(d);
    drawWorld(rc, d);
    r_hudDraw(rc, &v->overlay);
    drawPicture(rc, d);
    showPicture(rc, d);
    r_meshesTrim(d);
    d->drawn = true;
}

/* ---- Reading ---- */

bool r_drawRead(RRender *rc, RPicture *picture) {
    RDraw *d = rc->m_pViewer->draw;
    if (!d || !d->drawn || !rc->m_pViewer->backend->makeCurrent(rc))
        return false;
    const size_t stride = 4 * (size_t)d->width, rows = (size_t)d->height;
    *picture = (RPicture){d->width, d->height, r_alloc(stride * rows)};
    uint8_t *row = r_alloc(stride);
    if (!picture->rgba || !row) {
        r_free(picture->rgba);
        r_free(row);
        return false;
    }
    d->gl.BindFramebuffer(GL_FRAMEBUFFER, d->picture.frame);
    d->gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    d->gl.ReadPixels(0, 0, d->width, d->height, GL_RGBA, GL_UNSIGNED_BYTE, picture->rgba);
    for (size_t y = 0; y < rows / 2; y++) { /* OpenGL's first row is the lowest one. */
        uint8_t *a = picture->rgba + y * stride, *b = picture->rgba + (rows - 1 - y) * stride;
        memcpy(row, a, stride);
        memcpy(a, b, stride);
        memcpy(b, row, stride);
    }
    r_free(row);
    return true;
}
