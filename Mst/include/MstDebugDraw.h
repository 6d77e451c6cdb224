/** @file MstDebugDraw.h
 *  What a simulation is made of and does, as lines, points, triangles and texts: for any renderer. A program hands over
 *  a table of its functions and the layers that it wants, after a step, as often as it draws:
 *
 *      static void MEAPI line(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]) { ... }
 *      const MstDebugDraw draw = {.line = line};
 *      MstDebugDrawUniverse(u, MstDebugContacts | MstDebugJoints, &draw);
 *
 *  World frame; nothing is changed in the simulation, nor may the functions change it (docs/simulation.md,
 *  "Callbacks"), and nothing is kept. Colours are red, green, blue and opacity, each 0 to 1. Functions that are null
 *  are left out. Only one thread may draw at a time, and none may step a world meanwhile that draws by MeDebugDrawAPI.
 *  An addition to the 1.2 interface.
 */
#ifndef MSTDEBUGDRAW_H
#define MSTDEBUGDRAW_H

#include "MstTypes.h"

ME_BEGIN_C

/** How things are drawn. */
typedef struct MstDebugDraw {
    void(MEAPI *line)(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]);
    void(MEAPI *point)(void *userdata, const MeVector3 p, const float color[4]);
    void(MEAPI *triangle)(void *userdata, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                          const float color[4]);
    void(MEAPI *text)(void *userdata, const MeVector3 p, const char *text, const float color[4]);
    void *userdata; /**< Handed to each. */
} MstDebugDraw;

/** What is drawn; a sum. Lengths are in the length scale L. */
typedef enum MstDebugLayer {
    MstDebugShapes = 1,         /**< Outlines of all models, fixed ones too. */
    MstDebugBoxes = 2,          /**< Their boxes along the world's axes, as of the last update; not of planes. */
    MstDebugContacts = 4,       /**< A point and the normal, 0.2 L; red where they penetrate. */
    MstDebugForces = 8,         /**< At contacts: 0.1 L for each L/s² that it gives the first body that moves. */
    MstDebugJoints = 16,        /**< A line from each body's centre of mass, and the axes: 0.4 L, with a head. Of hinges
                                    and sliders, in orange: the way in which the first body moves (the second, where the
                                    first is the world) as the coordinate grows. */
    MstDebugLimits = 32,        /**< Of hinges, sliders and cones: sectors, tracks, sides; where the joint is, and its
                                    coordinate as a text; of hinges and sliders an orange arrow from zero to there. */
    MstDebugCentresOfMass = 64, /**< The axes of the inertia tensor's frame, 0.2 L: red, green, blue. */
    MstDebugVelocities = 128,   /**< Way in a tenth of a second; angular velocity along its axis, 0.1 L for 1 rad/s. */
    MstDebugPartitions = 256,   /**< Outlines of models with bodies, a colour for each partition of the last step. */
    MstDebugSleep = 512,        /**< The same: orange for those awake, blue for those that sleep. */
    MstDebugSolver = 1024,      /**< The same, by MdtReportWay: needs MdtWorldEnableReport. */
    MstDebugNames = 2048,       /**< What models are, with their number in the order of the space, and joints. */
    MstDebugAll = 4095
} MstDebugLayer;

/** @name Drawing
 *  Of MstDebugPartitions, MstDebugSleep and MstDebugSolver, the last one gives the colour where several are wanted.
 *  @{ */
/** All of a universe. A null or destroyed universe, a null table, or layers that there are not get a warning. */
MEPUBLIC void MEAPI MstDebugDrawUniverse(const MstUniverseID u, const unsigned int layers, const MstDebugDraw *draw);
/** The same of a world and a space that belong to no universe; either may be null. */
MEPUBLIC void MEAPI MstDebugDrawParts(const MdtWorldID w, const McdSpaceID s, const MeReal lengthScale,
                                      const unsigned int layers, const MstDebugDraw *draw);
/** @} */

ME_END_C

#endif
