/* The scene: a shared library with the function sweepScene, or a C file that is compiled to one.
 *
 * A library is loaded on trial first, in a process of its own: one that is cut off, or ends the process that loads it,
 * gets a message and does not end karma-sweep by a signal. */
#include "sweep_i.h"
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static uint64_t hashOfFile(const char *path) {
    unsigned char block[65536];
    uint64_t hash = SWEEP_HASH;
    struct stat status;
    FILE *file = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    if (!file)
        sweep_fail("%s cannot be read: SCENE has to be a file, a shared library or C source", path);
    for (size_t size; (size = fread(block, 1, sizeof block, file)) > 0;)
        hash = sweep_hash(hash, block, size);
    if (ferror(file))
        sweep_fail("%s cannot be read: %s", path, strerror(errno));
    fclose(file);
    return hash;
}

/* ---- compiling --------------------------------------------------------------------------------------------------- */

/* By the shell, as the flags are words of it: $KARMA_SWEEP_CC, or the compiler with the installed Karma, of single
 * precision, else of double. */
static bool compile(const char *source, const char *library) {
    const char *script =
        "set -e; cc=$KARMA_SWEEP_CC; libs=$KARMA_SWEEP_LIBS; if [ -z \"$cc\" ]; then k=karma-mst; "
        "pkg-config --exists $k || k=karma-mst-double; cc=\"${CC:-cc} -O2 $(pkg-config --cflags $k)\"; "
        "libs=$(pkg-config --libs $k); fi; exec $cc -shared -fPIC \"$1\" -o \"$2\" $libs -lm";
    const pid_t compiler = fork();
    int status = -1;
    if (compiler == 0) {
        execl("/bin/sh", "sh", "-c", script, "karma-sweep", source, library, (char *)NULL);
        _exit(127);
    }
    return compiler > 0 && waitpid(compiler, &status, 0) == compiler && status == 0;
}

/* The library of a C file, or the file itself. A library of ours is in a directory of ours. */
static bool findLibrary(const char *path, char library[PATH_MAX]) {
    const size_t length = strlen(path);
    const char *place = getenv("TMPDIR") && *getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp";
    if (length <= 2 || strcmp(path + length - 2, ".c") != 0) {
        /* Without a slash it would be looked for where the system has its libraries. */
        if (snprintf(library, PATH_MAX, "%s%s", strchr(path, '/') ? "" : "./", path) >= PATH_MAX)
            sweep_fail("%s: the path is too long", path);
        return false;
    }
    if (snprintf(library, PATH_MAX - 16, "%s/karma-sweep-XXXXXX", place) >= PATH_MAX - 16 || !mkdtemp(library))
        sweep_fail("there can be no directory in %s: %s: make room, or set TMPDIR to another", place, strerror(errno));
    strcat(library, "/scene.so");
    return true;
}

static void removeLibrary(char *library) {
    unlink(library);
    *strrchr(library, '/') = 0;
    rmdir(library);
}

/* ---- loading ----------------------------------------------------------------------------------------------------- */

static bool isTitle(const char *text) {
    if (!text || !*text)
        return false;
    for (; *text; text++)
        if (*text == ',' || *text == '"' || (unsigned char)*text < ' ')
            return false;
    return true;
}

static const char *mistakeInHead(const SweepScene *s) {
    if (!s)
        return "sweepScene returns null: it has to return a scene";
    if (s->version != SWEEP_VERSION)
        return "it was made for another version of KarmaSweep.h: compile it again";
    if (!isTitle(s->name) || strchr(s->name, '/'))
        return "the scene's name is null, empty, or has a slash, comma, quote or line end";
    if (!s->run)
        return "the scene's function run is null";
    if (s->parameterCount < 0 || s->parameterCount > SWEEP_PARAMETERS)
        return "parameterCount has to be 0 to 32";
    if (s->parameterCount > 0 && !s->parameter)
        return "the table of parameters is null";
    if (s->resultCount < 1 || s->resultCount > SWEEP_RESULTS)
        return "resultCount has to be 1 to 64";
    return s->result ? NULL : "the table of results is null";
}

static const char *mistakeInParameter(const SweepParameter *p) {
    if (!isTitle(p->name))
        return "its name is null, empty, or has a comma, quote or line end";
    if (!(p->largest >= p->least) || !isfinite(p->largest - p->least))
        return "least and largest have to be finite, and least <= largest";
    return p->count < 1 ? "count has to be 1 or more" : NULL;
}

