/* Inside Mst: movers. A move gathers once what is near (McdNear), and then computes on that alone.
 *
 * Coordinates are in double, along the world's axes, relative to the mover's foot (its lowest point) when the move
 * began. */
#ifndef MST_MOVER_I_H
#define MST_MOVER_I_H

#include "MstMover.h"
#include "McdInternal.h"
#include "MstModelDynamics.h"
#include <math.h>
#include <string.h>

enum { MST_MOVER = 0x4d4d4f56, MST_MOVER_CONTACTS = 48, MST_MOVER_PUSHED = 8 };

struct MstMover {
    MeU32 magic;
    MeHandle handle;
    MstUniverseID universe; /* null: it has been destroyed */
    struct MstMover *next;  /* in the universe's list, the newest first */
    McdSpaceID space;
    McdLineSegIntersectEnableCallback filter;
    void *filterData;
    double foot[3], up[3]; /* world */
    double radius, height, stepHeight, skin, strength;
    double minUp; /* cosine of the slope limit */
    MeBool isOnGround;
    McdModelID ground; /* valid if its serial number is still the same */
    MeU64 groundSerial;
    double anchor[3];         /* the point of contact, in its frame */
    double anchorPlace[3];    /* the same in the world, at the end of the last move */
    double groundVelocity[3]; /* m/s, of that point */
};

/* The half-space normal . d >= bound. */
typedef struct MstMoverPlane {
    double normal[3], bound;
} MstMoverPlane;

typedef struct MstMoverContact {
    int child;
    McdNearGap gap;
    MeBool isWalkable; /* can be stood on */
} MstMoverContact;

/* A move of a mover. */
typedef struct MstMove {
    MstMoverID mover;
    McdNear *near;
    double place[3];  /* of the foot */
    double reach;     /* m: the foot stays within this of its first place, but for steps up and down */
    double footing;   /* m, along up: where the step began; ledges are as high above it as a step may be */
    MeBool isBlocked; /* something that cannot be stood on was in its way */
    MeBool hasStepped;
    int contactCount, pushedCount;
    MeBool hasContacts;
    double foundAt[3];                           /* with hasContacts: the place where the contacts are */
    MstMoverContact contact[MST_MOVER_CONTACTS]; /* those of the last mst_findMoverContacts */
    MstMoverContact pushed[MST_MOVER_PUSHED];    /* one of each body in its way */
} MstMove;

/* ---- vectors ---- */

static inline double mst_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void mst_copy(double out[3], const double a[3]) {
    memcpy(out, a, 3 * sizeof *out);
}

static inline void mst_sub(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

/* out = a + k b */
static inline void mst_mad(double out[3], const double a[3], double k, const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] + k * b[i];
}

static inline void mst_scale(double out[3], const double a[3], double k) {
    for (int i = 0; i < 3; i++)
        out[i] = k * a[i];
}

static inline void mst_cross(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static inline double mst_length(const double a[3]) {
    return sqrt(mst_dot(a, a));
}

/* The part of a vector at right angles to a unit vector. */
static inline void mst_across(double out[3], const double a[3], const double unit[3]) {
    mst_mad(out, a, -mst_dot(a, unit), unit);
}

/* ---- for the universe (MstMover.c) ---- */

/* Adds a vector to the coordinates of all movers. */
void mst_moversShift(const MstUniverse *u, const double by[3]);
/* Whether that leaves all of them within the bound of positions. */
MeBool mst_moversMayShift(const MstUniverse *u, const double by[3]);
/* Takes the universe from its movers, which the program still owns. */
void mst_moversLeave(MstUniverse *u);

/* ---- planes (mst_planes.c) ---- */

/* Finds the point of the intersection of half-spaces that is nearest to a wanted one; false if there is none. */
MeBool mst_nearestInPlanes(const MstMoverPlane *plane, int count, const double want[3], double out[3]);

/* ---- contacts (mst_mover_contacts.c) ---- */

/* The capsule with its lowest point at a place. */
McdCapsule mst_moverCapsule(const MstMover *m, const double foot[3]);
/* Finds the contacts at the move's place: where the surface of all parts has a least distance, up to one and a half
 * skins. */
void mst_findMoverContacts(MstMove *v);
/* Casts a capsule along a displacement until it comes within `stop` of a part. Returns the fraction, 1: nothing is in
 * the way; and the gap there. */
double mst_castMover(const MstMove *v, const McdCapsule *c, const double by[3], double stop, McdNearGap *hit);

/* ---- slides (mst_slide.c) ---- */

/* Moves by as much of a displacement as can be, along what is in the way. */
void mst_slide(MstMove *v, const double want[3]);
/* Moves by a displacement along the ground; climbs steps. */
void mst_walk(MstMove *v, const double want[3]);
/* Follows the ground down; false: there is none within the height of a step. */
MeBool mst_followGround(MstMove *v);
/* The contact that it stands on, the max level one: of those that can be stood on, or of several that hold it; null:
 * none. */
const MstMoverContact *mst_groundContact(const MstMove *v);
/* Takes from a velocity what goes into the contacts; on ground, from its level part. */
void mst_clipVelocity(const MstMove *v, MeBool isOnGround, double velocity[3]);

#endif
