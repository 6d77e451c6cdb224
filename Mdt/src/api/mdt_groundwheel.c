/* Wheels without bodies, for vehicles of Mst. */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "api/mdt_api_i.h"
#include <string.h>

static MdtJoint *wheelOf(MdtConstraintID c, MeU64 serial) {
    MdtJoint *j = c ? mdt_asJoint(c) : NULL;
    const MeBool isSame = j && j->bcl.type == MdtBclGROUNDWHEEL && (MeU64)j->base.link.serial == serial;
    return isSame && !(j->base.record.flags & MDT_CONDEMNED) ? j : NULL;
}

MdtConstraintID MEAPI MdtGroundWheelCreate(const MdtBodyID chassis, MeU64 *serial) {
    MdtJoint *j = mdt_jointCreate(chassis->world, MdtBclGROUNDWHEEL, "MstVehicleAddWheel");
    if (!j)
        return NULL;
    mdt_constraintAttach(&j->base, chassis, NULL);
    mdt_constraintEnable(&j->base, "MstVehicleAddWheel");
    *serial = (MeU64)j->base.link.serial;
    return &j->base;
}

MdtBclGroundWheel *MEAPI MdtGroundWheelGet(const MdtConstraintID c, MeU64 serial, const MdtBodyID chassis) {
    MdtJoint *j = wheelOf(c, serial);
    if (!j || j->base.side[0].body != chassis)
        return NULL;
    mdt_constraintEnable(&j->base, "MstUniverseStep"); /* the end of a ground's body has disabled it */
    return &j->bcl.of.groundWheel;
}

static void orthoTo(double ortho[3], const double primary[3]) {
    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    keaCross(ortho, primary, fabs(primary[0]) < 0.7 ? x : y);
    keaScale(ortho, 1 / keaLength(ortho), ortho);
}

/* A point of the body's frame in the frame of its centre of mass; a direction likewise. */
static void intoCentre(const MdtBody *b, const MdtKeaTransformation *centre, const double *point,
                       const double *direction, double local[3]) {
    double world[3];
    keaApply(world, b->frame.R, point ? point : direction);
    for (int i = 0; i < 3 && point; i++)
        world[i] += b->frame.pos[i] - centre->pos[i];
    keaApplyTransposed(local, centre->R, world);
}

static void intoGround(const MdtKeaTransformation *ground, const MdtWheelPlace *place, MdtBclFrame *frame) {
    double from[3];
    keaSubtract(from, place->point, ground->pos);
    keaApplyTransposed(frame->position, ground->R, from);
    keaApplyTransposed(frame->primary, ground->R, place->normal);
    orthoTo(frame->ortho, frame->primary);
}

void MEAPI MdtGroundWheelPlace(const MdtConstraintID c, const MdtWheelPlace *place, const MdtBodyID ground) {
    MdtJoint *j = mdt_asJoint(c);
    MdtKeaTransformation pose[2];
    MEASSERT(j->base.side[0].body && j->base.side[0].body != ground);
    if (j->base.side[1].body != ground) {
        mdt_constraintAttach(c, j->base.side[0].body, ground);
        mdt_graphChanged(c->world);
    }
    mdt_constraintPoses(c, pose);
    intoCentre(c->side[0].body, &pose[0], place->position, NULL, j->bcl.frame[0].position);
    intoCentre(c->side[0].body, &pose[0], NULL, place->up, j->bcl.frame[0].primary);
    intoCentre(c->side[0].body, &pose[0], NULL, place->forward, j->bcl.frame[0].ortho);
    intoGround(&pose[1], place, &j->bcl.frame[1]);
    mdt_constraintDisturb(c);
}

MeBool MEAPI MdtGroundWheelJoin(const MdtConstraintID c, const MdtConstraintID twin, double stiffness) {
    MdtBclGroundWheel *g = &mdt_asJoint(c)->bcl.of.groundWheel;
    const MdtJoint *other = mdt_asJoint(twin);
    const MdtBclGroundWheel *o = &other->bcl.of.groundWheel;
    if (c->side[1].body != twin->side[1].body)
        return MEFALSE;
    memcpy(g->twin, other->bcl.frame, sizeof g->twin);
    g->barStiffness = stiffness;
    g->barBound[0] = -g->springForce;
    g->barBound[1] = o->springForce;
    g->twinDistance = o->distance;
    g->twinFreeLength = o->freeLength;
    g->twinShape = o->shape;
    return METRUE;
}

void MEAPI MdtGroundWheelDestroy(const MdtConstraintID c, MeU64 serial) {
    if (wheelOf(c, serial))
        mdt_constraintDestroy(c, NULL);
}

void MEAPI MdtBodyGetExactPose(const MdtBodyID b, MdtKeaTransformation *pose) {
    *pose = b->frame;
}

double MEAPI MdtBodyGetMobility(const MdtBodyID b, const double from[3], const double impulse[3], const double at[3],
                                const double direction[3]) {
    MdtKeaBody kicked = b->kea;
    double arm[3], spin[3], velocity[3];
    keaSubtract(arm, from, b->kea.position);
    keaCross(kicked.angularMomentum, arm, impulse);
    MdtKeaBodyGetAngularVelocity(&kicked, spin);
    keaSubtract(arm, at, b->kea.position);
    keaCross(velocity, spin, arm);
    keaAddScaled(velocity, b->kea.invMass, impulse);
    return keaDot(velocity, direction);
}
