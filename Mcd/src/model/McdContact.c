/* Contacts: accessors, and contact reduction: choosing a few points that support as well as many. */
#include "McdContact.h"
#include "McdInternal.h"
#include "model/mcd_result_i.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_shape_i.h"
#include "convex/mcd_spread_i.h"
#include <math.h>
#include <string.h>

/* Whether the separation is the one that the test found: the exact values of a contact are valid only then, since
 * programs may write another separation. */
static MeBool isSeparationAsFound(const McdContact *c) {
    return (MeReal)c->exactSeparation == c->separation;
}

static double separationOf(const McdContact *c) {
    return isSeparationAsFound(c) ? c->exactSeparation : (double)c->separation;
}

double MEAPI McdContactGetSeparation(const McdContact *c) {
    if (!c) {
        MeWarning(1, "McdContactGetSeparation: no contact");
        return 0;
    }
    return separationOf(c);
}

static void positionOf(const McdContact *c, double position[3]) {
    for (int i = 0; i < 3; i++)
        position[i] = (MeReal)c->exactPosition[i] == c->position[i] ? c->exactPosition[i] : (double)c->position[i];
}

void MEAPI McdContactGetPosition(const McdContact *c, double position[3]) {
    if (!c || !position) {
        MeWarning(1, "McdContactGetPosition: no %s", c ? "place for the position" : "contact");
        return;
    }
    positionOf(c, position);
}

static double radiusOf(const McdContact *c, int side) {
    return isSeparationAsFound(c) ? c->radius[side] : 0;
}

double MEAPI McdContactGetRadius(const McdContact *c, int side) {
    if (!c || side < 0 || side > 1) {
        MeWarning(1, "McdContactGetRadius: %s", c ? "side must be 0, for the first model, or 1" : "no contact");
        return 0;
    }
    return radiusOf(c, side);
}

/* The instance's shape, about the contact, with the outward normal there. */
static MeBool shapeAt(const McdContact *c, int side, McdGeometryInstanceID ins, McdShape *shape, double outward[3]) {
    double place[3];
    positionOf(c, place);
    for (int i = 0; i < 3; i++)
        outward[i] = (side == 0 ? -1 : 1) * (double)c->normal[i];
    return mcd_shapeOf(ins, place, shape);
}

static double rimOfShape(const McdContact *c, int side, McdGeometryInstanceID ins, double axis[3]) {
    double outward[3], point[3];
    McdShape shape;
    if (!shapeAt(c, side, ins, &shape, outward))
        return 0;
    for (int i = 0; i < 3; i++)
        point[i] = -0.5 * c->exactSeparation * outward[i];
    const double rim = shape.kind->rim(&shape, outward, point);
    for (int i = 0; i < 3 && rim > 0; i++)
        axis[i] = shape.axis[2][i];
    return rim;
}

/* The instance, in the first or second model, that the contact belongs to. Null: there is none, or the model has
 * been destroyed. */
static McdGeometryInstanceID instanceOf(const McdContact *c, int side) {
    const McdGeometryInstanceID ins = side == 0 ? c->instance1 : c->instance2;
    const MeBool isKnown = ins && MCD_IS_KNOWN(ins, MCD_INSTANCE) && ins->geometry && ins->model;
    return isKnown && mcd_record(ins->model)->magic == MCD_MODEL ? ins : 0;
}

static double rimOf(const McdContact *c, int side, double axis[3]) {
    const McdGeometryInstanceID ins = instanceOf(c, side);
    const McdKind *kind = ins ? mcd_kindOf(ins->geometry) : 0;
    const MeBool hasRim = kind && kind->rim && isSeparationAsFound(c) && mcd_instanceIsPlaced(ins);
    return hasRim ? rimOfShape(c, side, ins, axis) : 0;
}

