/* The contacts of boxes with a plane, for tutorials: collision in its simplest form.
 *
 * A box touches a plane with its corners. Before every step the contacts of the last one are thrown away, and a new one
 * is made at every corner that is in the plane, or so near above it that it could get there within the step.
 */
#ifndef BOX_ON_PLANE_H
#define BOX_ON_PLANE_H

#include "Mdt.h"

typedef struct {
    MdtBodyID body;
    MeReal half[3];             /* m */
    MdtContactGroupID group;    /* the contacts of this box with the world */
    MdtBclContactParams params; /* what its contacts are like */
} BoxOnPlane;

typedef struct {
    MeVector3 point, normal; /* a point of the plane; unit, out of it */
    MeVector3 along;         /* the primary direction of friction in it */
} Plane;

/* An enabled body for a box of a size [m] and mass [kg], and the group of its contacts. */
void boxCreate(BoxOnPlane *box, MdtWorldID world, const MeReal size[3], MeReal mass);

/* Makes the contacts for the next step. */
void boxTouchPlane(BoxOnPlane *box, const Plane *plane);

#endif
