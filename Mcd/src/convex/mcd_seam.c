/* Internal edges: a body slides over a surface of several pieces as over a single piece.
 *
 * A contact lies on one of the pieces, whose outward normal there is the contact's. A face of this piece, of normal f,
 * continues a face of another piece, of normal m, if
 *
 *   f . m >= cos 60 degrees: a fold, up or down;
 *   the point p of f's plane at the contact is at most a skin above m's plane: a step down of any height;
 *   the body's middle is above m's plane, so that the body comes from m's side;
 *   p, of the nearest contact along a normal, is at the edge of the face in the direction of the normal; the others, of
 *   an edge or a round side of the body that is not quite parallel to the edge, may be beside it;
 *   the point of m's plane at a distance of a skin, or of a gap, from p in that direction is on the other piece.
 *
 * Then the other piece rises above the plane through the contact orthogonal to the contact's normal. The body is on the
 * other piece and does not fit into the gap, so the body cannot touch the edge: the edge is internal, and the normal
 * must be f. A body above the gap, and above neither face, has the contacts of a face that bridges the gap. (The same
 * rule for triangles with common corners: mcd_mesh_topology.c.) A normal between m and f points to no part of the other
 * piece, so the normals at a fold down are kept. */
#include "convex/mcd_sampled_i.h"
#include "convex/mcd_seam_i.h"

/* cos(60 degrees): the largest angle between faces that continue each other. */
static const double foldCosine = .5;

/* ---- shapes ------------------------------------------------------------------------------------------------------ */

int mcd_shapeFaces(const McdShape *s) {
    return s->hull ? s->hull->faceCount : s->kind->isSampled ? s->sampled->features->flats : 6;
}

MeBool mcd_shapeFaceNormal(const McdShape *s, int i, double normal[3]) {
    if (s->hull || s->kind->isSampled) {
        const double *own = s->hull ? s->hull->face[i].normal : s->sampled->features->flat[i].normal;
        mcd_shapeDirection(s, own[0], own[1], own[2], normal);
        return METRUE;
    }
    mcd_scale(normal, s->axis[i / 2], i % 2 ? -1 : 1);
    return (s->kind->flatAxes >> i / 2 & 1) != 0;
}

/* m: the depth of a point below the shape's supporting plane orthogonal to a direction. */
static double depthBelow(const McdShape *s, const double direction[3], const double point[3]) {
    double farthest[3];
    mcd_support(s, direction, farthest);
    return mcd_heightOver(farthest, point, direction);
}

/* m: the smallest extent of the shape along its own axes. */
static double minWidth(const McdShape *s) {
    double width = INFINITY;
    for (int i = 0; i < 3; i++) {
        double back[3];
        mcd_scale(back, s->axis[i], -1);
        width = fmin(width, depthBelow(s, s->axis[i], s->place) + depthBelow(s, back, s->place));
    }
    return width;
}

/* ---- internal edges ---------------------------------------------------------------------------------------------- */

/* The skin is 1e-4 of the extent of the smaller shape. Places in single precision have errors up to 5e-6 of the size
 * at a hundred sizes from the origin (docs/collision.md), twice that relative to each other; a step of this height is
 * climbed. With twice or half this value Mst_Seams (what_is_flush_to_a_ten_thousandth_of_its_radius_passes) and
 * Mcd_Compounds fail. */
double mcd_seamSkin(const McdShape *piece, const McdShape *body, const double origin[3]) {
    double skin = 1e-4 * mcd_pairSize(piece, body);
    for (int i = 0; i < 3; i++)
        skin += 4 * (double)ME_EPSILON * fabs(origin[i]);
    return skin;
}

/* A quarter of the body's smallest width: a body does not enter a gap narrower than the body, and a ball would sink by
 * 1/32 of its radius into such a gap. */
double mcd_seamGap(const McdShape *body) {
    return minWidth(body) / 4;
}

/* A face of the contact's piece. */
typedef struct SeamFace {
    const McdSeam *seam;
    double normal[3];
    double point[3]; /* of the face's plane, at the contact; mcd_seamGapShift: of the body */
} SeamFace;

/* Whether a direction equals the contact's normal to within rounding. */
static MeBool isNormal(const McdSeam *s, const double direction[3]) {
    double across[3];
    if (mcd_dot(s->normal, direction) < foldCosine)
        return MEFALSE;
    mcd_cross(across, s->normal, direction);
    return mcd_dot(across, across) <= mcd_minSine * mcd_minSine;
}

