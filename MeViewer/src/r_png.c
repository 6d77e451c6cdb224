/* Writes and reads .png files. */
#include "r_i.h"

#include <png.h>
#include <stdio.h>

static png_voidp allocate(png_structp png, png_alloc_size_t size) {
    (void)png;
    return r_alloc(size);
}

static void release(png_structp png, png_voidp block) {
    (void)png;
    r_free(block);
}

static void onError(png_structp png, png_const_charp message) {
    snprintf(png_get_error_ptr(png), 128, "%s", message);
    png_longjmp(png, 1);
}

static void onWarning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/* The alpha is not written: a picture is opaque. Nothing that differs from run to run is written either. */
static void writeRows(png_structp png, png_infop info, const RPicture *p) {
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_compression_level(png, 6);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    for (int y = 0; y < p->height; y++)
        png_write_row(png, p->rgba + 4 * (size_t)p->width * (size_t)y);
    png_write_end(png, info);
}

static bool writeStream(FILE *file, const RPicture *p, char *trouble) {
    png_structp png =
        png_create_write_struct_2(PNG_LIBPNG_VER_STRING, trouble, onError, onWarning, NULL, allocate, release);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_init_io(png, file);
    writeRows(png, info, p);
    png_destroy_write_struct(&png, &info);
    return true;
}

bool r_writePng(const char *path, const RPicture *picture) {
    char trouble[128] = "the disk is full, or it may not be written";
    FILE *file = fopen(path, "wb");
    bool written = file && writeStream(file, picture, trouble);
    if (file && fclose(file) != 0)
        written = false;
    if (!written)
        MeWarning(1, "the picture %s cannot be written: %s", path, trouble);
    return written;
}

/* Any kind of .png file comes out as red, green, blue, alpha; a picture larger than a texture may be is refused. */
static const char *readImage(FILE *file, RPicture *p, png_image *image) {
    if (!png_image_begin_read_from_stdio(image, file))
        return image->message;
    if (image->width > R_MAX_PICTURE || image->height > R_MAX_PICTURE)
        return "its size is not between 1 and 4096";
    image->format = PNG_FORMAT_RGBA;
    p->width = (int)image->width;
    p->height = (int)image->height;
    p->rgba = r_alloc(PNG_IMAGE_SIZE(*image));
    if (!p->rgba)
        return "there is no memory for it";
    if (png_image_finish_read(image, NULL, p->rgba, 0, NULL))
        return NULL;
    r_free(p->rgba);
    return image->message;
}

bool r_pngRead(const char *path, RPicture *picture) {
    png_image image = {.version = PNG_IMAGE_VERSION};
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    const char *trouble = readImage(file, picture, &image);
    fclose(file);
    if (trouble)
        MeWarning(1, "the texture %s cannot be used: %s", path, trouble);
    png_image_free(&image);
    return !trouble;
}
