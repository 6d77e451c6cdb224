/* The camera: positions from polar coordinates, bounds, axes, projections. */
#include "viewer_test.h"

#include <sys/wait.h>
#include <unistd.h>

static const AcmeVector3 origin = {0, 0, 0};

static const float tolerance = 1e-5f;

TEST(position_is_polar) {
    RRender *rc = make_context("-null");
    const AcmeVector3 at = {1, 2, 3};
    const float views[][3] = {{5, 0, 0}, {5, 1, 0}, {2, 0.3f, 0.7f}, {40, -2.5f, -1.2f}, {1, 3.1f, 1.5f}};
    RCameraSetLookAt(rc, at);
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        const double d = views[i][0], theta = views[i][1], phi = views[i][2];
        AcmeVector3 p, dir, up, look;
        RCameraSetView(rc, views[i][0], views[i][1], views[i][2]);
        RCameraGetPosition(rc, p);
        /* theta anticlockwise from the z axis, seen from above: towards x. phi above the xz plane. */
        assert_vec3_near(p, 1 + d * cos(phi) * sin(theta), 2 + d * sin(phi), 3 + d * cos(phi) * cos(theta), 1e-4);
        RCameraGetLookDir(rc, dir);
        assert_vec3_near(dir, -cos(phi) * sin(theta), -sin(phi), -cos(phi) * cos(theta), tolerance);
        RCameraGetUp(rc, up);
        assert_near(dir[0] * up[0] + dir[1] * up[1] + dir[2] * up[2], 0, tolerance);
        assert_near(up[1], cos(phi), tolerance);
        RCameraGetLookAt(rc, look);
        assert_vec3_near(look, 1, 2, 3, 0);
    }
    RRenderContextDestroy(rc);
}

/* Programs zoom and turn relative to the view that they find. */
TEST(the_view_that_a_program_finds) {
    RRender *rc = make_context("-null");
    AcmeVector3 at, eye;
    assert_near(RCameraGetDistance(rc), 15, 0);
    assert_near(RCameraGetRotation(rc), 0, 0);
    assert_near(RCameraGetElevation(rc), 0, 0);
    RCameraGetLookAt(rc, at);
    assert_vec3_near(at, 0, 0, 1, 0);
    RCameraZoom(rc, -10);
    RCameraGetPosition(rc, eye);
    assert_vec3_near(eye, 0, 0, 6, tolerance);
    RRenderContextDestroy(rc);
}

/* Whether a point is in the picture. */
static int isSeen(const RRender *rc, double x, double y, double z) {
    double c[3];
    for (int j = 0; j < 3; j++)
        c[j] = x * rc->m_CameraMatrix[0][j] + y * rc->m_CameraMatrix[1][j] + z * rc->m_CameraMatrix[2][j] +
               rc->m_CameraMatrix[3][j];
    const double half = tan(rc->m_CameraFov / 2) * -c[2];
    return c[2] < 0 && fabs(c[1]) < half && fabs(c[0]) < half;
}

static int wantsDefault;

/* Leaves the program with 0 if the camera is as it should be. */
static void MEAPI look(RRender *rc) {
    const int isDefault = RCameraGetElevation(rc) == 0;
    const int sees = isSeen(rc, 0, 11, 0) && isSeen(rc, 0, 0, 0) && RCameraGetElevation(rc) > .1f;
    _exit(wantsDefault ? !isDefault : !sees);
}

/* The Dynamics guide's Drop sets no camera: a ball that starts 10 m above the ground. What a program sets is left. */
TEST(a_camera_that_nobody_sets_sees_the_scene) {
    for (int k = 0; k < 2; k++) {
        const pid_t child = fork();
        int status = 0;
        if (child == 0) {
            static MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 10, 0, 1}};
            RRender *rc = make_context("-null -frames 3");
            RGraphicSphereCreate(rc, 1, RED, tm);
            RGraphicGroundPlaneCreate(rc, 24, 2, WHITE, 0);
            wantsDefault = k;
            if (wantsDefault)
                RCameraZoom(rc, 1);
            RRun(rc, look);
        }
        ck_assert_int_eq(waitpid(child, &status, 0), child);
        ck_assert(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
}

