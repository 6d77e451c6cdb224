/* Inside Mcd: internal edges (mcd_seam.c), where pieces of one surface meet: convex shapes, triangles and half-spaces
 * of any fixed models and their parts. */
#ifndef MCD_SEAM_H
#define MCD_SEAM_H

#include "convex/mcd_kind_i.h"

/* The sine of the largest angle at which the normals of a contact and of a face count as equal: normals of contacts are
 * in single precision, with errors of 6e-8 in each coordinate. */
static const double mcd_minSine = 1e-6;

typedef struct McdSeam McdSeam;
/* Called for a piece. side: the outward normal of a piece that has only one side; null: it has all. Returns true to end
 * the search at this piece. */
typedef MeBool (*McdSeamVisit)(const McdShape *piece, const double *side, const void *context);

/* A contact with a piece of a surface, and the other pieces near the contact. Coordinates are relative to the query's
 * origin. */
struct McdSeam {
    McdShape shape;       /* the piece */
    const McdShape *body; /* that touches it */
    const double *side;   /* normal of a triangle's tested side; null: all flat faces of the piece are tested */
    double skin, gap;     /* m: mcd_seamSkin, mcd_seamGap */
    double normal[3];     /* the contact's, outward */
    double point[3];      /* the contact's, on the piece */
    double separation;    /* m, from the point to the body along the normal */
    MeBool isBeside;      /* it is not the nearest contact of its manifold, which has this one's normal */
    /* The supplier of the other pieces (mcd_piecesFind; for triangles those of the query): visits those within reach of
     * a point until a visit returns true. Returns the supplier's own handle of that piece; null: there is none. */
    void *(*find)(const McdSeam *s, const double point[3], double reach, McdSeamVisit visit, const void *context);
    const void *pieces; /* context of the supplier */
};

/* m: the skin of a piece for a body of this shape, plus the rounding of the places of two pieces that are as far from
 * the world's origin as the query's. */
double mcd_seamSkin(const McdShape *piece, const McdShape *body, const double origin[3]);
/* m: the widest gap that a body of this shape slides over. */
double mcd_seamGap(const McdShape *body);
/* Whether the contact is near an edge of a face of the piece, so that the result depends on the other pieces. */
MeBool mcd_seamIsNear(const McdSeam *s);
/* The piece beyond the internal edge at which the contact lies; null: the contact is not at an internal edge. Writes
 * the normal that replaces the contact's: that of a face of the contact's piece. */
void *mcd_seamPieceBeyond(const McdSeam *s, double normal[3]);
/* Whether the body, which lies at an internal edge beside the face of this normal, is above the gap between both
 * pieces: no other piece is below it. Then `shift`, in the face's plane, takes it above the face. */
MeBool mcd_seamGapShift(const McdSeam *s, const McdShape *body, const double face[3], double shift[3]);

/* The largest number of flat faces of a shape, and the outward normal of face i; false: there is no such face. */
int mcd_shapeFaces(const McdShape *s);
MeBool mcd_shapeFaceNormal(const McdShape *s, int i, double normal[3]);
/* Finds the contacts along a normal, if the shapes touch along it: their faces are above each other, or a sphere's
 * lowest point is above a face. The separation is that of the cores. Returns the number of contacts. */
int mcd_manifoldAlong(const McdShape *a, const McdShape *b, const double normal[3], double separation, McdReach reach,
                      McdManifold *m);

#endif