/* Whether an axis can be given for the arguments; else warns. */
static MeBool mayGiveAxis(const McdContact *c, int side, const double axis[3], const char *function) {
    if (!c || !axis || side < 0 || side > 1) {
        MeWarning(1, "%s: %s", function,
                  !c     ? "no contact"
                  : axis ? "side must be 0, for the first model, or 1"
                         : "no place for the axis");
        return MEFALSE;
    }
    if ((side == 0 ? c->instance1 : c->instance2) && !instanceOf(c, side))
        MeWarning(1, "%s: the contact's model has been destroyed", function);
    return METRUE;
}

double MEAPI McdContactGetRim(const McdContact *c, int side, double axis[3]) {
    return mayGiveAxis(c, side, axis, "McdContactGetRim") ? rimOf(c, side, axis) : 0;
}

/* Of a triangle, as the test has found it. */
static MeBool edgeOfTriangle(const McdContact *c, double axis[3]) {
    if (!(MeVector3Dot(c->edge, c->edge) > 0))
        return MEFALSE;
    mcd_fromReal(axis, c->edge);
    mcd_scale(axis, axis, 1 / mcd_length(axis));
    return METRUE;
}

static MeBool edgeOf(const McdContact *c, int side, double axis[3]) {
    const McdGeometryInstanceID ins = instanceOf(c, side);
    const McdKind *kind = ins ? mcd_kindOf(ins->geometry) : 0;
    double outward[3];
    McdShape shape;
    if (!kind || !isSeparationAsFound(c) || !mcd_instanceIsPlaced(ins))
        return MEFALSE;
    if (!kind->support)
        return edgeOfTriangle(c, axis);
    return shapeAt(c, side, ins, &shape, outward) && mcd_shapeEdge(&shape, outward, axis);
}

MeBool MEAPI McdContactGetEdge(const McdContact *c, int side, double axis[3]) {
    return mayGiveAxis(c, side, axis, "McdContactGetEdge") && edgeOf(c, side, axis);
}

static MeBool isVertex(const McdContact *c, int side) {
    return isSeparationAsFound(c) && (c->vertices & 1 << side);
}

MeBool MEAPI McdContactIsVertex(const McdContact *c, int side) {
    if (!c || side < 0 || side > 1) {
        MeWarning(1, "McdContactIsVertex: %s", c ? "side must be 0, for the first model, or 1" : "no contact");
        return MEFALSE;
    }
    return isVertex(c, side);
}

unsigned int MEAPI McdContactGetMaterial(const McdContact *c, int side) {
    if (!c || side < 0 || side > 1) {
        MeWarning(1, "McdContactGetMaterial: %s", c ? "side must be 0, for the first model, or 1" : "no contact");
        return 0;
    }
    const McdGeometryInstanceID ins = instanceOf(c, side);
    if (!ins)
        return 0;
    return mcd_elementMaterial(ins, side ? c->element2 : c->element1);
}

/* Sets the axes of edges and of capsules' sides, about which the normal turns, where the other side is round. */
static void setEdges(const McdContact *c, McdExactContact *exact) {
    MeBool isRound[2] = {exact->radius[0] > 0 || exact->rim[0] > 0, exact->radius[1] > 0 || exact->rim[1] > 0};
    const int flat = isRound[0] ? 1 : 0; /* first, as a capsule's axis counts on an edge, too */
    for (int i = 0; i < 2; i++) {
        const int side = i ? 1 - flat : flat;
        if (isRound[1 - side] && !(exact->rim[side] > 0) && edgeOf(c, side, exact->axis[side]))
            isRound[side] = METRUE;
    }
}

