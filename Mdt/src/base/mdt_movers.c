/* The list of a world's movers (mdt_mover.c moves them). */
#include "MeAssert.h"
#include "base/mdt_world_i.h"

static void linkMover(MdtMover *m) {
    MdtWorldID w = m->body->world;
    m->next = w->movers;
    m->previous = NULL;
    if (m->next)
        m->next->previous = m;
    w->movers = m;
}

static void unlinkMover(MdtMover *m) {
    *(m->previous ? &m->previous->next : &m->body->world->movers) = m->next;
    if (m->next)
        m->next->previous = m->previous;
}

MeBool mdt_moverMake(MdtBodyID b, const char *caller) {
    MEASSERT(!b->mover);
    b->mover = MeMemoryTakeZeroed(1, sizeof *b->mover, caller, "the motion of a body");
    if (!b->mover)
        return MEFALSE;
    b->mover->body = b;
    b->index = MdtKeaWORLD;
    b->partition = b->place = -1;
    linkMover(b->mover);
    return METRUE;
}

void mdt_moverFree(MdtBodyID b) {
    if (!b->mover)
        return;
    unlinkMover(b->mover);
    MeMemoryGive(b->mover);
    b->mover = NULL;
}
