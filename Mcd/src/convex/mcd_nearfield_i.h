/* Inside Mcd's narrow phase: the result of the search for the normal, and the faces from which the manifold is made. */
#ifndef MCD_NEARFIELD_H
#define MCD_NEARFIELD_H

#include "convex/mcd_shape_i.h"
#include "convex/mcd_vector_i.h"

/* The signed distance of two cores, and its witness points. Where the cores are farther apart than a limit, functions
 * that find it return false, and only the separation is valid: a lower bound. */
typedef struct McdProximity {
    double normal[3];      /* from b to a, length 1 */
    double separation;     /* of the cores along it; negative: depth */
    double onA[3], onB[3]; /* points of the cores that are so far apart */
    MeBool isGuess;        /* only normal and separation are valid; the separation, where >= 0, is a lower bound */
} McdProximity;

/* A face's normal is preferred to a direction that is better by no more than this, relative to the smaller shape, so
 * that a resting shape keeps its face. */
static const double mcd_faceBias = 2e-7;
/* A guessed normal is taken if no other direction can have a separation larger by more than this, relative to the
 * smaller shape: half of the bias. */
static const double mcd_guessTolerance = 1e-7;
/* Edges with a smaller sine between them are parallel: their cross product is no separating axis. */
static const double mcd_parallelSine = 1e-7;

/* The smaller extent of the two shapes: tolerances are relative to it. */
static inline double mcd_pairSize(const McdShape *a, const McdShape *b) {
    return a->extent < b->extent ? a->extent : b->extent;
}

/* The separation of the cores along the unit vector n, from b to a; its maximum over all n is the signed distance. */
double mcd_separationAlong(const McdShape *a, const McdShape *b, const double n[3]);

/* The signed distance of the cores, by GJK and EPA; false if it is more than limit. */
MeBool mcd_coreProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
/* The best separating axis among the normals of flat faces (McdKind.flatAxes), as a guess; a separation of -INFINITY if
 * there are none. */
void mcd_guessFaces(const McdShape *a, const McdShape *b, McdProximity *p);
/* Of a cylinder and another, a sphyl or a box: a better one between their sides, edges and rims, if there is. False: it
 * is another pair. (A sphyl and a box are searched faster.) */
MeBool mcd_guessSides(const McdShape *a, const McdShape *b, McdProximity *p);
/* Verify a guessed normal of cores that overlap, if their faces are as deep along it as it says (mcd_facesManifold): is
 * no other direction less deep? Conservative: may say no to a right guess. The second one is for contacts in a line or
 * a point of pairs that have sides. */
MeBool mcd_isMinDepth(const McdShape *a, const McdShape *b, const McdProximity *p);
MeBool mcd_isMinDepthOfRound(const McdShape *a, const McdShape *b, const McdProximity *p);
/* Two boxes, a box and a triangle: if they overlap, the exact result; else a normal of a face or across two edges that
 * separates them, as a guess. The points of a box and a triangle may be beside each other's face where several are
 * equally deep: contacts, which come of faces, do not need them to be. */
MeBool mcd_boxBoxProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_boxTriangleProximity(const McdShape *box, const McdShape *triangle, double limit, McdProximity *p);
/* For checks: is the separation that of the farthest corners along the normal, which has length 1? */
MeBool mcd_isAlongNormal(const McdShape *a, const McdShape *b, const McdProximity *p);
/* The points of two axes, between -low and low of each, that are nearest to each other. */
void mcd_nearestOfSegments(const McdShape *a, const McdShape *b, double *s, double *t);
/* Closed forms for cores that are points or segments, and for a point and a box or cylinder. */
MeBool mcd_pointPoint(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_pointSegment(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_segmentSegment(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_pointBox(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_pointCylinder(const McdShape *a, const McdShape *b, double limit, McdProximity *p);

/* The supporting face of a core in a direction: a point, a line, or a convex polygon, counter-clockwise seen from
 * outside. A disc is a polygon of 16 corners on its rim, and of the rim's farthest point if that is none of them. */
enum { MCD_FACE_POINTS = 64 };
typedef struct McdFace {
    int count;
    double normal[3]; /* outward, length 1; of a line: the surface's there; of a point: 0 */
    double bend;      /* m, of a line: radius of curvature of the surface across it */
    MeBool isDisc;    /* its corners are sampled from a circular rim */
    MeU32 id;         /* which face of the shape */
    double point[MCD_FACE_POINTS][3];
    MeU32 name[MCD_FACE_POINTS]; /* which corner; an edge goes by the corner where it begins */
} McdFace;
void mcd_faceToward(const McdShape *s, const double direction[3], McdFace *f);
/* Adds a corner, in the shape's own frame. */
static inline void mcd_faceAdd(const McdShape *s, McdFace *f, double x, double y, double z, MeU32 name) {
    mcd_shapePoint(s, x, y, z, f->point[f->count]);
    f->name[f->count++] = name;
}

/* The manifold along a normal: both faces clipped against each other, and the witness points of the proximity if none
 * of these is as deep. Roundings are included. Returns the count. A guess is verified: 0 unless the faces are as near
 * as its separation says. */
int mcd_facesManifold(const McdShape *a, const McdShape *b, const McdFace *faceA, const McdFace *faceB,
                      const McdProximity *p, double margin, McdManifold *m);
/* A manifold of one contact, at the witness points of the proximity. */
int mcd_pointManifold(const McdShape *a, const McdShape *b, const McdProximity *p, MeU64 feature, double margin,
                      McdManifold *m);

#endif