static int countFaces(const McdSeam *s) {
    return s->side ? 1 : mcd_shapeFaces(&s->shape);
}

/* Finds face number i; false if there is no such face, it is not near the contact, or its normal is the contact's. */
static MeBool faceAtContact(const McdSeam *s, int i, SeamFace *f) {
    if (s->side)
        mcd_copy(f->normal, s->side);
    else if (!mcd_shapeFaceNormal(&s->shape, i, f->normal))
        return MEFALSE;
    if (isNormal(s, f->normal))
        return MEFALSE;
    const double depth = depthBelow(&s->shape, f->normal, s->point);
    mcd_mad(f->point, s->point, depth, f->normal);
    return depth <= fmax(s->gap, s->skin) + fmax(s->separation, 0);
}

MeBool mcd_seamIsNear(const McdSeam *s) {
    SeamFace f;
    for (int i = 0; i < countFaces(s); i++)
        if (faceAtContact(s, i, &f))
            return METRUE;
    return MEFALSE;
}

/* The body's point that is nearest to the contact. */
static void bodyPoint(const McdSeam *s, double point[3]) {
    mcd_mad(point, s->point, s->separation, s->normal);
}

/* Finds the other piece's face that may continue a face of this normal; false: there is none. */
static MeBool faceAcross(const McdShape *piece, const double *side, const double normal[3], McdFace *face) {
    if (side && mcd_dot(side, normal) < 0)
        return MEFALSE;
    mcd_faceToward(piece, normal, face);
    return face->count >= 3 && mcd_dot(face->normal, normal) >= foldCosine;
}

/* Whether the middle of the body's extent along the normal of a piece's face is above the face's plane. */
static MeBool isMiddleAbove(const McdShape *body, const McdShape *piece, const McdFace *face) {
    double up[3], down[3], back[3];
    mcd_scale(back, face->normal, -1);
    mcd_support(body, face->normal, up);
    mcd_support(body, back, down);
    return mcd_heightOver(up, face->point[0], face->normal) + mcd_heightOver(down, face->point[0], face->normal) >
           2 * piece->rounding;
}

/* Whether the contact's normal is that of a flat face of the body, which contacts above the piece's face have, too. */
static MeBool isOfBodyFace(const McdSeam *s) {
    McdFace face;
    double down[3], across[3];
    mcd_scale(down, s->normal, -1);
    mcd_faceToward(s->body, down, &face);
    mcd_cross(across, face.normal, down);
    return face.count > 2 && mcd_dot(across, across) <= mcd_minSine * mcd_minSine;
}

/* Whether the face continues a face of this other piece, so that the edge between both is internal. */
static MeBool isContinued(const McdShape *piece, const double *side, const void *context) {
    const SeamFace *f = context;
    const McdSeam *s = f->seam;
    McdFace other;
    double inward[3], foot[3], at[3];
    if (!faceAcross(piece, side, f->normal, &other))
        return MEFALSE;
    const double height = mcd_heightOver(f->point, other.point[0], other.normal) - piece->rounding;
    if (height > s->skin || !isMiddleAbove(s->body, piece, &other))
        return MEFALSE;
    mcd_mad(inward, s->normal, -mcd_dot(s->normal, other.normal), other.normal);
    const double sine = mcd_length(inward);
    if (sine <= mcd_minSine)
        return MEFALSE;
    mcd_mad(at, f->point, s->skin / sine, inward);
    if (mcd_pointDistance(&s->shape, at) <= s->skin / 2 && !(s->isBeside && !isOfBodyFace(s)))
        return MEFALSE; /* the contact is not at the edge */
    mcd_mad(foot, f->point, -height, other.normal);
    for (int i = 0; i < 2; i++) {
        mcd_mad(at, foot, (i ? s->gap : s->skin) / sine, inward);
        if (mcd_pointDistance(piece, at) <= s->skin / 2)
            return METRUE;
    }
    return MEFALSE;
}

/* m: isContinued accepts no piece farther away. */
static double reachOf(const McdSeam *s) {
    return 3 * s->gap + 2 * fabs(s->separation);
}

