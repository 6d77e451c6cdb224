/* Processes of MPI: each rank has a pool on its machine; rank 0 has the journal, and gives runs to the others.
 *
 *     tag     from   to     what
 *     ASK     rank   0      how many runs it would like; with 0 it only says that it lives
 *     RUNS    0      rank   numbers of runs, or none
 *     ROW     rank   0      number and row, as text
 *     DONE    0      rank   nothing is left
 *
 * A rank that has said nothing for some seconds (-silence) is taken for dead; its runs go to the others. (mpirun ends
 * all ranks with the first that dies, unless it is told to go on; then the journal goes on, at the next start.) */
#include "sweep_i.h"
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void addRow(void *data, long run, const char *row) {
    sweep_journalAdd(data, run, row);
}

typedef struct Local {
    SweepQueue queue;
    SweepJournal *journal;
} Local;

static long takeLocal(void *data) {
    return sweep_queueTake(&((Local *)data)->queue);
}

static void keepLocal(void *data, long run, const char *row) {
    addRow(((Local *)data)->journal, run, row);
}

/* By mpirun of Open MPI, or of MPICH and its kin. */
static bool isLaunched(void) {
    return getenv("OMPI_COMM_WORLD_SIZE") || getenv("PMI_SIZE");
}

/* ---- without MPI ------------------------------------------------------------------------------------------------- */

#ifndef SWEEP_HAS_MPI

SweepRanks sweep_ranksBegin(int *argc, char ***argv) {
    (void)argc, (void)argv;
    if (isLaunched())
        sweep_fail("it was built without MPI, so that mpirun would start many that each do all: build it where MPI is "
                   "installed");
    return (SweepRanks){.count = 1};
}

void sweep_ranksLead(SweepRanks ranks, const SweepPlan *plan, SweepJournal *journal, int workers, int limit) {
    Local local = {{.journal = journal}, journal};
    const SweepClient client = {&local, takeLocal, keepLocal};
    SweepPool *pool = sweep_poolCreate(plan, workers, limit, &client);
    (void)ranks;
    while (sweep_poolTurn(pool, 1000))
        continue;
    sweep_poolDestroy(pool);
    free(local.queue.again);
}

bool sweep_ranksFollow(const SweepPlan *plan, int workers, int limit) {
    (void)plan, (void)workers, (void)limit;
    return true;
}

void sweep_ranksEnd(SweepRanks ranks) {
    (void)ranks;
}

#else

/* ---- with MPI ---------------------------------------------------------------------------------------------------- */

#include <mpi.h>

enum { ASK = 1, RUNS, ROW, DONE };
enum { MAX_AT_ONCE = 64 };
static const double beat = .5; /* s: a rank says that it lives */

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A program alone would start a daemon of MPI for itself. */
SweepRanks sweep_ranksBegin(int *argc, char ***argv) {
    SweepRanks ranks = {.count = 1, .isLaunched = isLaunched()};
    if (!ranks.isLaunched)
        return ranks;
    MPI_Init(argc, argv);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks.count);
    return ranks;
}

void sweep_ranksEnd(SweepRanks ranks) {
    if (ranks.isLaunched)
        MPI_Finalize();
}

/* ---- rank 0 ---- */

/* Another rank, as rank 0 knows it. */
typedef struct Rank {
    bool isDead;
    double heard; /* s, when last */
    long *run;    /* that it has not answered yet */
    int given, room;
} Rank;

typedef struct Leader {
    Local local;
    Rank *rank;
    int count, silence;
} Leader;

static void giveRuns(Leader *l, int to, int wanted) {
    Rank *r = &l->rank[to];
    long run[MAX_AT_ONCE];
    int count = 0;
    while (count < wanted && count < MAX_AT_ONCE && (run[count] = sweep_queueTake(&l->local.queue)) >= 0)
        count++;
    if (r->given + count > r->room) {
        r->room = 2 * (r->given + count);
        r->run = realloc(r->run, (size_t)r->room * sizeof *r->run);
        if (!r->run)
            sweep_fail("no memory");
    }
    memcpy(r->run + r->given, run, (size_t)count * sizeof *run);
    r->given += count;
    MPI_Send(run, count, MPI_LONG, to, RUNS, MPI_COMM_WORLD);
}

static void takeRow(Leader *l, int from, const char *text) {
    Rank *r = &l->rank[from];
    char *row;
    const long run = strtol(text, &row, 10);
    for (int i = 0; i < r->given; i++)
        if (r->run[i] == run) {
            r->run[i] = r->run[--r->given];
            break;
        }
    sweep_journalAdd(l->local.journal, run, row + 1);
}

