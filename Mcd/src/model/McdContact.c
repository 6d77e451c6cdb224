/* Contacts: accessors, and contact reduction: choosing a few points that support as well as many. */
#include "McdContact.h"
#include "McdInternal.h"
#include "model/mcd_result_i.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_shape_i.h"
#include "model/mcd_spread_i.h"
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

static double rimOfShape(const McdContact *c, int side, McdGeometryInstanceID ins, double axis[3]) {
    double place[3], outward[3], point[3];
    McdShape shape;
    positionOf(c, place);
    if (!mcd_shapeOf(ins, place, &shape))
        return 0;
    for (int i = 0; i < 3; i++) {
        outward[i] = (side == 0 ? -1 : 1) * (double)c->normal[i];
        point[i] = -0.5 * c->exactSeparation * outward[i];
    }
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

double MEAPI McdContactGetRim(const McdContact *c, int side, double axis[3]) {
    if (!c || !axis || side < 0 || side > 1) {
        MeWarning(1, "McdContactGetRim: %s",
                  !c     ? "no contact"
                  : axis ? "side must be 0, for the first model, or 1"
                         : "no place for the axis");
        return 0;
    }
    if ((side == 0 ? c->instance1 : c->instance2) && !instanceOf(c, side))
        MeWarning(1, "McdContactGetRim: the contact's model has been destroyed");
    return rimOf(c, side, axis);
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

void MEAPI McdContactGetExact(const McdContact *c, McdExactContact *exact) {
    MEASSERT(c && exact);
    positionOf(c, exact->position);
    exact->separation = separationOf(c);
    for (int side = 0; side < 2; side++) {
        exact->radius[side] = radiusOf(c, side);
        exact->isVertex[side] = isVertex(c, side);
        exact->rim[side] = rimOf(c, side, exact->axis[side]);
    }
}

static void difference(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    memcpy(out, c, sizeof c);
}

/* ---- spots with one normal ------------------------------------------------------------------- */

static int farthestFrom(const McdSpot *spot, int count, const double place[3]) {
    int best = 0;
    double max = -1;
    for (int i = 0; i < count; i++) {
        double d[3];
        difference(spot[i].position, place, d);
        if (dot(d, d) > max) {
            max = dot(d, d);
            best = i;
        }
    }
    return best;
}

static int deepestOf(const McdSpot *spot, int count) {
    int best = 0;
    for (int i = 1; i < count; i++)
        if (spot[i].separation < spot[best].separation)
            best = i;
    return best;
}

/* Twice the area of the triangle a, b, c, seen along the normal: positive if c is on the left of a -> b. */
static double areaBeside(const McdSpot *a, const McdSpot *b, const McdSpot *c, const double normal[3]) {
    double ab[3], ac[3], n[3];
    difference(b->position, a->position, ab);
    difference(c->position, a->position, ac);
    cross(ab, ac, n);
    return dot(n, normal);
}

/* The spot farthest to one side (sign 1: left, -1: right) of the line from a to b, seen along the normal; `area`
 * gets twice the area of its triangle. */
static int farthestBeside(const McdSpot *spot, int count, int a, int b, const double normal[3], double sign,
                          double *area) {
    int best = a;
    *area = 0;
    for (int i = 0; i < count; i++) {
        const double here = sign * areaBeside(&spot[a], &spot[b], &spot[i], normal);
        if (here > *area) {
            *area = here;
            best = i;
        }
    }
    return best;
}

/* Chooses up to four extreme spots: two far ends, and the spot farthest from their line on either side; if the
 * second side is empty, the spot that adds most area beyond the triangle's two other sides. All areas are seen along
 * one normal, since the spots' own normals differ by up to 1.1 degrees: along two of them a corner might lie outside
 * of its own triangle. */
static int keepExtremes(const McdSpot *spot, int count, int maxCount, double same, int *kept) {
    double mean[3] = {0, 0, 0}, ab[3];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            mean[k] += spot[i].position[k] / count;
    const int a = farthestFrom(spot, count, mean), b = farthestFrom(spot, count, spot[a].position);
    difference(spot[b].position, spot[a].position, ab);
    const double length = sqrt(dot(ab, ab));
    kept[0] = a;
    if (maxCount == 1 || !(length > same)) /* or NaN: the positions are not finite */
        return 1;
    kept[1] = b;
    if (maxCount == 2)
        return 2;
    const double *normal = spot[a].normal;
    double left, right;
    const int l = farthestBeside(spot, count, a, b, normal, 1, &left);
    const int r = farthestBeside(spot, count, a, b, normal, -1, &right);
    const double min = MeMAX(same, 1e-6 * length) * length;
    const int first = left >= right ? l : r, second = left >= right ? r : l;
    if (MeMAX(left, right) <= min)
        return 2;
    kept[2] = first;
    if (maxCount == 3)
        return 3;
    if (MeMIN(left, right) > min) {
        kept[3] = second;
        return 4;
    }
    const double outward = left >= right ? -1 : 1; /* a -> b -> first turns left if `left`: outside is right */
    double across[2];
    const int beyond[2] = {farthestBeside(spot, count, b, first, normal, outward, &across[0]),
                           farthestBeside(spot, count, first, a, normal, outward, &across[1])};
    const int better = across[1] > across[0];
    if (across[better] <= min)
        return 3;
    kept[3] = beyond[better];
    return 4;
}

/* Replaces the nearest kept spot by the deepest spot, if that is deeper than all kept ones. */
static void includeDeepest(const McdSpot *spot, int count, int *kept, int keptCount) {
    const int deepest = deepestOf(spot, count);
    double lowest = spot[kept[0]].separation, size = 0, nearest = INFINITY;
    int place = 0;
    for (int i = 0; i < keptCount; i++) {
        double d[3];
        difference(spot[kept[i]].position, spot[deepest].position, d);
        lowest = fmin(lowest, spot[kept[i]].separation);
        size = fmax(size, dot(d, d));
        if (dot(d, d) < nearest) {
            nearest = dot(d, d);
            place = i;
        }
    }
    if (spot[deepest].separation < lowest - 1e-7 * sqrt(size))
        kept[place] = deepest;
}

/* ---- spots with any normals ------------------------------------------------------------------ */

static double differenceSquared(const McdSpot *a, const McdSpot *b, double size) {
    double d[3], n[3];
    difference(a->position, b->position, d);
    difference(a->normal, b->normal, n);
    return dot(d, d) + size * size * dot(n, n);
}

static double extentOfSpots(const McdSpot *spot, int count) {
    double d[3];
    difference(spot[farthestFrom(spot, count, spot[0].position)].position, spot[0].position, d);
    return sqrt(dot(d, d));
}

/* Updates each spot's distance from the chosen ones, after one more was chosen. Spots that are not finite get
 * distance 0, so they are never chosen. */
static void updateDistances(McdSpot *spot, int count, const McdSpot *chosen, double size) {
    for (int i = 0; i < count; i++) {
        const double distance2 = differenceSquared(&spot[i], chosen, size);
        spot[i].distance2 = isnan(distance2) ? 0 : fmin(spot[i].distance2, distance2);
    }
}

static int addFarthest(McdSpot *spot, int count, int maxCount, double same, int *kept, int keptCount) {
    const double size = fmax(extentOfSpots(spot, count), same);
    for (int i = 0; i < count; i++)
        spot[i].distance2 = INFINITY;
    for (int k = 0; k < keptCount; k++)
        updateDistances(spot, count, &spot[kept[k]], size);
    while (keptCount < maxCount) {
        int best = 0;
        for (int i = 1; i < count; i++)
            if (spot[i].distance2 > spot[best].distance2)
                best = i;
        if (!(spot[best].distance2 > same * same))
            break;
        kept[keptCount++] = best;
        updateDistances(spot, count, &spot[best], size);
    }
    return keptCount;
}

static MeBool haveOneNormal(const McdSpot *spot, int count) {
    for (int i = 1; i < count; i++)
        if (dot(spot[i].normal, spot[0].normal) < .9998) /* 1.1 degrees */
            return MEFALSE;
    return METRUE;
}

static void sortAscending(int *kept, int count) {
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && kept[k] < kept[k - 1]; k--) {
            const int swap = kept[k];
            kept[k] = kept[k - 1];
            kept[k - 1] = swap;
        }
}

static MeBool areAscending(const int *kept, int count) {
    for (int i = 1; i < count; i++)
        if (kept[i] <= kept[i - 1])
            return MEFALSE;
    return METRUE;
}

int mcd_spread(McdSpot *spot, int count, int maxCount, double same, int *kept) {
    int keptCount;
    if (count <= 0 || maxCount <= 0)
        return 0;
    if (haveOneNormal(spot, count)) {
        keptCount = keepExtremes(spot, count, MeMIN(maxCount, 4), same, kept);
        includeDeepest(spot, count, kept, keptCount);
        if (maxCount > 4)
            keptCount = addFarthest(spot, count, maxCount, same, kept, keptCount);
    } else {
        kept[0] = deepestOf(spot, count);
        keptCount = addFarthest(spot, count, maxCount, same, kept, 1);
    }
    sortAscending(kept, keptCount);
    MEASSERT(keptCount >= 1 && keptCount <= maxCount && kept[0] >= 0 && kept[keptCount - 1] < count);
    MEVALIDATE(areAscending(kept, keptCount));
    return keptCount;
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

static McdSpot spotOf(const McdContact *c, const McdContact *reference) {
    McdSpot s;
    for (int i = 0; i < 3; i++) {
        s.position[i] = (double)c->position[i] - (double)reference->position[i];
        s.normal[i] = (double)c->normal[i];
    }
    s.separation = (double)c->separation;
    s.distance2 = 0;
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
    sortAscending(w->chosen, chosenCount);
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
