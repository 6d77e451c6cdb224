/* Options that nobody knows: one message that names the option and what to write instead, and the program's end. */
#include "r_i.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The options of the viewer that programs may mean, as RDisplayCommandLineHelp has them. */
static const char *const names[] = {"-gl",      "-osmesa", "-null",    "-bench", "-d3d",        "-size",
                                    "-camera",  "-frames", "-paused",  "-key",   "-screenshot", "-every",
                                    "-film",    "-bar",    "-profile", "-help",  "-quality",    "-rate",
                                    "-workers", "-scale",  "-ground",  "-advise"};
enum { NAMES = sizeof names / sizeof names[0], LONGEST = 31 };

static int min(int a, int b) {
    return a < b ? a : b;
}

/* The edit distance of two words (Levenshtein, 1965), row by row. */
static int distance(const char *a, const char *b) {
    int row[LONGEST + 2];
    const int length = (int)strlen(b);
    for (int j = 0; j <= length; j++)
        row[j] = j;
    for (int i = 1; a[i - 1]; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= length; j++) {
            const int above = row[j];
            row[j] = min(min(above, row[j - 1]) + 1, diagonal + (a[i - 1] != b[j - 1]));
            diagonal = above;
        }
    }
    return row[length];
}

/* The option that a word most likely means, or null: two letters wrong at most, and fewer than half of them. */
static const char *closest(const char *word) {
    const char *best = NULL;
    int fewest = min(2, (int)strlen(word) / 2) + 1;
    for (int i = 0; i < NAMES; i++) {
        const int wrong = distance(word, names[i]);
        if (wrong < fewest) {
            best = names[i];
            fewest = wrong;
        }
    }
    return best;
}

/* The first word that is left; what follows it may be its value, of which nothing is to be said. */
static void printRefusal(const char *left) {
    char word[LONGEST + 1];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(left, "="), left);
    const char *like = closest(word);
    if (left[0] != '-')
        MeWarning(1, "%s belongs to no option: options begin with a dash, and -help lists them", left);
    else if (like && strcmp(like, word) == 0)
        MeWarning(1, "%s is given more than once: write it once", like);
    else if (like)
        MeWarning(1, "%s is no option: write %s (-help lists all)", word, like);
    else
        MeWarning(1, "%s is no option: -help lists all", word);
}

bool r_refuseOthers(const MeCommandLineOptions *options) {
    if (!options || options->argc < 2)
        return false;
    printRefusal(options->argv[1]);
    return true;
}

void MEAPI RRenderRefuseOptions(RRender *rc, MeCommandLineOptions *options) {
    if (!rc)
        return;
    if (!r_isContext(rc, __func__) || (!rc->m_pViewer->isMistaken && !r_refuseOthers(options)))
        return;
    RRenderContextDestroy(rc);
    MeCommandLineOptionsDestroy(options);
    exit(2);
}
