/* Pictures in files, by stb_image: .png is written, .bmp, .png, .jpg and .tga are read. */
#include "r_i.h"

#include <limits.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <stdio.h>
#include <string.h>

/* ---- Writing ---- */

static void writeBytes(void *file, void *data, int size) {
    (void)fwrite(data, 1, (size_t)size, file); /* What went wrong is asked for at the end. */
}

/* The alpha is not written: a picture is opaque. */
static uint8_t *opaqueCopy(const RPicture *p) {
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    uint8_t *rgb = r_alloc(3 * pixels);
    for (size_t i = 0; rgb && i < pixels; i++)
        memcpy(rgb + 3 * i, p->rgba + 4 * i, 3);
    return rgb;
}

bool r_writePng(const char *path, const RPicture *picture) {
    FILE *file = fopen(path, "wb");
    uint8_t *rgb = file ? opaqueCopy(picture) : NULL;
    bool written =
        rgb && stbi_write_png_to_func(writeBytes, file, picture->width, picture->height, 3, rgb, 3 * picture->width);
    r_free(rgb);
    if (file) {
        written = !ferror(file) && written;
        written = fclose(file) == 0 && written;
    }
    if (!written)
        MeWarning(1, "the picture %s cannot be written: the disk is full, or it may not be written", path);
    return written;
}

/* ---- Reading ---- */

typedef struct {
    FILE *file;
    bool isShort; /* More was wanted than there is: stb_image goes on with zeros for some kinds of files. */
} Source;

static int readBytes(void *user, char *data, int size) {
    Source *s = user;
    const size_t got = fread(data, 1, (size_t)size, s->file);
    s->isShort = s->isShort || (got == 0 && size > 0);
    return (int)got;
}

static void skipBytes(void *user, int count) {
    (void)fseek(((Source *)user)->file, count, SEEK_CUR);
}

static int isAtEnd(void *user) {
    return feof(((Source *)user)->file);
}

static bool isSize(int length) {
    return length != INT_MIN && abs(length) >= 1 && abs(length) <= R_MAX_PICTURE;
}

/* Null, or what is wrong. A height may be negative in the head of a .bmp file. */
static const char *readImage(Source *s, RPicture *p) {
    static const stbi_io_callbacks callbacks = {readBytes, skipBytes, isAtEnd};
    int width, height, channels;
    if (!stbi_info_from_callbacks(&callbacks, s, &width, &height, &channels))
        return stbi_failure_reason();
    if (!isSize(width) || !isSize(height))
        return "its size is not between 1 and 4096";
    rewind(s->file);
    s->isShort = false;
    stbi_uc *read = stbi_load_from_callbacks(&callbacks, s, &p->width, &p->height, &channels, 4);
    const char *trouble = !read ? stbi_failure_reason() : s->isShort ? "it is cut short" : NULL;
    const size_t bytes = trouble ? 0 : 4 * (size_t)p->width * (size_t)p->height;
    p->rgba = trouble ? NULL : r_alloc(bytes);
    if (p->rgba)
        memcpy(p->rgba, read, bytes);
    else if (!trouble)
        trouble = "there is no memory for it";
    stbi_image_free(read);
    return trouble;
}

bool r_imageRead(const char *path, RPicture *picture) {
    Source s = {fopen(path, "rb"), false};
    if (!s.file)
        return false;
    const char *trouble = readImage(&s, picture);
    fclose(s.file);
    if (trouble)
        MeWarning(1, "the texture %s cannot be used: %s", path, trouble);
    return !trouble;
}
