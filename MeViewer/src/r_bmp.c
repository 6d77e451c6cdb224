/* Reads .bmp files: uncompressed, 24 bits. */
#include "r_i.h"

#include <stdio.h>
#include <string.h>

enum { HEADER = 54 };

static uint32_t number(const uint8_t *at, int bytes) {
    uint32_t value = 0;
    while (bytes-- > 0)
        value = value << 8 | at[bytes];
    return value;
}

/* Rows are padded to four bytes, blue comes first, and the lowest row unless the height is negative. */
static bool readRows(FILE *file, RPicture *p, bool upsideDown) {
    const size_t stride = ((size_t)p->width * 3 + 3) / 4 * 4;
    uint8_t *row = r_alloc(stride);
    bool good = row != NULL;
    for (int y = 0; good && y < p->height; y++) {
        uint8_t *to = p->rgba + 4 * (size_t)p->width * (size_t)(upsideDown ? p->height - 1 - y : y);
        good = fread(row, 1, stride, file) == stride;
        for (int x = 0; good && x < p->width; x++, to += 4) {
            to[0] = row[3 * x + 2];
            to[1] = row[3 * x + 1];
            to[2] = row[3 * x];
            to[3] = 255;
        }
    }
    r_free(row);
    return good;
}

static const char *readFile(FILE *file, RPicture *p) {
    uint8_t header[HEADER];
    if (fread(header, 1, HEADER, file) != HEADER || header[0] != 'B' || header[1] != 'M')
        return "it is no .bmp file";
    const int32_t width = (int32_t)number(header + 18, 4), height = (int32_t)number(header + 22, 4);
    if (number(header + 28, 2) != 24 || number(header + 30, 4) != 0)
        return "only uncompressed .bmp files of 24 bits are read";
    if (width < 1 || width > R_MAX_PICTURE || height == 0 || height > R_MAX_PICTURE || height < -R_MAX_PICTURE)
        return "its size is not between 1 and 4096";
    p->width = width;
    p->height = height < 0 ? -height : height;
    p->rgba = r_alloc(4 * (size_t)p->width * (size_t)p->height);
    if (!p->rgba)
        return "there is no memory for it";
    if (fseek(file, (long)number(header + 10, 4), SEEK_SET) == 0 && readRows(file, p, height > 0))
        return NULL;
    r_free(p->rgba);
    return "it is cut short";
}

bool r_bmpRead(const char *path, RPicture *picture) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    const char *trouble = readFile(file, picture);
    fclose(file);
    if (trouble)
        MeWarning(1, "the texture %s cannot be used: %s", path, trouble);
    return !trouble;
}
