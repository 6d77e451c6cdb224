/* Colours, and the debug drawing functions. */
#include "karma_test.h"

#include "MeDebugDraw.h"
#include "MeMisc.h"

static void assertColour(float h, float s, float v, double red, double green, double blue) {
    float rgb[3] = {-1, -1, -1};
    MeHSVtoRGB(h, s, v, rgb);
    assert_vec3_near(rgb, red, green, blue, TOL(2e-7, 9e-16));
}

TEST(corners_of_the_colour_circle) {
    assertColour(0, 1, 1, 1, 0, 0);
    assertColour(60, 1, 1, 1, 1, 0);
    assertColour(120, 1, 1, 0, 1, 0);
    assertColour(180, 1, 1, 0, 1, 1);
    assertColour(240, 1, 1, 0, 0, 1);
    assertColour(300, 1, 1, 1, 0, 1);
}

TEST(colours_in_between) {
    assertColour(30, 1, 1, 1, 0.5, 0);
    assertColour(90, 1, 1, 0.5, 1, 0);
    assertColour(150, 1, 1, 0, 1, 0.5);
    assertColour(210, 1, 1, 0, 0.5, 1);
    assertColour(270, 1, 1, 0.5, 0, 1);
    assertColour(330, 1, 1, 1, 0, 0.5);
    assertColour(30, 0.5f, 0.5f, 0.5, 0.375, 0.25);
}

TEST(grey_white_and_black) {
    for (int h = 0; h < 360; h += 30) {
        assertColour((float)h, 0, 0.25f, 0.25, 0.25, 0.25);
        assertColour((float)h, 1, 0, 0, 0, 0);
    }
    assertColour(77, 0, 1, 1, 1, 1);
}

TEST(hue_goes_round) {
    for (int turn = -2; turn <= 2; turn++) {
        assertColour(360 * (float)turn, 1, 1, 1, 0, 0);
        assertColour(360 * (float)turn + 210, 1, 1, 0, 0.5, 1);
    }
    assertColour(-1e-30f, 1, 1, 1, 0, 0);
}

TEST(numbers_out_of_range) {
    assertColour(120, 7, 7, 0, 1, 0);
    assertColour(120, -1, 1, 1, 1, 1);
    assertColour(120, 1, -1, 0, 0, 0);
    assertColour((float)NAN, 1, 1, 1, 0, 0);
    assertColour((float)INFINITY, 1, 1, 1, 0, 0);
    assertColour(120, (float)NAN, 1, 1, 1, 1);
    assertColour(120, 1, (float)NAN, 0, 0, 0);
}

static int lines;

static void countLine(MeVector3 start, MeVector3 end, MeReal r, MeReal g, MeReal b) {
    lines++;
    ck_assert(start[0] == 1 && end[0] == 4 && r == 1 && g == 0 && b == 0);
}

TEST(lines_are_drawn_by_the_function_in_use) {
    MeVector3 start = {1, 2, 3}, end = {4, 5, 6};
    const MeDebugLineFuncPtr nothing = MeDebugDrawAPI.line;
    ck_assert(nothing != NULL);
    MeDebugDrawAPI.line(start, end, 1, 0, 0);
    MeDebugDrawAPI.line = countLine;
    MeDebugDrawAPI.line(start, end, 1, 0, 0);
    MeDebugDrawAPI.line = nothing;
    ck_assert_int_eq(lines, 1);
}