/* Returns whether there was a message. */
static bool hear(Leader *l) {
    MPI_Status status;
    int isThere = 0, wanted = 0;
    char text[SWEEP_ROW + 32];
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &isThere, &status) != MPI_SUCCESS || !isThere)
        return false;
    const int from = status.MPI_SOURCE;
    l->rank[from].heard = now();
    l->rank[from].isDead = false; /* it was only slow */
    if (status.MPI_TAG == ASK) {
        MPI_Recv(&wanted, 1, MPI_INT, from, ASK, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (wanted > 0)
            giveRuns(l, from, wanted);
    } else {
        MPI_Recv(text, (int)sizeof text, MPI_CHAR, from, ROW, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        takeRow(l, from, text);
    }
    return true;
}

static void missDead(Leader *l) {
    for (int i = 1; i < l->count; i++) {
        Rank *r = &l->rank[i];
        if (r->isDead || now() - r->heard < l->silence)
            continue;
        r->isDead = true;
        sweep_say("rank %d has been silent for %d s: its share of %d runs is run again", i, l->silence, r->given);
        for (int k = 0; k < r->given; k++)
            sweep_queueGiveBack(&l->local.queue, r->run[k]);
        r->given = 0;
    }
}

static bool sayDone(Leader *l) {
    long dead = 0;
    for (int i = 1; i < l->count; i++)
        dead += l->rank[i].isDead;
    for (int i = 1; i < l->count; i++)
        if (!l->rank[i].isDead)
            MPI_Send(&dead, 1, MPI_LONG, i, DONE, MPI_COMM_WORLD);
    return dead == 0;
}

static long takeAsLeader(void *data) {
    return takeLocal(&((Leader *)data)->local);
}

static void keepAsLeader(void *data, long run, const char *row) {
    keepLocal(&((Leader *)data)->local, run, row);
}

void sweep_ranksLead(SweepRanks ranks, const SweepPlan *plan, SweepJournal *journal, int workers, int limit) {
    Leader l = {.local = {{.journal = journal}, journal}, .count = ranks.count, .silence = ranks.silence};
    const SweepClient client = {&l, takeAsLeader, keepAsLeader};
    SweepPool *pool = sweep_poolCreate(plan, workers, limit, &client);
    l.rank = sweep_memory((size_t)ranks.count, sizeof *l.rank);
    for (int i = 0; i < ranks.count; i++)
        l.rank[i].heard = now();
    while (journal->done < plan->runs) {
        sweep_poolTurn(pool, ranks.count > 1 ? 1 : 1000);
        while (ranks.count > 1 && hear(&l))
            continue;
        missDead(&l);
    }
    sweep_poolDestroy(pool);
    const bool areAllAlive = sayDone(&l);
    for (int i = 0; i < ranks.count; i++)
        free(l.rank[i].run);
    free(l.rank);
    free(l.local.queue.again);
    journal->isWithoutEnd = !areAllAlive;
}

/* ---- the others ---- */

typedef struct Follower {
    long run[MAX_AT_ONCE];
    int count;
    bool areAllAlive;
} Follower;

static long takeGiven(void *data) {
    Follower *f = data;
    if (f->count == 0)
        return -1;
    const long run = f->run[0];
    memmove(f->run, f->run + 1, (size_t)--f->count * sizeof *f->run);
    return run;
}

static void sendRow(void *data, long run, const char *row) {
    char text[SWEEP_ROW + 32];
    (void)data;
    const int length = snprintf(text, sizeof text, "%ld %s", run, row);
    MPI_Send(text, length + 1, MPI_CHAR, 0, ROW, MPI_COMM_WORLD);
}

/* False: all is done. */
static bool obey(Follower *f, bool *isAsking) {
    MPI_Status status;
    int isThere = 0;
    if (MPI_Iprobe(0, MPI_ANY_TAG, MPI_COMM_WORLD, &isThere, &status) != MPI_SUCCESS)
        return false;
    if (!isThere)
        return true;
    MPI_Recv(f->run, MAX_AT_ONCE, MPI_LONG, 0, status.MPI_TAG, MPI_COMM_WORLD, &status);
    if (status.MPI_TAG == DONE) {
        f->areAllAlive = f->run[0] == 0;
        return false;
    }
    MPI_Get_count(&status, MPI_LONG, &f->count);
    *isAsking = false;
    return true;
}

bool sweep_ranksFollow(const SweepPlan *plan, int workers, int limit) {
    Follower f = {.count = 0};
    const SweepClient client = {&f, takeGiven, sendRow};
    SweepPool *pool = sweep_poolCreate(plan, workers, limit, &client);
    bool isAsking = false;
    double said = 0;
    while (obey(&f, &isAsking)) {
        const bool isBusy = sweep_poolTurn(pool, 1);
        const bool wants = f.count == 0 && !isAsking && (isBusy || now() - said > .01);
        const int most = 8 * workers < MAX_AT_ONCE ? 8 * workers : MAX_AT_ONCE, wanted = wants ? most : 0;
        if (!wants && now() - said < beat)
            continue;
        MPI_Send(&wanted, 1, MPI_INT, 0, ASK, MPI_COMM_WORLD);
        said = now();
        isAsking |= wants;
    }
    sweep_poolDestroy(pool);
    return f.areAllAlive;
}

#endif
