/* Job systems for tests, that call tasks at once, late, or on threads of their own. The last is what docs/threads.md
 * shows. */
#ifndef TESTS_JOBS_H
#define TESTS_JOBS_H

#include "MeTask.h"
#include <pthread.h>
#include <stdlib.h>

typedef struct Job {
    MeTaskCB task;
    void *context;
    pthread_t thread;
} Job;

static Job *makeJob(MeTaskCB task, void *context) {
    Job *j = malloc(sizeof *j);
    if (!j)
        abort();
    *j = (Job){.task = task, .context = context};
    return j;
}

static void *MEAPI callAtOnce(MeTaskCB task, void *taskContext, void *userContext) {
    (void)userContext;
    task(taskContext);
    return NULL;
}

static void *MEAPI keepJob(MeTaskCB task, void *taskContext, void *userContext) {
    (void)userContext;
    return makeJob(task, taskContext);
}

static void MEAPI runKeptJob(void *userTask, void *userContext) {
    Job *j = userTask;
    (void)userContext;
    j->task(j->context);
    free(j);
}

static void *runJob(void *job) {
    Job *j = job;
    j->task(j->context);
    return NULL;
}

static inline void *MEAPI startJob(MeTaskCB task, void *taskContext, void *userContext) {
    Job *j = makeJob(task, taskContext);
    (void)userContext;
    if (pthread_create(&j->thread, NULL, runJob, j) != 0)
        abort();
    return j;
}

static inline void MEAPI waitForJob(void *userTask, void *userContext) {
    Job *j = userTask;
    (void)userContext;
    pthread_join(j->thread, NULL);
    free(j);
}

#endif
