/* Detects models that the program moves, and frozen models that have changed.
 * Boxes of frozen models, and pairs of two of them, are not updated.
 *
 * Setters of shapes and models increment a counter of the framework; after that all frozen models are compared. A
 * program may also write to a frozen model's matrix without a call, so a fraction of the models is compared in each
 * step, in turn.
 */
#include "McdInternal.h"
#include "space/mcd_space_i.h"
#include <string.h>

/* Compares a model with the inputs for which its box was made. If the box was made before the first comparison,
 * these inputs are not known: the current ones are stored. */
static MeBool hasChanged(McdModelRecord *m, MeBool *hasMoved) {
    MeReal before[4][3];
    memcpy(before, m->inputs.axis, sizeof before[0] * 3);
    memcpy(before[3], m->inputs.place, sizeof before[3]);
    const MeU64 stamp = mcd_modelCompare(m);
    *hasMoved = memcmp(before, m->inputs.axis, sizeof before[0] * 3) != 0 ||
                memcmp(before[3], m->inputs.place, sizeof before[3]) != 0;
    const MeBool isMarkedChanged = m->isMarkedChanged;
    m->isMarkedChanged = MEFALSE;
    if (m->boxStamp == 0) {
        m->boxStamp = stamp;
        return isMarkedChanged;
    }
    return isMarkedChanged || (stamp != 0 && stamp != m->boxStamp);
}

static void visitIfChanged(McdSpace *s, int i, McdFrozenVisit visit, void *context) {
    const McdProxy *p = &s->proxy[i];
    MeBool hasMoved;
    if (p->model && p->isFrozen && p->hasBox && hasChanged(p->model, &hasMoved))
        visit((McdModelID)p->model, hasMoved, context);
}

void MEAPI McdSpaceVisitChangedFrozen(McdSpaceID s, McdFrozenVisit visit, void *context) {
    enum { TURNS = 16 }; /* steps in which each model is compared once; a comparison takes some 60 ns */
    MEASSERT(s && visit);
    const int all = s->proxyRoom;
    const int count = s->changesSeen == s->frame->changes ? (all + TURNS - 1) / TURNS : all;
    s->changesSeen = s->frame->changes;
    for (int i = 0; i < count; i++) {
        s->lastCompared = s->lastCompared + 1 < s->proxyRoom ? s->lastCompared + 1 : 0;
        visitIfChanged(s, s->lastCompared, visit, context);
    }
}

void MEAPI McdSpaceVisitMoved(McdSpaceID s, McdMovedVisit visit, void *context) {
    MEASSERT(s && visit);
    for (int i = s->firstAwake, next; i != MCD_NONE; i = next) {
        McdModelRecord *m = s->proxy[i].model;
        next = s->proxy[i].nextAwake;
        if (!m || m->model.mBody || !m->past.isSet || m->past.block != s->step || m->stamp == 0)
            continue;
        MeMatrix4 before = {{0}};
        for (int k = 0; k < 3; k++)
            MeVector3Copy(before[k], m->past.axis[k]);
        MeVector3Copy(before[3], m->past.place);
        before[3][3] = 1;
        visit(&m->model, before, context);
    }
}
