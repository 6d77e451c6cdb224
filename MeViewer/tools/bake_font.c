/* Bakes a TrueType font into a C array of signed distances (see src/r_font_i.h). Run by CMake:
 *     bake_font FONT.ttf OUTPUT.c
 * Each glyph is drawn large, in black and white; the exact distance to the nearest pixel of the other colour is then
 * sampled once per SCALE pixels. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H

enum {
    EM = 44,     /* Pixels per em in the atlas. */
    SCALE = 8,   /* Pixels of the large drawing per pixel of the atlas. */
    SPREAD = 5,  /* Atlas pixels of distance that fit into a byte. */
    WIDTH = 512, /* Of the atlas. */
    MAX_HEIGHT = 2048,
    MAX_GLYPHS = 512
};

/* Characters besides ASCII and Latin-1: Greek, dashes, bullet, ellipsis, arrows, a few signs. */
static const struct {
    unsigned first, last;
} ranges[] = {{0x20, 0x7e},     {0xa0, 0xff},     {0x391, 0x3a1},   {0x3a3, 0x3a9},   {0x3b1, 0x3c9},
              {0x2013, 0x2014}, {0x2018, 0x2019}, {0x201c, 0x201d}, {0x2022, 0x2022}, {0x2026, 0x2026},
              {0x2190, 0x2193}, {0x2212, 0x2212}, {0x221e, 0x221e}, {0x2248, 0x2248}, {0x2264, 0x2265}};

typedef struct {
    unsigned code;
    int width, height; /* Atlas pixels. */
    float left, top;   /* Atlas pixels from the pen's position, y down. */
    float advance;     /* Atlas pixels. */
    uint8_t *pixels;
    int u, v;
} Glyph;

static Glyph glyphs[MAX_GLYPHS];
static int count;

static void fail(const char *what) {
    fprintf(stderr, "bake_font: %s\n", what);
    exit(EXIT_FAILURE);
}

static void *allocate(size_t n, size_t size) {
    void *block = calloc(n, size);
    if (!block)
        fail("out of memory");
    return block;
}

/* Squared distance of each of n samples to the nearest one that is 0, given squared distances across the other axis:
 * the lower envelope of parabolas (Felzenszwalb and Huttenlocher). */
static void distances(const float *f, float *d, int n, int *site, float *border) {
    int k = 0;
    site[0] = 0;
    border[0] = -INFINITY;
    border[1] = INFINITY;
    for (int q = 1; q < n; q++) {
        float s;
        for (;;) {
            const int p = site[k];
            s = (f[q] + (float)(q * q) - f[p] - (float)(p * p)) / (float)(2 * (q - p));
            if (s > border[k])
                break;
            k--;
        }
        site[++k] = q;
        border[k] = s;
        border[k + 1] = INFINITY;
    }
    for (int q = 0, i = 0; q < n; q++) {
        while (border[i + 1] < (float)q)
            i++;
        d[q] = (float)((q - site[i]) * (q - site[i])) + f[site[i]];
    }
}

/* field: 0 where the distance is measured to, a large number elsewhere; becomes the squared distance. */
static void transform(float *field, int width, int height) {
    const int n = width > height ? width : height;
    float *in = allocate((size_t)n, sizeof *in), *out = allocate((size_t)n, sizeof *out);
    float *border = allocate((size_t)n + 1, sizeof *border);
    int *site = allocate((size_t)n, sizeof *site);
    for (int x = 0; x < width; x++) {
        for (int y = 0; y < height; y++)
            in[y] = field[y * width + x];
        distances(in, out, height, site, border);
        for (int y = 0; y < height; y++)
            field[y * width + x] = out[y];
    }
    for (int y = 0; y < height; y++) {
        memcpy(in, field + y * width, (size_t)width * sizeof *in);
        distances(in, field + y * width, width, site, border);
    }
    free(in);
    free(out);
    free(border);
    free(site);
}

static int isInside(const FT_Bitmap *bitmap, int x, int y) {
    if (x < 0 || y < 0 || x >= (int)bitmap->width || y >= (int)bitmap->rows)
        return 0;
    return bitmap->buffer[y * bitmap->pitch + x] >= 128;
}

/* The glyph's signed distances, with a margin of SPREAD pixels. */
static void makePixels(Glyph *g, const FT_Bitmap *bitmap, int originX, int originY) {
    const int width = g->width * SCALE, height = g->height * SCALE;
    const size_t n = (size_t)(width * height);
    float *inside = allocate(n, sizeof *inside), *outside = allocate(n, sizeof *outside);
    const float far = 1e9f;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const int in = isInside(bitmap, x - originX, y - originY);
            inside[y * width + x] = in ? far : 0;
            outside[y * width + x] = in ? 0 : far;
        }
    }
    transform(inside, width, height);
    transform(outside, width, height);
    g->pixels = allocate((size_t)(g->width * g->height), 1);
    for (int y = 0; y < g->height; y++) {
        for (int x = 0; x < g->width; x++) {
            const int at = (y * SCALE + SCALE / 2) * width + x * SCALE + SCALE / 2;
            const float d = (sqrtf(inside[at]) - sqrtf(outside[at])) / SCALE;
            const float value = roundf(128 + 127 * d / SPREAD);
            g->pixels[y * g->width + x] = (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
        }
    }
    free(inside);
    free(outside);
}