TEST(increments_and_bounds) {
    RRender *rc = make_context("-null");
    RCameraSetView(rc, 5, 1, 0.5f);
    RCameraZoom(rc, 2);
    RCameraRotateAngle(rc, 0.25f);
    RCameraRotateElevation(rc, -0.25f);
    assert_near(RCameraGetDistance(rc), 7, tolerance);
    assert_near(RCameraGetRotation(rc), 1.25, tolerance);
    assert_near(RCameraGetElevation(rc), 0.25, tolerance);
    RCameraZoom(rc, -100);
    assert_near(RCameraGetDistance(rc), 0.01f, 0);
    RCameraSetOffset(rc, -3);
    assert_near(RCameraGetDistance(rc), 0.01f, 0);
    RCameraRotateElevation(rc, 10);
    assert_near(RCameraGetElevation(rc), acos(-1) / 2, tolerance);
    RCameraSetElevation(rc, -10);
    assert_near(RCameraGetElevation(rc), -acos(-1) / 2, tolerance);
    RCameraSetRotation(rc, 4); /* Beyond pi: comes out on the other side. */
    assert_near(RCameraGetRotation(rc), 4 - 2 * acos(-1), tolerance);
    RRenderContextDestroy(rc);
}

TEST(looking_straight_down_has_an_up) {
    RRender *rc = make_context("-null");
    AcmeVector3 up;
    RCameraSetView(rc, 5, 0, 10);
    RCameraGetUp(rc, up);
    assert_vec3_near(up, 0, 0, -1, 1e-6);
    RRenderContextDestroy(rc);
}

TEST(written_members_count_after_update) {
    RRender *rc = make_context("-null");
    AcmeVector3 p;
    RCameraSetLookAt(rc, origin);
    RCameraSetView(rc, 5, 0, 0);
    rc->m_CameraLookAt[0] = 7;
    rc->m_CameraDist = 2;
    RCameraGetPosition(rc, p);
    assert_vec3_near(p, 0, 0, 5, tolerance);
    RCameraUpdate(rc);
    RCameraGetPosition(rc, p);
    assert_vec3_near(p, 7, 0, 2, tolerance);
    rc->m_CameraDist = NAN;
    RCameraUpdate(rc);
    assert_warned("m_CameraDist");
    RRenderContextDestroy(rc);
}

TEST(panning_goes_along_the_cameras_axes) {
    RRender *rc = make_context("-null");
    AcmeVector3 at;
    RCameraSetLookAt(rc, origin);
    RCameraSetView(rc, 5, (float)acos(-1) / 2, 0); /* From +x: right is -z, up is y. */
    RCameraPanX(rc, 2);
    RCameraPanY(rc, 3);
    RCameraPanZ(rc, 4);
    RCameraGetLookAt(rc, at);
    assert_vec3_near(at, 4, 3, -2, tolerance);
    RRenderContextDestroy(rc);
}

TEST(from_two_points) {
    RRender *rc = make_context("-null");
    const MeVector3 at = {1, 1, 1}, from = {1 + 3, 1 + 12, 1 + 4};
    AcmeVector3 p;
    RCameraSetLookAtAndPosition(rc, at, from);
    RCameraGetPosition(rc, p);
    assert_vec3_near(p, 4, 13, 5, 1e-4);
    assert_near(RCameraGetDistance(rc), 13, 1e-4);
    assert_near(RCameraGetRotation(rc), atan2(3, 4), tolerance);
    RRenderContextDestroy(rc);
}

/* A point through the two matrices, to -1..1. */
static void project(const RRender *rc, const double p[3], double out[3]) {
    double eye[4], clip[4];
    for (int j = 0; j < 4; j++) {
        eye[j] = (double)rc->m_CameraMatrix[3][j];
        for (int i = 0; i < 3; i++)
            eye[j] += p[i] * (double)rc->m_CameraMatrix[i][j];
    }
    for (int j = 0; j < 4; j++) {
        clip[j] = 0;
        for (int i = 0; i < 4; i++)
            clip[j] += eye[i] * (double)rc->m_ProjectionMatrix[i][j];
    }
    for (int j = 0; j < 3; j++)
        out[j] = clip[j] / clip[3];
}

