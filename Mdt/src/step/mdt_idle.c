/* Check builds: warns that nothing moves in a world without gravity, which is the default of a new world.
 *
 * The warning is given once, after a second with enabled bodies on which nothing acts: the program has not called
 * MdtWorldSetGravity, no body has a velocity or a load, and no constraint is enabled. The second restarts when the
 * program moves a body itself, as programs do that use bodies to place models. */
#include "MdtBody.h"
#include "MdtInternal.h"
#include "step/mdt_step_i.h"
#include <string.h>

#if KARMA_CHECK
static MeBool isUnaffected(const MdtBody *b) {
    const MdtForces *f = mdt_forcesOf(b);
    return memcmp(f->load, mdt_noForces.load, sizeof f->load) == 0 &&
           memcmp(f->impulse, mdt_noForces.impulse, sizeof f->impulse) == 0 &&
           MeVector3MagnitudeSqr(b->velocity.lin) == 0 && MeVector3MagnitudeSqr(b->velocity.ang) == 0;
}

/* True if nothing acts on any body at the start of a step. `sum`, over bodies and their moves, detects bodies that the
 * program moves itself. */
static MeBool areAllUnaffected(const MdtWorld *w, unsigned long *sum) {
    *sum = 0;
    if (w->enabledBodies + w->asleepBodies == 0 || w->enabledConstraints > 0)
        return MEFALSE;
    for (const MdtLink *link = w->bodies.first; link; link = link->next) {
        const MdtBody *b = mdt_linkOwner(link);
        *sum += 1 + b->moves;
        if (!isUnaffected(b))
            return MEFALSE;
    }
    return METRUE;
}

void mdt_idleCheck(MdtWorldID w, double h) {
    unsigned long sum;
    if (w->idle.isOver)
        return;
    if (!areAllUnaffected(w, &sum)) {
        w->idle.isOver = w->enabledBodies + w->asleepBodies > 0;
        return;
    }
    w->idle.time = sum == w->idle.sum ? w->idle.time + h : 0;
    w->idle.sum = sum;
    if (w->idle.time < 1)
        return;
    w->idle.isOver = METRUE;
    MeWarning(1,
              "%s: for a second nothing has acted on the world's bodies, and there is no gravity: a new world "
              "has none. Call MdtWorldSetGravity; with zeros, if it is to have none",
              MeCallerName("MdtWorldStep"));
}
#else
void mdt_idleCheck(MdtWorldID w, double h) {
    (void)w, (void)h;
}
#endif
