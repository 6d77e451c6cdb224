/* Inside Mcd: the surface around a contact, in pieces: convex shapes, triangles and half-spaces of the contact's model
 * and of all other fixed models that the body has pairs with. */
#ifndef MCD_PIECES_H
#define MCD_PIECES_H

#include "convex/mcd_seam_i.h"
#include "model/mcd_frame_i.h"

typedef struct McdPieces {
    McdGeometryInstance *own; /* the contact's instance, or its stand-in's: no piece */
    McdModelRecord *body;     /* null: there are no other models */
    double origin[3];         /* of all coordinates */
} McdPieces;

/* The surroundings of an instance that a body (or a part of it) touches. Other models belong to them only if the
 * instance's model is fixed and the body is not. */
void mcd_piecesBegin(McdPieces *p, McdGeometryInstance *own, const McdGeometryInstance *body, const double origin[3]);
/* Whether a body moves, and its contacts with this model lie on the surface of all fixed models. */
MeBool mcd_piecesAreOfAll(const McdModelRecord *m, const McdModelRecord *body);

/* Visits instances without parts whose boxes overlap a box, until a visit returns true; returns that one, or null. */
typedef MeBool (*McdPieceVisit)(const McdPieces *p, McdGeometryInstance *piece, void *context);
McdGeometryInstance *mcd_piecesOverlap(const McdPieces *p, const double low[3], const double high[3],
                                       McdPieceVisit visit, void *context);
/* Visits those whose boxes are within reach of a point. */
McdGeometryInstance *mcd_piecesNear(const McdPieces *p, const double point[3], double reach, McdPieceVisit visit,
                                    void *context);
/* McdSeam.find for seams whose `pieces` is an McdPieces: the handle is a McdGeometryInstance. */
void *mcd_piecesFind(const McdSeam *s, const double point[3], double reach, McdSeamVisit visit, const void *context);
/* Whether a function of the program would be called for the pieces around a body's contacts with this model. */
MeBool mcd_piecesCallProgram(const McdModelRecord *m, const McdModelRecord *body);
/* A triangle of the plane about a point's projection, larger than reach; normal: outward. */
void mcd_planeTriangle(const MeVector4 *tm, const double origin[3], const double point[3], double reach,
                       double corner[3][3], double normal[3]);

#endif
