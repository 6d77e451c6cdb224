/** @file MstDebugDraw.h
 *  Debug drawing of a simulation as lines, points, triangles and texts, for any renderer. After a step, as often as it
 *  draws, a program passes a table of its functions and the layers that it wants:
 *
 *      static void MEAPI line(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]) { ... }
 *      const MstDebugDraw draw = {.line = line};
 *      MstDebugDrawUniverse(u, MstDebugContacts | MstDebugJoints, &draw);
 *
 *  Coordinates are in the world frame. Drawing changes nothing in the simulation, nor may the functions
 *  (docs/simulation.md, "Callbacks"), and no pointer is kept. Colours are red, green, blue and opacity, each 0 to 1.
 *  Null functions are not called. Only one thread may draw at a time; meanwhile no thread may step a world that draws
 *  by MeDebugDrawAPI. An addition to the 1.2 interface.
 */
#ifndef MSTDEBUGDRAW_H
#define MSTDEBUGDRAW_H

#include "MstTypes.h"

ME_BEGIN_C

/** The program's drawing functions. */
typedef struct MstDebugDraw {
    void(MEAPI *line)(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]);
    void(MEAPI *point)(void *userdata, const MeVector3 p, const float color[4]);
    void(MEAPI *triangle)(void *userdata, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                          const float color[4]);
    void(MEAPI *text)(void *userdata, const MeVector3 p, const char *text, const float color[4]);
    void *userdata; /**< Passed to each function. */
    /** Length of a contact force's arrow, m for each N; 0, the default: as MstDebugForces says. */
    MeReal forceLength;
    MdtBodyID only; /**< Draws only this body, its models, contacts and joints. Null, the default: everything. */
} MstDebugDraw;

/** What to draw; values may be added. Lengths are in units of the length scale L. */
typedef enum MstDebugLayer {
    MstDebugShapes = 1,         /**< Outlines of all models, fixed ones too. */
    MstDebugBoxes = 2,          /**< Axis-aligned bounding boxes of models, as of the last update; not of planes. */
    MstDebugContacts = 4,       /**< A point and the normal, 0.2 L long; the point is red where the models penetrate. */
    MstDebugForces = 8,         /**< Contact forces, divided by the mass of the first moving body: 0.1 L for each
                                     L/s²; or not divided, with MstDebugDraw::forceLength. */
    MstDebugJoints = 16,        /**< A line from each body's centre of mass to the joint, and the joint's axis: 0.4 L,
                                     with a head. For hinges and sliders also an orange arrow: the direction in which
                                     the first body moves (the second, if the first is the world) as the coordinate
                                     grows. */
    MstDebugLimits = 32,        /**< Limits of hinges (a sector), sliders (a track) and cones (their sides), the present
                                     position, and the coordinate as a text; for hinges and sliders also an orange arrow
                                     from zero to the present position. */
    MstDebugCentresOfMass = 64, /**< The axes of the inertia tensor's frame, 0.2 L: red, green, blue. */
    MstDebugVelocities = 128,   /**< Displacement in 0.1 s; angular velocity along its axis, 0.1 L for 1 rad/s. */
    MstDebugPartitions = 256,   /**< Outlines of models with bodies, coloured by their partition in the last step. */
    MstDebugSleep = 512,        /**< Outlines of models with bodies: orange if awake, blue if asleep. */
    MstDebugSolver = 1024,      /**< Outlines of models with bodies, coloured by MdtReportWay: needs
                                     MdtWorldEnableReport. */
    MstDebugNames = 2048,       /**< The type of each model with its index in the order of the space, and the type of
                                     each joint. */
    MstDebugAll = 4095
} MstDebugLayer;

/** @name Drawing
 *  If several of MstDebugPartitions, MstDebugSleep and MstDebugSolver are given, the last one determines the colour.
 *  @{ */
/** Draws a universe. A null or destroyed universe, a null table, unknown layers, or a force length below 0 get a
 *  warning, and nothing is drawn. */
MEPUBLIC void MEAPI MstDebugDrawUniverse(const MstUniverseID u, const unsigned int layers, const MstDebugDraw *draw);
/** Draws a world and a space that belong to no universe; either may be null. */
MEPUBLIC void MEAPI MstDebugDrawParts(const MdtWorldID w, const McdSpaceID s, const MeReal lengthScale,
                                      const unsigned int layers, const MstDebugDraw *draw);
/** @} */

ME_END_C

#endif
