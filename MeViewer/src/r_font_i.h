/* The built-in font: a picture of signed distances to the outlines of DejaVu Sans, made by tools/bake_font.c while
 * the library is built. */
#ifndef R_FONT_I_H
#define R_FONT_I_H

#include <stdint.h>

typedef struct {
    uint32_t code;                  /* Unicode */
    float left, top, right, bottom; /* Ems from the pen's position on the baseline, y down. */
    float advance;                  /* Ems to the next pen position. */
    uint16_t u0, v0, u1, v1;        /* Pixels in the picture. */
} RGlyph;

typedef struct {
    int width, height;     /* Of the picture. */
    float pixelsPerEm;     /* In the picture. */
    float spread;          /* Pixels from the outline (128) to 0 and to 255. */
    float ascent, descent; /* Ems above and below the baseline. */
    int count;
    const RGlyph *glyphs;    /* In ascending order of their codes. */
    const uint8_t *distance; /* width x height, from the upper left corner on; more than 128 is inside. */
} RFont;

extern const RFont r_font;

/* The glyph of a character, or that of a question mark. */
const RGlyph *r_glyph(uint32_t code);

#endif
