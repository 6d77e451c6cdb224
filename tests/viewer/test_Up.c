/* The up axis: a scene and its copy that is turned, with the up axis turned too, give the same picture. */
#include "viewer_test.h"

#include "r_i.h"

typedef double Turn[3][3]; /* world = columns . upright */

static RRender *rc;

/* The shortest turn from y to a unit vector, by Rodrigues' formula. */
static void shortestTurn(const double up[3], Turn turn) {
    const double angle = acos(up[1]), sine = sin(angle), k[3] = {up[2] / sine, 0, -up[0] / sine};
    for (int j = 0; j < 3; j++) {
        const double e[3] = {j == 0, j == 1, j == 2};
        const double cross[3] = {k[1] * e[2] - k[2] * e[1], k[2] * e[0] - k[0] * e[2], k[0] * e[1] - k[1] * e[0]};
        for (int i = 0; i < 3; i++)
            turn[i][j] = e[i] * cos(angle) + cross[i] * sine + k[i] * k[j] * (1 - cos(angle));
    }
}

static void turned(Turn turn, double x, double y, double z, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = turn[i][0] * x + turn[i][1] * y + turn[i][2] * z;
}

static void place(Turn turn, MeMatrix4 tm, double x, double y, double z) {
    double v[3];
    memset(tm, 0, sizeof(MeMatrix4));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tm[j][i] = (MeReal)turn[i][j];
    turned(turn, x, y, z, v);
    for (int i = 0; i < 3; i++)
        tm[3][i] = (MeReal)v[i];
    tm[3][3] = 1;
}

static void vector(Turn turn, double x, double y, double z, AcmeReal out[3]) {
    double v[3];
    turned(turn, x, y, z, v);
    for (int i = 0; i < 3; i++)
        out[i] = (AcmeReal)v[i];
}

/* Ground, sky, a solid and a see-through body, a lamp, lines of both kinds, a particle; read after a frame. */
static RPicture shootScene(const double up[3], Turn turn) {
    static MeMatrix4 box, ball;
    AcmeVector3 at, from, to;
    MeVector3 particle[1];
    rc = make_context("-osmesa -size 320x240");
    RGraphicGroundPlaneCreate(rc, 24, 2, WHITE, 0.25f); /* Before the axis is chosen: it follows. */
    RRenderSkydomeCreate(rc, "checkerboard", 2, 1);
    RCameraSetUp(rc, (AcmeReal)(3 * up[0]), (AcmeReal)(3 * up[1]), (AcmeReal)(3 * up[2]));
    vector(turn, 0.3, 0.5, -0.2, at);
    RCameraSetLookAt(rc, at);
    RCameraSetView(rc, 9, 2.46f, 0.4f);
    place(turn, box, 1, 0.9, 0.5);
    place(turn, ball, -1, 1.4, 0);
    RGraphicBoxCreate(rc, 1, 1.3f, 2, RED, box);
    RGraphicSphereCreate(rc, 1, (const float[4]){0.1f, 0.3f, 0.8f, 0.6f}, ball);
    vector(turn, -3, 0.5, 1, from);
    vector(turn, 3, 2, 1, to);
    RNLineCreate(rc, from, to, GREEN, NULL);
    RGraphic *wires = RGraphicBoxCreate(rc, 0.5f, 0.5f, 3, GREEN, box);
    RGraphicSetWireframe(wires, 1);
    vector(turn, 0, 2.6, 1, from);
    for (int i = 0; i < 3; i++)
        particle[0][i] = (MeReal)from[i];
    RParticleSystemCreate(rc, 1, particle, NULL, WHITE, 0.4f);
    vector(turn, 2, 3, 2, rc->m_PointLight.m_Position);
    RLightSwitchOn(rc, kRPoint);
    RPicture p;
    r_frame(rc, NULL);
    r_drawNow(rc);
    ck_assert(r_drawRead(rc, &p));
    RRenderContextDestroy(rc);
    return p;
}

/* Pixels with a channel that differs by more than so many levels. */
static int differing(const RPicture *p, const RPicture *q, int levels) {
    int n = 0;
    for (int i = 0; i < p->width * p->height; i++) {
        int max = 0;
        for (int k = 0; k < 3; k++)
            max =
                abs(p->rgba[4 * i + k] - q->rgba[4 * i + k]) > max ? abs(p->rgba[4 * i + k] - q->rgba[4 * i + k]) : max;
        n += max > levels;
    }
    return n;
}

/* Rounding moves outlines, the shadow's texels and the checker's edges by less than a sample; so does a single pixel
 * here and there. */
TEST(a_turned_scene_gives_the_same_picture) {
    static const double axes[][3] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {0.6, 0, 0.8}, {0.48, 0.6, 0.64}};
    static const int max[] = {0, 0, 0, 8, 8};
    Turn none = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    RPicture expected = shootScene((const double[3]){0, 1, 0}, none);
    for (int i = 0; i < 5; i++) {
        Turn turn;
        shortestTurn(axes[i], turn);
        RPicture p = shootScene(axes[i], turn);
        const int n = differing(&expected, &p, 1);
        ck_assert_msg(n <= max[i], "up %g %g %g: %d pixels differ", axes[i][0], axes[i][1], axes[i][2], n);
        r_free(p.rgba);
    }
    /* And the axis matters. */
    RPicture p = shootScene((const double[3]){0, 0, 1}, none);
    ck_assert_int_gt(differing(&expected, &p, 1), expected.width * expected.height / 2);
    r_free(p.rgba);
    r_free(expected.rgba);
}

