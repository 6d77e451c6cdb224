/* The surface around a contact. A body does not feel which model, or which part of a model, its ground belongs to: what
 * decides about a contact's normal is the surface that all fixed models and their parts have in common. */
#include "surface/mcd_pieces_i.h"
#include "surface/mcd_mesh_i.h"

/* ---- models ------------------------------------------------------------------------------------------------------ */

static MeBool isFixed(const McdModelRecord *m) {
    return m && !m->linearVelocity && !m->isSensor && !m->isGone;
}

/* The record of a model, also if a stand-in is given. */
static McdModelRecord *realModel(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    return m->standsFor ? mcd_record(m->standsFor) : m;
}

MeBool mcd_piecesAreOfAll(const McdModelRecord *m, const McdModelRecord *body) {
    return body->space && body->linearVelocity && isFixed(m);
}

void mcd_piecesBegin(McdPieces *p, McdGeometryInstance *own, const McdGeometryInstance *body, const double origin[3]) {
    McdModelRecord *mover = realModel(body->model);
    p->own = own;
    p->body = mcd_piecesAreOfAll(realModel(own->model), mover) ? mover : 0;
    mcd_copy(p->origin, origin);
}

/* Whether the triangles of the instance or of a part of it come from a function of the program. */
static MeBool callsProgram(const McdGeometryInstance *ins) {
    const McdKind *kind = mcd_kindOf(ins->geometry);
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        if (callsProgram(child))
            return METRUE;
    return kind && kind->callsProgram;
}

/* Iterates over the fixed models that the body has pairs with; *at: MCD_NO_NEIGHBOUR before the first call. */
static McdModelRecord *nextNeighbour(const McdModelRecord *body, int *at) {
    McdModelRecord *m;
    do
        m = body->frame->spaceNextNeighbour(body, at);
    while (m && !isFixed(m));
    return m;
}

MeBool mcd_piecesCallProgram(const McdModelRecord *m, const McdModelRecord *body) {
    int at = MCD_NO_NEIGHBOUR;
    if (!m->frame->hasProgramSurfaces || !mcd_piecesAreOfAll(m, body))
        return MEFALSE;
    for (const McdModelRecord *other; (other = nextNeighbour(body, &at)) != 0;)
        if (callsProgram(&other->instance))
            return METRUE;
    return MEFALSE;
}

/* ---- instances in a box ------------------------------------------------------------------------------------------ */

typedef struct Search {
    const McdPieces *pieces;
    double low[3], high[3]; /* in the world */
    McdPieceVisit visit;
    void *context;
} Search;

static MeBool overlapsBox(const McdGeometryInstance *ins, const Search *s) {
    for (int i = 0; i < 3; i++)
        if (!(s->low[i] <= (double)ins->max[i] && s->high[i] >= (double)ins->min[i]))
            return MEFALSE;
    return METRUE;
}

/* Whether the instance is the contact's own, which may be given by a stand-in: they have the same transform. */
static MeBool isOwn(const McdPieces *p, McdGeometryInstance *ins) {
    return mcd_instanceTM(ins) == mcd_instanceTM(p->own) && realModel(ins->model) == realModel(p->own->model);
}

static McdGeometryInstance *searchInstance(const Search *s, McdGeometryInstance *ins) {
    McdGeometryInstance *found = 0;
    if (!overlapsBox(ins, s))
        return 0;
    if (!ins->firstChild)
        return !isOwn(s->pieces, ins) && (mcd_isConvex(ins) || mcd_instanceIsPlaced(ins)) &&
                       s->visit(s->pieces, ins, s->context)
                   ? ins
                   : 0;
    for (McdGeometryInstance *child = ins->firstChild; child && !found; child = child->nextSibling)
        found = searchInstance(s, child);
    return found;
}

McdGeometryInstance *mcd_piecesOverlap(const McdPieces *p, const double low[3], const double high[3],
                                       McdPieceVisit visit, void *context) {
    Search s = {.pieces = p, .visit = visit, .context = context};
    McdModelRecord *own = realModel(p->own->model);
    int at = MCD_NO_NEIGHBOUR;
    mcd_mad(s.low, p->origin, 1, low);
    mcd_mad(s.high, p->origin, 1, high);
    McdGeometryInstance *found = own->instance.firstChild ? searchInstance(&s, &own->instance) : 0;
    while (p->body && !found) {
        McdModelRecord *other = nextNeighbour(p->body, &at);
        if (!other)
            break;
        found = other != own ? searchInstance(&s, &other->instance) : 0;
    }
    return found;
}

/* ---- pieces near a point ----------------------------------------------------------------------------------------- */

McdGeometryInstance *mcd_piecesNear(const McdPieces *p, const double point[3], double reach, McdPieceVisit visit,
                                    void *context) {
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = point[i] - reach;
        high[i] = point[i] + reach;
    }
    return mcd_piecesOverlap(p, low, high, visit, context);
}

void mcd_planeTriangle(const MeVector4 *tm, const double origin[3], const double point[3], double reach,
                       double corner[3][3], double normal[3]) {
    static const double across[3][2] = {{4, 0}, {-2, 3.5}, {-2, -3.5}}; /* its inner circle has a radius of 2 */
    double foot[3], place[3], u[3], w[3];
    mcd_fromReal(normal, tm[2]);
    mcd_scale(normal, normal, 1 / mcd_length(normal));
    for (int i = 0; i < 3; i++)
        place[i] = (double)tm[3][i] - origin[i];
    mcd_mad(foot, point, -mcd_heightOver(point, place, normal), normal);
    mcd_basis(normal, u, w);
    for (int i = 0; i < 3; i++) {
        mcd_mad(corner[i], foot, across[i][0] * reach, u);
        mcd_mad(corner[i], corner[i], across[i][1] * reach, w);
    }
}

typedef struct Find {
    const double *point;
    double reach;
    McdSeamVisit visit;
    const void *context;
    MeBool isFound;
} Find;

static MeBool findTriangle(void *context, const McdMeshTriangle *t, const McdShape *triangle) {
    Find *f = context;
    f->isFound = f->visit(triangle, t->flags & kMcdTriangleTwoSided ? 0 : t->normal, f->context);
    return !f->isFound;
}

static MeBool findPlane(const McdPieces *p, McdGeometryInstance *plane, Find *f) {
    double corner[3][3], normal[3];
    McdShape shape;
    mcd_planeTriangle(mcd_const(mcd_instanceTM(plane)), p->origin, f->point, f->reach, corner, normal);
    mcd_triangleShape(mcd_constRows(corner), &shape);
    return f->visit(&shape, normal, f->context);
}

static MeBool findPiece(const McdPieces *p, McdGeometryInstance *piece, void *context) {
    Find *f = context;
    McdShape shape;
    double low[3], high[3];
    if (mcd_isHalfSpace(piece))
        return findPlane(p, piece, f);
    if (!mcd_isSurface(piece))
        return mcd_shapeOf(piece, p->origin, &shape) && f->visit(&shape, 0, f->context);
    for (int i = 0; i < 3; i++) {
        low[i] = f->point[i] - f->reach;
        high[i] = f->point[i] + f->reach;
    }
    mcd_meshForEachNear(piece, p->body ? &p->body->model : 0, p->origin, low, high, findTriangle, f);
    return f->isFound;
}

void *mcd_piecesFind(const McdSeam *s, const double point[3], double reach, McdSeamVisit visit, const void *context) {
    Find f = {.point = point, .reach = reach, .visit = visit, .context = context};
    return mcd_piecesNear(s->pieces, point, reach, findPiece, &f);
}
