/* Inside Mcd: candidates for contacts, in the plane orthogonal to the normal. */
#ifndef MCD_FACE_H
#define MCD_FACE_H

#include "convex/mcd_kind_i.h"
#include "convex/mcd_landing_i.h"

/* The code of a feature: the face's id, the kind of feature, and the name of the face's corner (McdFace). 24 bits of
 * face id suffice for any hull that fits into memory. */
enum { CORNER = 0, EDGE = 1, INSIDE = 2, SUPPORT = 3 };
static inline MeU32 mcd_featureCode(MeU32 kind, MeU32 face, MeU32 name) {
    MEASSERT(face < 1u << 24 && name < MCD_FACE_POINTS);
    return face << 8 | kind << 6 | name;
}

static inline MeU32 mcd_featureKind(MeU32 feature) {
    return feature >> 6 & 3;
}

/* The codes of a polyhedron's corner and edge: the number in place of a face's id, and a name that its faces' corners
 * and witness points do not have. */
enum { CAP_NAME = MCD_FACE_POINTS - 1 };
static inline MeBool mcd_isOfCap(MeU32 feature) {
    return mcd_featureKind(feature) == SUPPORT && (feature & (MCD_FACE_POINTS - 1)) == CAP_NAME;
}

/* The feature id of a contact: a's feature in the upper 32 bits, b's in the lower ones. */
static inline MeU64 mcd_featureOfPair(MeU32 a, MeU32 b) {
    return (MeU64)a << 32 | b;
}

/* A candidate contact: a point in the plane orthogonal to the normal, with its heights on both surfaces. */
typedef struct McdCandidate {
    double x, y, a, b;
    MeU64 feature;
} McdCandidate;

enum { MCD_CANDIDATES = 2 * MCD_FACE_POINTS };

/* A face projected along the normal: counter-clockwise corners, with heights. */
typedef struct McdOutline {
    int count;
    double x[MCD_FACE_POINTS], y[MCD_FACE_POINTS], z[MCD_FACE_POINTS];
    MeU32 name[MCD_FACE_POINTS], id;
    double slopeX, slopeY; /* gradient of a polygon's plane */
    MeBool isDisc;
} McdOutline;

typedef struct McdView {
    double u[3], w[3];
    const double *n;
    double slack; /* m */
} McdView;

static inline double mcd_planeHeight(const McdOutline *o, double x, double y) {
    return o->z[0] + o->slopeX * (x - o->x[0]) + o->slopeY * (y - o->y[0]);
}

/* Whether more of a shape than its face may touch before the next test. Boxes do without. */
static inline MeBool mcd_mayLand(const McdShape *s) {
    return s->hull != 0 || mcd_isTurned(s);
}

/* Adds to the chosen candidates those of all others, and of what a tilt may bring down beside the faces, that will be
 * needed before the next test. Room for MCD_CANDIDATES in all, for MCD_MANIFOLD_POINTS in chosen. Returns the number of
 * chosen ones. */
int mcd_addLanding(const McdShape *a, const McdShape *b, const McdOutline *outA, const McdOutline *outB,
                   const McdView *v, McdReach reach, McdCandidate *all, int count, McdCandidate *chosen,
                   int chosenCount);

#endif
