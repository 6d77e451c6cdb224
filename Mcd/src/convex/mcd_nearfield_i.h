/* Inside Mcd's narrow phase: the result of the search for the contact normal, and the faces from which the manifold
 * is made. */
#ifndef MCD_NEARFIELD_H
#define MCD_NEARFIELD_H

#include "convex/mcd_shape_i.h"
#include "convex/mcd_vector_i.h"

/* The signed distance of two cores, and its witness points. If the cores are farther apart than the limit, the
 * functions that compute it return false, and only the separation is valid: a lower bound. */
typedef struct McdProximity {
    double normal[3];      /* from b to a, length 1 */
    double separation;     /* of the cores along the normal; negative: depth */
    double onA[3], onB[3]; /* witness points on the cores */
    double error;          /* m, a bound of the separation's; set by the search for it alone */
    MeBool isGuess;        /* only normal and separation are valid; the separation, where >= 0, is a lower bound */
} McdProximity;

/* Relative to the smaller shape: a face's normal is preferred to a direction whose separation is larger by no more
 * than this, so that a resting shape keeps its face. */
static const double mcd_faceBias = 2e-7;
/* Rounding of positions, relative to the smaller shape: corners that are outside by less count as inside, and
 * separations that differ by less count as equal. Depths are documented to 1e-6. */
static const double mcd_slack = 2e-7;
/* Edges with a smaller sine between them count as parallel: their cross product is not tried as separating axis. */
static const double mcd_parallelSine = 1e-7;

/* The smaller extent of two shapes, to which tolerances are relative. */
static inline double mcd_pairSize(const McdShape *a, const McdShape *b) {
    return a->extent < b->extent ? a->extent : b->extent;
}

/* m: a guessed normal is accepted if no other direction's separation can be larger by more than this. */
static inline double mcd_guessTolerance(const McdShape *a, const McdShape *b) {
    return mcd_faceBias / 2 * mcd_pairSize(a, b);
}

/* The separation of the cores along the unit vector n, which points from b to a. Its maximum over all n is the
 * signed distance. */
double mcd_separationAlong(const McdShape *a, const McdShape *b, const double n[3]);

/* The signed distance of the cores, by GJK and EPA; false if it is more than limit. */
MeBool mcd_coreProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
/* Makes the normal and the witness points exact where one of the shapes is smooth; else they stay, and false. */
MeBool mcd_polishNormal(const McdShape *a, const McdShape *b, McdProximity *p);
/* The best separating axis among the normals of flat faces (McdKind.flatAxes), as a guess; its separation is
 * -INFINITY if there are no flat faces. */
void mcd_guessFaces(const McdShape *a, const McdShape *b, McdProximity *p);
/* For a cylinder with a cylinder, sphyl or box: improves the guess by normals between their sides, edges and rims,
 * where one is better. Returns false for other pairs. (For a sphyl and a box the general search is faster.) */
MeBool mcd_guessSides(const McdShape *a, const McdShape *b, McdProximity *p);
/* Verify a guessed normal of overlapping cores: whether no other direction has a smaller depth, provided that their
 * faces are as deep along the normal as the guess says (mcd_facesManifold). Conservative: may reject a right guess.
 * mcd_isMinDepthOfRound is for pairs with round sides, which touch in a line or a point. */
MeBool mcd_isMinDepth(const McdShape *a, const McdShape *b, const McdProximity *p);
MeBool mcd_isMinDepthOfRound(const McdShape *a, const McdShape *b, const McdProximity *p);
/* Two boxes, or a box and a triangle. Exact if they overlap; else a separating face normal or edge-edge normal, as a
 * guess. Where several corners are equally deep, the witness points of a box and a triangle may lie beside the
 * other's face: contacts are made from faces and do not use them. */
MeBool mcd_boxBoxProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_boxTriangleProximity(const McdShape *box, const McdShape *triangle, double limit, McdProximity *p);
/* Sets the witness points of a contact with a face of a, or of b: the other core's support point, and its projection on
 * the face. */
void mcd_setFaceWitnesses(const McdShape *a, const McdShape *b, MeBool isFaceOfA, McdProximity *p);
/* For checks: whether the normal has length 1 and the separation is that of the support points along it, to within
 * fractions of the smaller shape's size and of the largest length. */
MeBool mcd_isAlongNormal(const McdShape *a, const McdShape *b, const McdProximity *p, double ofSize, double ofLargest);
/* The closest points of two segments along the shapes' z axes, each from -low to low: s and t, m from the origin of
 * a and of b. */
void mcd_nearestOfSegments(const McdShape *a, const McdShape *b, double *s, double *t);
/* Closed forms for cores that are points or segments, and for a point against a box or cylinder. */
MeBool mcd_pointPointProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_pointSegmentProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_segmentSegmentProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_pointBoxProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);
MeBool mcd_pointCylinderProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p);

/* The supporting face of a core in a direction: a point, a line, or a convex polygon, counter-clockwise seen from
 * outside. A disc is a polygon of 16 fixed corners on its rim, plus the rim's support point if it is not one of
 * these. */
enum { MCD_FACE_POINTS = 64 };
typedef struct McdFace {
    int count;
    double normal[3];       /* outward, unit; of a line: the surface's normal there; of a point: 0 */
    double curvatureRadius; /* m, of a line: the surface's radius of curvature across it */
    MeBool isDisc;          /* its corners are samples of a circular rim */
    MeU32 id;               /* which face of the shape */
    double point[MCD_FACE_POINTS][3];
    MeU32 name[MCD_FACE_POINTS]; /* of each corner; an edge is named by the corner where it begins */
} McdFace;
void mcd_faceToward(const McdShape *s, const double direction[3], McdFace *f);
/* Adds a corner, given in the shape's own frame. */
static inline void mcd_faceAdd(const McdShape *s, McdFace *f, double x, double y, double z, MeU32 name) {
    mcd_shapePoint(s, x, y, z, f->point[f->count]);
    f->name[f->count++] = name;
}

/* Makes the manifold along a normal: clips both faces against each other, and adds the witness points of the
 * proximity if no clipped point is as deep. Includes the roundings. Returns the number of contacts. If the proximity
 * is a guess, it is verified: 0 unless the faces are as near as its separation says. */
int mcd_facesManifold(const McdShape *a, const McdShape *b, const McdFace *faceA, const McdFace *faceB,
                      const McdProximity *p, McdReach reach, McdManifold *m);
/* Makes a manifold of one contact, midway between the witness points. Returns the number of contacts: 0 beyond the
 * margin. */
int mcd_pointManifold(const McdShape *a, const McdShape *b, const McdProximity *p, MeU64 feature, double margin,
                      McdManifold *m);

#endif