/* False, with the mistake as text. */
static bool isRight(const SweepScene *s, char *text, size_t size) {
    const char *mistake = mistakeInHead(s);
    if (mistake) {
        snprintf(text, size, "has a wrong scene: %s", mistake);
        return false;
    }
    for (int i = 0; i < s->parameterCount; i++)
        if ((mistake = mistakeInParameter(&s->parameter[i])) != NULL) {
            snprintf(text, size, "has a wrong parameter %d: %s", i, mistake);
            return false;
        }
    for (int i = 0; i < s->resultCount; i++)
        if (!isTitle(s->result[i])) {
            snprintf(text, size, "has a wrong result %d: its name is null, empty, or has a comma, quote or line end",
                     i);
            return false;
        }
    return true;
}

/* Null, with the mistake as text. */
static const SweepScene *load(const char *library, char *text, size_t size) {
    const SweepScene *(*find)(void);
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        const char *error = dlerror();
        snprintf(text, size, "cannot be loaded: %s%s", error,
                 strstr(error, "Precision") ? " (compile and link it with one precision: karma-mst or karma-mst-double)"
                                            : "");
        return NULL;
    }
    *(void **)&find = dlsym(handle, "sweepScene"); /* POSIX's way from a data pointer to a function's */
    if (!find) {
        snprintf(text, size, "has no function sweepScene (KarmaSweep.h)");
        return NULL;
    }
    const SweepScene *scene = find();
    return isRight(scene, text, size) ? scene : NULL;
}

/* ---- on trial ---------------------------------------------------------------------------------------------------- */

typedef struct Trial {
    bool isDone;
    char mistake[1000]; /* empty: none */
} Trial;

static void sayEnd(char *text, size_t size, int status) {
    char how[80];
    if (WIFSIGNALED(status))
        snprintf(how, sizeof how, "by signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else
        snprintf(how, sizeof how, "with exit code %d", WEXITSTATUS(status));
    snprintf(text, size,
             "cannot be loaded: that ends the process %s: the file is cut off (build it again), or its constructors, "
             "sweepScene or the "
             "tables that this returns are wrong",
             how);
}

/* Whether it can be loaded by a process that is nobody else's. */
static bool isLoadable(const char *library, char *text, size_t size) {
    Trial *trial = mmap(NULL, sizeof *trial, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    int status = 0;
    fflush(NULL);
    const pid_t process = trial == MAP_FAILED ? -1 : fork();
    if (process == 0) {
        load(library, trial->mistake, sizeof trial->mistake);
        trial->isDone = true;
        _exit(0);
    }
    if (process < 0)
        sweep_fail("no process can be started: %s: make room (ulimit -u, memory)", strerror(errno));
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        continue;
    if (trial->isDone)
        snprintf(text, size, "%s", trial->mistake);
    else
        sayEnd(text, size, status);
    munmap(trial, sizeof *trial);
    return !*text;
}

/* ---- descriptors ------------------------------------------------------------------------------------------------- */

enum { DESCRIPTORS = 1024 }; /* beyond them a scene's are closed, too */
static bool isOpen[DESCRIPTORS], isOfScene[DESCRIPTORS];

static void noteDescriptors(bool *is) {
    for (int i = 0; i < DESCRIPTORS; i++)
        is[i] = fcntl(i, F_GETFD) >= 0 && !isOpen[i];
}

void sweep_sceneCloseOthers(void) {
    unsigned int first = STDERR_FILENO + 1;
    for (unsigned int i = first; i < DESCRIPTORS; i++)
        if (isOfScene[i]) {
            if (first < i)
                close_range(first, i - 1, 0);
            first = i + 1;
        }
    close_range(first, UINT_MAX, 0);
}

/* ---- all of it --------------------------------------------------------------------------------------------------- */

SweepLoaded sweep_sceneLoad(const char *path) {
    SweepLoaded loaded = {NULL, hashOfFile(path)};
    char library[PATH_MAX], mistake[1000] = "";
    const bool isSource = findLibrary(path, library), isCompiled = !isSource || compile(path, library);
    if (!isCompiled)
        snprintf(mistake, sizeof mistake,
                 "could not be compiled: the compiler and pkg-config have to know karma-mst (PKG_CONFIG_PATH), or "
                 "KARMA_SWEEP_CC says how, with all its options");
    noteDescriptors(isOpen);
    if (isCompiled && isLoadable(library, mistake, sizeof mistake))
        loaded.scene = load(library, mistake, sizeof mistake);
    noteDescriptors(isOfScene);
    if (isSource)
        removeLibrary(library); /* it stays in memory */
    if (!loaded.scene)
        sweep_fail("%s %s", path, mistake);
    return loaded;
}
