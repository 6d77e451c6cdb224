/* How aggregates interact: part with part, by whatever the parts' types have in the framework's table. */
#include "McdAggregate.h"
#include "mcd_geometries.h"
#include "mcd_spread.h"
#include <string.h>

/* A model that stands for one part of a model: at the part's place, with the model's everything else. */
typedef struct StandIn {
    McdModelRecord record;
    MeVector3 velocity; /* of the part's origin */
} StandIn;

/* The part itself, where it is no child, else the stand-in. */
static McdModelID standInFor(McdGeometryInstance *part, StandIn *s) {
    if (!part->parent)
        return part->model;
    const McdModelRecord *m = mcd_record(part->model);
    s->record = *m;
    s->record.instance = *part;
    s->record.instance.parent = s->record.instance.nextSibling = 0;
    s->record.instance.model = &s->record.model;
    s->record.instance.tm = part->placed;
    s->record.instance.material = (int)mcd_instanceMaterial(part);
    s->record.relTM = s->record.refTM = 0;
    s->record.ownsRelative = MEFALSE;
    s->record.update = 0;
    s->record.intersect = 0; /* called once for the whole */
    if (m->linearVelocity && m->angularVelocity) {
        MeVector3 arm;
        MeVector3Subtract(arm, part->placed[3], m->instance.tm[3]);
        MeVector3Cross(s->velocity, m->angularVelocity, arm);
        MeVector3Add(s->velocity, s->velocity, m->linearVelocity);
        s->record.linearVelocity = s->velocity;
    }
    return &s->record.model;
}

/* ---- pairs of parts ----------------------------------------------------------------------------------------------------- */

typedef struct Meeting Meeting;
struct Meeting {
    McdModelPair *pair;
    MeReal margin; /* how far boxes may be apart; negative: as far as they like */
    void (*meet)(Meeting *, McdModelPair *parts, McdGeometryInstance *part1, McdGeometryInstance *part2);
    void *data;
};

static MeBool areNear(const Meeting *m, const McdGeometryInstance *a, const McdGeometryInstance *b) {
    for (int i = 0; i < 3 && m->margin >= 0; i++)
        if (a->min[i] - m->margin > b->max[i] || b->min[i] - m->margin > a->max[i])
            return MEFALSE;
    return METRUE;
}

static MeBool isAggregate(const McdGeometryInstance *ins) {
    return ins->geometry->type == kMcdGeometryTypeAggregate;
}

static void meetParts(Meeting *m, McdGeometryInstance *a, McdGeometryInstance *b) {
    StandIn standIn[2];
    McdModelPair parts = *m->pair;
    parts.model1 = standInFor(a, &standIn[0]);
    parts.model2 = standInFor(b, &standIn[1]);
    parts.cache = 0;
    McdHello(&parts);
    m->meet(m, &parts, a, b);
    McdGoodbye(&parts);
}

/* Every two parts, in the order of the elements. */
static void meetAll(Meeting *m, McdGeometryInstance *a, McdGeometryInstance *b) {
    if (!areNear(m, a, b))
        return;
    if (isAggregate(a))
        for (McdGeometryInstance *child = a->firstChild; child; child = child->nextSibling)
            meetAll(m, child, b);
    else if (isAggregate(b))
        for (McdGeometryInstance *child = b->firstChild; child; child = child->nextSibling)
            meetAll(m, a, child);
    else
        meetParts(m, a, b);
}

static void meetModels(Meeting *m) {
    meetAll(m, &mcd_record(m->pair->model1)->instance, &mcd_record(m->pair->model2)->instance);
}

/* ---- contacts ------------------------------------------------------------------------------------------------------------ */

typedef struct Gathering {
    McdAggregate *owner; /* of the memory */
    int count;
    int each; /* contacts that two parts may make */
} Gathering;

static MeBool makeRoom(McdAggregate *a, int count, int needed) {
    if (needed <= a->contactMax)
        return METRUE;
    const int max = MeMAX(needed, 2 * a->contactMax);
    McdContact *larger = MeMemoryAPI.create((size_t)max * sizeof *larger);
    void *choice = larger ? MeMemoryAPI.create(mcd_simplifyBytes(max)) : 0;
    if (!choice) {
        if (larger)
            MeMemoryAPI.destroy(larger);
        MeFatalError(1, "McdIntersect: no memory for %d contacts of an aggregate", max);
        return MEFALSE;
    }
    if (count)
        memcpy(larger, a->contact, (size_t)count * sizeof *larger);
    if (a->contact) {
        MeMemoryAPI.destroy(a->contact);
        MeMemoryAPI.destroy(a->choice);
    }
    a->contact = larger;
    a->choice = choice;
    a->contactMax = max;
    return METRUE;
}

/* Which part of its model it is, as a number. */
static MeU32 pathOf(const McdGeometryInstance *part) {
    MeU32 path = 0;
    for (; part->parent; part = part->parent)
        path = path * 31 + (MeU32)part->element + 1;
    return path;
}

