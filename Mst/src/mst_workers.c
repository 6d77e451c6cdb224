/* Collide and commit by workers (mst_i.h): runs of pairs are collided ahead of the calling thread, which commits them
 * in their order, and collides too where it would have to wait. */
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeTeam.h"
#include "mst_i.h"

/* Runs that are worth calling workers for: some 20 us each in a heap of boxes. A thread that sleeps needs up to .35 ms
 * to wake, on a virtual machine. */
enum { LEAST_RUNS = 4 };

typedef struct Piping {
    MstBridgeRecord *b;
    McdModelPair *const *pairs;
    int count;
    McdSpaceID s;
    MdtWorldID w;
} Piping;

static void freeRuns(MstRun *runs) {
    for (int i = 0; runs && i < MST_AHEAD; i++)
        mst_runTerm(&runs[i]);
    MeMemoryGive(runs);
}

void mst_workersTerm(MstBridgeRecord *b) {
    freeRuns(b->runsAhead);
    b->runsAhead = 0;
}

/* Once, for as long as contacts need the same room. */
static MeBool makeRuns(MstBridgeRecord *b) {
    if (b->runsAhead)
        return METRUE;
    MstRun *runs = MeMemoryTakeZeroed(MST_AHEAD, sizeof *runs, "MstBridgeUpdateContacts", "runs of pairs");
    for (int i = 0; runs && i < MST_AHEAD; i++)
        if (!mst_runInit(&runs[i], b->run.contactMax, "MstBridgeUpdateContacts")) {
            freeRuns(runs);
            return MEFALSE;
        }
    b->runsAhead = runs;
    return runs != 0;
}

/* Pairs from the first on that workers may collide; their models have got their stamps. */
static int countPlainPairs(const MstBridgeRecord *b, McdModelPair *const pairs[], int count) {
    int i = 0;
    for (; i < count && mst_isPlainPair(b, pairs[i]); i++)
        McdModelPairLookAtModels(pairs[i]);
    return i;
}

static int firstOf(int run) {
    return run * MST_RUN;
}

static int endOf(const Piping *p, int run) {
    return MeMIN(firstOf(run + 1), p->count);
}

static void MEAPI collide(void *context, int item, int worker) {
    const Piping *p = context;
    MstRun *run = &p->b->runsAhead[item % MST_AHEAD];
    (void)worker;
    mst_collideRun(p->b, run, p->pairs + firstOf(item), endOf(p, item) - firstOf(item), p->s);
}

/* Pairs for whose contacts the run had no room are taken as without workers. */
static void MEAPI commit(void *context, int item, int worker) {
    const Piping *p = context;
    MstRun *run = &p->b->runsAhead[item % MST_AHEAD];
    (void)worker;
    mst_commitRun(p->b, run, p->s, p->w);
    for (int i = firstOf(item) + run->pairCount; i < endOf(p, item);) {
        i += mst_collideRun(p->b, &p->b->run, p->pairs + i, endOf(p, item) - i, p->s);
        mst_commitRun(p->b, &p->b->run, p->s, p->w);
    }
}

int mst_handleByWorkers(MstBridgeRecord *b, McdModelPair *const pairs[], int count, McdSpaceID s, MdtWorldID w) {
    MeTeam *team = w ? MdtWorldGetTeam(w) : 0;
    if (!team || b->part > 0 || count < LEAST_RUNS * MST_RUN || !makeRuns(b))
        return 0;
    Piping p = {b, pairs, countPlainPairs(b, pairs, count), s, w};
    if (p.count < LEAST_RUNS * MST_RUN)
        return 0;
    MeTeamOpen(team);
    MeTeamPipe(team, (p.count + MST_RUN - 1) / MST_RUN, MST_AHEAD, collide, commit, &p);
    MeTeamClose(team);
    return p.count;
}
