/* Inside Mcd: convex shapes that are known by their support function alone, which is the program's. Their flat faces
 * and the straight lines of their round sides are found once, when a shape gets its data (mcd_features.c); contacts
 * take the nearest one (mcd_sampled_face.c). */
#ifndef MCD_SAMPLED_H
#define MCD_SAMPLED_H

#include "McdConvexType.h"
#include "convex/mcd_kind_i.h"
#include <stdatomic.h>

/* What all shapes of a type share. */
typedef struct McdSampledType {
    McdKind kind; /* first: a shape's kind is its type */
    McdConvexFunctions functions;
    size_t dataSize;
    atomic_int hasWarned; /* about a support point that is not valid */
    char name[];
} McdSampledType;

/* A flat face of the core. */
typedef struct McdFlat {
    double normal[3];         /* outward, length 1 */
    double centre[3], radius; /* of a circular border; else a point of the face, and 0 */
    int first, count;         /* its corners, counter-clockwise from outside; count 0: its border is round */
} McdFlat;

/* One of the straight lines of a round side, or of an edge between round sides. */
typedef struct McdRuling {
    double normal[3], along[3], length; /* m */
    double twist;                       /* rad per rad: how far `along` turns as the normal turns across it */
    MeBool isBent;                      /* it is straight to within the slack alone, and has no ends */
} McdRuling;

/* Limits of memory: 58 kilobytes a shape at most. Faces beyond the limit have their farthest point alone. */
enum { MCD_FLATS = 256, MCD_FLAT_CORNERS = 1024, MCD_RULINGS = 256 };

/* One block of memory. */
typedef struct McdFeatures {
    McdFlat *flat;
    double (*corner)[3];
    McdRuling *ruling;
    int flats, corners, rulings;
    MeBool isPolyhedron; /* the flat faces are the whole surface */
    MeBool hasDisc;      /* the shape is a solid of revolution about z with a flat end */
} McdFeatures;

/* One shape, in its own frame. */
struct McdSampled {
    McdSampledType *type;
    const void *data;
    McdFeatures *features;
    double rounding, extent; /* m; extent: from the origin, an upper bound, with the rounding */
    double noise;            /* m: by how much support points are not the farthest ones, as they are rounded */
    MeBool isConsistent;     /* support points are those of one shape, to within rounding */
    double middle[3];        /* a point of the shape */
    MeU32 flatFaces;         /* bits: faces whose normals are x, -x, y, -y, z, -z */
};

/* A straight line of the surface. */
typedef struct McdLine {
    double end[2][3], along[3], normal[3], length;
} McdLine;

/* Brackets calls of the program's function, one or many. */
MeProgramCall mcd_sampledEnter(void);
/* Warns, once for the type, that a support point cannot be one. */
void mcd_sampledWarn(const McdSampled *s);
/* Calls the support function, within mcd_sampledEnter; direction: length 1. If its point is not finite, beyond the
 * extent, or behind the middle: the middle, and a warning, once for the type. While the extent is INFINITY, any point
 * is taken. */
void mcd_sampledPoint(const McdSampled *s, const double direction[3], double point[3]);
/* The same in the direction n + k along, n and along of length 1 and orthogonal. */
void mcd_sampledBeside(const McdSampled *s, const double n[3], double k, const double along[3], double point[3]);
/* The same, beyond mcd_sampledEnter. */
void mcd_sampledCall(const McdSampled *s, const double direction[3], double point[3]);
/* A direction in the shape's own frame, of length 1; z for one without length. */
void mcd_sampledDirection(const McdShape *s, const double direction[3], double own[3]);
/* m: how far the shape is above the plane through a point. */
double mcd_sampledHeight(const McdSampled *s, const double normal[3], const double point[3]);
/* Whether two points are one, to within rounding. */
MeBool mcd_sampledEqual(const McdSampled *s, const double a[3], const double b[3]);
/* m: how far the shape may be above what lies on its surface; and above a plane or a line that is found exactly. */
double mcd_sampledSlack(const McdSampled *s);
double mcd_sampledExact(const McdSampled *s);
/* Tangent of the angle in which corners of a face are found, m per m that these are below the face. */
double mcd_sampledBesideFlat(const McdSampled *s);
/* Support points in `count` directions around n, tilted by the tangent k; count divides MCD_RING. */
enum { MCD_RING = 16 };
void mcd_sampledRing(const McdSampled *s, const double n[3], double k, int count, double point[][3]);
/* Finds the straight line of the surface whose normal is nearest to n, which is near one, and which goes nearly along
 * the direction given, the shape being above it by no more than `exact`, in m, if possible; false: there is none.
 * Rounded ends are approached from outside. */
MeBool mcd_sampledLine(const McdSampled *s, const double n[3], const double along[3], double exact, McdLine *line);
/* The angle by which a line has to turn about its axis for its normal to be nearest to n; and the line that has turned
 * so, as far as the axis is constant. */
double mcd_rulingAngle(const McdRuling *r, const double n[3]);
void mcd_rulingTurn(const McdRuling *r, double angle, double normal[3], double along[3]);

/* Finds the features; null, with an error: no memory. MeMemoryGive frees them. Within mcd_sampledEnter. */
McdFeatures *mcd_sampledFeatures(const McdSampled *s);

/* Sets rounding, extent, features, which are the caller's, and flatFaces. False, with features null: not finite, or
 * without extent, or, with an error, no memory. */
MeBool mcd_sampledMeasure(McdSampled *s);
/* The functions of the type's McdKind. */
void mcd_sampledSupport(const McdShape *s, const double direction[3], double point[3]);
void mcd_sampledFace(const McdShape *s, const double direction[3], McdFace *f);
/* The straight line along which the shape lies if something flat touches it from a direction, within .05 rad: its ends
 * and normal, and its radius of curvature. False: there is none. */
MeBool mcd_sampledLineToward(const McdShape *s, const double direction[3], McdLine *line, double *radius);
double mcd_sampledRadius(const McdShape *s, const double outward[3], const double point[3]);
double mcd_sampledRim(const McdShape *s, const double outward[3], const double point[3]);

/* The middle and half the sides of the shape's box, of which none is less than a thousandth of the longest. */
void mcd_sampledBox(const McdSampled *s, double centre[3], double half[3]);
/* Visits the triangles between support points, rounding included; counter-clockwise from outside. The directions are
 * on a grid that divides each edge of an octahedron in `count` pieces, at most MCD_GRID; of an ellipsoid with these
 * half axes the points are as far apart as those directions. */
enum { MCD_GRID = 64 };
typedef void (*McdSampledVisit)(void *context, const double corner[3][3]);
void mcd_sampledTriangles(const McdSampled *s, const double half[3], int count, McdSampledVisit visit, void *context);

#endif
