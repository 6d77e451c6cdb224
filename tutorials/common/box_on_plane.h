/* Contacts of boxes with a plane, for tutorials: a minimal collision detection.
 *
 * A box touches a plane with its corners. Before each step, the contacts of the last one are removed, and a new one is
 * made for each corner below the plane, or so close above it that it may reach the plane within the step.
 */
#ifndef BOX_ON_PLANE_H
#define BOX_ON_PLANE_H

#include "Mdt.h"

typedef struct {
    MdtBodyID body;
    MeReal half[3];             /* m */
    MdtContactGroupID group;    /* contacts of the box with the world */
    MdtBclContactParams params; /* parameters of the contacts */
} BoxOnPlane;

typedef struct {
    MeVector3 point, normal; /* a point of the plane; its unit normal, outwards */
    MeVector3 along;         /* primary direction of friction, in the plane */
} Plane;

/* Creates an enabled body for a box of a size [m] and mass [kg], and the group of its contacts. */
void boxCreate(BoxOnPlane *box, MdtWorldID world, const MeReal size[3], MeReal mass);

/* Makes the contacts for the next step. */
void boxTouchPlane(BoxOnPlane *box, const Plane *plane);

#endif
