/* The pool of threads, teams of workers on top of it or of a program's functions, and messages that wait. */
#include "MeInternal.h"
#include "MeTeam.h"
#include "jobs.h"
#include "karma_test.h"
#include <fenv.h>
#include <stdatomic.h>

#ifdef TEST_IS_FOR_THREADS
enum { ITEMS = 10000, ROUNDS = 50 };
#else
enum { ITEMS = 10000, ROUNDS = 200 };
#endif

/* What is not as it should be on other threads, where Check may not be asked. */
static atomic_int wrong;
static atomic_int calls;
static int doneBy[ITEMS], times[ITEMS];
static const int counts[] = {1, 2, 3, 4, 8};

static void MEAPI countCall(void *context) {
    (void)context;
    atomic_fetch_add(&calls, 1);
}

/* ---- the pool ---- */

TEST(each_task_is_called_once) {
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        MeTaskPoolID pool = MeTaskPoolCreate(counts[k]);
        void *task[64];
        ck_assert_int_eq(MeTaskPoolGetWorkers(pool), counts[k]);
        atomic_store(&calls, 0);
        for (int round = 0; round < ROUNDS; round++) {
            for (int i = 0; i < 64; i++)
                task[i] = MeTaskPoolEnqueue(countCall, NULL, pool);
            for (int i = 0; i < 64; i++)
                MeTaskPoolFinish(task[i], pool);
        }
        ck_assert_int_eq(atomic_load(&calls), 64 * ROUNDS);
        MeTaskPoolDestroy(pool);
    }
}

TEST(a_pool_takes_the_nearest_number_of_workers) {
    MeTaskPoolID none = MeTaskPoolCreate(0), many = MeTaskPoolCreate(MeTaskMaxWorkers + 1);
    ck_assert_int_eq(caught.warnings, 2);
    ck_assert_int_eq(MeTaskPoolGetWorkers(none), 1);
    ck_assert_int_eq(MeTaskPoolGetWorkers(many), MeTaskMaxWorkers);
    MeTaskPoolDestroy(none);
    MeTaskPoolDestroy(many);
    MeTaskPoolDestroy(NULL);
    ck_assert_int_eq(MeTaskPoolGetWorkers(NULL), 1);
    messages_forget();
}

/* ---- teams ---- */

static void MEAPI noteItem(void *context, int item, int worker) {
    if (item < 0 || item >= *(int *)context)
        atomic_fetch_add(&wrong, 1);
    else {
        times[item]++;
        doneBy[item] = worker;
    }
}

static void runLoops(MeTeam *team) {
    int items[] = {0, 1, 2, 7, 100, ITEMS};
    MeTeamOpen(team);
    for (int round = 0; round < ROUNDS; round++)
        for (size_t k = 0; k < sizeof items / sizeof *items; k++) {
            memset(times, 0, sizeof times);
            MeTeamRun(team, items[k], noteItem, &items[k]);
            for (int i = 0; i < items[k]; i++) {
                ck_assert_int_eq(times[i], 1);
                ck_assert_int_lt(doneBy[i], MeTeamGetSize(team));
            }
        }
    MeTeamClose(team);
    ck_assert_int_eq(atomic_load(&wrong), 0);
}

/* ---- watching ---- */

static int told[MeTeamLoopEnds + 1]; /* by event */

/* Loops and pipes are told between their beginning and their end, and items in their order where no task is started. */
static void MEAPI noteNews(const MeTeamNews *news, void *watchContext) {
    const int begun = told[MeTeamLoopBegins] + told[MeTeamPipeBegins];
    ck_assert(watchContext == told);
    if (news->event == MeTeamLoopBegins || news->event == MeTeamPipeBegins)
        ck_assert_int_eq(begun, told[MeTeamLoopEnds]);
    else
        ck_assert_int_eq(begun, told[MeTeamLoopEnds] + 1);
    if (news->event == MeTeamPipeBegins)
        ck_assert_int_eq(news->ahead, 2);
    told[news->event]++;
}

static void MEAPI doNothing(void *context, int item, int worker) {
    (void)context, (void)item, (void)worker;
}

