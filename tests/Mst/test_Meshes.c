/* Worlds on indexed meshes: as on planes, materials of triangles, sleep and changes, fast bodies, meshes that move. */
#include "McdMesh.h"
#include "universe.h"

#include <math.h>
#include <string.h>

enum { SIDE = 20, VERTICES = (SIDE + 1) * (SIDE + 1), TRIANGLES = 2 * SIDE * SIDE };

static MeMatrix4 place = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
static MeVector3 vertex[VERTICES];
static int index[3 * TRIANGLES];
static McdMeshID mesh;
static McdModelID floorModel;

/* A square of cells a metre wide about the origin. */
static void begin(const MeU32 *materials) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    for (int j = 0, n = 0; j <= SIDE; j++)
        for (int i = 0; i <= SIDE; i++) {
            const int a = j * (SIDE + 1) + i, of[6] = {a, a + 1, a + SIDE + 2, a, a + SIDE + 2, a + SIDE + 1};
            MeVector3Set(vertex[a], (MeReal)(i - SIDE / 2), (MeReal)(j - SIDE / 2), 0);
            if (i < SIDE && j < SIDE) {
                memcpy(index + n, of, sizeof of);
                n += 6;
            }
        }
    mesh = McdMeshCreate(u->frame, (const MeVector3 *)vertex, VERTICES, index, TRIANGLES, materials);
    MeMatrix4TMMakeIdentity(place);
    floorModel = MstFixedModelCreate(u, mesh, place);
}

static McdModelID addBox(double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, .5, .5, .5), 1000);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

static double height(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[2];
}

/* A box, a ball and a stack move as on a plane. */
TEST(bodies_move_as_on_a_plane) {
    MeVector3 end[2][5];
    for (int onPlane = 0; onPlane < 2; onPlane++) {
        McdModelID m[5];
        begin(0);
        if (onPlane) {
            MstFixedModelDestroy(floorModel);
            universe_addFloor();
        }
        for (int i = 0; i < 3; i++)
            m[i] = addBox(-2, .3, .25 + .5 * i);
        m[3] = addBox(-4, 2.2, .25);
        m[4] = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .3), 1000);
        McdModelDynamicsSetPosition(m[4], -4, -2.2, .3);
        McdModelDynamicsSetLinearVelocity(m[3], 3, .5, 0);
        McdModelDynamicsSetLinearVelocity(m[4], 2, .5, 0);
        universe_step(60);
        for (int i = 0; i < 5; i++)
            McdModelDynamicsGetPosition(m[i], end[onPlane][i]);
    }
    for (int i = 0; i < 5; i++)
        assert_vec3_near(end[0][i], end[1][i][0], end[1][i][1], end[1][i][2], TOL(2e-5, 1e-8));
}

/* Ice where x < 0; else a box stops after v^2 / (2 mu g). */
TEST(each_triangle_has_its_material) {
    MeU32 material[TRIANGLES];
    universe_begin(&MstUniverseGrowingSizes);
    const MstMaterialID ice = 1, rubber = 2;
    for (int i = 0; i < TRIANGLES; i++)
        material[i] = i / 2 % SIDE < SIDE / 2 ? ice : rubber;
    begin(material);
    ck_assert_uint_eq(MstBridgeGetNewMaterial(u->bridge), ice);
    ck_assert_uint_eq(MstBridgeGetNewMaterial(u->bridge), rubber);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, ice), 0, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, rubber), .5, 0);
    const McdModelID onIce = addBox(-9, 3.1, .25), onRubber = addBox(2, -3.1, .25);
    MeVector3 p, v;
    McdModelDynamicsSetLinearVelocity(onIce, 3, 0, 0);
    McdModelDynamicsSetLinearVelocity(onRubber, 3, 0, 0);
    universe_step(60);
    McdModelDynamicsGetPosition(onIce, p);
    assert_near(p[0], -6, TOL(1e-4, 1e-8));
    McdModelDynamicsGetPosition(onRubber, p);
    assert_near(p[0], 2 + 9 / (2 * .5 * 10), .03);
    universe_step(240); /* it reaches the rubber, and stops there */
    McdModelDynamicsGetLinearVelocity(onIce, v);
    assert_near(v[0], 0, TOL(1e-4, 1e-6));
    McdModelDynamicsGetPosition(onIce, p);
    ck_assert(p[0] > 0 && p[0] < 1.5);
    /* a change of a material that only triangles have wakes and moves */
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(onRubber)));
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, rubber), 0, 0);
    universe_step(3);
    ck_assert(MdtBodyIsEnabled(McdModelGetBody(onRubber)));
}

/* Sleeping bodies wake when vertices move, fall where the surface has gone, and are lifted where it rises. */
TEST(vertices_that_move_wake_what_lies_on_them) {
    begin(0);
    const McdModelID left = addBox(-5.3, 0, .25), right = addBox(5.3, 0, .25);
    universe_step(180);
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(left)) && !MdtBodyIsEnabled(McdModelGetBody(right)));
    for (int i = 0; i < VERTICES; i++)
        vertex[i][2] = (MeReal)(vertex[i][0] < 0 ? -.5 : .01);
    McdMeshSetVertices(mesh, (const MeVector3 *)vertex);
    universe_step(120);
    assert_near(height(left), -.5 + .25, 2e-3);
    assert_near(height(right), .01 + .25, 2e-3);
    universe_step(120);
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(left)));
}

