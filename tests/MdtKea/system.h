/* A system of Kea that tests fill by hand, through the public header only. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "karma_test.h"

enum { MAX_BODIES = 60, GUARD = 256 };

static MdtKeaSystem s;
static MdtKeaBody body[MAX_BODIES], *pointer[MAX_BODIES];
static unsigned char *block;
static size_t scratchSize;

/* Scratch memory with guards on both sides, full of what was there before. */
static inline void system_beginIn(int garbage, int numBodies, int maxRows, int maxContacts, double stepsize) {
    memset(&s, 0, sizeof s);
    memset(body, 0, sizeof body);
    for (int i = 0; i < numBodies; i++)
        pointer[i] = &body[i];
    s.numBodies = numBodies;
    s.bodies = pointer;
    s.maxRows = maxRows;
    s.maxContacts = maxContacts;
    s.cache = MdtKeaCacheCreate();
    s.parameters.stepsize = stepsize;
    scratchSize = MdtKeaScratchSize(numBodies, maxRows, maxContacts);
    block = aligned_alloc(16, (scratchSize + 2 * GUARD + 15) & ~(size_t)15);
    memset(block, garbage, scratchSize + 2 * GUARD);
    memset(block, 0x5a, GUARD);
    memset(block + GUARD + scratchSize, 0x5a, GUARD);
}

static inline void system_begin(int numBodies, int maxRows, int maxContacts, double stepsize) {
    system_beginIn(0, numBodies, maxRows, maxContacts, stepsize);
}

static inline void end(void) {
    for (size_t i = 0; i < GUARD; i++) {
        ck_assert_msg(block[i] == 0x5a, "%zu bytes before the scratch memory", GUARD - i);
        ck_assert_msg(block[GUARD + scratchSize + i] == 0x5a, "%zu bytes after the scratch memory", i);
    }
    MdtKeaCacheDestroy(s.cache);
    free(block);
}

static inline void setBody(int i, double mass, double inertia, double x) {
    const double tensor[3][3] = {{inertia, 0, 0}, {0, inertia, 0}, {0, 0, inertia}};
    body[i].position[0] = x;
    body[i].quaternion[0] = 1;
    body[i].invMass = 1 / mass;
    body[i].flags = MdtKeaBodyFlagAddCoriolisForce;
    ck_assert(MdtKeaBodySetInertia(&body[i], tensor));
}

static inline void system_init(void) {
    MdtKeaInit(&s, block + GUARD);
}

static inline MdtKeaRow *addRow(int a, int b) {
    MdtKeaRow *row = &s.rows[s.numRows++];
    ck_assert_int_le(s.numRows, s.maxRows);
    memset(row, 0, sizeof *row);
    row->body[0] = a;
    row->body[1] = b;
    row->lower = -HUGE_VAL;
    row->upper = HUGE_VAL;
    row->normal = row->partner = row->contact = -1;
    row->owner = s.numRows;
    return row;
}

/* A row between the centres of two bodies, along x: its velocity is v_a - v_b. */
static inline MdtKeaRow *addAlongX(int a, int b) {
    MdtKeaRow *row = addRow(a, b);
    row->J[0].lin[0] = 1;
    row->J[1].lin[0] = b < 0 ? 0 : -1;
    return row;
}

static inline void step(void) {
    MdtKeaSolve(&s);
    ck_assert(MdtKeaIntegrate(&s));
}

#endif