TEST(who_watches_is_told_all_that_an_open_team_does) {
    MeTeam *team = MeTeamCreate(4, keepJob, runKeptJob, NULL, "test");
    MeTeamWatch(team, noteNews, told);
    MeTeamRun(team, 3, doNothing, NULL); /* it is not open */
    MeTeamOpen(team);
    MeTeamRun(team, 7, doNothing, NULL);
    MeTeamRun(team, 1, doNothing, NULL);
    MeTeamPipe(team, 5, 2, doNothing, doNothing, NULL);
    MeTeamClose(team);
    ck_assert_int_eq(told[MeTeamLoopBegins], 2);
    ck_assert_int_eq(told[MeTeamPipeBegins], 1);
    ck_assert_int_eq(told[MeTeamItemDone], 7 + 1 + 5);
    ck_assert_int_eq(told[MeTeamItemUsed], 5);
    ck_assert_int_eq(told[MeTeamLoopEnds], 3);
    MeTeamWatch(team, NULL, NULL);
    MeTeamOpen(team);
    MeTeamRun(team, 7, doNothing, NULL);
    MeTeamClose(team);
    ck_assert_int_eq(told[MeTeamLoopBegins], 2);
    MeTeamDestroy(team);
}

TEST(each_item_of_a_loop_is_done_once) {
    runLoops(NULL);
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        MeTaskPoolID pool = MeTaskPoolCreate(counts[k]);
        MeTeam *team = MeTeamCreate(counts[k], MeTaskPoolEnqueue, MeTaskPoolFinish, pool, "test");
        runLoops(team);
        runLoops(team);
        MeTeamDestroy(team);
        MeTaskPoolDestroy(pool);
    }
}

TEST(a_loop_ends_though_no_task_is_started) {
    MeTeam *atOnce = MeTeamCreate(4, callAtOnce, runKeptJob, NULL, "test");
    MeTeam *later = MeTeamCreate(4, keepJob, runKeptJob, NULL, "test");
    runLoops(atOnce);
    runLoops(later);
    MeTeamDestroy(atOnce);
    MeTeamDestroy(later);
}

/* ---- pipes ---- */

enum { AHEAD = 5 };
static int made[AHEAD], lastUsed;

static void MEAPI makeItem(void *context, int item, int worker) {
    (void)context, (void)worker;
    made[item % AHEAD] = item;
}

static void MEAPI useItem(void *context, int item, int worker) {
    (void)context;
    ck_assert_int_eq(worker, 0);
    ck_assert_int_eq(item, lastUsed + 1);
    ck_assert_int_eq(made[item % AHEAD], item);
    lastUsed = item;
}

TEST(a_pipe_hands_over_its_items_in_their_order) {
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        MeTaskPoolID pool = MeTaskPoolCreate(counts[k]);
        MeTeam *team = MeTeamCreate(counts[k], MeTaskPoolEnqueue, MeTaskPoolFinish, pool, "test");
        MeTeamOpen(team);
        for (int round = 0; round < ROUNDS; round++) {
            lastUsed = -1;
            MeTeamPipe(team, round, AHEAD, makeItem, useItem, NULL);
            ck_assert_int_eq(lastUsed, round - 1);
        }
        MeTeamClose(team);
        MeTeamDestroy(team);
        MeTaskPoolDestroy(pool);
    }
}

/* ---- what workers take along ---- */

static void MEAPI checkWorker(void *context, int item, int worker) {
    (void)item, (void)worker;
    if (fegetround() != *(int *)context || strcmp(MeCallerName("nobody"), "caller") != 0)
        atomic_fetch_add(&wrong, 1);
}

TEST(workers_round_and_name_as_the_opening_thread) {
    int rounding = FE_UPWARD;
    MeTaskPoolID pool = MeTaskPoolCreate(4);
    MeTeam *team = MeTeamCreate(4, MeTaskPoolEnqueue, MeTaskPoolFinish, pool, "test");
    const char *before = MeCallerSet("caller");
    fesetround(rounding);
    for (int i = 0; i < ROUNDS; i++) {
        MeTeamOpen(team);
        MeTeamRun(team, 100, checkWorker, &rounding);
        MeTeamClose(team);
    }
    fesetround(FE_TONEAREST);
    ck_assert_int_eq(atomic_load(&wrong), 0);
    MeCallerSet(before);
    MeTeamDestroy(team);
    MeTaskPoolDestroy(pool);
}

/* ---- messages ---- */

static char said[256];

static void MEAPI say(const int level, const char *const string) {
    (void)level;
    strcat(said, strrchr(string, ' '));
}

