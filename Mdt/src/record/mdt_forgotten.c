/* Warnings about common omissions of programs, each given once: a joint whose motor runs was not enabled, a compound's
 * centre of mass was not set, or masses were not scaled with lengths. */
#include "MdtInternal.h"
#include "record/mdt_record_i.h"

/* ---- motors ---- */

static const MdtBclLimit *limitOf(const MdtJoint *j) {
    switch (j->bcl.type) {
    case MdtBclHINGE:
    case MdtBclPRISMATIC:
        return &j->bcl.of.limit;
    case MdtBclSPRING:
        return &j->bcl.of.distance.limit;
    default:
        return NULL;
    }
}

static MeBool isMotorForgotten(const MdtJoint *j) {
    const MdtBclLimit *l = limitOf(j);
    return l && l->bPowered && l->fmax > 0 && (j->base.side[0].body || j->base.side[1].body) &&
           !(j->base.record.flags & (MDT_ENABLED | MDT_WAS_ENABLED | MDT_WARNED));
}

/* Checks all joints in every 64th step, and only while some joint is disabled. */
static void checkMotors(MdtWorldID w) {
    enum { STEPS = 64 };
    MEASSERT(w->jointPool.used >= w->enabledJoints && w->enabledJoints >= 0);
    if (w->jointPool.used == w->enabledJoints || ++w->watchedSteps % STEPS != 0)
        return;
    for (MdtLink *link = w->constraints.first; link; link = link->next) {
        MdtJoint *j = mdt_linkOwner(link);
        if (!mdt_isJoint(&j->base) || !isMotorForgotten(j))
            continue;
        j->base.record.flags |= MDT_WARNED;
        MeWarning(1, "%s: a %s has a motor that runs, and was never enabled: call Mdt%sEnable",
                  MeCallerName("MdtWorldStep"), j->type->name, j->type->name);
    }
}

/* ---- centres of mass ---- */

void MEAPI MdtBodyExpectCentreOfMass(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    b->record.flags |= MDT_OFF_CENTRE;
    b->world->expectsCentre = !b->world->isCentreWarned;
}

/* Warns of the first such body that is simulated, once per world. */
static void checkCentres(MdtWorldID w) {
    for (MdtLink *link = w->expectsCentre ? w->bodies.first : NULL; link; link = link->next) {
        const MdtBody *b = mdt_linkOwner(link);
        if ((b->record.flags & (MDT_OFF_CENTRE | MDT_ENABLED)) != (MDT_OFF_CENTRE | MDT_ENABLED))
            continue;
        w->expectsCentre = MEFALSE;
        w->isCentreWarned = METRUE;
        MeWarning(1,
                  "%s: the centre of mass of a model's geometry is not at its origin, and that of its body (sort key "
                  "%d) is still taken to be there. McdGeometryGetMassProperties tells where it is; call "
                  "MdtBodySetCenterOfMassRelativePosition, with zeros if that is meant",
                  MeCallerName("MdtWorldStep"), b->link.sortKey);
        return;
    }
}

/* ---- scales ---- */

/* The mass, kg, whose weight makes contacts sink by a fiftieth of the length scale: a contact gives way by
 * epsilon F h^2 / gamma. */
static double sinkingMass(const MdtWorld *w, double h) {
    MEASSERT(h > 0);
    const double share = 0.02;
    double g[3];
    mdt_fromReal(g, w->params.gravity);
    const double max = share * (double)w->params.lengthScale * (double)w->gamma;
    return max > 0 ? max / ((double)w->epsilon * keaLength(g) * h * h) : HUGE_VAL; /* no sinking */
}

void mdt_forgottenScale(MdtBodyID b) {
    MdtWorldID w = b->world;
    if (b->manifolds == 0 || __atomic_exchange_n(&w->isScaleWarned, METRUE, __ATOMIC_RELAXED))
        return;
    MeWarning(1,
              "%s: bodies of more than %g kg sink into what they lie on: contacts are made for bodies of about %g kg "
              "(massScale of MstUniverseSizes or MdtWorldCreate, which is to follow lengthScale, %g m), or call "
              "MdtWorldSetEpsilon",
              MeCallerName("MdtWorldStep"), w->sinkingMass, (double)w->params.massScale, (double)w->params.lengthScale);
}

/* ---- each step ---- */

void mdt_forgottenCheck(MdtWorldID w, double h) {
    checkMotors(w);
    checkCentres(w);
    w->sinkingMass = w->isScaleWarned ? HUGE_VAL : sinkingMass(w, h);
}
