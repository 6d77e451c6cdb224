/** @file McdConvexType.h
 *  A program's own convex shapes, given by their support function alone: ellipsoids, tapered capsules, lenses, any
 *  shape of which the point that lies farthest in a direction is easily found. Beyond Karma;
 *  McdFrameworkRegisterGeometryType is the guide's interface for own types of any kind, which need a function for each
 *  pair.
 *
 *  Such a shape gets all that a built-in one has: contacts with all geometries, distances, overlaps, casts, times of
 *  impact, rays, a box, mass properties, drawing. Depths and normals are as exact as those of built-in shapes. Its
 *  flat faces, and the straight lines of its round sides, are found when it is created (docs/collision.md, "A
 *  program's own convex shapes"). So a box made this way has the box's contacts at any tilt, a cylinder on its side
 *  two, an ellipsoid one. A built-in shape takes less time; prefer it if there is one.
 *
 *  @code
 *      typedef struct Ellipsoid { double radius[3]; } Ellipsoid;
 *      static void MEAPI farthest(const void *data, const double d[3], double point[3]) {
 *          const double *r = ((const Ellipsoid *)data)->radius;
 *          const double x = r[0] * d[0], y = r[1] * d[1], z = r[2] * d[2], length = sqrt(x * x + y * y + z * z);
 *          point[0] = r[0] * x / length, point[1] = r[1] * y / length, point[2] = r[2] * z / length;
 *      }
 *      static const McdConvexFunctions functions = {.support = farthest};
 *      int type = McdFrameworkRegisterConvexType(frame, "Ellipsoid", sizeof(Ellipsoid), &functions);
 *      McdGeometryID egg = McdConvexCreate(frame, type, &(Ellipsoid){{.5, .3, .3}});
 *  @endcode
 */
#ifndef MCDCONVEXTYPE_H
#define MCDCONVEXTYPE_H

#include "McdCTypes.h"
#include <stddef.h>

ME_BEGIN_C

/** @name Functions of the program
 *  All numbers are double in any build, in the shape's own frame. The same data and arguments must give the same
 *  results at any time, and several threads may call at once. They may call nothing that changes an object of the
 *  library (docs/simulation.md, "Callbacks").
 *  @{ */
/** The point of the shape that lies farthest in a direction of length 1, as exact as double allows; rounding as that of
 *  single precision, 1e-7 of the size, is measured and allowed for. Where several points lie equally far: any of them.
 *  Points that are not the farthest ones by more than 1e-6 of the size: a warning, once for the type, and shapes that
 *  touch with one contact at a time. */
typedef void(MEAPI *McdConvexSupportFn)(const void *data, const double direction[3], double point[3]);
/** m, >= 0: all points within this distance of the support function's shape, which may then be a point, a segment or
 *  flat, belong to the shape. */
typedef double(MEAPI *McdConvexRoundingFn)(const void *data);
/** The mass properties for unit density: volume (m³), centre of mass, and inertia (m⁵) about it along the shape's
 *  axes. */
typedef void(MEAPI *McdConvexMassFn)(const void *data, double *volume, double centre[3], double inertia[3][3]);
/** Where a line from + t along enters the shape, 0 < t <= 1, and the outward normal there, length 1. False: it does
 *  not. Not called for lines that begin inside. */
typedef MeBool(MEAPI *McdConvexRayFn)(const void *data, const double from[3], const double along[3], double *t,
                                      double normal[3]);
/** @} */

/** The functions of a type. Only `support` is needed; with null for others, the library computes what they would. */
typedef struct McdConvexFunctions {
    McdConvexSupportFn support;
    McdConvexRoundingFn rounding; /**< Null: 0. */
    /** Null: by some 20 000 support points, to 1e-5 for round shapes, 1e-4 for flat or long ones, 1e-3 with rims; exact
     *  for polyhedra whose faces are at more than some 3 degrees to each other. Flat shapes have none. */
    McdConvexMassFn mass;
    McdConvexRayFn ray; /**< Null: by distances, to 1e-9 of the size. */
} McdConvexFunctions;

/**
 * Registers a type of convex shapes, and its interactions with all types that are registered, including earlier ones of
 * this kind. Call it after McdAllRegisterTypes and McdAllRegisterInteractions, which a universe has done; repeated,
 * with the same name and functions, it adds interactions with types that were registered in between.
 * @param typeName  copied; null: "(no name)".
 * @param dataSize  bytes of the data of each shape, 0 or more.
 * @param functions copied.
 * @return the type's number, for McdConvexCreate, the same when repeated. It does not count as one of McdInit's
 *         geoTypeMaxCount. 0, with a warning: not a framework, no support function, no memory, or called while the
 *         framework is in use. Pointers from McdFrameworkGetInteractions are invalid after it.
 */
MEPUBLIC int MEAPI McdFrameworkRegisterConvexType(McdFrameworkID frame, const char *typeName, size_t dataSize,
                                                  const McdConvexFunctions *functions);
/** Whether it is the number of a type of McdFrameworkRegisterConvexType; 0 also for numbers out of range. */
MEPUBLIC MeBool MEAPI McdFrameworkTypeIsConvex(McdFrameworkID frame, int typeId);

/**
 * Creates a shape. It calls the support function 1700 times for a polyhedron, up to 20 000 times for what has many
 * round edges, and keeps up to 58 kilobytes of faces: 256 faces with 1024 corners. Further faces, and those among
 * curved surfaces at less than .1 rad to the next face or line, have their deepest contact alone.
 * @param data dataSize bytes, copied; may be null if that is 0.
 * @return null, with a warning: no such type, no data, or a support function whose points are not finite, beyond a
 *         quarter of the range of single precision or, with the rounding, without extent. McdGeometryDestroy destroys
 *         it.
 */
MEPUBLIC McdGeometryID MEAPI McdConvexCreate(McdFrameworkID frame, int typeId, const void *data);
/** The shape's data; read-only, valid while it lives. Null, with a warning, if it is not such a shape. */
MEPUBLIC const void *MEAPI McdConvexGetData(McdGeometryID g);
/** Sets the shape's data, as McdConvexCreate; for bad data a warning, and the shape stays unchanged. Also to be called
 *  when memory has changed that the data point to. Not while models are tested. */
MEPUBLIC void MEAPI McdConvexSetData(McdGeometryID g, const void *data);

ME_END_C

#endif
