/* The journal: each row is appended as it comes, with a checksum, so that a sweep that was killed goes on where it was.
 *
 *     karma-sweep 1 <id of scene and plan> <runs>
 *     <run> <status> <result> <result> ... #<checksum>
 *
 * A row that is torn, or does not fit its checksum, ends the journal: it is cut off there. One process at a time has
 * it. */
#include "sweep_i.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/* ---- reading ----------------------------------------------------------------------------------------------------- */

_Noreturn static void failWriting(const char *path) {
    sweep_fail(
        "%s cannot be written: %s: make room (df, quota, ulimit -f) or choose another -out; started again with the "
        "same options, it goes on where it was",
        path, strerror(errno));
}

static void writeAll(const SweepJournal *j, const char *text, size_t size) {
    while (size > 0) {
        const ssize_t written = write(j->file, text, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            failWriting(j->path);
        text += written;
        size -= (size_t)written;
    }
}

static void readAll(SweepJournal *j, size_t *size) {
    const off_t end = lseek(j->file, 0, SEEK_END);
    ssize_t got = 1;
    j->text = sweep_memory((size_t)end + 1, 1);
    for (*size = 0; got > 0; *size += got > 0 ? (size_t)got : 0)
        got = pread(j->file, j->text + *size, (size_t)end - *size, (off_t)*size);
    if (got < 0) /* not damaged: rows may still be there */
        sweep_fail("%s cannot be read: %s: try again, or choose another -out", j->path, strerror(errno));
}

static int head(const SweepPlan *plan, char *text, size_t size) {
    return snprintf(text, size, "karma-sweep 1 %016llx %ld\n", (unsigned long long)plan->id, plan->runs);
}

static uint64_t checksum(const SweepPlan *plan, const char *text, size_t size) {
    return sweep_hash(sweep_hash(SWEEP_HASH, &plan->id, sizeof plan->id), text, size);
}

static void keep(SweepJournal *j, long run, const char *row) {
    if (j->row[run])
        return;
    j->row[run] = strcpy(sweep_memory(strlen(row) + 1, 1), row);
    j->done++;
}

/* One line, which ends with a 0. */
static bool readRow(SweepJournal *j, char *line) {
    char *mark = strrchr(line, '#'), *end;
    if (!mark || mark == line || mark[-1] != ' ')
        return false;
    const unsigned long long sum = strtoull(mark + 1, &end, 16);
    if (*end || end != mark + 17 || sum != checksum(j->plan, line, (size_t)(mark - line)))
        return false;
    mark[-1] = 0;
    const long run = strtol(line, &end, 10);
    if (run < 0 || run >= j->plan->runs || *end != ' ')
        return false;
    keep(j, run, end + 1);
    return true;
}

/* Returns how much of it is good. */
static size_t readRows(SweepJournal *j, char *text, size_t size, size_t at) {
    while (at < size) {
        char *end = memchr(text + at, '\n', size - at);
        if (!end)
            return at;
        *end = 0;
        if (!readRow(j, text + at))
            return at;
        at = (size_t)(end + 1 - text);
    }
    return at;
}

/* Whether it begins as a journal does, of whatever sweep. */
static bool isJournal(const char *text) {
    int length = 0;
    return sscanf(text, "karma-sweep 1 %*16[0-9a-f] %*d%n", &length) == 0 && length > 0 && text[length] == '\n';
}

/* Returns how much of the text is good, 0: all of it is to be written; fails if it is somebody else's. */
static size_t readText(SweepJournal *j, size_t size, const char *expected, size_t length) {
    char *text = j->text;
    if (size >= length && memcmp(text, expected, length) == 0)
        return readRows(j, text, size, length);
    if (size < length && memcmp(text, expected, size) == 0)
        return 0; /* torn as it was begun */
    if (isJournal(text))
        sweep_fail("%s is of another scene, other parameters or another sample: choose another -out, or -again",
                   j->path);
    sweep_fail("%s is damaged in its first line, or no journal: choose another -out, or -again, which begins it anew",
               j->path);
}

static void readJournal(SweepJournal *j) {
    char expected[80];
    size_t size;
    const size_t length = (size_t)head(j->plan, expected, sizeof expected);
    readAll(j, &size);
    const size_t good = readText(j, size, expected, length);
    free(j->text);
    j->text = NULL;
    if (good < size && good > 0)
        sweep_say("%s: what follows after %ld rows is damaged, and is run again", j->path, j->done);
    if (ftruncate(j->file, (off_t)good) != 0)
        failWriting(j->path);
    if (good == 0)
        writeAll(j, expected, length);
    else if (j->done > 0)
        sweep_say("%ld of %ld rows are there already", j->done, j->plan->runs);
}

void sweep_journalOpen(SweepJournal *j, const char *path, const SweepPlan *plan, bool again) {
    *j = (SweepJournal){.plan = plan, .path = path, .file = open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)};
    if (j->file < 0)
        sweep_fail("%s cannot be written: %s: choose another -out", path, strerror(errno));
    if (flock(j->file, LOCK_EX | LOCK_NB) != 0)
        sweep_fail("%s is at work in another karma-sweep: wait for it, or choose another -out", path);
    j->row = sweep_memory((size_t)plan->runs, sizeof *j->row);
    if (again && ftruncate(j->file, 0) != 0)
        failWriting(path);
    readJournal(j);
}

