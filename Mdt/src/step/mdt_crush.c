/* Crush: movers that leave bodies no room.
 *
 * Nothing stops a mover, so the contacts of what it presses against something else contradict each other. The exact
 * solver then finds the way out that a tilt t of the faces leaves, across them, at 2 v/t: a box is thrown out at
 * thousands of times the speed v of the mover. It takes the impulse P = 2 m v/t², which no load explains: a partition
 * that a mover touches is crushed if an impulse is beyond
 *
 *     C (Σ m v + Σ m g h),    v: the fastest speed there, of bodies and movers, at the start of the step.
 *
 * Then the fast solver takes over, whose passes leave the bodies at the mean of what their contacts demand: movers
 * enter them. Slower ways out, among several bodies without friction and by the correction of deep overlaps, are closed
 * by a cap: no body ends the step faster than v and its load make it. Contacts are not timed for a while, and an
 * impact that crushes is undone.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

/* C: what is not crushed leaves at sqrt(2 C) v, eight times the mover's speed, at most. A lever or a wedge that
 * multiplies forces by more is solved by the fast solver. */
static const double mdt_maxLeverage = 32;

/* s, after a crush, in which contacts are not timed, and speeds are capped if no motor or spring may raise them: in a
 * crush answers that no load explains alternate with others, and what has overlapped comes apart. */
static const float mdt_crushTime = .5F;

static MeBool hasMover(const MdtIsland *p, int manifold) {
    const MdtBaseConstraint *c = &mdt_manifoldOf(p->manifolds[manifold].point[0])->base;
    return mdt_sideMover(c, 0) || mdt_sideMover(c, 1);
}

/* m/s: of a mover, at the contact's place; 0: it does not move. */
static double speedOfMover(const MdtKeaManifold *m) {
    double arm[3], v[3];
    if (!m->mover)
        return 0;
    keaSubtract(arm, m->point[0].position, m->mover->position);
    keaCross(v, m->mover->velocity.ang, arm);
    keaAddScaled(v, 1, m->mover->velocity.lin);
    return keaLength(v);
}

/* N s: the sum of a manifold's normal impulses, from forces over `time`. */
static double impulseOf(const MdtKeaManifold *m, double time) {
    double sum = 0;
    for (int k = 0; k < m->numPoints; k++)
        sum += time * m->point[k].force[0];
    return sum;
}

/* m/s: the fastest speed at the start of the step, of bodies and movers. */
static double fastestOf(const MdtIsland *p) {
    double fastest = 0;
    for (int i = 0; i < p->numBodies; i++) {
        const MdtKeaVelocity *v = &p->bodies[i]->start.velocity;
        fastest = fmax(fastest, fmax(keaLength(v->lin), mdt_bodyRadius(p->bodies[i]) * keaLength(v->ang)));
    }
    for (int i = 0; i < p->kea.numManifolds; i++)
        fastest = fmax(fastest, speedOfMover(&p->kea.manifolds[i]));
    return fastest;
}

/* kg m/s: P, but for C. */
static double momentumScale(const MdtIsland *p) {
    double mass = 0, load = 0;
    for (int i = 0; i < p->numBodies; i++) {
        mass += p->bodies[i]->mass;
        load += keaLength(p->bodies[i]->kea.force) * p->parameters.stepsize;
    }
    return mass * fastestOf(p) + load;
}

/* Whether impulses, from forces over `time`, are beyond the bound, in a partition that a mover touches. */
static MeBool hasCrush(const MdtIsland *p, double time) {
    double max = 0;
    MeBool isMoved = MEFALSE;
    for (int i = 0; i < p->kea.numManifolds; i++) {
        isMoved = isMoved || hasMover(p, i);
        max = fmax(max, impulseOf(&p->kea.manifolds[i], time));
    }
    return isMoved && max > mdt_maxLeverage * momentumScale(p);
}

MeBool mdt_isCrushed(const MdtIsland *p) {
    if (!p->world->movers || p->numMembers > 0 || !hasCrush(p, p->parameters.stepsize))
        return MEFALSE;
    p->record->crushed = mdt_crushTime;
    return METRUE;
}

void mdt_crushUndoImpact(const MdtIsland *p) {
    if (!p->world->movers || !hasCrush(p, 1))
        return;
    p->record->crushed = mdt_crushTime;
    mdt_contactsClearForces(p);
    for (int i = 0; i < p->numBodies; i++) {
        MdtKeaBody *b = &p->bodies[i]->kea;
        keaCopy(b->velocity, p->bodies[i]->start.velocity.lin);
        MdtKeaBodySetAngularVelocity(b, p->bodies[i]->start.velocity.ang);
    }
}

void mdt_crushCapSpeeds(const MdtIsland *p) {
    const MeBool isCrushed = mdt_isCrushed(p), wasCrushed = p->record->crushed > 0 && p->numJoints == 0;
    if (!isCrushed && !wasCrushed)
        return;
    const double fastest = fastestOf(p);
    for (int i = 0; i < p->numBodies; i++) {
        MdtKeaBody *b = &p->bodies[i]->kea;
        const double max = fastest + keaLength(b->force) * b->invMass * p->h, radius = mdt_bodyRadius(p->bodies[i]);
        double w[3];
        MdtKeaBodyGetAngularVelocity(b, w);
        keaScale(b->velocity, fmin(1, max / fmax(keaLength(b->velocity), DBL_MIN)), b->velocity);
        keaScale(b->angularMomentum, fmin(1, max / fmax(radius * keaLength(w), DBL_MIN)), b->angularMomentum);
    }
}
