/* A rag doll as in tutorial Ragdolls, eleven parts, and ten joints with stops or cones: ready to be dropped on a plane,
 * each one in a place of its own. */
#ifndef RAGDOLL_H
#define RAGDOLL_H

#include "Mst.h"
#include <math.h>
#include <string.h>

enum {
    DOLL_PELVIS,
    DOLL_CHEST,
    DOLL_HEAD,
    DOLL_ARMS,
    DOLL_FOREARMS = DOLL_ARMS + 2,
    DOLL_THIGHS = DOLL_FOREARMS + 2,
    DOLL_SHINS = DOLL_THIGHS + 2,
    DOLL_PARTS = DOLL_SHINS + 2
};

/* A box or a ball if its size says so, else a sphyl that hangs down; its middle as the figure stands. */
typedef struct DollPart {
    double x, y, size[3]; /* m: of a box; or a radius, a height (0: a ball), and 0 */
    int above;            /* the part that it is joined to, */
    double jointX, jointY;
    double cone; /* by a ball and socket with a cone, rad; 0: by a hinge */
    double bend; /* of a hinge, rad, the most; negative: forward */
} DollPart;

static const DollPart doll_part[DOLL_PARTS] = {
    {0, 1.02, {.34, .24, .22}, -1, 0, 0, 0, 0},
    {0, 1.38, {.42, .40, .24}, DOLL_PELVIS, 0, 1.16, .6, 0},
    {0, 1.78, {.15, 0, 0}, DOLL_CHEST, 0, 1.60, .6, 0},
    {-.30, 1.36, {.07, .24, 0}, DOLL_CHEST, -.27, 1.52, 1.4, 0},
    {.30, 1.36, {.07, .24, 0}, DOLL_CHEST, .27, 1.52, 1.4, 0},
    {-.30, 1.02, {.06, .24, 0}, DOLL_ARMS, -.30, 1.19, 0, -2.2},
    {.30, 1.02, {.06, .24, 0}, DOLL_ARMS + 1, .30, 1.19, 0, -2.2},
    {-.11, .71, {.09, .32, 0}, DOLL_PELVIS, -.11, .92, 1, 0},
    {.11, .71, {.09, .32, 0}, DOLL_PELVIS, .11, .92, 1, 0},
    {-.11, .26, {.07, .34, 0}, DOLL_THIGHS, -.11, .49, 0, 2.2},
    {.11, .26, {.07, .34, 0}, DOLL_THIGHS + 1, .11, .49, 0, 2.2},
};

typedef struct Doll {
    McdModelID model[DOLL_PARTS];
    MdtConstraintID joint[DOLL_PARTS]; /* of a part to the one above; null: none */
    MdtConeLimitID cone[DOLL_PARTS];   /* beside it, of what is no hinge */
} Doll;

static inline MeBool doll_isSphyl(int i) {
    return !(doll_part[i].size[2] > 0) && doll_part[i].size[1] > 0;
}

static inline McdGeometryID doll_shape(McdFrameworkID frame, int i) {
    const MeReal a = doll_part[i].size[0], b = (MeReal)doll_part[i].size[1], c = (MeReal)doll_part[i].size[2];
    if (c > 0)
        return McdBoxCreate(frame, a, b, c);
    return doll_isSphyl(i) ? McdSphylCreate(frame, a, b) : McdSphereCreate(frame, a);
}

/* The cone of a waist or a neck stands upright; those of limbs hang, forward, and an arm's sideways too. */
static inline MdtConeLimitID doll_addCone(MdtWorldID w, int i, MdtBodyID below, MdtBodyID above) {
    const MdtConeLimitID cone = MdtConeLimitCreate(w);
    const double sideways = i >= DOLL_THIGHS ? 0 : doll_part[i].x > 0 ? .6 : -.6;
    MdtConeLimitSetBodies(cone, below, above);
    MdtConeLimitSetAxes(cone, 0, 1, 0, 1, 0, 0);
    if (i >= DOLL_ARMS) {
        MdtConeLimitBodySetAxes(cone, 0, 0, -1, 0, 1, 0, 0);
        MdtConeLimitBodySetAxes(cone, 1, sideways, -1, .6, 1, 0, 0);
    }
    MdtConeLimitSetConeHalfAngle(cone, doll_part[i].cone);
    MdtConeLimitEnable(cone);
    return cone;
}

static inline MdtConstraintID doll_addSocket(MdtWorldID w, MdtBodyID below, MdtBodyID above, const double at[3]) {
    const MdtBSJointID socket = MdtBSJointCreate(w);
    MdtBSJointSetBodies(socket, below, above);
    MdtBSJointSetPosition(socket, at[0], at[1], at[2]);
    MdtBSJointEnable(socket);
    return MdtBSJointQuaConstraint(socket);
}

static inline void doll_setStop(MdtSingleLimitID stop, double angle) {
    MdtSingleLimitSetStop(stop, angle);
    MdtSingleLimitSetRestitution(stop, 0);
}