static void gatherContacts(Meeting *m, McdModelPair *parts, McdGeometryInstance *part1, McdGeometryInstance *part2) {
    Gathering *g = m->data;
    McdIntersectResult result;
    if (!makeRoom(g->owner, g->count, g->count + g->each))
        return;
    memset(&result, 0, sizeof result);
    result.contacts = g->owner->contact + g->count;
    result.contactMaxCount = g->each;
    if (!(McdIntersect)(parts, &result))
        return;
    const MeU32 path = pathOf(part1) * 0x9e3779b1u ^ pathOf(part2) * 0x85ebca6bu;
    for (int i = 0; i < result.contactCount; i++) {
        McdContact *c = &result.contacts[i];
        c->instance1 = part1;
        c->instance2 = part2;
        c->feature ^= path;
    }
    g->count += result.contactCount;
}

/* An aggregate of the pair, whose memory the query may use. */
static McdAggregate *ownerOf(const McdModelPair *p) {
    McdGeometryInstance *first = &mcd_record(p->model1)->instance, *second = &mcd_record(p->model2)->instance;
    return (McdAggregate *)(isAggregate(first) ? first->geometry : second->geometry);
}

static int MEAPI intersect(McdModelPair *p, McdIntersectResult *result) {
    Gathering g = {ownerOf(p), 0, MeMAX(result->contactMaxCount, 1)};
    Meeting m = {p, (MeReal)mcd_pairMargin(p), gatherContacts, &g};
    mcd_resultBegin(result, p);
    meetModels(&m);
    if (g.count > result->contactMaxCount)
        g.count = mcd_simplify(g.owner->contact, g.count, g.owner->contact, result->contactMaxCount, 0,
                               1e-6 * (double)mcd_record(p->model1)->frame->lengthScale, g.owner->choice);
    if (g.count)
        memcpy(result->contacts, g.owner->contact, (size_t)g.count * sizeof *result->contacts);
    result->contactCount = g.count;
    return mcd_resultEnd(result);
}

/* ---- safe time -------------------------------------------------------------------------------------------------------------- */

static void earliest(Meeting *m, McdModelPair *parts, McdGeometryInstance *part1, McdGeometryInstance *part2) {
    McdSafeTimeResult *best = m->data, here;
    (void)part1;
    (void)part2;
    if (McdSafeTime(parts, best->time, &here) && here.time < best->time)
        *best = here;
}

static int MEAPI safeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    Meeting m = {p, -1, earliest, result};
    result->time = maxTime;
    meetModels(&m);
    result->pair = p;
    return 1;
}

/* ---- line segments ---------------------------------------------------------------------------------------------------------- */

static int firstHit(McdGeometryInstance *ins, MeReal *from, MeReal *to, McdLineSegIntersectResult *best, int hits) {
    if (isAggregate(ins)) {
        for (McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
            hits = firstHit(child, from, to, best, hits);
        return hits;
    }
    StandIn s;
    McdLineSegIntersectResult here;
    const McdTypeRecord *type = mcd_geometryType(ins->geometry, "McdLineSegIntersect");
    if (!type || !type->lineSegment || !type->lineSegment(standInFor(ins, &s), from, to, &here) ||
        (hits && here.distance >= best->distance))
        return hits;
    *best = here;
    return 1;
}

static int MEAPI meetSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                             McdLineSegIntersectResult *outOverlap) {
    const int hits = firstHit(&mcd_record(cm)->instance, inOrig, inDest, outOverlap, 0);
    outOverlap->model = cm;
    return hits;
}

void MEAPI McdAggregateLineSegmentRegisterInteraction(McdFramework *frame) {
    McdFrameworkSetLineSegInteraction(frame, kMcdGeometryTypeAggregate, meetSegment);
}

/* ---- registration ----------------------------------------------------------------------------------------------------------- */

MeBool MEAPI McdAggregateGenericRegisterInteractions(McdFrameworkID frame) {
    McdInteractions interactions = {0, 0, intersect, safeTime};
    if (!mcd_frameCheck(frame, "McdAggregateGenericRegisterInteractions"))
        return MEFALSE;
    for (int type = 0; type < frame->typeCount; type++)
        if (type != kMcdGeometryTypeNull && !McdFrameworkGetInteractions(frame, kMcdGeometryTypeAggregate, type) &&
            !McdFrameworkGetInteractions(frame, type, kMcdGeometryTypeAggregate))
            McdFrameworkSetInteractions(frame, kMcdGeometryTypeAggregate, type, &interactions);
    return METRUE;
}

void MEAPI McdAggregateRegisterInteractions(McdFrameworkID frame) {
    if (McdAggregateGenericRegisterInteractions(frame))
        McdAggregateLineSegmentRegisterInteraction(frame);
}