TEST(messages_that_wait_are_sent_by_their_keys) {
    messages_show();
    MeMessageBuffer first = {0}, second = {0}, *held[] = {&first, &second};
    MeSetWarningShow(say);
    ck_assert_ptr_null(MeMessagesBuffer(&first));
    first.key = 5;
    MeWarning(1, "is %s", "e");
    MeWarning(1, "is %s", "f");
    first.key = 1;
    MeWarning(1, "is %s", "a");
    ck_assert_ptr_eq(MeMessagesBuffer(&second), &first);
    second.key = 3;
    MeWarning(1, "is %s", "c");
    ck_assert_ptr_eq(MeMessagesBuffer(NULL), &second);
    ck_assert_str_eq(said, "");
    MeMessagesSend(held, 2);
    ck_assert_str_eq(said, " a c e f");
    MeMessagesSend(held, 2);
    MeWarning(1, "is %s", "g");
    ck_assert_str_eq(said, " a c e f g");
    MeSetWarningShow(NULL);
}

enum { SPEAKERS = 500 };
static int spoken[SPEAKERS + 1], numSpoken;

static void MEAPI noteSpeaker(const int level, const char *const string) {
    (void)level;
    if (numSpoken <= SPEAKERS)
        spoken[numSpoken++] = atoi(strrchr(string, ' '));
}

static void MEAPI speak(void *context, int item, int worker) {
    (void)context, (void)worker;
    MeWarning(1, "item %d", item);
}

static void MEAPI speakOfRange(void *context, int first, int end, int worker) {
    for (int i = first; i < end; i++)
        speak(context, i, worker);
}

static void MEAPI useNothing(void *context, int item, int worker) {
    (void)context, (void)item, (void)worker;
}

static void assertSpokenInOrder(void) {
    ck_assert_int_eq(numSpoken, SPEAKERS);
    for (int i = 0; i < SPEAKERS; i++)
        ck_assert_int_eq(spoken[i], i);
    numSpoken = 0;
}

TEST(messages_of_items_come_in_the_items_order) {
    messages_show();
    MeTaskPoolID pool = MeTaskPoolCreate(4);
    MeTeam *team = MeTeamCreate(4, MeTaskPoolEnqueue, MeTaskPoolFinish, pool, "test");
    MeSetWarningShow(noteSpeaker);
    MeTeamOpen(team);
    MeTeamRun(team, SPEAKERS, speak, NULL);
    assertSpokenInOrder();
    MeTeamRunRanges(team, SPEAKERS, 7, speakOfRange, NULL);
    assertSpokenInOrder();
    MeTeamPipe(team, SPEAKERS, 5, speak, useNothing, NULL);
    assertSpokenInOrder();
    MeTeamClose(team);
    MeTeamRunRanges(NULL, SPEAKERS, 7, speakOfRange, NULL);
    assertSpokenInOrder();
    MeSetWarningShow(NULL);
    MeTeamDestroy(team);
    MeTaskPoolDestroy(pool);
}

static int tasksOut, tasksDone;

static void *MEAPI countOut(MeTaskCB task, void *taskContext, void *userContext) {
    (void)task, (void)taskContext, (void)userContext;
    tasksOut++;
    return &tasksOut;
}

static void MEAPI countDone(void *userTask, void *userContext) {
    (void)userTask, (void)userContext;
    tasksDone++;
}

static void openAndClose(MeTeam *team) {
    MeTeamOpen(team);
    MeTeamClose(team);
}

TEST(a_team_that_is_kept_has_its_tasks_out_once) {
    MeTeam *team = MeTeamCreate(3, countOut, countDone, NULL, "test");
    tasksOut = tasksDone = 0;
    openAndClose(team);
    ck_assert(tasksOut == 2 && tasksDone == 2);
    MeTeamKeep(team);
    MeTeamRelease(team); /* nobody has opened it */
    ck_assert(tasksOut == 2 && tasksDone == 2);
    MeTeamKeep(team);
    openAndClose(team);
    openAndClose(team);
    ck_assert(tasksOut == 4 && tasksDone == 2);
    MeTeamRelease(team);
    ck_assert(tasksOut == 4 && tasksDone == 4);
    openAndClose(team);
    ck_assert(tasksOut == 6 && tasksDone == 6);
    MeTeamDestroy(team);
}
