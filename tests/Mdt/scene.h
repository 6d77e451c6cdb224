/* Small scenes that several tests of dynamics start from. */
#ifndef SCENE_H
#define SCENE_H

#include "Mdt.h"
#include "karma_test.h"

#define FRAME ((MeReal)(1.0 / 60)) /* s, one picture of a game */

/* A world that puts nothing to rest by itself. */
static inline MdtWorldID scene_open(unsigned int bodies, unsigned int constraints, double gravity) {
    MdtWorldID w = MdtWorldCreate(bodies, constraints);
    MdtWorldSetAutoDisable(w, 0);
    MdtWorldSetGravity(w, 0, -gravity, 0);
    return w;
}

static inline void scene_end(void *world) {
    MdtWorldDestroy((MdtWorldID)world);
}

/* The same, which is destroyed at the end of the test. */
static inline MdtWorldID scene_world(unsigned int bodies, unsigned int constraints, double gravity) {
    MdtWorldID w = scene_open(bodies, constraints, gravity);
    test_finally(scene_end, w);
    return w;
}

/* An enabled body. */
static inline MdtBodyID scene_body(MdtWorldID w, double mass, double x, double y, double z) {
    MdtBodyID b = MdtBodyCreate(w);
    MdtBodySetMass(b, mass);
    MdtBodySetPosition(b, x, y, z);
    MdtBodyEnable(b);
    return b;
}

static inline MdtBodyID scene_box(MdtWorldID w, double mass, const double edge[3], double x, double y, double z) {
    MdtBodyID b = scene_body(w, mass, x, y, z);
    MeMatrix3 inertia;
    MdtMakeInertiaTensorBox(mass, edge[0], edge[1], edge[2], inertia);
    MdtBodySetInertiaTensor(b, inertia);
    return b;
}

/* Enabled joints; a body of null is the world. */
static inline MdtBSJointID scene_ball(MdtWorldID w, MdtBodyID a, MdtBodyID b, double x, double y, double z) {
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, a, b);
    MdtBSJointSetPosition(j, x, y, z);
    MdtBSJointEnable(j);
    return j;
}

static inline MdtHingeID scene_hinge(MdtWorldID w, MdtBodyID a, MdtBodyID b, double x, double y, double z, double ax,
                                     double ay, double az) {
    MdtHingeID j = MdtHingeCreate(w);
    MdtHingeSetBodies(j, a, b);
    MdtHingeSetPosition(j, x, y, z);
    MdtHingeSetAxis(j, ax, ay, az);
    MdtHingeEnable(j);
    return j;
}

/* A bar of the mass 1 and the length 1 along x, hinged to the world about z at one end, which is the origin. Its moment
 * of inertia about the hinge is 1/3. */
typedef struct {
    MdtWorldID world;
    MdtBodyID bar;
    MdtHingeID hinge;
    MdtLimitID limit;
} HingedBar;

static inline HingedBar scene_hingedBar(double gravity) {
    const double edge[3] = {1, 1e-3, 1e-3};
    HingedBar s;
    s.world = scene_world(4, 4, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.bar = scene_box(s.world, 1, edge, .5, 0, 0);
    s.hinge = MdtHingeCreate(s.world);
    MdtHingeSetBodies(s.hinge, s.bar, 0);
    MdtHingeSetPosition(s.hinge, 0, 0, 0);
    MdtHingeSetAxis(s.hinge, 0, 0, 1);
    MdtHingeEnable(s.hinge);
    s.limit = MdtHingeGetLimit(s.hinge);
    MdtLimitCalculatePosition(s.limit, 1);
    return s;
}

/* Sets the bar turning about the hinge. */
static inline void scene_spinBar(HingedBar s, double rate) {
    MdtBodySetAngularVelocity(s.bar, 0, 0, rate);
    MdtBodySetLinearVelocity(s.bar, 0, .5 * rate, 0);
}

static inline void steps(MdtWorldID w, int n, MeReal h) {
    for (int i = 0; i < n; i++)
        MdtWorldStep(w, h);
}

#endif