static void bakeGlyph(FT_Face face, unsigned code) {
    if (FT_Get_Char_Index(face, code) == 0 || count == MAX_GLYPHS)
        return;
    if (FT_Load_Char(face, code, FT_LOAD_NO_HINTING | FT_LOAD_RENDER))
        fail("a glyph cannot be drawn");
    const FT_GlyphSlot slot = face->glyph;
    Glyph *g = &glyphs[count++];
    g->code = code;
    g->advance = (float)slot->linearHoriAdvance / 65536 / SCALE;
    if (slot->bitmap.width == 0)
        return;
    g->width = ((int)slot->bitmap.width + SCALE - 1) / SCALE + 2 * SPREAD;
    g->height = ((int)slot->bitmap.rows + SCALE - 1) / SCALE + 2 * SPREAD;
    g->left = (float)slot->bitmap_left / SCALE - SPREAD;
    g->top = -(float)slot->bitmap_top / SCALE - SPREAD;
    makePixels(g, &slot->bitmap, SPREAD * SCALE, SPREAD * SCALE);
}

static int taller(const void *a, const void *b) {
    const Glyph *p = *(const Glyph *const *)a, *q = *(const Glyph *const *)b;
    return p->height != q->height ? q->height - p->height : (int)p->code - (int)q->code;
}

/* Places the glyphs in rows, the tallest first, and returns the atlas's height. */
static int pack(void) {
    Glyph *order[MAX_GLYPHS];
    int x = 1, y = 1, row = 0;
    for (int i = 0; i < count; i++)
        order[i] = &glyphs[i];
    qsort(order, (size_t)count, sizeof *order, taller);
    for (int i = 0; i < count; i++) {
        if (x + order[i]->width + 1 > WIDTH) {
            x = 1;
            y += row + 1;
            row = 0;
        }
        order[i]->u = x;
        order[i]->v = y;
        x += order[i]->width + 1;
        row = order[i]->height > row ? order[i]->height : row;
    }
    if (y + row + 1 > MAX_HEIGHT)
        fail("the glyphs do not fit");
    return (y + row + 1 + 3) / 4 * 4;
}

static void writeGlyphs(FILE *out) {
    fprintf(out, "static const RGlyph glyphs[] = {\n");
    for (int i = 0; i < count; i++) {
        const Glyph *g = &glyphs[i];
        const double right = g->left + (float)g->width, bottom = g->top + (float)g->height;
        fprintf(out, "    {0x%x, %.6ff, %.6ff, %.6ff, %.6ff, %.6ff, %d, %d, %d, %d},\n", g->code, (double)g->left / EM,
                (double)g->top / EM, right / EM, bottom / EM, (double)g->advance / EM, g->u, g->v, g->u + g->width,
                g->v + g->height);
    }
    fprintf(out, "};\n\n");
}

static void writeAtlas(FILE *out, int height) {
    uint8_t *atlas = allocate((size_t)(WIDTH * height), 1);
    for (int i = 0; i < count; i++)
        for (int y = 0; y < glyphs[i].height; y++)
            memcpy(atlas + (glyphs[i].v + y) * WIDTH + glyphs[i].u, glyphs[i].pixels + y * glyphs[i].width,
                   (size_t)glyphs[i].width);
    fprintf(out, "static const uint8_t distance[%d * %d] = {", WIDTH, height);
    for (int i = 0; i < WIDTH * height; i++)
        fprintf(out, "%s%d,", i % 32 ? "" : "\n", atlas[i]);
    fprintf(out, "\n};\n\n");
    free(atlas);
}

int main(int argc, char **argv) {
    FT_Library library = NULL;
    FT_Face face = NULL;
    if (argc != 3)
        fail("usage: bake_font FONT.ttf OUTPUT.c");
    if (FT_Init_FreeType(&library) || FT_New_Face(library, argv[1], 0, &face))
        fail("the font cannot be read");
    if (FT_Set_Pixel_Sizes(face, 0, EM * SCALE))
        fail("the font cannot be scaled");
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++)
        for (unsigned code = ranges[i].first; code <= ranges[i].last; code++)
            bakeGlyph(face, code);
    const int height = pack();
    FILE *out = fopen(argv[2], "w");
    if (!out)
        fail("the output cannot be written");
    fprintf(out, "/* Made from %s %s by bake_font. Not to be edited. */\n#include \"r_font_i.h\"\n\n",
            face->family_name, face->style_name);
    writeGlyphs(out);
    writeAtlas(out, height);
    fprintf(out, "const RFont r_font = {%d, %d, %d, %d, %.6ff, %.6ff, %d, glyphs, distance};\n", WIDTH, height, EM,
            SPREAD, (double)face->ascender / face->units_per_EM, -(double)face->descender / face->units_per_EM, count);
    if (fclose(out))
        fail("the output cannot be written");
    for (int i = 0; i < count; i++)
        free(glyphs[i].pixels);
    FT_Done_Face(face);
    FT_Done_FreeType(library);
    return EXIT_SUCCESS;
}
