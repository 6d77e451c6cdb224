/* The twelve scenes (twelve.h). */
#include "twelve.h"
#include "ragdoll.h"
#include <string.h>

static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};

/* ---- parts ------------------------------------------------------------------------------------------------------- */

double twelve_random(unsigned int *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) / (1 << 24);
}

/* Never twice among the arguments of one call, whose order is the compiler's. */
static double between(Place *p, double low, double high) {
    return twelve_random(&p->seed, low, high);
}

static McdModelID put(Place *p, McdGeometryID g, double density, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(p->u, g, density);
    McdModelDynamicsSetPosition(m, p->x + x, y, p->z + z);
    return p->model[p->count++] = m;
}

static void putFixed(Place *p, McdGeometryID g, double x, double y, double z) {
    MeMatrix4Ptr tm = p->fixedTM[p->numFixed++];
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, p->x + x, y, p->z + z);
    MstFixedModelCreate(p->u, g, tm);
}

static McdGeometryID box(Place *p, double x, double y, double z) {
    return McdBoxCreate(p->u->frame, x, y, z);
}

static McdGeometryID ball(Place *p, double radius) {
    return McdSphereCreate(p->u->frame, radius);
}

/* b null: the world. */
static void joinByBall(Place *p, McdModelID a, McdModelID b, double x, double y, double z) {
    const MdtBSJointID j = MdtBSJointCreate(p->u->world);
    MdtBSJointSetBodies(j, McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtBSJointSetPosition(j, p->x + x, y, p->z + z);
    MdtBSJointEnable(j);
    if (b)
        McdSpaceDisablePair(a, b);
}

/* Across, along z. */
static MdtHingeID joinByHinge(Place *p, McdModelID a, McdModelID b, double x, double y, double z) {
    const MdtHingeID j = MdtHingeCreate(p->u->world);
    MdtHingeSetBodies(j, McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtHingeSetPosition(j, p->x + x, y, p->z + z);
    MdtHingeSetAxis(j, 0, 0, 1);
    MdtHingeEnable(j);
    if (b)
        McdSpaceDisablePair(a, b);
    return j;
}

static void turnAnyHow(Place *p, McdModelID m) {
    MeReal q[4], v[3];
    for (int k = 0; k < 4; k++)
        q[k] = (MeReal)between(p, -1, 1);
    McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
    for (int k = 0; k < 3; k++)
        v[k] = (MeReal)between(p, -3, 3);
    McdModelDynamicsSetLinearVelocity(m, v[0], v[1], v[2]);
}

/* ---- the scenes -------------------------------------------------------------------------------------------------- */

/* Large enough for the fast solver, and for several of its regions. */
static void makeHeap(Place *p) {
    const McdGeometryID g = box(p, 1, .8, .6);
    for (int i = 0; i < 500; i++) {
        const double x = 1.1 * (i % 5) + between(p, 0, .3), z = i / 5 % 5 + between(p, 0, .2);
        turnAnyHow(p, put(p, g, 1, x, .7 + i / 25, z));
    }
}

static void makeRagdolls(Place *p) {
    for (int i = 0; i < 3; i++) {
        const double feet[3] = {p->x + .9 * i, .1 + .8 * i, p->z};
        const double along = between(p, -1, 1), roll = between(p, -3, 3), turn = between(p, -3, 3);
        const double v[3] = {1 - i, 1, along}, w[3] = {roll, turn, 2};
        Doll doll;
        doll_make(&doll, p->u, feet);
        doll_throw(&doll, v, w);
        for (int k = 0; k < DOLL_PARTS; k++)
            p->model[p->count++] = doll.model[k];
    }
}

/* Let go level, a ball of 200 times a link's mass at its end, into a wall. */
static void makeChain(Place *p) {
    const McdGeometryID link = box(p, .2, .05, .05), brick = box(p, .5, .3, .25);
    McdModelID last = 0;
    for (int i = 0; i < 20; i++) {
        const McdModelID m = put(p, link, 1000, .1 + .2 * i, 4.6, 0);
        joinByBall(p, m, last, .2 * i, 4.6, 0);
        last = m;
    }
    joinByBall(p, put(p, ball(p, .3), 900, 4.3, 4.6, 0), last, 4, 4.6, 0);
    for (int i = 0; i < 24; i++)
        put(p, brick, 300, -.6, .15 + .3 * (i / 4), -.6 + .4 * (i % 4));
}

/* A card that stands on its inner lower edge at (x, y) and leans to one side by 25 degrees. */
static void leanCard(Place *p, McdGeometryID card, double x, double y, int side) {
    const double sine = .42261826174069944, cosine = .90630778703664996;         /* of 25 degrees */
    const double halfSine = .21643961393810288, halfCosine = .97629600711993336; /* of half of it */
    const double middle = .2 * sine - .005 * cosine;
    const McdModelID m = put(p, card, 80, x + side * middle, y + .2 * cosine + .005 * sine, 0);
    McdModelDynamicsSetQuaternion(m, halfCosine, 0, 0, -side * halfSine);
}

/* Three storeys of cards that lean on each other, and a ball that comes. */
static void makeCards(Place *p) {
    const McdGeometryID card = box(p, .01, .4, .3), flat = box(p, .3538, .01, .3);
    const double height = .36675, half = .16905, spacing = .3578;
    for (int level = 0; level < 3; level++)
        for (int i = 0; i < 3 - level; i++) {
            const double x = spacing * (i - (2 - level) / 2.), y = level * (height + .01);
            leanCard(p, card, x - half, y, 1);
            leanCard(p, card, x + half, y, -1);
            if (i > 0)
                put(p, flat, 80, x - spacing / 2, y + height + .005, 0);
        }
    McdModelDynamicsSetLinearVelocity(put(p, ball(p, .08), 400, -2.2, .6, 0), 3, 1.5, 0);
}

/* Four wheels with springs, the rear ones driven, over two sills. */
static void makeCar(Place *p) {
    const McdModelID chassis = put(p, box(p, 2, .4, 1), 250, 0, .75, 0);
    const McdGeometryID tyre = ball(p, .4);
    for (int i = 0; i < 4; i++) {
        const double x = i < 2 ? .8 : -.8, z = i % 2 ? .8 : -.8;
        const McdModelID wheel = put(p, tyre, 100, x, .4, z);
        const MdtCarWheelID j = MdtCarWheelCreate(p->u->world);
        MdtCarWheelSetBodies(j, McdModelGetBody(chassis), McdModelGetBody(wheel));
        MdtCarWheelSetPosition(j, p->x + x, .4, p->z + z);
        MdtCarWheelSetSteeringAndHingeAxes(j, 0, 1, 0, 0, 0, -1);
        MdtCarWheelSetSteeringLock(j, METRUE);
        MdtCarWheelSetSuspension(j, 12000, 900, 0, -.2, .2, 0);
        if (i >= 2)
            MdtCarWheelSetHingeLimitedForceMotor(j, 12, 150);
        MdtCarWheelEnable(j);
        McdSpaceDisablePair(chassis, wheel);
    }
    for (int i = 0; i < 2; i++)
        putFixed(p, box(p, .3, .16, 1.2), 2.5 + 2 * i, .08, .6 - 1.2 * i);
}

/* Five balls on rods, one of them pulled aside. */
static void makeCradle(Place *p) {
    const McdGeometryID g = ball(p, .25);
    for (int i = 0; i < 5; i++) {
        const double x = .506 * i;
        const McdModelID m = i > 0 ? put(p, g, 1000, x, .8, 0) : put(p, g, 1000, x - 1.2, 1.2, 0);
        for (int side = -1; side <= 1; side += 2) {
            const MdtSpringID s = MdtSpringCreate(p->u->world);
            MdtSpringSetBodies(s, McdModelGetBody(m), 0);
            MdtSpringSetPosition(s, 0, p->x + (i > 0 ? x : x - 1.2), i > 0 ? .8 : 1.2, p->z);
            MdtSpringSetPosition(s, 1, p->x + x, 2.8, p->z + .5 * side);
            MdtSpringSetNaturalLength(s, 2.0615528128088303); /* the root of 2^2 + .5^2 */
            MdtSpringSetStiffness(s, MEINFINITY);
            MdtSpringEnable(s);
        }
    }
}

/* Balls of up to 500 m/s against a wall of 2 cm. */
static void makeBullets(Place *p) {
    const McdGeometryID g = ball(p, .09);
    putFixed(p, box(p, .02, 3, 4), 0, 1.5, 0);
    for (int i = 0; i < 12; i++) {
        const McdModelID m = put(p, g, 1000, -5 + .05 * i, .6 + .2 * (i * 5 % 8), -1.5 + .25 * i);
        McdModelSetSwept(m, METRUE);
        McdModelDynamicsSetLinearVelocity(m, 60. + 40 * i, 0, 0);
    }
}

/* A square drum, turned by a motor, and boxes in it. */
static void makeTumbler(Place *p) {
    static const double at[6][3] = {{1.6, 0, 0}, {-1.6, 0, 0}, {0, 1.6, 0}, {0, -1.6, 0}, {0, 0, 1.1}, {0, 0, -1.1}};
    static MeMatrix4 part[6]; /* the same in each drum; kept by pointer */
    const McdAggregateID drum = McdAggregateCreate(p->u->frame, 6);
    for (int i = 0; i < 6; i++) {
        const double x = i < 2 ? .2 : 3.4, y = i == 2 || i == 3 ? .2 : 3.4, z = i < 4 ? 2.4 : .2;
        MeMatrix4TMMakeIdentity(part[i]);
        MeMatrix4TMSetPosition(part[i], at[i][0], at[i][1], at[i][2]);
        McdAggregateAddElement(drum, box(p, x, y, z), part[i]);
    }
    const McdModelID m = put(p, drum, 100, 0, 2.6, 0);
    const MdtLimitID drive = MdtHingeGetLimit(joinByHinge(p, m, 0, 0, 2.6, 0));
    MdtLimitSetLimitedForceMotor(drive, 1, 40000);
    MdtLimitActivateMotor(drive, METRUE);
    const McdGeometryID cube = box(p, .4, .4, .4);
    for (int i = 0; i < 27; i++)
        put(p, cube, 300, -.6 + .55 * (i % 3), 1.6 + .5 * (i / 9), -.5 + .5 * (i / 3 % 3));
}

static void makeDominoes(Place *p) {
    const McdGeometryID stone = box(p, .06, .5, .25);
    for (int i = 0; i < 24; i++)
        put(p, stone, 500, .25 * i, .25, .02 * (i * i % 5));
    McdModelDynamicsSetAngularVelocity(p->model[0], 0, 0, -2.5);
}

/* Planks tied to each other at both edges, and to the world at both ends; boxes fall onto it. */
static void makeBridge(Place *p) {
    enum { PLANKS = 12 };
    const McdGeometryID plank = box(p, .45, .08, 1), crate = box(p, .5, .5, .5);
    McdModelID last = 0;
    for (int i = 0; i < PLANKS; i++) {
        const McdModelID m = put(p, plank, 500, .5 * i, 2, 0);
        for (int side = -1; side <= 1; side += 2) {
            joinByBall(p, m, last, .5 * i - .25, 2, .45 * side);
            if (i == PLANKS - 1)
                joinByBall(p, m, 0, .5 * i + .25, 2, .45 * side);
        }
        last = m;
    }
    for (int i = 0; i < 6; i++)
        put(p, crate, 200, .8 + .7 * (i % 6), 2.6 + .3 * i, -.1 + .04 * i);
}

enum { SHAPES = 6 };

static void makeShapes(Place *p, McdGeometryID shape[SHAPES]) {
    static const MeVector3 gem[6] = {{.5, 0, 0}, {-.5, 0, 0}, {0, .5, 0}, {0, -.5, 0}, {0, 0, .5}, {0, 0, -.5}};
    shape[0] = box(p, .8, .5, .6);
    shape[1] = ball(p, .3);
    shape[2] = McdSphylCreate(p->u->frame, .2, .6);
    shape[3] = McdCylinderCreate(p->u->frame, .3, .6);
    shape[4] = McdConeCreate(p->u->frame, .8, .35);
    shape[5] = McdConvexMeshCreateHull(p->u->frame, gem, 6, 0);
}

/* A pile of all shapes, and chains that hang into it. */
static void makeMixed(Place *p) {
    McdGeometryID shape[SHAPES];
    makeShapes(p, shape);
    for (int i = 0; i < 48; i++)
        put(p, shape[i % SHAPES], 500, .9 * (i % 4) + between(p, 0, .1), .5 + .95 * (i / 16), .9 * (i / 4 % 4));
    for (int i = 0; i < 4; i++) {
        McdModelID last = 0;
        for (int k = 0; k < 6; k++) {
            const McdModelID m = put(p, shape[1], 500, .9 * i + .1, 6 - .7 * k, 1.3);
            joinByBall(p, m, last, .9 * i + .1, 6.35 - .7 * k, 1.3);
            last = m;
        }
    }
}

/* Any shape, anywhere, any way round; neighbours joined by any joint, or none. */
static void makeRandom(Place *p) {
    McdGeometryID shape[SHAPES];
    McdModelID last = 0;
    makeShapes(p, shape);
    for (int i = 0; i < 60; i++) {
        const double x = between(p, 0, 6), y = between(p, 1, 6), z = between(p, 0, 4), kind = between(p, 0, 6);
        const double which = between(p, 0, SHAPES), density = between(p, 100, 2000);
        const McdModelID m = put(p, shape[(int)which], density, x, y, z);
        turnAnyHow(p, m);
        if (last && kind < 1)
            joinByBall(p, m, last, x, y, z);
        else if (last && kind < 2)
            joinByHinge(p, m, last, x, y, z);
        else if (last && kind < 3) {
            const MdtSpringID s = MdtSpringCreate(p->u->world);
            MdtSpringSetBodies(s, McdModelGetBody(m), McdModelGetBody(last));
            MdtSpringSetStiffness(s, 2000);
            MdtSpringSetDamping(s, 20);
            MdtSpringEnable(s);
        }
        last = m;
    }
}

const TwelveScene twelve[TWELVE] = {
    {"heap", 12, makeHeap},       {"ragdolls", 8, makeRagdolls}, {"chain", 14, makeChain},
    {"cards", 8, makeCards},      {"car", 60, makeCar},          {"cradle", 8, makeCradle},
    {"bullets", 30, makeBullets}, {"tumbler", 6, makeTumbler},   {"dominoes", 10, makeDominoes},
    {"bridge", 10, makeBridge},   {"mixed", 10, makeMixed},      {"random", 20, makeRandom},
};

/* ---- universes --------------------------------------------------------------------------------------------------- */

MstUniverseID twelve_makeUniverse(void) {
    const MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, -9.81, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, .2);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    return u;
}

void twelve_make(Place *p, const TwelveScene *s, MstUniverseID u, double x, double z) {
    memset(p, 0, sizeof *p);
    p->u = u;
    p->x = x;
    p->z = z;
    p->seed = 1;
    s->make(p);
}

static unsigned int add(unsigned int hash, const void *bytes, size_t size) {
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ byte[i]) * 0x01000193u;
    return hash;
}

unsigned int twelve_state(MdtWorldID w) {
    unsigned int hash = 0x811c9dc5u;
    for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b)) {
        MeVector3 velocity, spin;
        MdtBodyGetLinearVelocity(b, velocity);
        MdtBodyGetAngularVelocity(b, spin);
        hash = add(hash, MdtBodyGetTransformPtr(b), sizeof(MeMatrix4));
        hash = add(add(hash, velocity, sizeof velocity), spin, sizeof spin);
    }
    return hash;
}

MeBool twelve_isFinite(MdtWorldID w) {
    for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b)) {
        MeVector3 at;
        MdtBodyGetPosition(b, at);
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2]))
            return MEFALSE;
    }
    return METRUE;
}
