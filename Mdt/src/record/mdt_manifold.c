/* Manifolds: the life of contacts and their groups (mdt_manifold_i.h). */
#include "record/mdt_point_i.h"
#include "MeAssert.h"
#include <string.h>

int mdt_countSlots(const MdtManifold *block) {
    int count = 0;
    for (MdtPoint *p = mdt_pointIn(block, 0); p; p = mdt_pointIn(block, p->slot + 1))
        count++;
    return count;
}

MeBool mdt_pointIsAlone(const MdtPoint *p) {
    const MdtManifold *block = mdt_blockOf(p);
    return mdt_countSlots(block) == 1 && (block->group || (block->base.record.flags & MDT_LONE));
}

static MeBool areSlotsConsistent(const MdtManifold *block) {
    for (int slot = 0; slot < MDT_POINTS; slot++)
        if ((block->point[slot].magic == MDT_POINT) != ((block->used >> slot & 1) != 0))
            return MEFALSE;
    return block->used < 1u << MDT_POINTS;
}

MeBool mdt_manifoldIsConsistent(const MdtManifold *m) {
    unsigned int count = 0;
    if (m->group)
        return MEFALSE;
    for (const MdtManifold *block = m; block; block = block->next) {
        if ((block != m && (block->group != m || mdt_countSlots(block) == 0)) || !block->surface ||
            !areSlotsConsistent(block))
            return MEFALSE;
        for (const MdtPoint *p = mdt_pointIn(block, 0); p; p = mdt_pointIn(block, p->slot + 1), count++)
            if (p != &block->point[p->slot] || mdt_manifoldOf(p) != m)
                return MEFALSE;
    }
    return count == m->numPoints && (!(m->base.record.flags & MDT_LONE) || count == 1);
}

/* ---- records ----------------------------------------------------------------------------------------------------- */

static MdtManifold *allocateBlock(MdtWorldID w, const char *caller) {
    MdtManifold *block = mdt_poolGet(&w->manifoldPool, MDT_MANIFOLD, caller);
    if (!block)
        return NULL;
    block->base.world = w;
    block->surface = &w->surfaces.standard;
    w->surfaces.standard.users++;
    block->normal[1] = 1;
    return block;
}

static void freeBlock(MdtManifold *block) {
    MdtWorldID w = block->base.world;
    MEASSERT(mdt_countSlots(block) == 0);
    MEASSERT(!block->group && !block->next);
    while (block->extras) {
        MdtExtra *extra = block->extras;
        block->extras = extra->next;
        mdt_poolPut(&w->extraPool, extra);
    }
    mdt_surfaceRelease(&w->surfaces, block->surface);
    mdt_poolPut(&w->manifoldPool, block);
}

MdtPoint *mdt_slotActivate(MdtManifold *block, int slot) {
    MdtPoint *p = &block->point[slot];
    MEASSERT(slot >= 0 && slot < MDT_POINTS);
    MEASSERT(!(block->used & 1u << slot));
    block->used |= 1u << slot;
    memset(p, 0, sizeof *p);
    p->magic = MDT_POINT;
    p->slot = (MeU8)slot;
    return p;
}

static void appendContinuation(MdtManifold *group, MdtManifold *block) {
    MdtManifold *last = group;
    MEASSERT(!group->group && !(group->base.record.flags & MDT_LONE) && !block->group);
    while (last->next)
        last = last->next;
    last->next = block;
    block->next = NULL;
    block->group = group;
}

static void unlinkContinuation(MdtManifold *block) {
    MdtManifold *before = block->group;
    while (before->next != block)
        before = before->next;
    before->next = block->next;
    block->group = block->next = NULL;
}

/* ---- extras ------------------------------------------------------------------------------------------------------ */

MdtExtra *mdt_extraOf(const MdtManifold *block, int slot) {
    MdtExtra *extra = block->extras;
    while (extra && extra->slot != slot)
        extra = extra->next;
    return extra;
}

MdtExtra *mdt_extraMake(MdtManifold *block, int slot, const char *caller) {
    MdtExtra *extra = mdt_extraOf(block, slot);
    MEASSERT(slot >= 0 && (slot == MDT_GROUP_SLOT || (block->used >> slot & 1)));
    if (extra)
        return extra;
    extra = mdt_poolGet(&block->base.world->extraPool, MDT_EXTRA, caller);
    if (!extra)
        return NULL;
    extra->slot = slot;
    extra->next = block->extras;
    block->extras = extra;
    return extra;
}

