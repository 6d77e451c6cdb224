/* Models, bodies, geometries, worlds and universes that end in an order that nobody planned. */
#include "Mst.h"
#include "karma_test.h"

static MeMatrix4 identity = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

static MstUniverseID makeUniverse(void) {
    const MstUniverseID u = MstUniverseCreate(0);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    return u;
}

static McdModelID makeBall(MstUniverseID u, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    McdModelDynamicsSetPosition(m, 0, 0, z);
    return m;
}

static double heightOf(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[2];
}

static void run(MstUniverseID u, int steps) {
    for (int i = 0; i < steps; i++)
        MstUniverseStep(u, 1. / 60);
}

static int countEvents(MstUniverseID u, MstEventKind kind) {
    int count, found = 0;
    const MstEvent *event = MstUniverseGetEvents(u, &count);
    for (int i = 0; i < count; i++)
        found += event[i].kind == kind;
    return found;
}

/* It went on colliding: as a ghost while it had not touched yet, and by the contacts that it had. */
TEST(what_stands_on_a_destroyed_floor_falls) {
    for (int touches = 0; touches < 2; touches++) {
        const MstUniverseID u = makeUniverse();
        const McdModelID floor = MstFixedModelCreate(u, McdPlaneCreate(u->frame), identity);
        const McdModelID ball = makeBall(u, touches ? .5 : 2);
        run(u, 10);
        McdModelDestroy(floor);
        run(u, 1);
        ck_assert_int_eq(countEvents(u, MstEventEnd), touches);
        const double before = heightOf(ball);
        run(u, 59);
        assert_below(heightOf(ball), before - 4);
        MstUniverseDestroy(u);
    }
}

TEST(a_destroyed_ball_leaves_nothing_with_the_world) {
    const MstUniverseID u = makeUniverse();
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), identity);
    const McdModelID ball = makeBall(u, .5);
    const MdtBodyID body = McdModelGetBody(ball);
    run(u, 10);
    ck_assert_ptr_nonnull(MdtBodyGetFirstConstraint(body));
    McdModelDestroy(ball);
    ck_assert_ptr_null(MdtBodyGetFirstConstraint(body));
    ck_assert_ptr_null(MdtBodyGetModel(body));
    run(u, 10);
    MstUniverseDestroy(u);
}

TEST(all_may_go_after_their_universe) {
    const MstUniverseID u = makeUniverse();
    const McdGeometryID plane = McdPlaneCreate(u->frame);
    const McdModelID floor = MstFixedModelCreate(u, plane, identity), ball = makeBall(u, .5);
    const MdtBodyID body = McdModelGetBody(ball);
    run(u, 10);
    MstUniverseDestroy(u);
    MdtBodyDestroy(body);
    McdModelDestroy(ball);
    McdModelDestroy(floor);
    McdPlaneDestroy(plane);
    assert_silent();
    ck_assert(!MdtBodyIsValid(body));
    assert_refused(MstUniverseDestroy, u);
#if KARMA_CHECK
    MstUniverseStep(u, 1);
    assert_warned("MstUniverseStep");
    assert_none(MstUniverseGetWorld, u);
#endif
}

/* The contacts, and what knows of the model, have gone with the world. */
TEST(a_world_may_go_before_its_models) {
    const McdFrameworkID frame = McdInit(0, 10, 0, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    const McdSpaceID space = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    const MdtWorldID world = MdtWorldCreate(5, 20, 1, 1);
    const MstBridgeID bridge = MstBridgeCreate(frame, 5);
    const McdGeometryID plane = McdPlaneCreate(frame), ball = McdSphereCreate(frame, 1);
    const McdModelID floor = McdModelCreate(plane), model = McdModelCreate(ball);
    McdModelSetTransformPtr(floor, identity);
    const MdtBodyID body = MdtBodyCreate(world);
    MdtBodySetPosition(body, 0, 0, 1);
    McdModelSetBody(model, body);
    McdSpaceInsertModel(space, floor);
    McdSpaceInsertModel(space, model);
    McdSpaceUpdateAll(space);
    MstBridgeUpdateContacts(bridge, space, world);
    ck_assert_ptr_nonnull(MdtBodyGetFirstConstraint(body));
    MdtWorldDestroy(world);
    McdModelDestroy(floor);
    McdModelDestroy(model);
    McdSpaceDestroy(space);
    MstBridgeDestroy(bridge);
    McdGeometryDestroy(plane);
    McdTerm(frame);
    assert_warned("1 geometries were left");
    McdSphereDestroy(ball);
    MdtBodyDestroy(body);
}
