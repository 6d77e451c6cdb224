/* What a program forgets, or gets wrong without an error: it is told once, with what to call. */
#include "universe.h"

static void begin(void) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.8);
    universe_addFloor();
}

static void step(int n) {
    universe_step(n);
}

static McdModelID addBox(double x, double z) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), 1000);
    McdModelDynamicsSetPosition(m, x, 0, z);
    return m;
}

/* One that is never enabled; not one that was, nor one that has no bodies yet. */
TEST(a_motor_on_a_joint_that_is_not_enabled) {
    for (int way = 0; way < 4; way++) {
        begin();
        MdtHingeID j = MdtHingeCreate(u->world);
        if (way != 3)
            MdtHingeSetBodies(j, McdModelGetBody(addBox(0, 5)), 0);
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), 1, 50);
        if (way == 1 || way == 2)
            MdtHingeEnable(j);
        if (way == 2)
            MdtHingeDisable(j);
        step(130);
        if (way == 0)
            assert_warned("MdtHingeEnable");
        step(130);
        assert_silent();
    }
}

static McdModelID addHammer(void) {
    static MeMatrix4 tm[2];
    McdAggregateID a = McdAggregateCreate(u->frame, 2);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(tm[i]);
        tm[i][3][0] = (MeReal)i;
        McdAggregateAddElement(a, McdBoxCreate(u->frame, i ? (MeReal).4 : 2, .2, .2), tm[i]);
    }
    McdModelID m = MstModelAndBodyCreate(u, a, 1000);
    McdModelDynamicsSetPosition(m, 0, 0, 3);
    return m;
}

/* A hammer; not a cone, whose origin is its centre of mass. */
TEST(a_centre_of_mass_that_is_elsewhere) {
    for (int way = 0; way < 4; way++) {
        const MeVector3 centre = {.1, 0, 0};
        begin();
        McdModelID m = way == 3 ? MstModelAndBodyCreate(u, McdConeCreate(u->frame, 1, 1), 1000) : addHammer();
        McdModelDynamicsSetPosition(m, 0, 0, 3);
        if (way == 1)
            MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(m), centre);
        step(1);
        if (way == 0 || way == 2)
            assert_warned("MdtBodySetCenterOfMassRelativePosition");
        if (way == 2)
            addHammer();
        step(20);
        assert_silent(); /* once a world */
    }
}

/* Of the model that it belongs to, and what is to be done about it. */
TEST(a_matrix_that_is_none_any_more) {
    static MeMatrix4 tm;
    begin();
    MeMatrix4TMMakeIdentity(tm);
    McdModelID m = MstFixedModelCreate(u, McdBoxCreate(u->frame, 1, 1, 1), tm);
    McdSpaceUnfreezeModel(m);
    step(1);
    tm[3][2] = (MeReal)NAN;
    step(1);
    assert_warned("number 2, a Box) or box is not finite");
    step(10);
}

/* Rays, casts and overlaps meet no sensors, unless the program says so. */
TEST(queries_meet_sensors_if_they_are_asked_to) {
    static MeMatrix4 tm;
    begin();
    MeMatrix4TMMakeIdentity(tm);
    tm[3][2] = 5;
    McdModelID gate = MstFixedModelCreate(u, McdBoxCreate(u->frame, 2, 2, 2), tm), list[4];
    McdModelSetSensor(gate, METRUE);
    McdSpaceEndChanges(u->space);
    const MeVector3 from = {0, 0, 10}, down = {0, 0, -20}, low = {-1, -1, 4}, high = {1, 1, 6};
    for (int on = 0; on < 2; on++) {
        McdCastResult hit;
        McdClosestResult closest;
        McdSpaceSetQuerySensors(u->space, on);
        ck_assert_int_eq(McdSpaceGetQuerySensors(u->space) != 0, on);
        ck_assert(McdSpaceCastRay(u->space, from, down, 0, 0, &hit));
        ck_assert((hit.model == gate) == on);
        ck_assert_int_eq(McdSpaceOverlapBox(u->space, low, high, 0, 0, list, 4), on);
        ck_assert_int_eq(McdSpaceGetClosest(u->space, McdSphereCreate(u->frame, 1), tm, 1, 0, 0, &closest), on);
    }
    McdSpaceBeginChanges(u->space);
}

/* A bridge collides the spaces of its framework that are no other bridge's, and nothing else. */
TEST(a_space_that_a_bridge_may_not_collide) {
    begin();
    addBox(0, .5);
    MstUniverseID other = MstUniverseCreate(&MstUniverseGrowingSizes);
    MstBridgeID second = MstBridgeCreate(u->frame, 2);
    McdSpaceID own = McdSpaceAxisSortCreate(u->frame, McdAllAxes, 4, 4);
    step(2);
    assert_silent();
    MstBridgeUpdateContacts(second, u->space, u->world);
    assert_warned("MstBridgeUpdateContacts: the space is another bridge's");
    MstBridgeUpdateTransitions(other->bridge, u->space, u->world);
    assert_warned("MstBridgeUpdateTransitions: the space is of another framework");
    MstBridgeUpdateContacts(second, own, u->world);
    assert_silent();
    McdSpaceDestroy(own);
    MstBridgeUpdateContacts(second, own, u->world);
    assert_warned("MstBridgeUpdateContacts: s is no space, or one that is destroyed");
    MstBridgeUpdateContacts(second, NULL, u->world);
    assert_warned("MstBridgeUpdateContacts: s is null");
    MstBridgeDestroy(second);
    MstUniverseDestroy(other);
}
