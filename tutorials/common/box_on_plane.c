/* Contacts of boxes with a plane: one per corner. */
#include "box_on_plane.h"

static const MeReal margin = (MeReal)0.02; /* m, above the plane */

void boxCreate(BoxOnPlane *box, MdtWorldID world, const MeReal size[3], MeReal mass) {
    MeMatrix3 inertia;
    box->body = MdtBodyCreate(world);
    MdtBodySetMass(box->body, mass);
    MdtMakeInertiaTensorBox(mass, size[0], size[1], size[2], inertia);
    MdtBodySetInertiaTensor(box->body, inertia);
    MdtBodyEnable(box->body);
    for (int i = 0; i < 3; i++)
        box->half[i] = size[i] / 2;
    MdtContactParamsReset(&box->params);
    box->group = MdtContactGroupCreate(world);
    MdtContactGroupSetBodies(box->group, box->body, 0);
    MdtContactGroupEnable(box->group);
}

/* A corner of the box in the world frame: bit `axis` of its number, 0 to 7, is the side along that axis. */
static void cornerOf(const BoxOnPlane *box, int number, MeVector3 corner) {
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(box->body);
    for (int i = 0; i < 3; i++) {
        corner[i] = tm[3][i];
        for (int axis = 0; axis < 3; axis++)
            corner[i] += (number >> axis & 1 ? box->half[axis] : -box->half[axis]) * tm[axis][i];
    }
}

static MeReal heightAbove(const Plane *plane, const MeVector3 p) {
    MeReal height = 0;
    for (int i = 0; i < 3; i++)
        height += (p[i] - plane->point[i]) * plane->normal[i];
    return height;
}

static void touchAt(BoxOnPlane *box, const Plane *plane, const MeVector3 p, MeReal depth) {
    MdtContactID contact = MdtContactGroupCreateContact(box->group);
    MdtContactSetPosition(contact, p[0], p[1], p[2]);
    MdtContactSetNormal(contact, plane->normal[0], plane->normal[1], plane->normal[2]);
    MdtContactSetDirection(contact, plane->along[0], plane->along[1], plane->along[2]);
    MdtContactSetPenetration(contact, depth);
    MdtContactSetParams(contact, &box->params);
}

void boxTouchPlane(BoxOnPlane *box, const Plane *plane) {
    MdtContactGroupReset(box->group);
    for (int i = 0; i < 8; i++) {
        MeVector3 corner;
        cornerOf(box, i, corner);
        const MeReal height = heightAbove(plane, corner);
        if (height < margin)
            touchAt(box, plane, corner, -height);
    }
}