/* ---- writing ----------------------------------------------------------------------------------------------------- */

void sweep_journalAdd(SweepJournal *j, long run, const char *row) {
    char line[SWEEP_ROW + 64];
    if (run < 0 || run >= j->plan->runs || j->row[run])
        return;
    const int length = snprintf(line, sizeof line - 20, "%ld %s ", run, row);
    const uint64_t sum = checksum(j->plan, line, (size_t)length);
    const int whole = length + snprintf(line + length, 20, "#%016llx\n", (unsigned long long)sum);
    writeAll(j, line, (size_t)whole);
    keep(j, run, row);
}

static void writeTitles(const SweepScene *s, FILE *out) {
    fprintf(out, "run");
    for (int i = 0; i < s->parameterCount; i++)
        fprintf(out, ",%s", s->parameter[i].name);
    for (int i = 0; i < s->resultCount; i++)
        fprintf(out, ",%s", s->result[i]);
    fprintf(out, ",status\n");
}

static void writeRow(const SweepJournal *j, long run, FILE *out) {
    double value[SWEEP_PARAMETERS];
    char number[40];
    const char *row = j->row[run], *results = strchr(row, ' ');
    sweep_planValues(j->plan, run, value);
    fprintf(out, "%ld", run);
    for (int i = 0; i < j->plan->scene->parameterCount; i++) {
        sweep_number(number, sizeof number, value[i]);
        fprintf(out, ",%s", number);
    }
    for (int i = 0; i < j->plan->scene->resultCount; i++) {
        const size_t length = results ? strcspn(results + 1, " ") : 0;
        fprintf(out, ",%.*s", (int)length, results ? results + 1 : "");
        results = results ? strchr(results + 1, ' ') : NULL;
    }
    fprintf(out, ",%.*s\n", (int)strcspn(row, " "), row);
}

static bool writeTable(const SweepJournal *j, FILE *out) {
    writeTitles(j->plan->scene, out);
    for (long run = 0; run < j->plan->runs; run++)
        writeRow(j, run, out);
    return fflush(out) == 0 && !ferror(out) && fsync(fileno(out)) == 0;
}

void sweep_journalWrite(const SweepJournal *j, const char *path) {
    char target[PATH_MAX], draft[PATH_MAX + 8];
    if (!realpath(path, target)) /* a link stays one */
        snprintf(target, sizeof target, "%s", path);
    snprintf(draft, sizeof draft, "%s.draft", target);
    unlink(draft);
    const int file = open(draft, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *out = file < 0 ? NULL : fdopen(file, "w");
    if (!out)
        failWriting(draft);
    int error = writeTable(j, out) ? 0 : errno;
    if (fclose(out) != 0 && error == 0)
        error = errno;
    if (error == 0 && rename(draft, target) == 0)
        return;
    error = error ? error : errno;
    unlink(draft);
    errno = error;
    failWriting(path);
}

void sweep_journalClose(SweepJournal *j) {
    for (long run = 0; run < j->plan->runs; run++)
        free(j->row[run]);
    free(j->row);
    close(j->file);
}

/* ---- queue ------------------------------------------------------------------------------------------------------- */

long sweep_queueTake(SweepQueue *q) {
    while (q->againCount > 0) {
        const long run = q->again[--q->againCount];
        if (!q->journal->row[run])
            return run;
    }
    while (q->next < q->journal->plan->runs)
        if (!q->journal->row[q->next++])
            return q->next - 1;
    return -1;
}

void sweep_queueGiveBack(SweepQueue *q, long run) {
    if (q->againCount == q->againRoom) {
        q->againRoom = 2 * q->againRoom + 16;
        q->again = realloc(q->again, (size_t)q->againRoom * sizeof *q->again);
        if (!q->again)
            sweep_fail("no memory");
    }
    q->again[q->againCount++] = run;
}
