/* Edges of triangles that something round rolls over: the normal turns about the edge within the step, as long as the
 * round side's centre stays beside each triangle that has this edge. Where it comes over one of them, the contact keeps
 * its normal, or that of the chord (mcd_mesh_sweep.c). */
#include "surface/mcd_mesh_stages_i.h"

/* Relative to the extent: within this distance of an edge a contact is on it. Its normal, which is no face's, says that
 * it is on some edge; the search for it ends at less than that. */
static const double onEdge = 1e-5;

/* Side i of a triangle. */
static void directionOf(const McdMeshTriangle *t, int i, double along[3]) {
    mcd_sub(along, t->corner[(i + 1) % 3], t->corner[i]);
    mcd_scale(along, along, 1 / mcd_length(along));
}

/* Whether the point lies on the line of side i, at right angles to the normal. */
static MeBool isOnSide(const McdMeshTriangle *t, int i, const double point[3], const double normal[3], double slack,
                       double along[3]) {
    static const double across = 1e-3; /* rad */
    double from[3], aside[3];
    directionOf(t, i, along);
    mcd_sub(from, point, t->corner[i]);
    mcd_cross(aside, from, along);
    return fabs(mcd_dot(along, normal)) < across && mcd_length(aside) <= slack;
}

/* Writes the axis of the edge at the point, unless the normal is that of one of its triangles, or the centre comes over
 * one. */
static void findEdge(const McdMesh *mesh, const double point[3], const double normal[3], const double centre[3],
                     double slack, double edge[3]) {
    double found[3] = {0, 0, 0};
    for (int k = 0; k < mesh->count; k++)
        for (int i = 0; i < 3; i++) {
            const McdMeshTriangle *t = &mesh->triangle[k];
            double along[3];
            if (t->isFlat || !isOnSide(t, i, point, normal, slack, along))
                continue;
            if (mcd_meshAreParallel(normal, t->normal) || mcd_heightOver(centre, t->corner[i], t->inward[i]) > 0)
                return;
            mcd_copy(found, along);
        }
    mcd_copy(edge, found);
}

/* Not of bodies on joints, whose normals do not turn within the step. */
void mcd_meshMarkEdges(McdMeshQuery *q) {
    if (q->pair->isJointed)
        return;
    for (int i = 0; i < q->mesh->contactCount; i++) {
        McdMeshContact *c = &q->mesh->contact[i];
        double point[3], centre[3];
        if (!(c->radius > 0) || c->isOnFace)
            continue;
        mcd_mad(point, c->position, -c->separation / 2, c->normal);
        mcd_mad(centre, point, c->radius + c->separation, c->normal);
        mcd_mad(centre, centre, 1, q->displacement);
        findEdge(q->mesh, point, c->normal, centre, onEdge * q->shape.extent, c->edge);
    }
}
