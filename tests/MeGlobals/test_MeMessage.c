/* Messages: limits, handlers, show functions, and what the defaults print where. */
#define _POSIX_C_SOURCE 200809L /* dup2, fork */
#include "MeInternal.h"
#include "karma_test.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- the five kinds ---- */

typedef struct {
    void (*send)(const int level, const char *const format, ...);
    int *limit;
    MeHandler *handler;
    MeHandler standardHandler;
    MeHandler (*setHandler)(MeHandler);
    MeShow *show;
    MeShow standardShow;
    MeShow (*setShow)(MeShow);
    int standardLimit;
    const char *prefix;
} Kind;

static const Kind kinds[] = {
    {MeInfo, &MeInfoLevel, &MeInfoHandler, MeHandlerInfo, MeSetInfoHandler, &MeInfoShow, MeShowStdout, MeSetInfoShow, 1,
     ""},
    {MeDebug, &MeDebugLevel, &MeDebugHandler, MeHandlerDebug, MeSetDebugHandler, &MeDebugShow, MeShowStderr,
     MeSetDebugShow, -1, "Karma debug: "},
    {MeLog, &MeLogLevel, &MeLogHandler, MeHandlerLog, MeSetLogHandler, &MeLogShow, MeShowStderr, MeSetLogShow, 1, ""},
    {MeWarning, &MeWarningLevel, &MeWarningHandler, MeHandlerWarning, MeSetWarningHandler, &MeWarningShow, MeShowStderr,
     MeSetWarningShow, 5, "Karma warning: "},
    {MeFatalError, &MeFatalErrorLevel, &MeFatalErrorHandler, MeHandlerFatalError, MeSetFatalErrorHandler,
     &MeFatalErrorShow, MeShowStderr, MeSetFatalErrorShow, 5, "Karma fatal error: "},
};
enum { numKinds = sizeof kinds / sizeof kinds[0], fatal = numKinds - 1 };

static struct {
    int calls, level;
    char text[2 * MeMAXMESSAGE];
} got;

static void catchMessage(const int level, const char *const format, va_list ap) {
    got.calls++;
    got.level = level;
    vsnprintf(got.text, sizeof got.text, format, ap);
}

static void catchText(const int level, const char *const string) {
    got.calls++;
    got.level = level;
    snprintf(got.text, sizeof got.text, "%s", string);
}

TEST(defaults) {
    messages_show();
    for (int i = 0; i < numKinds; i++) {
        ck_assert_int_eq(*kinds[i].limit, kinds[i].standardLimit);
        ck_assert(*kinds[i].handler == kinds[i].standardHandler);
        ck_assert(*kinds[i].show == kinds[i].standardShow);
    }
}

TEST(handlers_get_the_message) {
    messages_show();
    for (int i = 0; i < numKinds; i++) {
        const Kind *const k = &kinds[i];
        const int limit = *k->limit;
        memset(&got, 0, sizeof got);
        ck_assert(k->setHandler(catchMessage) == k->standardHandler);
        *k->limit = 3;
        k->send(3, "%d bodies and %s", 12, "a joint");
        ck_assert_int_eq(got.calls, 1);
        ck_assert_int_eq(got.level, 3);
        ck_assert_str_eq(got.text, "12 bodies and a joint");
        k->send(4, "dropped");
        ck_assert_int_eq(got.calls, 1);
        *k->limit = limit;
        ck_assert(k->setHandler(NULL) == catchMessage);
        ck_assert(*k->handler == k->standardHandler);
    }
}

/* But for fatal errors, whose default handler does not return. */
TEST(show_functions_get_the_finished_text) {
    messages_show();
    for (int i = 0; i < fatal; i++) {
        const Kind *const k = &kinds[i];
        char expected[64];
        const int limit = *k->limit;
        memset(&got, 0, sizeof got);
        ck_assert(k->setShow(catchText) == k->standardShow);
        *k->limit = 3;
        k->send(2, "%d bodies\n", 12);
        *k->limit = limit;
        snprintf(expected, sizeof expected, "%s12 bodies", k->prefix);
        ck_assert_int_eq(got.level, 2);
        ck_assert_str_eq(got.text, expected);
        ck_assert(k->setShow(NULL) == catchText);
        ck_assert(*k->show == k->standardShow);
    }
}

TEST(fatal_show_is_replaceable) {
    ck_assert(MeSetFatalErrorShow(catchText) == MeShowStderr);
    ck_assert(MeSetFatalErrorShow(NULL) == catchText);
    ck_assert(MeFatalErrorShow == MeShowStderr);
}

TEST(long_messages_are_cut) {
    messages_show();
    static char text[3 * MeMAXMESSAGE];
    memset(text, 'x', sizeof text - 1);
    MeSetWarningShow(catchText);
    MeWarning(0, "%s", text);
    MeSetWarningShow(NULL);
    ck_assert_uint_eq(strlen(got.text), MeMAXMESSAGE - 1);
    ck_assert(strncmp(got.text, "Karma warning: xxx", 18) == 0);
}

