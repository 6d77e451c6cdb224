/* Whether a model's box, and what a pair has in common, would be found as they were.
 *
 * For convex shapes and planes that depends on where they are, how large they are and how fast, and on nothing else. A
 * model gets a new stamp when any of that has another bit than at the last look; a pair keeps the stamps of its last
 * test. Triangle lists, fields, aggregates and a program's own types may depend on more: they are always tested.
 */
#include "McdInternal.h"
#include "mcd_kind_i.h"
#include <string.h>

static void copyIfThere(MeVector3 to, const MeReal *from) {
    if (from)
        MeVector3Copy(to, from);
}

/* All that tests of a model read, but for how far the space has it look ahead. */
static MeBool look(const McdModelRecord *m, McdSeen *seen) {
    const McdGeometry *g = m->instance.geometry;
    const McdKind *kind = mcd_kindOf(g);
    if (!kind || kind->size == 0 || m->intersect || !m->instance.tm)
        return MEFALSE;
    const size_t bytes = kind->size - sizeof *g;
    MEASSERT(bytes <= sizeof seen->parameters);
    memset(seen, 0, sizeof *seen);
    seen->geometry = g;
    memcpy(seen->parameters, (const char *)g + sizeof *g, bytes);
    memcpy(seen->tm, m->instance.tm, sizeof seen->tm);
    copyIfThere(seen->velocity, m->linearVelocity);
    copyIfThere(seen->spin, m->angularVelocity);
    seen->tolerance = m->tolerance;
    seen->isSwept = m->isSwept;
    return METRUE;
}

MeU64 mcd_modelStamp(McdModelRecord *m) {
    McdSeen now;
    m->lookedIn = m->frame->round;
    if (!look(m, &now)) {
        m->stamp = 0;
    } else if (m->stamp == 0 || memcmp(&now, &m->seen, sizeof now) != 0) {
        m->seen = now;
        m->stamp = ++m->frame->lastStamp;
    }
    return m->stamp;
}

static MeU64 stampInRound(McdModelRecord *m) {
    return m->lookedIn == m->frame->round ? m->stamp : mcd_modelStamp(m);
}

void MEAPI McdFrameworkBeginRound(McdFrameworkID frame) {
    MEASSERT(frame);
    frame->round++;
}

MeBool MEAPI McdModelPairIsAsTested(McdModelPair *p) {
    MEASSERT(p && p->model1 && p->model2);
    McdModelRecord *m1 = mcd_record(p->model1), *m2 = mcd_record(p->model2);
    const McdRequest *request = p->request ? p->request : m1->frame->defaultRequest;
    const McdTest now = {.stamp1 = stampInRound(m1),
                         .stamp2 = stampInRound(m2),
                         .contactMaxCount = request->contactMaxCount,
                         .faceNormalsFirst = request->faceNormalsFirst};
    const MeBool isSame = now.stamp1 != 0 && now.stamp2 != 0 && memcmp(&now, &p->test, sizeof now) == 0;
    p->test = now;
    return isSame && mcd_interactionIsBuiltIn(p);
}

void MEAPI McdModelPairForgetTest(McdModelPair *p) {
    MEASSERT(p);
    memset(&p->test, 0, sizeof p->test);
}
