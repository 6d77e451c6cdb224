/* Collide and commit by workers (mst_step_i.h): runs of pairs are collided ahead of the calling thread, which commits
 * them in their order, and collides too where it would have to wait.
 *
 * The rule for order (MeTeam.h): a run writes to its own record and to its pairs (mst_update.c); where runs are looked
 * through, each writes its own counts, which are read in the runs' order. */
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeTeam.h"
#include "step/mst_step_i.h"

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

/* Allocates the runs once; again only if contacts need more room. */
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

/* ---- pairs that workers may collide ---- */

static int firstOf(int run) {
    return run * MST_RUN;
}

static int runsOf(int count) {
    return (count + MST_RUN - 1) / MST_RUN;
}

/* How many pairs are looked through at once: in runs. Fewer once one has been found that workers may not collide, and
 * twice as many as long as there is none. */
enum { MAX_RUNS = 1024 };

typedef struct Plain {
    const MstBridgeRecord *b;
    McdModelPair *const *pairs;
    int count;
    int end[MAX_RUNS];    /* by run: behind its first pairs that are plain */
    int unseen[MAX_RUNS]; /* the first of them with a model that has no stamp of this round; or its end */
} Plain;

static void MEAPI findPlainPairs(void *context, int run, int worker) {
    Plain *p = context;
    const int end = MeMIN(firstOf(run + 1), p->count);
    int i = firstOf(run), unseen = i;
    (void)worker;
    for (; i < end && mst_isPlainPair(p->b, p->pairs[i]); i++) {
        mst_prefetchModels(p->pairs, i, end);
        if (unseen == i && McdModelPairHasSeenModels(p->pairs[i]))
            unseen++;
    }
    p->end[run] = i;
    p->unseen[run] = unseen;
}

/* Pairs from the first on that workers may collide. All models of these have been looked at then: what is fixed or
 * sleeps, with the first pair that it is in. */
static int countPlainPairs(MeTeam *team, MstBridgeRecord *b, McdModelPair *const pairs[], int count) {
    Plain p = {.b = b, .pairs = pairs, .count = MeMIN(count, firstOf(b->runsLooked))};
    const int runs = runsOf(p.count);
    int plain = 0;
    MeTeamRun(team, runs, findPlainPairs, &p);
    for (int run = 0; run < runs && plain == firstOf(run); run++) {
        plain = p.end[run];
        for (int i = p.unseen[run]; i < plain; i++)
            McdModelPairLookAtModels(pairs[i]);
    }
    b->runsLooked = plain < p.count ? MST_MIN_RUNS : MeMIN(2 * b->runsLooked, MAX_RUNS);
    return plain;
}

/* ---- collide and commit ---- */

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

static MeBool areWorth(const MstBridgeRecord *b, const MeTeam *team, int count) {
    return team && b->substep == 0 && count >= MST_MIN_RUNS * MST_RUN;
}

/* Where there are more models than pairs, only the models of pairs are looked at. */
void mst_lookByWorkers(MstBridgeRecord *b, int count, McdSpaceID s, MdtWorldID w) {
    MeTeam *team = w ? MdtWorldGetTeam(w) : 0;
    b->runsLooked = MAX_RUNS;
    if (!areWorth(b, team, count) || count < McdSpaceGetModelCount(s))
        return;
    MeTeamOpen(team);
    McdSpaceLookAtModels(s);
    MeTeamClose(team);
}

int mst_handleByWorkers(MstBridgeRecord *b, McdModelPair *const pairs[], int count, McdSpaceID s, MdtWorldID w) {
    MeTeam *team = w ? MdtWorldGetTeam(w) : 0;
    if (!areWorth(b, team, count) || !makeRuns(b))
        return 0;
    MeTeamOpen(team);
    Piping p = {b, pairs, countPlainPairs(team, b, pairs, count), s, w};
    MeTeamPipe(team, runsOf(p.count), MST_AHEAD, collide, commit, &p);
    MeTeamClose(team);
    return p.count;
}