/* Of others in between, 64 are remembered. */
TEST(a_warning_that_repeats_is_shown_twice) {
    messages_show();
    enum { REMEMBERED = 64 };
    memset(&got, 0, sizeof got);
    MeSetWarningShow(catchText);
    for (int i = 0; i < 5; i++)
        MeWarning(0, "again and again");
    ck_assert_int_eq(got.calls, 2);
    ck_assert_str_eq(got.text, "Karma warning: again and again (again: not shown any more)");
    for (int i = 0; i < REMEMBERED - 1; i++)
        MeWarning(0, "another %d", i);
    MeWarning(0, "again and again");
    ck_assert_int_eq(got.calls, 2 + REMEMBERED - 1);
    MeWarning(0, "one more");
    MeWarning(0, "again and again");
    ck_assert_int_eq(got.calls, 2 + REMEMBERED + 1);
    MeSetWarningShow(NULL);
}

/* The name that a message begins with, in its format or as an argument, is replaced; what has none stays as it is. Of
 * several the first is sent. */
TEST(messages_go_under_the_name_of_the_caller) {
    const char *before = MeMessagesAs("Outer");
    ck_assert_ptr_null(before);
    ck_assert_str_eq(MeMessagesAs("Inner"), "Outer"); /* who is set stays */
    MeWarning(1, "%s: %d of %s", "Callee", 2, "three");
    ck_assert_str_eq(caught.last, "Outer: 2 of three");
    MeWarning(1, "Callee: not sent");
    ck_assert_int_eq(caught.warnings, 1);
    MeFatalError(1, "Callee_2: no memory for %d", 7);
    ck_assert_str_eq(caught.last, "Outer: no memory for 7");
    MeMessagesAs(before);
    MeMessagesAs("Outer");
    MeWarning(1, "no name here: %d", 4);
    ck_assert_str_eq(caught.last, "no name here: 4");
    MeMessagesAs(NULL);
    MeWarning(1, "Callee: sent");
    ck_assert_str_eq(caught.last, "Callee: sent");
    messages_forget();
}

TEST(empty_messages) {
    MeSetLogShow(catchText);
    const char *const empty = "";
    MeLog(0, "%s", empty);
    ck_assert_str_eq(got.text, "");
    MeLog(0, "\n");
    ck_assert_str_eq(got.text, "");
    MeSetLogShow(NULL);
}

/* ---- what is printed ---- */

static FILE *printed;
static int keptStdout, keptStderr;

/* From here to printedText() both streams go to one file. */
static void catchStreams(void) {
    fflush(NULL);
    printed = tmpfile();
    ck_assert_ptr_nonnull(printed);
    keptStdout = dup(STDOUT_FILENO);
    keptStderr = dup(STDERR_FILENO);
}

static void redirect(int stream) {
    ck_assert_int_ge(dup2(fileno(printed), stream), 0);
}

static const char *printedText(void) {
    static char text[1024];
    fflush(NULL);
    dup2(keptStdout, STDOUT_FILENO);
    dup2(keptStderr, STDERR_FILENO);
    close(keptStdout);
    close(keptStderr);
    rewind(printed);
    text[fread(text, 1, sizeof text - 1, printed)] = 0;
    fclose(printed);
    return text;
}

TEST(what_goes_to_stdout) {
    catchStreams();
    redirect(STDOUT_FILENO);
    MeInfo(1, "ready");
    MeInfo(2, "dropped");
    MeShowStdout(0, "shown");
    ck_assert_str_eq(printedText(), "ready\nshown\n");
}

TEST(what_goes_to_stderr) {
    messages_show();
    catchStreams();
    redirect(STDERR_FILENO);
    MeWarning(5, "body %d", 3);
    MeWarning(6, "dropped");
    MeLog(1, "line");
    MeDebug(0, "dropped");
    MeShowStderr(0, "a");
    MeShowDialog(0, "b");
    MeShowCrtErr(0, "c");
    MeShowCrtWarn(0, "d");
    ck_assert_str_eq(printedText(), "Karma warning: body 3\nline\na\nb\nc\nd\n");
}

TEST(fatal_errors_abort) {
    messages_show();
    catchStreams();
    const pid_t child = fork();
    if (child == 0) {
        redirect(STDERR_FILENO);
        MeFatalError(0, "out of %s", "memory");
        _exit(0);
    }
    int status = 0;
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    ck_assert_str_eq(printedText(), "Karma fatal error: out of memory\n");
    ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}

TEST(paths_are_shortened) {
    char path[] = "/home/karma/src/MdtBody.c", windows[] = "C:\\karma\\Mdt.c", bare[] = "Mdt.c", dir[] = "src/";
    ck_assert_ptr_eq(MeShortenPath(path), path + 16);
    ck_assert_str_eq(MeShortenPath(windows), "Mdt.c");
    ck_assert_ptr_eq(MeShortenPath(bare), bare);
    ck_assert_str_eq(MeShortenPath(dir), "");
    ck_assert_ptr_null(MeShortenPath(NULL));
}
