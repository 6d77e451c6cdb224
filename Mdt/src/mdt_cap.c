/* The cap on the rows of a partition (Dynamics guide ch. 4, "Limiting the Matrix Size"): which rows are left out.
 *
 * First friction rows, then contacts between bodies, then contacts with the world, each from the shallowest to the
 * deepest; with a callback of the program, by its importance instead of depth and kind. Joints are never touched, and a
 * contact group keeps one contact.
 */
#include "MeAssert.h"
#include "mdt_i.h"
#include "MeAssert.h"

/* Contacts that are worth as much go in the order of simulation. */
static MeBool isBefore(const MdtBaseConstraint *a, const MdtBaseConstraint *b) {
    return a->importance != b->importance ? a->importance < b->importance : a->rank < b->rank;
}

/* Shell's sort, which needs no memory. */
static void sortByImportance(MdtConstraintID ranking[], int n) {
    for (int gap = n / 2; gap > 0; gap /= 2) {
        for (int i = gap; i < n; i++) {
            MdtConstraintID c = ranking[i];
            int j = i;
            for (; j >= gap && isBefore(c, ranking[j - gap]); j -= gap)
                ranking[j] = ranking[j - gap];
            ranking[j] = c;
        }
    }
}

static double importanceOf(MdtWorldID w, MdtConstraintID c) {
    const double value = w->importance ? (double)w->importance((MdtContactID)c) : c->bcl.of.contact.depth;
    return isnan(value) ? 0 : value;
}

static int rankContacts(MdtWorldID w, MdtConstraintID constraints[], int count) {
    int n = 0;
    for (int i = 0; i < count; i++) {
        MdtConstraintID c = constraints[i];
        if (c->group)
            c->group->numKept = 0;
        if (c->bcl.type != MdtBclCONTACT)
            continue;
        c->importance = importanceOf(w, c);
        c->rank = n;
        w->ranking[n++] = c;
    }
    for (int i = 0; i < n; i++)
        if (w->ranking[i]->group)
            w->ranking[i]->group->numKept++;
    sortByImportance(w->ranking, n);
    return n;
}

/* Returns how many rows are left. */
static int dropFriction(MdtWorldID w, int n, int rows, int most) {
    for (int i = 0; i < n && rows > most; i++) {
        MdtConstraintID c = w->ranking[i];
        rows -= c->numRows - 1;
        c->numRows = 1;
        c->bcl.of.contact.rows = 0;
    }
    return rows;
}

static MeBool isWithWorld(const MdtBaseConstraint *c) {
    return !c->side[0].body || !c->side[1].body;
}

static int dropContacts(MdtWorldID w, int n, int rows, int most, MeBool (*isOfKind)(const MdtBaseConstraint *)) {
    for (int i = 0; i < n && rows > most; i++) {
        MdtConstraintID c = w->ranking[i];
        if (c->isDropped || !isOfKind(c) || (c->group && c->group->numKept == 1))
            continue;
        MEASSERT(c->numRows <= 1 && (!c->group || c->group->numKept > 1));
        c->isDropped = METRUE;
        c->numRows = 0;
        if (c->group)
            c->group->numKept--;
        MEASSERT(!c->group || c->group->numKept > 0);
        rows--;
    }
    return rows;
}

static MeBool isBetweenBodies(const MdtBaseConstraint *c) {
    return !isWithWorld(c);
}

static MeBool isAny(const MdtBaseConstraint *c) {
    (void)c;
    return METRUE;
}

int mdt_capRows(MdtWorldID w, MdtConstraintID constraints[], int count, int rows, int most) {
    const int n = rankContacts(w, constraints, count);
    MEASSERT(n <= count);
    rows = dropFriction(w, n, rows, most);
    if (w->importance)
        return dropContacts(w, n, rows, most, isAny);
    rows = dropContacts(w, n, rows, most, isBetweenBodies);
    return dropContacts(w, n, rows, most, isWithWorld);
}