void *mcd_seamPieceBeyond(const McdSeam *s, double normal[3]) {
    SeamFace f = {.seam = s};
    for (int i = 0; i < countFaces(s); i++) {
        void *piece = faceAtContact(s, i, &f) ? s->find(s, f.point, reachOf(s), isContinued, &f) : 0;
        if (!piece)
            continue;
        mcd_copy(normal, f.normal);
        return piece;
    }
    return 0;
}

/* ---- gaps -------------------------------------------------------------------------------------------------------- */

/* m: how far the body's point may be from a face that it is above. Where the surface folds, by the rounding of places;
 * and the point of a body that overlaps the edge is aside of the face. Where it is flat, a point above neither piece
 * has no contact but that of the shift. */
static double slackOver(const SeamFace *f, const double face[3]) {
    double fold[3], across[3];
    mcd_cross(fold, f->normal, face);
    mcd_cross(across, f->seam->normal, face);
    return mcd_length(fold) > mcd_minSine ? .05 * f->seam->skin + fmax(-f->seam->separation, 0) * mcd_length(across)
                                          : mcd_faceBias / 2 * f->seam->body->extent;
}

/* Whether the body's point is above a face of this other piece. */
static MeBool isBelowBody(const McdShape *piece, const double *side, const void *context) {
    const SeamFace *f = context;
    McdFace face;
    double foot[3];
    if (!faceAcross(piece, side, f->normal, &face))
        return MEFALSE;
    const double height = mcd_heightOver(f->point, face.point[0], face.normal);
    mcd_mad(foot, f->point, -height, face.normal);
    return mcd_pointDistance(piece, foot) <= slackOver(f, face.normal);
}

/* The point of the body's lowest face, a point or a line, that is nearest to the contact; false: the face is flat, and
 * wider than the gap. */
static MeBool lowestPoint(const McdSeam *s, const McdShape *body, const double face[3], double lowest[3]) {
    McdFace low;
    double down[3], line[3];
    mcd_scale(down, face, -1);
    mcd_faceToward(body, down, &low);
    if (low.count < 1 || low.count > 2)
        return MEFALSE;
    mcd_sub(line, low.point[low.count - 1], low.point[0]);
    const double square = mcd_dot(line, line), at = mcd_heightOver(s->point, low.point[0], line);
    mcd_mad(lowest, low.point[0], square > 0 ? MeCLAMP(at / square, 0, 1) : 0, line);
    return METRUE;
}

MeBool mcd_seamGapShift(const McdSeam *s, const McdShape *body, const double face[3], double shift[3]) {
    SeamFace f = {.seam = s};
    double lowest[3];
    mcd_copy(f.normal, face);
    bodyPoint(s, f.point);
    if (!lowestPoint(s, body, face, lowest) || s->find(s, f.point, reachOf(s), isBelowBody, &f))
        return MEFALSE;
    mcd_sub(shift, s->point, lowest);
    mcd_mad(shift, shift, -mcd_dot(shift, face), face);
    const double length = mcd_length(shift);
    if (length > 0) /* a skin farther than to the edge, as the contact's point is rounded */
        mcd_scale(shift, shift, 1 + s->skin / length);
    return length <= s->gap;
}

/* ---- contacts along a normal ------------------------------------------------------------------------------------- */

int mcd_manifoldAlong(const McdShape *a, const McdShape *b, const double normal[3], double separation, McdReach reach,
                      McdManifold *m) {
    double back[3];
    McdProximity p = {.separation = separation, .isGuess = METRUE};
    McdFace faceA, faceB;
    mcd_scale(back, normal, -1);
    mcd_copy(p.normal, normal);
    mcd_faceToward(a, back, &faceA);
    mcd_faceToward(b, normal, &faceB);
    if (faceA.count > 1 && faceB.count > 1)
        return mcd_facesManifold(a, b, &faceA, &faceB, &p, reach, m);
    mcd_coreSupport(a, back, p.onA);
    mcd_coreSupport(b, normal, p.onB);
    const MeBool isOnA = faceA.count == 1; /* the shape that is a point; the other witness point is its projection */
    mcd_mad(isOnA ? p.onB : p.onA, isOnA ? p.onA : p.onB, isOnA ? -separation : separation, normal);
    if (mcd_pointDistance(isOnA ? b : a, isOnA ? p.onB : p.onA) > mcd_faceBias * mcd_pairSize(a, b))
        return 0;
    return mcd_pointManifold(a, b, &p, 0, reach.margin, m);
}
