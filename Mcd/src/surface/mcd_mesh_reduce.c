/* Reduces the contacts of all triangles to manifolds: clusters with one normal, each of those contacts that support the
 * others. */
#include "surface/mcd_mesh_stages_i.h"
#include "convex/mcd_landing_i.h"
#include "convex/mcd_spread_i.h"
#include <string.h>

MeBool mcd_meshReserveContacts(McdMesh *mesh, int contacts) {
    if (contacts <= mesh->contactMax)
        return METRUE;
    const int n = mesh->contactCount, max = MeMAX(contacts, 2 * mesh->contactMax + 64);
    McdSpot *spots = mesh->spots;
    McdSite *sites = mesh->sites;
    if (!MCD_MESH_GROW(mesh->contact, n, max) || !MCD_MESH_GROW(mesh->cluster, 0, max) ||
        !MCD_MESH_GROW(mesh->merged, 0, max) || !MCD_MESH_GROW(mesh->contactOrder, 0, max) ||
        !MCD_MESH_GROW(spots, 0, max))
        return MEFALSE;
    mesh->spots = spots;
    if (!MCD_MESH_GROW(sites, 0, max))
        return MEFALSE;
    mesh->sites = sites;
    if (!MCD_MESH_GROW(mesh->kept, 0, max))
        return MEFALSE;
    mesh->contactMax = max;
    return METRUE;
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

/* Orders contacts of the shape's face before those of its cap, and these by their corners; then corners before cut
 * points, then by feature and position: independent of the order of triangles. */
static int compareContacts(const McdMesh *mesh, int a, int b) {
    const McdMeshContact *x = &mesh->contact[a], *y = &mesh->contact[b];
    if (x->ofCap != y->ofCap)
        return x->ofCap - y->ofCap;
    if (x->isCut != y->isCut)
        return x->isCut - y->isCut;
    if (x->feature != y->feature)
        return x->feature < y->feature ? -1 : 1;
    for (int i = 0; i < 3; i++)
        if (x->position[i] != y->position[i])
            return x->position[i] < y->position[i] ? -1 : 1;
    return a - b;
}

static void siftDown(const McdMesh *mesh, int *index, int root, int end) {
    for (int child = 2 * root + 1; child < end; root = child, child = 2 * root + 1) {
        if (child + 1 < end && compareContacts(mesh, index[child], index[child + 1]) < 0)
            child++;
        if (compareContacts(mesh, index[root], index[child]) >= 0)
            return;
        const int swap = index[root];
        index[root] = index[child];
        index[child] = swap;
    }
}

/* For checks. */
static MeBool areContactsSorted(const McdMesh *mesh, int count) {
    for (int i = 1; i < count; i++)
        if (compareContacts(mesh, mesh->contactOrder[i - 1], mesh->contactOrder[i]) >= 0)
            return MEFALSE;
    return METRUE;
}

/* Sorts contactOrder by heapsort: in place, since qsort may allocate. */
static void sortContacts(McdMesh *mesh, int count) {
    int *index = mesh->contactOrder;
    for (int i = 0; i < count; i++)
        index[i] = i;
    for (int i = count / 2 - 1; i >= 0; i--)
        siftDown(mesh, index, i, count);
    for (int end = count - 1; end > 0; end--) {
        const int swap = index[0];
        index[0] = index[end];
        index[end] = swap;
        siftDown(mesh, index, 0, end);
    }
    MEVALIDATE(areContactsSorted(mesh, count));
}

/* Relative to the shape's extent: contacts whose surface points differ by more than this along their normal lie on two
 * planes of the surface, on either side of a fold or a step that the shape bridges. With a single manifold of four
 * points for both planes a box tilts there. With 3 times or a third of this value the displacement of a box over folds
 * changes by less than .2 %. */
static const double planeSlack = 1e-3;

/* Maximal number of contacts of a manifold over bumps: those of convex shapes lie in one plane, of a face over bumps
 * more may touch next. With eight one of two bumps that touch is left out in 1 of 4000 poses; with four in 765. */
enum { BUMPY_POINTS = 8 };

/* ---- manifolds --------------------------------------------------------------------------------------------------- */

static MeBool isInCluster(const McdMesh *mesh, int count, const double position[3], double same) {
    for (int i = 0; i < count; i++)
        if (mcd_distanceSquared(mesh->cluster[i].position, position) <= same * same)
            return METRUE;
    return MEFALSE;
}

/* Moves the first contact in contactOrder, and all with nearly the same normal, to the cluster, without duplicates
 * (nearer than `same`, m). Returns the size of the cluster. */
static int removeCluster(McdMesh *mesh, int *left, double same) {
    const McdMeshContact *first = &mesh->contact[mesh->contactOrder[0]];
    int count = 0, remaining = 0;
    for (int i = 0; i < *left; i++) {
        const McdMeshContact *c = &mesh->contact[mesh->contactOrder[i]];
        if (i > 0 && mcd_dot(c->normal, first->normal) <= MCD_MESH_SAME_MANIFOLD)
            mesh->contactOrder[remaining++] = mesh->contactOrder[i];
        else if (!isInCluster(mesh, count, c->position, same))
            mesh->cluster[count++] = *c;
    }
    MEASSERT(remaining < *left && count >= 1); /* the first one is always in the cluster */
    *left = remaining;
    return count;
}

static void setSpots(McdMesh *mesh, const McdMeshContact *contact, int count) {
    McdSpot *spot = mesh->spots;
    for (int i = 0; i < count; i++) {
        mcd_copy(spot[i].at, contact[i].position);
        mcd_copy(spot[i].at + 3, contact[i].normal);
        spot[i].separation = contact[i].separation;
    }
}

/* Moves the chosen contacts (mesh->kept, ascending) to the front. */
static int keep(const McdMesh *mesh, McdMeshContact *contact, int keptCount) {
    for (int i = 0; i < keptCount; i++) {
        MEASSERT(mesh->kept[i] >= i); /* ascending: nothing is overwritten before it is copied */
        contact[i] = contact[mesh->kept[i]];
    }
    return keptCount;
}

/* Keeps at most `maxCount` of the contacts, chosen by mcd_spread; returns their number. */
static int keepSpread(McdMesh *mesh, McdMeshContact *contact, int count, int maxCount, double same) {
    setSpots(mesh, contact, count);
    return keep(mesh, contact, mcd_spread(mesh->spots, count, maxCount, same, mesh->kept));
}

/* Adds to the kept contacts of a plane those that will be needed. Returns the number of kept ones. */
static int addLanding(const McdMeshQuery *q, const McdMeshContact *contact, int count, int keptCount) {
    static const McdKind surface = {.rank = MCD_RANK_OTHER};
    McdMesh *mesh = q->mesh;
    McdSite *site = mesh->sites;
    McdShape ground = {.kind = &surface, .extent = q->shape.extent};
    McdLanding landing;
    mcd_copy(ground.place, q->place);
    if (!q->mayLand || keptCount == count ||
        !mcd_landingBegin(&landing, &q->forecast, &q->shape, &ground, contact->normal))
        return keptCount;
    for (int i = 0; i < count; i++) {
        site[i].separation = contact[i].separation;
        for (int k = 0; k < 2; k++)
            mcd_mad(site[i].on[k], contact[i].position, (k ? -.5 : .5) * contact[i].separation, landing.normal);
    }
    keptCount = mcd_landingChoose(&landing, site, count, MCD_MANIFOLD_POINTS, keptCount, mesh->kept);
    mcd_sortAscending(mesh->kept, keptCount);
    return keptCount;
}

/* The number of contacts that are not of the cap. These come first. */
static int countOfFace(const McdMeshContact *contact, int count) {
    int n = 0;
    while (n < count && contact[n].ofCap == 0)
        n++;
    return n;
}

/* Keeps those of a plane that support the others, of the shape's face if there are any, and those that will be
 * needed. */
static int keepOfPlane(const McdMeshQuery *q, McdMeshContact *contact, int count, int maxCount, double same) {
    McdMesh *mesh = q->mesh;
    const int ofFace = countOfFace(contact, count), candidates = ofFace ? ofFace : count;
    setSpots(mesh, contact, candidates);
    const int keptCount = mcd_spread(mesh->spots, candidates, maxCount, same, mesh->kept);
    return keep(mesh, contact, addLanding(q, contact, count, keptCount));
}

/* The coordinate of a contact's surface point along a normal. */
static double heightOf(const McdMeshContact *c, const double normal[3]) {
    return mcd_dot(c->position, normal) - c->separation / 2;
}

static int deepestOf(const McdMeshContact *contact, int count) {
    int deepest = 0;
    for (int i = 1; i < count; i++)
        if (contact[i].separation < contact[deepest].separation)
            deepest = i;
    return deepest;
}

/* Whether two contacts of one face of the shape lie on different planes of the surface. */
static MeBool areOnTwoPlanes(const McdMeshContact *a, const McdMeshContact *b, double slack) {
    return mcd_meshAreParallel(a->normal, b->normal) && fabs(heightOf(a, b->normal) - heightOf(b, b->normal)) > slack;
}

/* Moves the contacts on the plane of the deepest contact to the front and returns their number. Keeps the order within
 * both groups. */
static int moveDeepestPlane(McdMesh *mesh, McdMeshContact *contact, int count, double slack) {
    const McdMeshContact deepest = contact[deepestOf(contact, count)];
    McdMeshContact *others = mesh->merged; /* its end: the array has room for all contacts */
    int onPlane = 0, other = mesh->contactMax;
    for (int i = count - 1; i >= 0; i--)
        if (areOnTwoPlanes(&contact[i], &deepest, slack))
            others[--other] = contact[i];
    if (other == mesh->contactMax)
        return count;
    for (int i = 0; i < count; i++)
        if (!areOnTwoPlanes(&contact[i], &deepest, slack))
            contact[onPlane++] = contact[i];
    memcpy(contact + onPlane, others + other, (size_t)(mesh->contactMax - other) * sizeof *contact);
    return onPlane;
}

/* Whether the shape's point of a contact is deeper below a triangle of another contact's plane than below its own. */
static MeBool isBelowPlane(const McdMeshQuery *q, const McdMeshContact *c, const McdMeshContact *plane, double slack) {
    double point[3], foot[3], offset[3], in, out;
    mcd_mad(point, c->position, c->separation / 2, c->normal);
    mcd_mad(foot, plane->position, -plane->separation / 2, plane->normal);
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        if (t->isFlat || fabs(mcd_dot(t->normal, plane->normal)) < MCD_MESH_SAME_MANIFOLD ||
            !mcd_meshClipSegment(t, point, point, MCD_MESH_OVERLAP * q->shape.extent, &in, &out))
            continue;
        mcd_sub(offset, foot, t->corner[0]);
        if (fabs(mcd_dot(offset, t->normal)) > slack)
            continue;
        mcd_sub(offset, point, foot);
        if (mcd_dot(offset, plane->normal) < c->separation)
            return METRUE;
    }
    return MEFALSE;
}

