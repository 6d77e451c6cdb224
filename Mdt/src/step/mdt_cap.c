/* The cap on the rows of a partition (Dynamics guide ch. 4, "Limiting the Matrix Size"): selects rows to leave out.
 *
 * First friction rows, then contacts between bodies, then contacts with the world, each from the shallowest to the
 * deepest. If the program has set a callback, its importance replaces depth and the distinction of bodies and world.
 * Joints keep their rows, and a contact group keeps one contact.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"
#include <limits.h>

/* A contact of the partition. Contacts of a group are consecutive. */
typedef struct MdtRanked {
    const MdtPoint *point;
    MdtKeaPoint *at;
    double importance;
    int first;   /* index of its group's first contact, or its own */
    int numKept; /* of a first contact: how many contacts of the group still have rows */
    int place;   /* entry i of a separate ranking: index of the i-th least important contact */
} MdtRanked;

/* Contacts of equal importance are ordered as in simulation. */
static MeBool isBefore(const MdtRanked ranking[], int a, int b) {
    const double x = ranking[a].importance, y = ranking[b].importance;
    return x != y ? x < y : a < b;
}

/* Shell's sort, which needs no further memory. */
static void sortByImportance(MdtRanked ranking[], int n) {
    for (int i = 0; i < n; i++)
        ranking[i].place = i;
    for (int gap = n / 2; gap > 0; gap /= 2) {
        for (int i = gap; i < n; i++) {
            const int c = ranking[i].place;
            int j = i;
            for (; j >= gap && isBefore(ranking, c, ranking[j - gap].place); j -= gap)
                ranking[j].place = ranking[j - gap].place;
            ranking[j].place = c;
        }
    }
}

static MeBool areRanked(const MdtRanked ranking[], int n) {
    for (int i = 1; i < n; i++)
        if (!isBefore(ranking, ranking[i - 1].place, ranking[i].place))
            return MEFALSE;
    return METRUE;
}

static double importanceOf(const MdtWorld *w, const MdtPoint *point, double depth) {
    double value = depth;
    if (w->importance) {
        const MeProgramCall before = MeProgramEnter("MdtWorldSetContactImportanceCB");
        value = (double)w->importance((MdtContactID)(uintptr_t)point);
        MeProgramLeave(&before);
    }
    return isnan(value) ? 0 : value;
}

static void rankContacts(const MdtIsland *p, MdtRanked ranking[]) {
    int n = 0;
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++, n++) {
            MdtRanked *c = &ranking[n];
            c->point = p->manifolds[i].point[k];
            c->at = &p->kea.manifolds[i].point[k];
            c->importance = importanceOf(p->world, c->point, c->at->depthNow);
            c->numKept = mdt_manifoldOf(c->point)->numPoints;
            c->first = n > 0 && mdt_manifoldOf(c[-1].point) == mdt_manifoldOf(c->point) ? c[-1].first : n;
        }
    MEASSERT(n == p->numContacts);
    sortByImportance(ranking, n);
    MEVALIDATE(areRanked(ranking, n));
}

/* Removes the friction rows of the least important contacts. Returns the number of rows left. */
static int dropFriction(const MdtIsland *p, MdtRanked ranking[], int rows, int max) {
    for (int i = 0; i < p->numContacts && rows > max; i++) {
        MdtKeaPoint *at = ranking[ranking[i].place].at;
        if (at->numRows <= 1) /* none: its bodies' axes are locked */
            continue;
        rows -= at->numRows - 1;
        at->numRows = 1;
    }
    return rows;
}

static MeBool isWithWorld(const MdtPoint *point) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(point)->base;
    return !mdt_sideBody(base, 0) || !mdt_sideBody(base, 1);
}

/* Sets of contacts: between two bodies, and with the world. */
enum { BETWEEN_BODIES = 1, WITH_WORLD = 2 };

static int dropContacts(const MdtIsland *p, MdtRanked ranking[], int rows, int max, int set) {
    for (int i = 0; i < p->numContacts && rows > max; i++) {
        MdtRanked *c = &ranking[ranking[i].place], *first = &ranking[c->first];
        if (c->at->numRows == 0 || !(set & (isWithWorld(c->point) ? WITH_WORLD : BETWEEN_BODIES)) ||
            (mdt_isInGroup(c->point) && first->numKept == 1))
            continue;
        MEASSERT(c->at->numRows == 1 && first->numKept > 0);
        c->at->numRows = 0;
        first->numKept--;
        rows--;
    }
    return rows;
}

/* Leaves out rows in the documented order. Returns the number of rows left. */
static int dropRows(const MdtIsland *p, MdtRanked ranking[], int rows, int max) {
    rows = dropFriction(p, ranking, rows, max);
    if (p->world->importance)
        return dropContacts(p, ranking, rows, max, BETWEEN_BODIES | WITH_WORLD);
    rows = dropContacts(p, ranking, rows, max, BETWEEN_BODIES);
    return dropContacts(p, ranking, rows, max, WITH_WORLD);
}

int mdt_capRows(MdtIsland *p, int rows, int max) {
    const size_t bytes = (size_t)p->numContacts * sizeof(MdtRanked);
    MdtRanked *ranking = bytes <= INT_MAX ? MeChunkGetMem(&p->worker->ranking, (int)bytes) : NULL;
    p->isCapped = METRUE;
    MEASSERT(rows > max);
    if (!ranking)
        return rows;
    rankContacts(p, ranking);
    if (p->world->importance) /* the callback may have changed joints, though it must not */
        rows = mdt_rowsCount(p);
    rows = dropRows(p, ranking, rows, max);
    MeChunkPutMem(&p->worker->ranking, ranking);
    return rows;
}
