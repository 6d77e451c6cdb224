/* Collide by workers, commit by the calling thread (mst_step_i.h): runs of pairs are collided ahead of the calling
 * thread, which commits them in order, and collides as well where it would have to wait.
 *
 * The rule for order (MeTeam.h): a run writes only to its own record and its pairs (mst_update.c); a search for plain
 * pairs writes only the counts of its run, which are then read in the order of the runs. */
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeTeam.h"
#include "step/mst_step_i.h"

typedef struct PairPipeline {
    MstBridgeRecord *b;
    McdModelPair *const *pairs;
    int count;
    MdtWorldID w;
} PairPipeline;

static void freeRuns(MstRun *runs) {
    for (int i = 0; runs && i < MST_AHEAD; i++)
        mst_runTerm(&runs[i]);
    MeMemoryGive(runs);
}

void mst_workersTerm(MstBridgeRecord *b) {
    freeRuns(b->runsAhead);
    b->runsAhead = 0;
}

/* Allocates the runs for workers, unless they exist. */
static MeBool allocateRuns(MstBridgeRecord *b) {
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

/* ---- pairs that workers may collide ---- */

static int firstPairOf(int run) {
    return run * MST_RUN;
}

static int runCountOf(int count) {
    return (count + MST_RUN - 1) / MST_RUN;
}

/* The maximum number of runs that a search for plain pairs covers. The next search covers MST_MIN_RUNS after a pair was
 * found that workers may not collide, else twice as many as this one. */
enum { MAX_RUNS = 1024 };

typedef struct PlainSearch {
    const MstBridgeRecord *b;
    McdModelPair *const *pairs;
    int count;
    int end[MAX_RUNS];       /* by run: end of its leading plain pairs */
    int unstamped[MAX_RUNS]; /* by run: the first of these with an unstamped model; or `end` */
} PlainSearch;

static void MEAPI findPlainPairs(void *context, int run, int worker) {
    PlainSearch *p = context;
    const int end = MeMIN(firstPairOf(run + 1), p->count);
    int i = firstPairOf(run), unstamped = i;
    (void)worker;
    for (; i < end && mst_isPlainPair(p->b, p->pairs[i]); i++) {
        mst_prefetchModels(p->pairs, i, end);
        if (unstamped == i && McdModelPairHasComparedModels(p->pairs[i]))
            unstamped++;
    }
    p->end[run] = i;
    p->unstamped[run] = unstamped;
}

/* The number of leading pairs that workers may collide. Stamps their models: of fixed and sleeping ones, with the first
 * pair that has them. */
static int countPlainPairs(MeTeam *team, MstBridgeRecord *b, McdModelPair *const pairs[], int count) {
    PlainSearch p = {.b = b, .pairs = pairs, .count = MeMIN(count, firstPairOf(b->runsSearched))};
    MEASSERT(b->runsSearched > 0 && b->runsSearched <= MAX_RUNS);
    const int runs = runCountOf(p.count);
    int plain = 0;
    MeTeamRun(team, runs, findPlainPairs, &p);
    for (int run = 0; run < runs && plain == firstPairOf(run); run++) {
        plain = p.end[run];
        for (int i = p.unstamped[run]; i < plain; i++)
            McdModelPairCompareModels(pairs[i]);
    }
    b->runsSearched = plain < p.count ? MST_MIN_RUNS : MeMIN(2 * b->runsSearched, MAX_RUNS);
    MEASSERT(plain >= 0 && plain <= p.count);
    return plain;
}

/* ---- collide and commit ---- */

static int endPairOf(const PairPipeline *p, int run) {
    return MeMIN(firstPairOf(run + 1), p->count);
}

static void MEAPI collideItem(void *context, int item, int worker) {
    const PairPipeline *p = context;
    MstRun *run = &p->b->runsAhead[item % MST_AHEAD];
    (void)worker;
    mst_collideRun(p->b, run, p->pairs + firstPairOf(item), endPairOf(p, item) - firstPairOf(item));
}

/* Commits a run; pairs that its contact buffer had no room for are collided and committed here. */
static void MEAPI commitItem(void *context, int item, int worker) {
    const PairPipeline *p = context;
    MstRun *run = &p->b->runsAhead[item % MST_AHEAD];
    (void)worker;
    mst_commitRun(p->b, run, p->w);
    for (int i = firstPairOf(item) + run->pairCount; i < endPairOf(p, item);) {
        i += mst_collideRun(p->b, &p->b->run, p->pairs + i, endPairOf(p, item) - i);
        mst_commitRun(p->b, &p->b->run, p->w);
    }
}

static MeBool areEnoughForWorkers(const MstBridgeRecord *b, const MeTeam *team, int count) {
    return team && b->substep == 0 && count >= MST_MIN_RUNS * MST_RUN;
}

/* If there are more models than pairs, only the models of pairs are stamped (countPlainPairs). */
void mst_stampModelsByWorkers(MstBridgeRecord *b, int count, McdSpaceID s, MdtWorldID w) {
    MeTeam *team = w ? MdtWorldGetTeam(w) : 0;
    b->runsSearched = MAX_RUNS;
    if (!areEnoughForWorkers(b, team, count) || count < McdSpaceGetModelCount(s))
        return;
    MeTeamOpen(team);
    McdSpaceCompareModels(s);
    MeTeamClose(team);
}

int mst_handlePairsByWorkers(MstBridgeRecord *b, McdModelPair *const pairs[], int count, MdtWorldID w) {
    MeTeam *team = w ? MdtWorldGetTeam(w) : 0;
    if (!areEnoughForWorkers(b, team, count) || !allocateRuns(b))
        return 0;
    MeTeamOpen(team);
    PairPipeline p = {b, pairs, countPlainPairs(team, b, pairs, count), w};
    MeTeamPipe(team, runCountOf(p.count), MST_AHEAD, collideItem, commitItem, &p);
    MeTeamClose(team);
    return p.count;
}
