/* What the tests of the order of both solvers' motion share: a universe without impacts met in time, which falls along
 * -z and puts nothing to rest, and the length of a step. */
#ifndef ORDER_H
#define ORDER_H

#include "universe.h"

static const double gravity = 9.81;

static double step;
static MdtSolver solver;

static const MdtSolver solvers[] = {MdtSolverFast, MdtSolverExact};
enum { SOLVERS = sizeof solvers / sizeof *solvers };

static inline void order_begin(void) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetSolver(u->world, solver);
    MdtWorldSetTimedContacts(u->world, 0);
    MdtWorldSetGravity(u->world, 0, 0, -gravity);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
}

static inline MdtBodyID order_addBox(double width, double height, double density) {
    return McdModelGetBody(MstModelAndBodyCreate(u, McdBoxCreate(u->frame, width, width, height), density));
}

static inline void order_join(MdtHingeID hinge, MdtBodyID a, MdtBodyID b, double x, double z, const MeVector3 axis) {
    MdtHingeSetBodies(hinge, a, b);
    MdtHingeSetPosition(hinge, x, 0, z);
    MdtHingeSetAxis(hinge, axis[0], axis[1], axis[2]);
    MdtHingeEnable(hinge);
}

static inline void stepFor(double seconds) {
    for (int i = 0, n = (int)lround(seconds / step); i < n; i++)
        MstUniverseStep(u, step);
}

static const MeVector3 level = {0, 1, 0}, upright = {0, 0, 1};

#endif