/* Across the limb, with stops at straight and at the most that it bends. */
static inline MdtConstraintID doll_addHinge(MdtWorldID w, int i, MdtBodyID below, MdtBodyID above, const double at[3]) {
    const MdtHingeID hinge = MdtHingeCreate(w);
    const MdtLimitID limit = MdtHingeGetLimit(hinge);
    MdtHingeSetBodies(hinge, below, above);
    MdtHingeSetPosition(hinge, at[0], at[1], at[2]);
    MdtHingeSetAxis(hinge, 1, 0, 0);
    doll_setStop(MdtLimitGetLowerLimit(limit), fmin(doll_part[i].bend, 0));
    doll_setStop(MdtLimitGetUpperLimit(limit), fmax(doll_part[i].bend, 0));
    MdtLimitActivateLimits(limit, METRUE);
    MdtHingeEnable(hinge);
    return MdtHingeQuaConstraint(hinge);
}

static inline void doll_join(Doll *doll, MstUniverseID universe, int i, const double feet[3]) {
    const McdModelID m = doll->model[i], above = doll->model[doll_part[i].above];
    const MdtBodyID b1 = McdModelGetBody(m), b2 = McdModelGetBody(above);
    const double at[3] = {feet[0] + doll_part[i].jointX, feet[1] + doll_part[i].jointY, feet[2]};
    if (doll_part[i].cone > 0) {
        doll->joint[i] = doll_addSocket(universe->world, b1, b2, at);
        doll->cone[i] = doll_addCone(universe->world, i, b1, b2);
    } else {
        doll->joint[i] = doll_addHinge(universe->world, i, b1, b2, at);
    }
    McdSpaceDisablePair(m, above);
}

/* A figure that stands with its feet there, at rest; y is up. */
static inline void doll_make(Doll *doll, MstUniverseID universe, const double feet[3]) {
    for (int i = 0; i < DOLL_PARTS; i++) {
        const double half = doll_isSphyl(i) ? -0.25 * 3.14159265358979323846 : 0;
        const McdModelID m = doll->model[i] = MstModelAndBodyCreate(universe, doll_shape(universe->frame, i), 1000);
        McdModelDynamicsSetPosition(m, feet[0] + doll_part[i].x, feet[1] + doll_part[i].y, feet[2]);
        McdModelDynamicsSetQuaternion(m, cos(half), sin(half), 0, 0);
        McdModelDynamicsSetDamping(m, 0, 2);
    }
    doll->joint[DOLL_PELVIS] = 0;
    memset(doll->cone, 0, sizeof doll->cone);
    for (int i = DOLL_CHEST; i < DOLL_PARTS; i++)
        doll_join(doll, universe, i, feet);
    McdSpaceDisablePair(doll->model[DOLL_THIGHS], doll->model[DOLL_THIGHS + 1]); /* hips are narrow */
}

/* Every part gets the velocity v + w x (its place from the feet), m/s, rad/s: the figure turns as one. */
static inline void doll_throw(const Doll *doll, const double v[3], const double w[3]) {
    for (int i = 0; i < DOLL_PARTS; i++) {
        const double x = doll_part[i].x, y = doll_part[i].y;
        McdModelDynamicsSetLinearVelocity(doll->model[i], v[0] - w[2] * y, v[1] + w[2] * x, v[2] + w[0] * y - w[1] * x);
        McdModelDynamicsSetAngularVelocity(doll->model[i], w[0], w[1], w[2]);
    }
}

/* How far the worst joint is open, m. */
static inline double doll_opening(const Doll *doll) {
    double worst = 0;
    for (int i = DOLL_CHEST; i < DOLL_PARTS; i++) {
        MeVector3 a, b;
        MdtConstraintBodyGetPosition(doll->joint[i], 0, a);
        MdtConstraintBodyGetPosition(doll->joint[i], 1, b);
        MeVector3Subtract(a, a, b);
        worst = fmax(worst, MeVector3Magnitude(a));
    }
    return worst;
}

static inline double doll_beyondCone(MdtConeLimitID cone) {
    MeVector3 axis[2], other, across;
    for (int k = 0; k < 2; k++)
        MdtConeLimitBodyGetAxes(cone, (unsigned int)k, axis[k], other);
    MeVector3Cross(across, axis[0], axis[1]);
    return atan2(MeVector3Magnitude(across), MeVector3Dot(axis[0], axis[1])) -
           (double)MdtConeLimitGetConeHalfAngle(cone);
}

static inline double doll_beyondStops(MdtHingeID hinge, int i) {
    const double angle = MdtLimitGetPosition(MdtHingeGetLimit(hinge));
    return fmax(angle - fmax(doll_part[i].bend, 0), fmin(doll_part[i].bend, 0) - angle);
}

/* By how much the worst limit is overrun, rad; negative: none is reached. */
static inline double doll_overrun(const Doll *doll) {
    double worst = -10;
    for (int i = DOLL_CHEST; i < DOLL_PARTS; i++)
        worst = fmax(worst, doll->cone[i] ? doll_beyondCone(doll->cone[i])
                                          : doll_beyondStops(MdtConstraintDCastHinge(doll->joint[i]), i));
    return worst;
}

#endif