void MEAPI McdContactGetExact(const McdContact *c, McdExactContact *exact) {
    MEASSERT(c && exact);
    positionOf(c, exact->position);
    exact->separation = separationOf(c);
    for (int side = 0; side < 2; side++) {
        memset(exact->axis[side], 0, sizeof exact->axis[side]);
        exact->radius[side] = radiusOf(c, side);
        exact->isVertex[side] = isVertex(c, side);
        exact->rim[side] = rimOf(c, side, exact->axis[side]);
    }
    setEdges(c, exact);
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

static McdSpot spotOf(const McdContact *c, const McdContact *reference) {
    McdSpot s = {.support = 0};
    for (int i = 0; i < 3; i++) {
        s.at[i] = (double)c->position[i] - (double)reference->position[i];
        s.at[3 + i] = (double)c->normal[i];
    }
    s.separation = (double)c->separation;
    return s;
}

static MeBool isOnFace(const McdContact *c, const MeReal *normal) {
    return MeVector3Dot(c->normal, normal) > (MeReal).99;
}

/* Whether the contact's numbers are finite: programs may have made it. */
static MeBool isContactFinite(const McdContact *c) {
    return mcd_areInRange(c->position, 3) && mcd_areInRange(c->normal, 3) && mcd_areInRange(&c->separation, 1);
}

/* Makes spots of the contacts on faces, or of the others; of all if normal is null. `from` gets their indices.
 * Contacts that are not finite are left out. */
static int gatherSpots(const McdContact *contacts, int count, const MeReal *normal, MeBool onFaces, McdSpot *spot,
                       int *from) {
    const McdContact *reference = NULL;
    int n = 0;
    for (int i = 0; i < count; i++) {
        if (!isContactFinite(&contacts[i]))
            continue;
        reference = reference ? reference : &contacts[i];
        if (!normal || isOnFace(&contacts[i], normal) == onFaces) {
            spot[n] = spotOf(&contacts[i], reference);
            from[n++] = i;
        }
    }
    return n;
}

typedef struct Workplace {
    McdSpot *spot;
    int *from, *kept, *chosen; /* each has room for all contacts */
} Workplace;

static int chooseContacts(const Workplace *w, const McdContact *contacts, int count, int maxCount, const MeReal *normal,
                          double same) {
    int chosenCount = 0;
    for (int pass = 0; pass < (normal ? 2 : 1) && chosenCount < maxCount; pass++) {
        const int n = gatherSpots(contacts, count, normal, pass == 0, w->spot, w->from);
        const int keptCount = mcd_spread(w->spot, n, maxCount - chosenCount, same, w->kept);
        for (int i = 0; i < keptCount; i++)
            w->chosen[chosenCount++] = w->from[w->kept[i]];
    }
    mcd_sortAscending(w->chosen, chosenCount);
    return chosenCount;
}

size_t mcd_simplifyBytes(int count) {
    return (size_t)count * (sizeof(McdSpot) + 3 * sizeof(int));
}

int mcd_simplify(const McdContact *from, int count, McdContact *to, int maxCount, const MeReal *faceNormal, double same,
                 void *memory) {
    McdSpot *spot = memory;
    int *index = (int *)(spot + count);
    const Workplace w = {spot, index, index + count, index + 2 * count};
    const int chosenCount = chooseContacts(&w, from, count, maxCount, faceNormal, same);
    MEASSERT(chosenCount <= MeMAX(maxCount, 0) && chosenCount <= count);
    for (int i = 0; i < chosenCount; i++)
        to[i] = from[w.chosen[i]]; /* `chosen` is ascending: nothing is overwritten before it is read */
    return chosenCount;
}

int MEAPI McdContactSimplify(const MeReal *avgNormal, McdContact *contacts_src, const int nContacts_src,
                             McdContact *contacts_dst, const int nContacts_dest, const int faceNormalsFirst,
                             const MeReal scale) {
    if (nContacts_src == 0)
        return 0;
    if (!contacts_src || !contacts_dst || nContacts_src < 0 || nContacts_dest < 0) {
        MeWarning(1, "McdContactSimplify: %d contacts at %p, %d at %p", nContacts_src, (void *)contacts_src,
                  nContacts_dest, (void *)contacts_dst);
        return 0;
    }
    void *memory = MeMemoryTake(1, mcd_simplifyBytes(nContacts_src), "McdContactSimplify", "the choice of contacts");
    if (!memory)
        return 0;
    const double same = 1e-6 * (scale > 0 && MeRealIsValid(scale) ? (double)scale : 1);
    const int chosenCount = mcd_simplify(contacts_src, nContacts_src, contacts_dst, nContacts_dest,
                                         faceNormalsFirst ? avgNormal : 0, same, memory);
    MeMemoryGive(memory);
    return chosenCount;
}