static void freeExtra(MdtManifold *block, int slot) {
    for (MdtExtra **at = &block->extras; *at; at = &(*at)->next)
        if ((*at)->slot == slot) {
            MdtExtra *extra = *at;
            *at = extra->next;
            mdt_poolPut(&block->base.world->extraPool, extra);
            return;
        }
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

static MdtManifold *createLinked(MdtWorldID w, int flags, const char *caller) {
    if (!mdt_isWorld(w, caller) || !mdt_constraintCount(w, caller))
        return NULL;
    MdtManifold *m = allocateBlock(w, caller);
    if (!m) {
        mdt_constraintUncount(w);
        return NULL;
    }
    m->base.record.flags = flags;
    mdt_listAppend(&w->constraints, &m->base.link, w->nextSerial++);
    return m;
}

MdtManifold *mdt_manifoldCreate(MdtWorldID w, const char *caller) {
    return createLinked(w, 0, caller);
}

MdtPoint *mdt_pointCreate(MdtWorldID w, const char *caller) {
    MdtManifold *m = createLinked(w, MDT_LONE, caller);
    if (!m)
        return NULL;
    m->numPoints = 1;
    return mdt_slotActivate(m, 0);
}

MdtPoint *mdt_pointCreateIn(MdtManifold *group, const char *caller) {
    MdtWorldID w = group->base.world;
    if (!mdt_constraintCount(w, caller))
        return NULL;
    MdtManifold *block = allocateBlock(w, caller);
    if (!block) {
        mdt_constraintUncount(w);
        return NULL;
    }
    appendContinuation(group, block);
    group->numPoints++;
    mdt_constraintDisturb(&group->base);
    return mdt_slotActivate(block, 0);
}

static void freeSlot(MdtPoint *p) {
    MdtManifold *m = mdt_manifoldOf(p);
    freeExtra(mdt_blockOf(p), p->slot);
    MEASSERT(m->numPoints > 0 && (mdt_blockOf(p)->used & 1u << p->slot));
    mdt_blockOf(p)->used ^= 1u << p->slot;
    p->magic = 0;
    m->numPoints--;
    mdt_constraintUncount(m->base.world);
}

void mdt_pointTerm(MdtPoint *p) {
    MdtManifold *block = mdt_blockOf(p), *m = mdt_manifoldOf(p);
    mdt_constraintDisturb(&m->base);
    if (m->base.record.flags & MDT_LONE)
        mdt_constraintTerm(&m->base);
    freeSlot(p);
    if (block->group && mdt_countSlots(block) == 0)
        unlinkContinuation(block), freeBlock(block);
    else if (m->base.record.flags & MDT_LONE)
        freeBlock(m);
    else
        MEVALIDATE(mdt_manifoldIsConsistent(m));
}

void mdt_manifoldClear(MdtManifold *m) {
    for (MdtPoint *p = mdt_pointFirst(m); p; p = mdt_pointFirst(m))
        mdt_pointTerm(p);
    MEASSERT(m->numPoints == 0 && !m->next);
}

void mdt_manifoldTerm(MdtManifold *m) {
    MEASSERT(!m->group);
    mdt_manifoldClear(m);
    if (m->holder)
        *m->holder = NULL;
    mdt_constraintTerm(&m->base);
    mdt_constraintUncount(m->base.world);
    freeBlock(m);
}

void mdt_pointJoin(MdtPoint *p, MdtManifold *group) {
    MdtManifold *block = mdt_blockOf(p);
    MEASSERT(mdt_pointIsAlone(p) && !block->group && block->base.world == group->base.world);
    mdt_constraintTerm(&block->base);
    block->base.record.flags = 0;
    appendContinuation(group, block);
    block->numPoints = 0;
    group->numPoints++;
    mdt_constraintDisturb(&group->base);
    mdt_constraintClearWarmStart(&group->base);
    MEVALIDATE(mdt_manifoldIsConsistent(group));
}

void mdt_pointLeave(MdtPoint *p) {
    MdtManifold *block = mdt_blockOf(p), *group = block->group;
    MEASSERT(mdt_pointIsAlone(p) && group);
    mdt_constraintDisturb(&group->base);
    unlinkContinuation(block);
    group->numPoints--;
    block->numPoints = 1;
    block->base.record.flags = MDT_LONE;
    mdt_listAppend(&group->base.world->constraints, &block->base.link, group->base.world->nextSerial++);
    mdt_constraintAttach(&block->base, group->base.side[0].body, group->base.side[1].body);
    MEVALIDATE(mdt_manifoldIsConsistent(group) && mdt_manifoldIsConsistent(block));
}