/* Whether the surface has bumps, higher than slack, below the contacts. */
static MeBool isBumpy(const McdMeshContact *contact, int count, double slack) {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < count; i++) {
        const double height = heightOf(&contact[i], contact->normal);
        low = fmin(low, height);
        high = fmax(high, height);
    }
    return high - low > slack;
}

/* Appends the manifolds of a cluster, one for each plane, in descending order of depth. Contacts of a plane whose point
 * on the shape is below a deeper plane are dropped. Returns the new number of contacts. */
static int addManifolds(const McdMeshQuery *q, int size, int count, double same) {
    McdMesh *mesh = q->mesh;
    McdMeshContact *left = mesh->cluster;
    const double slack = planeSlack * q->shape.extent;
    while (size) {
        const int onPlane = moveDeepestPlane(mesh, left, size, slack);
        McdMeshContact *others = left + onPlane;
        int remaining = 0;
        for (int i = 0; i < size - onPlane; i++)
            if (!isBelowPlane(q, &others[i], left, slack))
                others[remaining++] = others[i];
        const int max = isBumpy(left, onPlane, slack) ? BUMPY_POINTS : MCD_FACE_CONTACTS;
        const int keptCount = keepOfPlane(q, left, onPlane, max, same);
        for (int i = 0; i < keptCount; i++)
            left[i].dims = mcd_regionDims(keptCount);
        memcpy(mesh->merged + count, left, (size_t)keptCount * sizeof *left);
        count += keptCount;
        left = others;
        size = remaining;
    }
    return count;
}

void mcd_meshReduceContacts(McdMeshQuery *q, int max) {
    McdMesh *mesh = q->mesh;
    McdMeshContact *out = mesh->merged;
    const double same = 1e-6 * q->shape.extent;
    int left = mesh->contactCount, count = 0;
    sortContacts(mesh, left);
    while (left) {
        const int size = removeCluster(mesh, &left, same);
        count = addManifolds(q, size, count, same);
    }
    if (count > max)
        count = keepSpread(mesh, out, count, max, same);
    MEASSERT(count <= MeMIN(max, mesh->contactCount));
    mesh->merged = mesh->contact;
    mesh->contact = out;
    mesh->contactCount = count;
}
