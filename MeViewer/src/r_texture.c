/* Textures by name: their numbers, the files they come from, and the two that are built in. */
#include "r_i.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int MEAPI RRenderTextureCreate(RRender *rc, const char *filename) {
    if (!r_isContext(rc, __func__) || !r_isPointer(filename, __func__, "filename"))
        return -1;
    RTextures *t = &rc->m_pViewer->textures;
    for (int i = 0; i < t->count; i++)
        if (strcmp(t->names[i], filename) == 0)
            return i;
    if (t->count == R_MAX_TEXTURES) {
        MeWarning(1, "%s: %s: all %d textures are in use", __func__, filename, R_MAX_TEXTURES);
        return -1;
    }
    char *name = r_copyText(filename);
    if (!name)
        return -1;
    t->names[t->count] = name;
    return t->count++;
}

int MEAPI RGraphicSetTexture(RRender *rc, RGraphic *rg, const char *filename) {
    if (!r_isContext(rc, __func__) || !r_isGraphic(rg, __func__))
        return -1;
    rg->m_pObject->m_nTextureID = filename ? RRenderTextureCreate(rc, filename) : -1;
    return rg->m_pObject->m_nTextureID;
}

void r_texturesFree(RTextures *textures) {
    for (int i = 0; i < textures->count; i++)
        r_free(textures->names[i]);
    textures->count = 0;
}

static bool newPicture(RPicture *p, int width, int height) {
    p->width = width;
    p->height = height;
    p->rgba = r_alloc((size_t)width * (size_t)height * 4);
    return p->rgba != NULL;
}

/* Eight by eight squares in two light greys, to be tinted by the graphic's colour. */
static bool checkerboard(RPicture *p) {
    enum { SIZE = 256, SQUARE = SIZE / 8 };
    if (!newPicture(p, SIZE, SIZE))
        return false;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const bool dark = (i % SIZE / SQUARE + i / SIZE / SQUARE) % 2 != 0;
        memset(p->rgba + 4 * i, dark ? 205 : 245, 3);
        p->rgba[4 * i + 3] = 255;
    }
    return true;
}

/* The file of a texture in a directory. */
static bool readFrom(const char *place, const char *name, RPicture *picture) {
    static const char *const endings[] = {"bmp", "png", "jpg", "tga"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        char path[1024];
        if (snprintf(path, sizeof path, "%s/%s.%s", place, name, endings[i]) < (int)sizeof path &&
            r_imageRead(path, picture))
            return true;
    }
    return false;
}

bool r_texturePicture(const char *name, RPicture *picture) {
    if (strcmp(name, "checkerboard") == 0)
        return checkerboard(picture);
    if (strcmp(name, "font") == 0)
        return r_fontPicture(picture);
    const char *const places[] = {".", getenv("KARMA_TEXTURES"), "textures", "../textures"};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (places[i] && *places[i] && readFrom(places[i], name, picture))
            return true;
    /* Programs run without their pictures: that is worth a message, but no trouble that the exit code tells. */
    MeInfo(0,
           "there is no texture %s.bmp, .png, .jpg or .tga in ., $KARMA_TEXTURES, textures or ../textures; drawing "
           "without it",
           name);
    return false;
}
