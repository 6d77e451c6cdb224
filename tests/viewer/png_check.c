/* Looks at PNG pictures:
 *     png_check same A B     are all pixels equal?
 *     png_check near A B     are they equal but for some rounding, and for a small label somewhere?
 *     png_check help A B     does B show a dark panel with light text in its middle, where A does not?
 *     png_check size A WxH   has it this size?
 *     png_check blue A X,Y,R is its strong blue a disc of radius R round the pixel (X, Y)? To a pixel.
 * Says what it found; exit code 0 for yes, 1 for no, 2 if it could not look. */
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int width, height;
    png_bytep rgb;
} Picture;

static Picture readPicture(const char *path) {
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        exit(2);
    }
    image.format = PNG_FORMAT_RGB;
    Picture p = {(int)image.width, (int)image.height, malloc(PNG_IMAGE_SIZE(image))};
    if (!p.rgb || !png_image_finish_read(&image, NULL, p.rgb, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        exit(2);
    }
    return p;
}

static long different(const Picture *a, const Picture *b) {
    long n = 0;
    if (a->width != b->width || a->height != b->height)
        return -1;
    for (long i = 0; i < (long)a->width * a->height; i++)
        n += memcmp(a->rgb + 3 * i, b->rgb + 3 * i, 3) != 0;
    return n;
}

/* At most 3 pixels of 100 differ by more than 8 of 255. */
static int isNear(const Picture *a, const Picture *b) {
    long n = 0;
    for (long i = 0; i < (long)a->width * a->height; i++)
        for (int k = 0, far = 0; k < 3 && !far; k++)
            n += far = abs(a->rgb[3 * i + k] - b->rgb[3 * i + k]) > 8;
    printf("%ld of them clearly\n", n);
    return 100 * n <= 3 * (long)a->width * a->height;
}

/* Fractions of dark and of light pixels in the middle of a picture. */
static void middle(const Picture *p, double *dark, double *light) {
    long n = 0, darks = 0, lights = 0;
    for (int y = p->height / 4; y < 3 * p->height / 4; y++) {
        for (int x = p->width / 3; x < 2 * p->width / 3; x++, n++) {
            const png_bytep c = p->rgb + 3 * ((long)y * p->width + x);
            const int sum = c[0] + c[1] + c[2];
            darks += sum < 240;
            lights += sum > 600;
        }
    }
    *dark = (double)darks / (double)n;
    *light = (double)lights / (double)n;
}

static int isHelp(const Picture *a, const Picture *b) {
    double darkA, lightA, darkB, lightB;
    middle(a, &darkA, &lightA);
    middle(b, &darkB, &lightB);
    printf("in the middle: %.0f%% dark and %.1f%% light; before: %.0f%% and %.1f%%\n", 100 * darkB, 100 * lightB,
           100 * darkA, 100 * lightA);
    return darkB > 0.6 && darkA < 0.4 && lightB > 0.01 && lightB < 0.3;
}

/* The centre and the radius of what is strongly blue: clearly more so than sky and pale things behind glass are. */
static int isBlueDisc(const Picture *p, double x, double y, double r) {
    double n = 0, sx = 0, sy = 0;
    for (int j = 0; j < p->height; j++) {
        for (int i = 0; i < p->width; i++) {
            const png_bytep c = p->rgb + 3 * ((long)j * p->width + i);
            if (5 * c[2] > 13 * c[0] && c[2] > 60) {
                n++;
                sx += i + 0.5;
                sy += j + 0.5;
            }
        }
    }
    const double cx = sx / n, cy = sy / n, radius = sqrt(n / 3.14159265358979);
    printf("blue: %.0f pixels round (%.1f, %.1f), radius %.1f; expected (%.1f, %.1f), %.1f\n", n, cx, cy, radius, x, y,
           r);
    return fabs(cx - x) < 1 && fabs(cy - y) < 1 && fabs(radius - r) < 1;
}

int main(int argc, char **argv) {
    int yes = 0;
    if (argc != 4) {
        fprintf(stderr, "usage: png_check same|near|help|size|blue A B\n");
        return 2;
    }
    Picture a = readPicture(argv[2]);
    if (strcmp(argv[1], "size") == 0) {
        char size[32];
        snprintf(size, sizeof size, "%dx%d", a.width, a.height);
        printf("%s is %s\n", argv[2], size);
        yes = strcmp(size, argv[3]) == 0;
    } else if (strcmp(argv[1], "blue") == 0) {
        double x, y, r;
        yes = sscanf(argv[3], "%lf,%lf,%lf", &x, &y, &r) == 3 && isBlueDisc(&a, x, y, r);
    } else {
        Picture b = readPicture(argv[3]);
        const long n = different(&a, &b);
        printf("%ld pixels differ\n", n);
        if (strcmp(argv[1], "same") == 0)
            yes = n == 0;
        else if (n >= 0) /* Of one size. */
            yes = strcmp(argv[1], "near") == 0 ? isNear(&a, &b) : isHelp(&a, &b);
        free(b.rgb);
    }
    free(a.rgb);
    return yes ? 0 : 1;
}