TEST(angles_and_drags_go_about_the_axis) {
    AcmeVector3 at = {1, 2, 3}, eye, up, moved;
    rc = make_context("-null");
    RCameraSetUp(rc, 0, 0, 2);
    RCameraSetLookAt(rc, at);
    for (int i = 0; i < 8; i++) {
        const double theta = 0.7 * i, phi = 0.4;
        RCameraSetView(rc, 5, (AcmeReal)theta, (AcmeReal)phi);
        RCameraGetPosition(rc, eye);
        assert_vec3_near(eye, 1 + 5 * cos(phi) * sin(theta), 2 - 5 * cos(phi) * cos(theta), 3 + 5 * sin(phi), 1e-5);
        RCameraGetUp(rc, up);
        assert_near(up[2], cos(phi), 1e-6);
    }
    RCameraSetView(rc, 5, 0, 0);
    RCameraPanX(rc, 2);
    RCameraPanY(rc, 3);
    RCameraGetLookAt(rc, moved);
    assert_vec3_near(moved, 3, 2, 6, 1e-5);
    /* Dragging to the right turns the camera about the axis, at the same height. */
    r_post(rc, (REvent){.kind = rMouseDown, .which = kRLeftButton, .x = 100, .y = 100});
    r_post(rc, (REvent){.kind = rMouseMove, .x = 160, .y = 100});
    r_post(rc, (REvent){.kind = rMouseUp, .which = kRLeftButton, .x = 160, .y = 100});
    r_frame(rc, NULL);
    RCameraGetPosition(rc, eye);
    assert_near(eye[2], 6, 1e-5);
    assert_below(eye[0], 3 - 0.3);
    RRenderContextDestroy(rc);
}

/* A position gives the angles that give the position, with any axis. */
TEST(positions_and_angles) {
    static const AcmeReal axes[][3] = {{0, 1, 0},  {0, 0, 1},      {1, 0, 0},     {0, -1, 0},      {0, 0, -1},
                                       {-1, 0, 0}, {1e-30f, 0, 0}, {1e30f, 0, 0}, {1, -1e-7f, -1}, {.3f, -.9f, .2f}};
    const MeVector3 at = {1, 2, 3}, from = {-2, 4, 8};
    rc = make_context("-null");
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; i++) {
        AcmeVector3 eye, dir;
        AcmeReal theta = 9, phi = 9, m[3][3];
        RCameraSetUp(rc, axes[i][0], axes[i][1], axes[i][2]);
        RCameraSetLookAtAndPosition(rc, at, from);
        RCameraGetPosition(rc, eye);
        assert_vec3_near(eye, -2, 4, 8, 1e-5);
        RCameraFindAngles(rc, (const AcmeVector3){-3, 2, 5}, &theta, &phi);
        assert_near(theta, RCameraGetRotation(rc), 1e-6);
        assert_near(phi, RCameraGetElevation(rc), 1e-6);
        RCameraSetElevation(rc, acos(-1) / 2); /* From above one looks along the axis. */
        RCameraGetLookDir(rc, dir);
        const double length = sqrt(pow(axes[i][0], 2) + pow(axes[i][1], 2) + pow(axes[i][2], 2));
        AcmeVector3 axis;
        RCameraGetUpAxis(rc, axis);
        assert_vec3_near(axis, -dir[0], -dir[1], -dir[2], 1e-6);
        assert_vec3_near(dir, -axes[i][0] / length, -axes[i][1] / length, -axes[i][2] / length, 1e-6);
        memcpy(m, rc->m_pViewer->camera.upright, sizeof m); /* A rotation. */
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                assert_near(m[a][0] * m[b][0] + m[a][1] * m[b][1] + m[a][2] * m[b][2], a == b, 1e-6);
        assert_near(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                        m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                        m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]),
                    1, 1e-6);
    }
    RRenderContextDestroy(rc);
}

TEST(bad_axes_change_nothing) {
    AcmeVector3 up;
    AcmeReal theta = 1, phi = 2;
    rc = make_context("-null");
    assert_refused(RCameraSetUp, rc, 0, 0, 0);
    assert_refused(RCameraSetUp, rc, 0, NAN, 0);
    assert_refused(RCameraSetUp, NULL, 0, 0, 1);
    assert_refused(RCameraGetUpAxis, rc, NULL);
    assert_refused(RCameraFindAngles, rc, (const AcmeVector3){NAN, 0, 0}, &theta, &phi);
    assert_refused(RCameraFindAngles, rc, (const AcmeVector3){1, 0, 0}, NULL, &phi);
    RCameraFindAngles(rc, (const AcmeVector3){0, 0, 0}, &theta, &phi); /* No direction: they stay. */
    ck_assert(theta == 1 && phi == 2);
    RCameraGetUp(rc, up);
    assert_vec3_near(up, 0, 1, 0, 0);
    RRenderContextDestroy(rc);
}
