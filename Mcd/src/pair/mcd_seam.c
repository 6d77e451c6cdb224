/* Seams: a body slides from one fixed box onto the next as if they were one.
 *
 * Speculative contacts are made along the shortest displacement between two shapes. For a box that slides on a floor
 * of tiles this is along the floor to the side of the next tile, although the box will pass over that tile: it
 * stopped at the seam. A body beyond the plane of a box's face can hit the box only through this plane; and if the
 * body is separated from the box but flush with the plane, it has not reached the face yet. When it does, the
 * contact is with the face. */
#include "McdContact.h"
#include "McdInternal.h"
#include "model/mcd_frame_i.h"
#include <math.h>

/* Relative to a model's radius: how near to the plane is flush. Larger than the depth of resting contacts, and than
 * rounding of single precision at a hundred times the model's size from the origin; a step of this height is
 * climbed. With twice or half of it Mst_Seams fails: what_is_flush_to_a_ten_thousandth_of_its_radius_passes. */
static const double flushShare = 1e-4;

static double radiusOf(McdModelID m) {
    MeVector3 centre;
    MeReal radius;
    McdGeometryGetBSphere(mcd_record(m)->instance.geometry, centre, &radius);
    return (double)radius;
}

/* m: the distance of m beyond the plane of the box's face; negative: below it. */
static double beyondFace(McdModelID box, McdModelID m, MeVector3 outward) {
    MeVector3 inward, face, nearest;
    MeVector3MultiplyScalar(inward, outward, -1);
    const McdGeometryInstance *a = &mcd_record(box)->instance, *b = &mcd_record(m)->instance;
    McdGeometryMaximumPoint(a->geometry, mcd_const(a->tm), outward, face);
    McdGeometryMaximumPoint(b->geometry, mcd_const(b->tm), inward, nearest);
    MeVector3Subtract(nearest, nearest, face);
    return (double)MeVector3Dot(nearest, outward);
}

/* Whether the contact is not with the face: the models are separated, or the normal differs from the face's by more
 * than 60 degrees. */
static MeBool isBesideFace(const McdContact *contact, const MeVector3 outward, double max) {
    return McdContactGetSeparation(contact) > max || 2 * MeFabs(MeVector3Dot(contact->normal, outward)) < 1;
}

static MeBool isFlush(McdModelID box, McdModelID m, const McdContact *contact, double max) {
    const MeMatrix4Ptr tm = mcd_record(box)->instance.tm;
    for (int i = 0; i < 6; i++) {
        MeVector3 outward;
        MeVector3MultiplyScalar(outward, tm[i / 2], i % 2 ? -1 : 1);
        if (isBesideFace(contact, outward, max) && fabs(beyondFace(box, m, outward)) <= max)
            return METRUE;
    }
    return MEFALSE;
}

static MeBool isBox(McdModelID m) {
    return mcd_record(m)->instance.geometry->type == kMcdGeometryTypeBox;
}

static const McdContact *nearestContact(const McdContact contacts[], int count) {
    const McdContact *nearest = contacts;
    for (int i = 1; i < count; i++)
        if (McdContactGetSeparation(&contacts[i]) < McdContactGetSeparation(nearest))
            nearest = &contacts[i];
    return nearest;
}

MeBool MEAPI McdModelPairPassesSeam(const McdModelPair *p, const MeBool mayMove[2], const McdContact contacts[],
                                    int count) {
    const MeBool isFirst = !mayMove[0] && isBox(p->model1);
    if (count == 0 || (!isFirst && (mayMove[1] || !isBox(p->model2))))
        return MEFALSE;
    const McdContact *nearest = nearestContact(contacts, count);
    const McdModelID box = isFirst ? p->model1 : p->model2, m = isFirst ? p->model2 : p->model1;
    const double max = flushShare * radiusOf(m);
    return McdContactGetSeparation(nearest) > -max && isFlush(box, m, nearest, max);
}
