/* Inside karma-sweep: what its files share.
 *
 *     file              what
 *     sweep_main.c      options, and the course
 *     sweep_scene.c     the scene: loads it, or compiles it first
 *     sweep_plan.c      which values the parameters have in run i: a grid or a sample
 *     sweep_journal.c   rows, as they come, in a file that survives; and all of them in order as CSV
 *     sweep_pool.c      the processes of this machine: which runs they get, and what is done when they die
 *     sweep_worker.c    one of them, and how it is kept from harm to others
 *     sweep_ranks.c     processes of MPI, each with a pool of its own
 */
#ifndef SWEEP_I_H
#define SWEEP_I_H

#include "KarmaSweep.h"
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

enum { SWEEP_ROW = 2048 }; /* bytes of a row's text: SWEEP_RESULTS numbers of 25, and its head */

/* To stderr, after "karma-sweep: "; the second also ends the program, with exit code 2. */
void sweep_say(const char *format, ...) __attribute__((__format__(__printf__, 1, 2)));
_Noreturn void sweep_fail(const char *format, ...) __attribute__((__format__(__printf__, 1, 2)));
void *sweep_memory(size_t count, size_t size); /* zeroed; none: fails */

/* FNV-1a, 64 bits. */
uint64_t sweep_hash(uint64_t hash, const void *data, size_t size);
#define SWEEP_HASH 14695981039346656037u

/* Fails if the path is of what a table must not replace: a directory, a device, a link to one, the scene. */
void sweep_mustBeFile(const char *path, const char *scene);

/* The fewest digits that read back as the same number. */
void sweep_number(char *text, size_t size, double x);

/* ---- scene ---- */

typedef struct SweepLoaded {
    const SweepScene *scene;
    uint64_t id; /* of the file's contents */
} SweepLoaded;

/* A path of a library, or of a .c file. Fails with a message. */
SweepLoaded sweep_sceneLoad(const char *path);
/* All descriptors but the standard ones and those that the scene opened when it was loaded. */
void sweep_sceneCloseOthers(void);

/* ---- plan ---- */

typedef struct SweepPlan {
    const SweepScene *scene;
    SweepParameter parameter[SWEEP_PARAMETERS];
    long runs;
    bool isSample;
    unsigned long seed;
    uint64_t id; /* of the scene's contents and all of the plan: rows of one id belong together */
} SweepPlan;

enum { SWEEP_RUNS = 100000000 }; /* most */

void sweep_planInit(SweepPlan *p, const SweepScene *scene);
/* "name=value", "name=least:largest" or "name=least:largest:count"; the name up to its unit will do. */
void sweep_planSet(SweepPlan *p, const char *text);
/* A sample of so many runs; 0: the grid. */
void sweep_planFinish(SweepPlan *p, long sample, unsigned long seed, uint64_t sceneId);
void sweep_planValues(const SweepPlan *p, long run, double *value);

/* ---- journal ---- */

typedef struct SweepJournal {
    const SweepPlan *plan;
    const char *path;
    int file;
    char *text; /* of the file, as long as it is read */
    char **row; /* by run: "status result ..."; null: not yet */
    long done;
    bool isWithoutEnd; /* a rank has died: MPI does not end */
} SweepJournal;

/* Opens it, or makes it; reads what it has. `again`: forgets that. The path is kept. */
void sweep_journalOpen(SweepJournal *j, const char *path, const SweepPlan *plan, bool again);
/* Adds a row; of a run that has one already nothing is changed. */
void sweep_journalAdd(SweepJournal *j, long run, const char *row);
/* All rows in order; replaces the file when it is whole. */
void sweep_journalWrite(const SweepJournal *j, const char *path);
void sweep_journalClose(SweepJournal *j);

/* ---- queue: which runs are still to be given away ---- */

typedef struct SweepQueue {
    const SweepJournal *journal;
    long next;
    long *again; /* given back: `againCount` of them */
    long againCount, againRoom;
} SweepQueue;

long sweep_queueTake(SweepQueue *q); /* -1: none is left */
void sweep_queueGiveBack(SweepQueue *q, long run);

/* ---- worker: a process that makes runs ---- */

enum { SWEEP_SHARE = 4 }; /* runs that a worker has at most, so that it need not wait for the pool */

typedef struct SweepAnswer {
    long run;
    int status; /* 0, or what went wrong */
    double result[SWEEP_RESULTS];
} SweepAnswer;

typedef struct SweepDesk SweepDesk; /* memory that a worker shares with its pool */

typedef struct SweepWorker {
    pid_t process; /* 0: none */
    int output;    /* what its runs print; -1: closed */
    SweepDesk *desk;
    long run[SWEEP_SHARE];
    int given;           /* runs that it has not answered: run[0] is the one at work */
    unsigned long taken; /* answers */
    double since;        /* s, by the pool's clock: begin of run[0] */
    size_t printed;      /* bytes, in run[0] */
    bool isEnded;        /* by the pool */
    long lateIn;         /* run for which it was, as that took too long; -1: none */
} SweepWorker;

enum { SWEEP_WORKERS = 256 };

/* All workers of a pool. */
typedef struct SweepCrew {
    const SweepPlan *plan;
    sigset_t signals; /* that were blocked when karma-sweep began */
    int count;
    SweepWorker worker[SWEEP_WORKERS];
} SweepCrew;

/* False: there is no room for another process; errno. */
bool sweep_workerStart(SweepCrew *crew, SweepWorker *w);
/* One more run; it may have SWEEP_SHARE. */
void sweep_workerGive(SweepWorker *w, long run, double now);
typedef enum SweepTaken { SWEEP_NONE, SWEEP_TAKEN, SWEEP_RUBBISH } SweepTaken;
/* Its next answer. Rubbish: a run has written where it has no business, and the worker is of no more use. */
SweepTaken sweep_workerTake(SweepWorker *w, SweepAnswer *answer, double now);
/* Kills it, whatever it does; it is dead soon. */
void sweep_workerEnd(SweepWorker *w);
bool sweep_workerIsDead(const SweepWorker *w);
/* Of one that is dead or killed, with the processes of its group. Returns its status, as wait() does. */
int sweep_workerBury(SweepWorker *w);

/* ---- pool ---- */

/* Where a pool gets its runs from, and where its rows go. */
typedef struct SweepClient {
    void *data;
    long (*take)(void *data); /* -1: none now */
    void (*row)(void *data, long run, const char *row);
} SweepClient;

typedef struct SweepPool SweepPool;
/* limit: s that a run may take, 0: any. */
SweepPool *sweep_poolCreate(const SweepPlan *plan, int workers, int limit, const SweepClient *client);
/* Gives runs to workers that wait, and takes rows; waits for some for so many ms. False: there is nothing to do. */
bool sweep_poolTurn(SweepPool *pool, int wait);
void sweep_poolDestroy(SweepPool *pool);

/* ---- ranks ---- */

typedef struct SweepRanks {
    int rank, count;
    bool isLaunched; /* by mpirun */
    int silence;     /* s, after which a rank is taken for dead */
} SweepRanks;

/* Of a program that mpirun has started; else, and without MPI, one rank. */
SweepRanks sweep_ranksBegin(int *argc, char ***argv);
/* The whole sweep, of rank 0: its pool and the others'. */
void sweep_ranksLead(SweepRanks ranks, const SweepPlan *plan, SweepJournal *journal, int workers, int limit);
/* Of the others: until rank 0 says that all is done. False: a rank has died, and MPI_Finalize would wait for it. */
bool sweep_ranksFollow(const SweepPlan *plan, int workers, int limit);
void sweep_ranksEnd(SweepRanks ranks);

#endif
