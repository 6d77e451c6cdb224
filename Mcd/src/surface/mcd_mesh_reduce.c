/* Reduces the contacts of all triangles to manifolds: clusters with one normal, each of at most four well-spread
 * contacts. */
#include "surface/mcd_mesh_stages_i.h"
#include "model/mcd_spread_i.h"
#include <string.h>

MeBool mcd_meshReserveContacts(McdMesh *mesh, int contacts) {
    if (contacts <= mesh->contactMax)
        return METRUE;
    const int n = mesh->contactCount, max = MeMAX(contacts, 2 * mesh->contactMax + 64);
    McdSpot *spots = mesh->spots;
    if (!MCD_MESH_GROW(mesh->contact, n, max) || !MCD_MESH_GROW(mesh->cluster, 0, max) ||
        !MCD_MESH_GROW(mesh->merged, 0, max) || !MCD_MESH_GROW(mesh->contactOrder, 0, max) ||
        !MCD_MESH_GROW(spots, 0, max))
        return MEFALSE;
    mesh->spots = spots;
    if (!MCD_MESH_GROW(mesh->kept, 0, max))
        return MEFALSE;
    mesh->contactMax = max;
    return METRUE;
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

/* Orders corners of the shape before cut points, then by feature and position: independent of the order of
 * triangles. */
static int compareContacts(const McdMesh *mesh, int a, int b) {
    const McdMeshContact *x = &mesh->contact[a], *y = &mesh->contact[b];
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

/* Keeps at most `maxCount` of the contacts, chosen by mcd_spread; returns their number. */
static int keepSpread(McdMesh *mesh, McdMeshContact *contact, int count, int maxCount, double same) {
    McdSpot *spot = mesh->spots;
    for (int i = 0; i < count; i++) {
        mcd_copy(spot[i].position, contact[i].position);
        mcd_copy(spot[i].normal, contact[i].normal);
        spot[i].separation = contact[i].separation;
    }
    const int keptCount = mcd_spread(spot, count, maxCount, same, mesh->kept);
    MEASSERT(keptCount >= 0 && keptCount <= MeMIN(count, maxCount));
    for (int i = 0; i < keptCount; i++) {
        MEASSERT(mesh->kept[i] >= i); /* ascending: nothing is overwritten before it is copied */
        contact[i] = contact[mesh->kept[i]];
    }
    return keptCount;
}

void mcd_meshReduceContacts(McdMeshQuery *q, int max) {
    McdMesh *mesh = q->mesh;
    McdMeshContact *out = mesh->merged;
    const double same = 1e-6 * q->shape.extent;
    int left = mesh->contactCount, count = 0;
    sortContacts(mesh, left);
    while (left) {
        const int size = removeCluster(mesh, &left, same);
        const int keptCount = keepSpread(mesh, mesh->cluster, size, MCD_MANIFOLD_POINTS, same);
        for (int i = 0; i < keptCount; i++)
            mesh->cluster[i].dims = mcd_regionDims(keptCount);
        memcpy(out + count, mesh->cluster, (size_t)keptCount * sizeof *out);
        count += keptCount;
    }
    if (count > max)
        count = keepSpread(mesh, out, count, max, same);
    MEASSERT(count <= MeMIN(max, mesh->contactCount));
    mesh->merged = mesh->contact;
    mesh->contact = out;
    mesh->contactCount = count;
}
