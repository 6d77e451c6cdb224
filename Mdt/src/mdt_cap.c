/* The cap on the rows of a partition (Dynamics guide ch. 4, "Limiting the Matrix Size"): which rows are left out.
 *
 * First friction rows, then contacts between bodies, then contacts with the world, each from the shallowest to the
 * deepest; with a callback of the program, by its importance instead of depth and kind. Joints are never touched, and a
 * contact group keeps one contact.
 */
#include "MeAssert.h"
#include "mdt_step_i.h"

/* Contacts that are worth as much go in the order of simulation. */
static MeBool isBefore(const MdtIslandContact *a, const MdtIslandContact *b) {
    return a->importance != b->importance ? a->importance < b->importance : a < b;
}

/* Shell's sort, which needs no memory. */
static void sortByImportance(MdtIslandContact *ranking[], int n) {
    for (int gap = n / 2; gap > 0; gap /= 2) {
        for (int i = gap; i < n; i++) {
            MdtIslandContact *c = ranking[i];
            int j = i;
            for (; j >= gap && isBefore(c, ranking[j - gap]); j -= gap)
                ranking[j] = ranking[j - gap];
            ranking[j] = c;
        }
    }
}

static double importanceOf(MdtWorldID w, const MdtIslandContact *c) {
    const double value = w->importance ? (double)w->importance((MdtContactID)c->point) : c->bcl.depth;
    return isnan(value) ? 0 : value;
}

static void rankContacts(MdtIsland *p) {
    MdtIslandContact **ranking = p->world->ranking;
    for (int i = 0; i < p->numContacts; i++) {
        MdtIslandContact *c = &p->contacts[i];
        c->importance = importanceOf(p->world, c);
        c->numKept = mdt_manifoldOf(c->point)->numPoints;
        ranking[i] = c;
    }
    sortByImportance(ranking, p->numContacts);
}

/* Returns how many rows are left. */
static int dropFriction(MdtIsland *p, int rows, int most) {
    for (int i = 0; i < p->numContacts && rows > most; i++) {
        MdtIslandContact *c = p->world->ranking[i];
        rows -= c->numRows - 1;
        c->numRows = 1;
        c->bcl.rows = 0;
    }
    return rows;
}

static MeBool isWithWorld(const MdtIslandContact *c) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(c->point)->base;
    return !base->side[0].body || !base->side[1].body;
}

static MeBool isBetweenBodies(const MdtIslandContact *c) {
    return !isWithWorld(c);
}

static MeBool isAny(const MdtIslandContact *c) {
    (void)c;
    return METRUE;
}

/* The first contact of the same manifold, which counts those that are kept. */
static MdtIslandContact *firstOfManifold(MdtIsland *p, MdtIslandContact *c) {
    const MdtManifold *m = mdt_manifoldOf(c->point);
    while (c > p->contacts && mdt_manifoldOf(c[-1].point) == m)
        c--;
    return c;
}

static int dropContacts(MdtIsland *p, int rows, int most, MeBool (*isOfKind)(const MdtIslandContact *)) {
    for (int i = 0; i < p->numContacts && rows > most; i++) {
        MdtIslandContact *c = p->world->ranking[i], *first = firstOfManifold(p, c);
        if (c->isDropped || !isOfKind(c) || (mdt_isInGroup(c->point) && first->numKept == 1))
            continue;
        MEASSERT(c->numRows <= 1 && first->numKept > 0);
        c->isDropped = METRUE;
        c->numRows = 0;
        first->numKept--;
        rows--;
    }
    return rows;
}

void mdt_capRows(MdtIsland *p, int rows, int most) {
    MEASSERT(p->numContacts <= p->world->constraintRoom);
    rankContacts(p);
    rows = dropFriction(p, rows, most);
    if (p->world->importance) {
        dropContacts(p, rows, most, isAny);
        return;
    }
    rows = dropContacts(p, rows, most, isBetweenBodies);
    dropContacts(p, rows, most, isWithWorld);
}
