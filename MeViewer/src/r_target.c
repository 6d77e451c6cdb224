/* What is drawn into: the picture in its three stages, and the maps for shadow and occlusion. */
#include "r_draw_i.h"

static bool isComplete(const RGL *gl) {
    return gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static GLuint makeTexture(const RGL *gl, GLint format, int width, int height, GLenum pixels, GLenum type,
                          GLint filter) {
    GLuint texture;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, pixels, type, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static bool makeColorTarget(const RGL *gl, RTarget *t, GLint format, int width, int height, GLenum pixels, GLenum type,
                            GLint filter) {
    t->color = makeTexture(gl, format, width, height, pixels, type, filter);
    gl->GenFramebuffers(1, &t->frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, t->frame);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t->color, 0);
    return isComplete(gl);
}

static bool makeDepthTarget(const RGL *gl, RTarget *t, int size, GLint filter) {
    t->depth = makeTexture(gl, GL_DEPTH_COMPONENT24, size, size, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, filter);
    gl->GenFramebuffers(1, &t->frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, t->frame);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, t->depth, 0);
    gl->DrawBuffer(GL_NONE);
    gl->ReadBuffer(GL_NONE);
    return isComplete(gl);
}

/* One sample: without multisampling. */
static bool makeSampleTarget(const RGL *gl, RTarget *t, int samples, int width, int height) {
    const GLsizei several = samples > 1 ? samples : 0;
    gl->GenRenderbuffers(1, &t->color);
    gl->BindRenderbuffer(GL_RENDERBUFFER, t->color);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, several, GL_RGBA16F, width, height);
    gl->GenRenderbuffers(1, &t->depth);
    gl->BindRenderbuffer(GL_RENDERBUFFER, t->depth);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, several, GL_DEPTH_COMPONENT24, width, height);
    gl->GenFramebuffers(1, &t->frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, t->frame);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, t->color);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, t->depth);
    return isComplete(gl);
}

/* A depth buffer beside a target's colours, to be read as a texture. */
static bool addDepth(const RGL *gl, RTarget *t, int width, int height) {
    t->depth = makeTexture(gl, GL_DEPTH_COMPONENT24, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, GL_NEAREST);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, t->depth, 0);
    return isComplete(gl);
}

static void freeTarget(const RGL *gl, RTarget *t, bool renderbuffers) {
    gl->DeleteFramebuffers(1, &t->frame); /* 0 is ignored, everywhere here. */
    if (renderbuffers) {
        gl->DeleteRenderbuffers(1, &t->color);
        gl->DeleteRenderbuffers(1, &t->depth);
    } else {
        gl->DeleteTextures(1, &t->color);
        gl->DeleteTextures(1, &t->depth);
    }
    *t = (RTarget){0};
}

static void freePicture(RDraw *d) {
    freeTarget(&d->gl, &d->samples, true);
    freeTarget(&d->gl, &d->linear, false);
    freeTarget(&d->gl, &d->ambient, false);
    freeTarget(&d->gl, &d->ambientMean, false);
    freeTarget(&d->gl, &d->picture, false);
    d->width = d->height = 0;
    d->drawn = false;
}

static int scaled(int length, float scale) {
    const int pixels = (int)lroundf((float)length * scale);
    return pixels > 1 ? pixels : 1;
}

static bool makeShadow(RDraw *d, int size) {
    const RGL *gl = &d->gl;
    freeTarget(gl, &d->shadow, false);
    if (!makeDepthTarget(gl, &d->shadow, size, GL_LINEAR))
        return false;
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    return true;
}

static bool makeBelow(RDraw *d, int size) {
    const RGL *gl = &d->gl;
    freeTarget(gl, &d->below, false);
    freeTarget(gl, &d->occlusion, false);
    return makeDepthTarget(gl, &d->below, size, GL_LINEAR) &&
           makeColorTarget(gl, &d->occlusion, GL_R8, size, size, GL_RED, GL_UNSIGNED_BYTE, GL_LINEAR);
}

/* After the picture's linear target, which is bound. */
static bool makeAmbient(RDraw *d) {
    const RGL *gl = &d->gl;
    const int width = (d->drawnWidth + 1) / 2, height = (d->drawnHeight + 1) / 2;
    return addDepth(gl, &d->linear, d->drawnWidth, d->drawnHeight) &&
           makeColorTarget(gl, &d->ambient, GL_RG16F, width, height, GL_RG, GL_FLOAT, GL_LINEAR) &&
           makeColorTarget(gl, &d->ambientMean, GL_R8, width, height, GL_RED, GL_UNSIGNED_BYTE, GL_LINEAR);
}

bool r_targetsResize(RDraw *d, int width, int height, int sceneWidth, int level) {
    const RGL *gl = &d->gl;
    const RQualityLevel *q = &r_qualityLevels[level];
    if (width == d->width && height == d->height && sceneWidth == d->sceneWidth && level == d->level)
        return true;
    freePicture(d);
    d->level = level;
    d->drawnWidth = scaled(sceneWidth, q->scale);
    d->drawnHeight = scaled(height, q->scale);
    const GLint filter = q->scale < 1 ? GL_LINEAR : GL_NEAREST;
    if (!makeShadow(d, q->shadowSize) || !makeBelow(d, q->belowSize) ||
        !makeSampleTarget(gl, &d->samples, q->samples, d->drawnWidth, d->drawnHeight) ||
        !makeColorTarget(gl, &d->linear, GL_RGBA16F, d->drawnWidth, d->drawnHeight, GL_RGBA, GL_FLOAT, filter) ||
        (q->ambient && !makeAmbient(d)) ||
        !makeColorTarget(gl, &d->picture, GL_RGBA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE, GL_NEAREST)) {
        freePicture(d);
        return false;
    }
    d->width = width;
    d->height = height;
    d->sceneWidth = sceneWidth;
    return true;
}

void r_targetsStart(RDraw *d) {
    d->level = -1; /* of none yet */
}

void r_targetsStop(RDraw *d) {
    freePicture(d);
    freeTarget(&d->gl, &d->shadow, false);
    freeTarget(&d->gl, &d->below, false);
    freeTarget(&d->gl, &d->occlusion, false);
}
