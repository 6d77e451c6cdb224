/* The scene: a shared library with the function sweepScene, or a C file that is compiled to one. */
#define _DEFAULT_SOURCE /* mkdtemp */
#include "sweep_i.h"
#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static uint64_t hashOfFile(const char *path) {
    unsigned char block[65536];
    uint64_t hash = SWEEP_HASH;
    FILE *file = fopen(path, "rb");
    if (!file)
        sweep_fail("%s cannot be read", path);
    for (size_t size; (size = fread(block, 1, sizeof block, file)) > 0;)
        hash = sweep_hash(hash, block, size);
    fclose(file);
    return hash;
}

/* ---- compiling --------------------------------------------------------------------------------------------------- */

/* By the shell, as the flags are words of it: $KARMA_SWEEP_CC, or the compiler with the installed Karma, of single
 * precision, else of double. */
static void compile(const char *source, const char *library) {
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
    if (compiler < 0 || waitpid(compiler, &status, 0) != compiler || status != 0)
        sweep_fail("%s could not be compiled: the compiler and pkg-config have to know karma-mst (PKG_CONFIG_PATH), or "
                   "KARMA_SWEEP_CC says how, with all its options",
                   source);
}

/* Loads it from a directory that is gone then: the library stays in memory. */
static void *loadSource(const char *source) {
    char directory[] = "/tmp/karma-sweep-XXXXXX", library[64];
    if (!mkdtemp(directory))
        sweep_fail("there can be no directory in /tmp");
    snprintf(library, sizeof library, "%s/scene.so", directory);
    compile(source, library);
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    unlink(library);
    rmdir(directory);
    return handle;
}

/* ---- loading ----------------------------------------------------------------------------------------------------- */

static void *load(const char *path) {
    char full[4096];
    const size_t length = strlen(path);
    if (length > 2 && strcmp(path + length - 2, ".c") == 0)
        return loadSource(path);
    /* Without a slash it would be looked for where the system has its libraries. */
    snprintf(full, sizeof full, "%s%s", strchr(path, '/') ? "" : "./", path);
    return dlopen(full, RTLD_NOW | RTLD_LOCAL);
}

static bool isTitle(const char *text) {
    return text && *text && !strpbrk(text, ",\"\r\n");
}

static const char *mistakeIn(const SweepScene *s) {
    if (!s || s->version != SWEEP_VERSION)
        return "it was made for another version of KarmaSweep.h";
    if (!s->run || !isTitle(s->name) || s->parameterCount < 0 || s->parameterCount > SWEEP_PARAMETERS ||
        s->resultCount < 1 || s->resultCount > SWEEP_RESULTS)
        return "name, run, or the number of parameters or results is wrong";
    for (int i = 0; i < s->parameterCount; i++) {
        const SweepParameter *p = &s->parameter[i];
        if (!isTitle(p->name) || !isfinite(p->least) || !isfinite(p->largest) || p->largest < p->least || p->count < 1)
            return "a parameter has no name, range or count";
    }
    for (int i = 0; i < s->resultCount; i++)
        if (!isTitle(s->result[i]))
            return "a result has no name";
    return NULL;
}

SweepLoaded sweep_sceneLoad(const char *path) {
    SweepLoaded loaded = {NULL, hashOfFile(path)};
    void *library = load(path);
    if (!library)
        sweep_fail("%s cannot be loaded: %s", path, dlerror());
    const SweepScene *(*find)(void);
    *(void **)&find = dlsym(library, "sweepScene"); /* POSIX's way from a data pointer to a function's */
    if (!find)
        sweep_fail("%s has no function sweepScene (KarmaSweep.h)", path);
    loaded.scene = find();
    const char *mistake = mistakeIn(loaded.scene);
    if (mistake)
        sweep_fail("%s: %s", path, mistake);
    return loaded;
}
