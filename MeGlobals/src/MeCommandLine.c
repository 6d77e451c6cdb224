/* Command line options: one block of memory has the struct, the pointers to the remaining words, and all words. */
#include "MeCommandLine.h"

#include "MeAssert.h"
#include "MeMath.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

static int countWords(int argc, const char **argv) {
    int n = 0;
    while (n < argc && argv != NULL && argv[n] != NULL)
        n++;
    return n;
}

MeCommandLineOptions *MEAPI MeCommandLineOptionsCreate(const int argc, const char **argv) {
    static const char *unnamed[] = {""};
    const int given = countWords(argc, argv), count = MeMAX(given, 1);
    const char **const words = given > 0 ? argv : unnamed;

    const size_t pointers = ((size_t)count + 1) * sizeof(char *);
    size_t bytes = sizeof(MeCommandLineOptions) + pointers;
    for (int i = 0; i < count; i++)
        bytes += strlen(words[i]) + 1;
    MeCommandLineOptions *const options = MeMemoryTake(bytes, 1, "MeCommandLineOptionsCreate", "the options");
    if (options == NULL)
        return NULL;

    options->argc = count;
    options->argv = (char **)(options + 1);
    options->argv[count] = NULL;
    char *text = (char *)options->argv + pointers;
    for (int i = 0; i < count; i++) {
        const size_t length = strlen(words[i]) + 1;
        options->argv[i] = memcpy(text, words[i], length);
        text += length;
    }
    return options;
}

void MEAPI MeCommandLineOptionsDestroy(MeCommandLineOptions *options) {
    MeMemoryGive(options);
}

/* ---- finding ---- */

/* The rest of a word after an option's name: "" for "-name", "=value" for "-name=value", null for another word. */
static char *restOfOption(char *word, const char *name) {
    const size_t length = strlen(name);
    if (strncmp(word, name, length) != 0)
        return NULL;
    char *const rest = word + length;
    return *rest == 0 || *rest == '=' ? rest : NULL;
}

int MEAPI MeCommandLineOptionsGetPos(MeCommandLineOptions *options, const char *arg) {
    if (options == NULL || arg == NULL)
        return 0;
    for (int i = 1; i < options->argc; i++) {
        if (restOfOption(options->argv[i], arg) != NULL)
            return i;
    }
    return 0;
}

MeBool MEAPI MeCommandLineOptionsCheckFor(MeCommandLineOptions *options, const char *arg, const MeBool eat) {
    const int pos = MeCommandLineOptionsGetPos(options, arg);
    if (pos == 0)
        return MEFALSE;
    if (eat)
        MeCommandLineOptionsEat(options, &pos, 1);
    return METRUE;
}

MeBool MEAPI MeCommandLineOptionsCheckForList(MeCommandLineOptions *options, const char *arglist[], const MeBool eat) {
    MeBool found = MEFALSE;
    for (int i = 0; arglist != NULL && arglist[i] != NULL; i++) {
        if (MeCommandLineOptionsCheckFor(options, arglist[i], eat))
            found = METRUE;
    }
    return found;
}

void MEAPI MeCommandLineOptionsEat(MeCommandLineOptions *options, const int *eat, const int num_eat) {
    if (options == NULL)
        return;
    for (int i = 0; i < num_eat; i++) {
        if (eat[i] < 1 || eat[i] >= options->argc)
            MeWarning(1, "MeCommandLineOptionsEat: no option at %d of %d", eat[i], options->argc);
        else
            options->argv[eat[i]] = NULL;
    }
    int kept = 0;
    for (int i = 0; i < options->argc; i++) {
        if (options->argv[i] != NULL)
            options->argv[kept++] = options->argv[i];
    }
    MEASSERT(kept >= 1 && kept <= options->argc); /* the program's name is never removed */
    options->argc = kept;
    options->argv[kept] = NULL;
}

/* ---- values ---- */

static MeBool readFloat(const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    return end != text && *end == 0 && isfinite(*value);
}

static MeBool readInt(const char *text, int *value) {
    char *end;
    errno = 0;
    const long read = strtol(text, &end, 10);
    *value = (int)read;
    return end != text && *end == 0 && errno == 0 && read >= INT_MIN && read <= INT_MAX;
}

static MeBool looksLikeOption(const char *word) {
    double number;
    return word[0] == '-' && !readFloat(word, &number);
}

/* The value of an option, null if the option is missing; null with a warning if only the value is. */
static char *findValue(MeCommandLineOptions *options, const char *arg, MeBool eat, const char *function) {
    const int pos = MeCommandLineOptionsGetPos(options, arg);
    const int places[2] = {pos, pos + 1};
    if (pos == 0)
        return NULL;
    char *const rest = restOfOption(options->argv[pos], arg);
    char *const next = options->argv[pos + 1];
    MEASSERT(rest != NULL && options->argv[options->argc] == NULL);
    char *value = NULL;
    if (*rest == '=')
        value = rest + 1;
    else if (next != NULL && !looksLikeOption(next))
        value = next;
    else
        MeWarning(1, "%s: option %s has no value: write %s VALUE", function, arg, arg);
    if (eat)
        MeCommandLineOptionsEat(options, places, value != NULL && value == next ? 2 : 1);
    return value;
}

int MEAPI MeCommandLineOptionsGetNumeric(MeCommandLineOptions *options, const char *arg, const MeBool eat) {
    int number = 0;
    const char *const value = findValue(options, arg, eat, "MeCommandLineOptionsGetNumeric");
    if (value == NULL || readInt(value, &number))
        return number;
    MeWarning(1, "MeCommandLineOptionsGetNumeric: option %s has '%s', expected a whole number", arg, value);
    return 0;
}

double MEAPI MeCommandLineOptionsGetFloat(MeCommandLineOptions *options, const char *arg, const MeBool eat) {
    double number = 0;
    const char *const value = findValue(options, arg, eat, "MeCommandLineOptionsGetFloat");
    if (value == NULL || readFloat(value, &number))
        return number;
    MeWarning(1, "MeCommandLineOptionsGetFloat: option %s has '%s', expected a number", arg, value);
    return 0;
}

char *MEAPI MeCommandLineOptionsGetString(MeCommandLineOptions *options, const char *arg, const MeBool eat) {
    return findValue(options, arg, eat, "MeCommandLineOptionsGetString");
}
