/* Textures to OpenGL, when they are first needed. */
#include "r_draw_i.h"

static GLuint upload(const RGL *gl, const RPicture *picture) {
    GLuint texture;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture->width, picture->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   picture->rgba);
    gl->GenerateMipmap(GL_TEXTURE_2D);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

GLuint r_textureObject(RRender *rc, RDraw *d, int id) {
    RPicture picture;
    const RTextures *t = &rc->m_pViewer->textures;
    if (id < 0 || id >= t->count)
        return 0;
    if (!d->textureTried[id] && r_texturePicture(t->names[id], &picture)) {
        d->textures[id] = upload(&d->gl, &picture);
        r_free(picture.rgba);
    }
    d->textureTried[id] = true;
    return d->textures[id];
}