/* Bodies at up to 1000 m/s onto one thin surface, aslant: none gets through. */
TEST(fast_bodies_do_not_pass) {
    begin(0);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    McdModelID m[12];
    for (int i = 0; i < 12; i++) {
        const double speed = pow(10, i % 4), x = 5 * (i % 3) - 5;
        m[i] = i % 2 ? addBox(0, 0, 0) : MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .1), 1000);
        McdModelDynamicsSetPosition(m[i], x + .13 * i, 1.5 * i - 8, 3);
        McdModelDynamicsSetLinearVelocity(m[i], .3 * speed, .1 * speed, -speed);
        McdModelSetSwept(m[i], METRUE);
    }
    for (int k = 0; k < 60; k++) {
        universe_step(1);
        for (int i = 0; i < 12; i++)
            ck_assert(height(m[i]) > 0);
    }
}

/* A mesh that is moved pushes what lies on it: the surface of a lift. */
TEST(a_mesh_that_moves_lifts) {
    begin(0);
    const McdModelID m = addBox(.3, .3, .25);
    McdSpaceUnfreezeModel(floorModel);
    for (int i = 0; i < 120; i++) {
        place[3][2] += (MeReal)(.5 / 60);
        universe_step(1);
    }
    assert_near(height(m), 1 + .25, .01);
}

/* ---- what queries tell ------------------------------------------------------------------------------------------- */

/* The triangle below a point of the square: the second one of its cell is above the diagonal. */
static int triangleAt(double x, double y) {
    const int i = (int)floor(x + SIDE / 2), j = (int)floor(y + SIDE / 2);
    return 2 * (j * SIDE + i) + (y - floor(y) > x - floor(x));
}

/* Rays and casts, also where one triangle stands for a flat patch: the triangle, its material, the part. */
LOOP_TEST(queries_tell_the_triangle_and_its_material, 0, 2) {
    const MeVector3 down = {0, 0, -4};
    static MeU32 materials[TRIANGLES];
    McdCastResult hit;
    MeMatrix4 from, turned;
    for (int i = 0; i < TRIANGLES; i++)
        materials[i] = (MeU32)(i % 7);
    begin(materials);
    McdGeometryInstanceID part = McdModelGetGeometryInstance(floorModel);
    if (_i == 1) { /* the same as the second part of a compound */
        const McdAggregateID whole = McdAggregateCreate(u->frame, 2);
        MeMatrix4TMMakeIdentity(turned);
        turned[3][2] = -30;
        McdAggregateAddElement(whole, McdBoxCreate(u->frame, 1, 1, 1), turned);
        McdAggregateAddElement(whole, mesh, 0);
        MstFixedModelDestroy(floorModel);
        floorModel = MstFixedModelCreate(u, whole, place);
        part = McdGeometryInstanceGetChild(McdModelGetGeometryInstance(floorModel), 1);
    }
    ck_assert(McdGeometryInstanceGetGeometry(part) == mesh);
    const McdGeometryID ball = McdSphereCreate(u->frame, (MeReal).05);
    McdSpaceEndChanges(u->space);
    for (int n = 0; n < 200; n++) {
        const double x = fmod(n * 7.317, 18) - 9 + .013, y = fmod(n * 3.711, 18) - 9 + .029;
        const MeVector3 start = {(MeReal)x, (MeReal)y, 2};
        if (fabs(fmod(x + 20, 1) - fmod(y + 20, 1)) < .01)
            continue; /* an edge: both triangles are right */
        MeMatrix4TMMakeIdentity(from);
        MeVector3Copy(from[3], start);
        for (int isCast = 0; isCast < 2; isCast++) {
            memset(&hit, 0x55, sizeof hit);
            ck_assert(isCast ? McdSpaceCastGeometry(u->space, ball, from, down, 0, 0, &hit)
                             : McdSpaceCastRay(u->space, start, down, 0, 0, &hit));
            ck_assert(hit.model == floorModel && hit.instance == part);
            ck_assert_int_eq(hit.element.tag, triangleAt(x, y));
            ck_assert_int_eq((int)hit.material, triangleAt(x, y) % 7);
        }
    }
    McdSpaceBeginChanges(u->space);
}

/* A closed mesh falls through a plane; the program hears of it once, and what to do. A kinematic one is right. */
TEST(a_mesh_that_forces_move_is_told_of) {
    static const MeVector3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const int faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    universe_addFloor();
    const McdMeshID solid = McdMeshCreate(u->frame, corner, 4, faces, 4, 0);
    const McdModelID moved = MstModelAndBodyCreateWithCenter(u, solid, 1000);
    MdtBodySetKinematic(McdModelGetBody(moved), METRUE);
    MdtBodySetLinearVelocity(McdModelGetBody(moved), 0, 0, -1);
    universe_step(60);
    assert_silent();
    McdModelID falling = 0;
    for (int i = 0; i < 2; i++) {
        falling = MstModelAndBodyCreateWithCenter(u, solid, 1000);
        McdModelDynamicsSetPosition(falling, 3 + 3. * i, 0, 1);
    }
    universe_step(60);
    ck_assert_int_eq(caught.warnings, 1);
    assert_warned("MdtBodySetKinematic");
    ck_assert(height(falling) < -2);
}