TEST(matrices_project) {
    RRender *rc = make_context("-null -size 800x400");
    double p[3];
    RCameraSetLookAt(rc, origin);
    RCameraSetView(rc, 10, 0, 0);
    RCameraSetFov(rc, 1);
    RRenderUpdateProjectionMatrices(rc);
    project(rc, (const double[3]){0, 0, 0}, p);
    assert_near(p[0], 0, tolerance);
    assert_near(p[1], 0, tolerance);
    /* The window's upper edge is tan(fov / 2) above the middle at distance 1; it is twice as wide as high. */
    project(rc, (const double[3]){0, 10 * tan(0.5), 0}, p);
    assert_near(p[1], 1, tolerance);
    project(rc, (const double[3]){20 * tan(0.5), 0, 0}, p);
    assert_near(p[0], 1, tolerance);
    RRenderContextDestroy(rc);
}

TEST(orthographic_views) {
    RRender *rc = make_context("-null -size 400x400");
    double p[3];
    RCameraSetLookAt(rc, origin);
    RCameraSetTopView(rc, 8, 50);
    RRenderUpdateProjectionMatrices(rc);
    project(rc, (const double[3]){4, 3, 0}, p); /* At the right edge, whatever the height. */
    assert_near(p[0], 1, tolerance);
    assert_near(p[1], 0, tolerance);
    project(rc, (const double[3]){0, -20, -4}, p); /* -z is up. */
    assert_near(p[1], 1, tolerance);
    ck_assert(fabs(p[2]) < 1);
    RCameraSetLeftView(rc, 8, 50);
    RRenderUpdateProjectionMatrices(rc);
    project(rc, (const double[3]){0, 0, 4}, p); /* From -x, z is to the right. */
    assert_near(p[0], 1, tolerance);
    RCameraSetFov(rc, 0.7f);
    RRenderUpdateProjectionMatrices(rc);
    assert_near(rc->m_ProjectionMatrix[2][3], -1, 0);
    RRenderContextDestroy(rc);
}

TEST(own_matrix) {
    RRender *rc = make_context("-null");
    MeMatrix4 m = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {-1, -2, -30, 1}};
    AcmeVector3 p;
    RCameraSetMatrix(rc, m);
    RCameraGetPosition(rc, p);
    assert_vec3_near(p, 1, 2, 30, 0);
    RCameraGetLookDir(rc, p);
    assert_vec3_near(p, 0, 0, -1, 0);
    RRenderContextDestroy(rc);
}

TEST(portal_coordinates) {
    RRender *rc = make_context("-null -size 400x200");
    AcmeReal x, y;
    RCalculatePortalCoordinates(rc, 4, 2, 200, 100, &x, &y);
    assert_near(x, 0, 0);
    assert_near(y, 0, 0);
    RCalculatePortalCoordinates(rc, 4, 2, 0, 0, &x, &y);
    assert_near(x, -2, 0);
    assert_near(y, 1, 0);
    RRenderContextDestroy(rc);
}

TEST(bad_input) {
    RRender *rc = make_context("-null");
    AcmeVector3 p = {7, 7, 7}, bad = {0, NAN, 0};
    AcmeReal x;
    assert_refused(RCameraSetLookAt, rc, bad);
    RCameraSetView(rc, INFINITY, 0, 0);
    assert_warned("dist");
    RCameraSetFov(rc, 0);
    assert_warned("fov");
    RCameraSetFov(rc, 4);
    assert_warned("fov");
    RCameraSetOrthographicView(rc, -1, 5);
    assert_warned("zoomFactor");
    RCameraSetFrontView(rc, 1, 0);
    assert_warned("viewDepth");
    assert_refused(RCameraGetPosition, NULL, p);
    assert_vec3_near(p, 7, 7, 7, 0);
    RCameraPanX(rc, NAN);
    assert_warned("dist");
    assert_refused(RCameraSetMatrix, rc, NULL);
    RCalculatePortalCoordinates(rc, 1, 1, 0, 0, &x, NULL);
    assert_warned("portaly");
    ck_assert(RCameraGetDistance(NULL) == 0);
    assert_warned("null");
    RCameraGetPosition(rc, p);
    assert_near(p[2], 16, 1e-5);
    RRenderContextDestroy(rc);
}
