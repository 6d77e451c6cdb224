/* Speed against error: the scenes in Karma and its peers, interleaved, as tables and as CSV.
 *
 * Built twice: as bench, where Karma's contacts are those of the scenes, so that dynamics is compared; and, with
 * BENCH_PIPELINE, as pipeline, where Karma is a universe and finds them itself: scenes without contact are left out. */
#include "timing.h"

#include "engines.h"
#include "run.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SUBSTEPS = 8, MAX_ROWS = 256, RUNS = 5 };
enum { CROWD_SUBSTEPS = 2, CROWD_SHARE = 8 }; /* numbers of sub-steps, and times as long as another scene */

typedef struct Options {
    bool quick, free;
    const char *scene, *engine; /* null: all */
    const char *csv, *markdown; /* null: none */
    const char *rows;           /* a file of rows beside those; null: none */
    int substeps[MAX_SUBSTEPS], numSubsteps;
    bool hasSubsteps;            /* as asked for */
    double budget;               /* s, asked for; 0: what --quick says */
    double total;                /* s, of all scenes; 0: as long as they take */
    double runBudget, rowBudget; /* s, of one run, and after which a row gets no further one */
} Options;

/* An engine with a setting and a number of sub-steps, and its runs of a scene. */
typedef struct Row {
    const Engine *engine;
    int setting, substeps, numRuns;
    const char *lack; /* of what the scene needs; null: nothing */
    double spent;     /* s */
    RunResult runs[RUNS];
} Row;

/* Options */

static void usage(FILE *to) {
    fputs("usage: bench [options]\n"
          "  --quick            one step a frame, fewer settings, fewer runs of slow rows, none of more than 2 s\n"
          "  --free             only scenes without contact\n"
          "  --scene NAME       only this scene (see --list)\n"
          "  --engine NAME      only engines whose names begin so\n"
          "  --peer FILE        also the engine of that shared library, see engine.h\n"
          "  --substeps N,...   steps per frame of 1/60 s, at most 8 numbers; 1,4 if not given\n"
          "  --rows FILE        and rows of that file, a line SCENE,ENGINE,SETTING,SUBSTEPS each\n"
          "  --budget S         s that a run may take before it is too slow\n"
          "  --total S          s that all may take: each scene gets its share, and a run that of its scene\n"
          "  --csv FILE         also write all figures there, a line for each run\n"
          "  --markdown FILE    also write a table of the first errors and the median times there\n"
          "  --list             name the scenes\n"
          "  --solvers          name the engines' settings, as sweep_settings.c numbers them\n",
          to);
}

static void list(void) {
    for (int i = 0; scenes[i]; i++)
        printf("%s: %s.\n", scenes[i]->name, scenes[i]->text);
}

static void listSolvers(void) {
    for (int n = 0; engines_solver(n).engine; n++) {
        const EngineSolver solver = engines_solver(n);
        printf("%d,%s,%s\n", n, solver.engine->name, solver.engine->settings[solver.setting]);
    }
}

static bool readSubsteps(Options *o, const char *text) {
    o->numSubsteps = 0;
    o->hasSubsteps = true;
    while (o->numSubsteps < MAX_SUBSTEPS) {
        char *end;
        const long n = strtol(text, &end, 10);
        if (end == text || n < 1 || n > 1000)
            return false;
        o->substeps[o->numSubsteps++] = (int)n;
        if (*end == 0)
            return true;
        if (*end != ',')
            return false;
        text = end + 1;
    }
    return false;
}

/* Takes an option and its value; says how many words it took, or 0. */
static int readOption(Options *o, const char *name, const char *value) {
    if (strcmp(name, "--quick") == 0) {
        o->quick = true;
        return 1;
    }
    if (strcmp(name, "--free") == 0) {
        o->free = true;
        return 1;
    }
    if (!value)
        return 0;
    if (strcmp(name, "--scene") == 0 && scene_find(value)) {
        o->scene = value;
        return 2;
    }
    if (strcmp(name, "--engine") == 0) {
        o->engine = value;
        return 2;
    }
    if (strcmp(name, "--peer") == 0)
        return engines_addPeer(value) ? 2 : 0;
    if (strcmp(name, "--budget") == 0 && atof(value) > 0) {
        o->budget = atof(value);
        return 2;
    }
    if (strcmp(name, "--total") == 0 && atof(value) > 0) {
        o->total = atof(value);
        return 2;
    }
    if (strcmp(name, "--csv") == 0) {
        o->csv = value;
        return 2;
    }
    if (strcmp(name, "--rows") == 0) {
        o->rows = value;
        return 2;
    }
    if (strcmp(name, "--markdown") == 0) {
        o->markdown = value;
        return 2;
    }
    return strcmp(name, "--substeps") == 0 && readSubsteps(o, value) ? 2 : 0;
}

static Options readOptions(int argc, char *argv[]) {
    Options o = {.substeps = {1, 4}, .numSubsteps = 2, .runBudget = 10, .rowBudget = 4};
    for (int i = 1; i < argc;) {
        if (strcmp(argv[i], "--help") == 0) {
            usage(stdout);
            exit(0);
        }
        if (strcmp(argv[i], "--list") == 0) {
            list();
            exit(0);
        }
        if (strcmp(argv[i], "--solvers") == 0) {
            listSolvers();
            exit(0);
        }
        const int taken = readOption(&o, argv[i], argv[i + 1]);
        if (!taken) {
            fprintf(stderr, "bench: cannot make sense of '%s %s'\n", argv[i], argv[i + 1] ? argv[i + 1] : "");
            usage(stderr);
            exit(2);
        }
        i += taken;
    }
    if (o.quick) {
        if (!o.hasSubsteps)
            o.numSubsteps = 1;
        o.runBudget = 2;
        o.rowBudget = .05;
    }
    if (o.budget > 0)
        o.runBudget = o.budget;
    return o;
}

/* Running */

static bool isWantedScene(const Options *o, const Scene *s) {
    if (o->scene && strcmp(s->name, o->scene) != 0)
        return false;
    SceneWorld world = {.numBodies = 0};
    s->build(s, &world);
#ifdef BENCH_PIPELINE
    return world.collides;
#else
    return !(o->free && world.collides);
#endif
}

/* Karma's engine of the other program is left out. */
static bool isWanted(const Options *o, const Engine *e) {
#ifdef BENCH_PIPELINE
    const bool isOther = engines_isWorld(e);
#else
    const bool isOther = engines_isUniverse(e);
#endif
    return !isOther && (!o->engine || strncmp(e->name, o->engine, strlen(o->engine)) == 0);
}

/* Frames of a published scene are longer or shorter, and it has steps of 1 ms. */
static int chooseSubsteps(const Options *o, const Scene *scene, int substeps[MAX_SUBSTEPS]) {
    if (scene->frame > 0 && !o->hasSubsteps) {
        substeps[0] = 1;
        substeps[1] = (int)lround(scene->frame / .001);
        return o->quick ? 1 : 2;
    }
    const int n =
        scene->isCrowd && !o->hasSubsteps && o->numSubsteps > CROWD_SUBSTEPS ? CROWD_SUBSTEPS : o->numSubsteps;
    memcpy(substeps, o->substeps, (size_t)n * sizeof *substeps);
    return n;
}

static bool isSettingWanted(const Options *o, const Scene *scene, const Engine *e, int setting) {
    return !(scene->isCrowd || o->quick) || !e->crowds || (e->crowds & 1u << setting);
}

static bool hasRow(const Row rows[], int n, const Row *r) {
    for (int i = 0; i < n; i++)
        if (rows[i].engine == r->engine && rows[i].setting == r->setting && rows[i].substeps == r->substeps)
            return true;
    return false;
}

/* The solver of these names, if the program has it. */
static EngineSolver findSolver(const Options *o, const char *engine, const char *setting) {
    EngineSolver solver;
    for (int n = 0; (solver = engines_solver(n)).engine; n++)
        if (isWanted(o, solver.engine) && strcmp(solver.engine->name, engine) == 0 &&
            strcmp(solver.engine->settings[solver.setting], setting) == 0)
            break;
    return solver;
}

/* The rows of --rows that are not there yet. Returns how many rows there are then. */
static int addRows(const Options *o, const Scene *scene, Row rows[MAX_ROWS], int n) {
    char name[64], engine[64], setting[64];
    int substeps;
    FILE *file = fopen(o->rows, "r");
    if (!file) {
        fprintf(stderr, "bench: cannot read %s\n", o->rows);
        exit(1);
    }
    while (n < MAX_ROWS && fscanf(file, " %63[^,],%63[^,],%63[^,],%d", name, engine, setting, &substeps) == 4) {
        const EngineSolver solver = findSolver(o, engine, setting);
        const Row row = {.engine = solver.engine, .setting = solver.setting, .substeps = substeps};
        if (strcmp(name, scene->name) != 0 || !solver.engine || hasRow(rows, n, &row))
            continue;
        rows[n] = row;
        rows[n++].lack = run_lack(scene, solver.engine, solver.setting);
    }
    fclose(file);
    return n;
}

/* Those with few sub-steps come first: they shall not lack time. */
static int makeRows(const Options *o, const Scene *scene, Row rows[MAX_ROWS]) {
    int n = 0, substeps[MAX_SUBSTEPS];
    const int numSubsteps = chooseSubsteps(o, scene, substeps);
    for (int k = 0; k < numSubsteps; k++)
        for (int e = 0; engines[e]; e++)
            for (int s = 0; engines[e]->settings[s] && n < MAX_ROWS; s++)
                if (isWanted(o, engines[e]) && isSettingWanted(o, scene, engines[e], s))
                    rows[n++] = (Row){.engine = engines[e],
                                      .setting = s,
                                      .substeps = substeps[k],
                                      .lack = run_lack(scene, engines[e], s)};
    return o->rows ? addRows(o, scene, rows, n) : n;
}

/* Whether a row has one more run. What a first run may take is its share of what is left; others are as long as it. */
static bool runsOnce(const Options *o, const Row *r, int run, double left, double *budget) {
    if (r->lack)
        return false;
    *budget = run == 0 && left < o->runBudget ? fmax(left, 0) : o->runBudget;
    return run == 0 || (r->spent <= o->rowBudget && r->spent / run < left);
}

/* The rows take turns, so that what else the machine does meets all of them. */
static void runRows(const Options *o, const Scene *scene, Row rows[], int n, double seconds) {
    const double end = now() + seconds;
    for (int run = 0; run < RUNS; run++)
        for (int i = 0; i < n; i++) {
            Row *r = &rows[i];
            double budget;
            const double left = end - now();
            if (!runsOnce(o, r, run, run == 0 ? left / (n - i) : left, &budget))
                continue;
            RunResult *result = &r->runs[r->numRuns++];
            *result = run_scene(scene, r->engine, r->setting, r->substeps, budget);
            r->spent += 1e-6 * result->median * result->simulated / scene_frame(scene);
        }
}

static double medianOf(const Row *r, size_t offset) {
    double values[RUNS];
    for (int i = 0; i < r->numRuns; i++)
        memcpy(&values[i], (const char *)&r->runs[i] + offset, sizeof values[i]);
    return r->numRuns ? median(values, r->numRuns) : 0;
}

/* What the runs agree in is taken from the first. */
static RunResult resultOf(const Row *r) {
    RunResult result = r->runs[0];
    result.median = medianOf(r, offsetof(RunResult, median));
    result.worst = medianOf(r, offsetof(RunResult, worst));
    return result;
}

/* Printing */

/* Broken into lines of at most 118 characters. */
static void printText(const char *text) {
    int column = 0;
    while (*text) {
        const int word = (int)strcspn(text, " ");
        if (column + 1 + word > 118)
            column = 0;
        column += printf("%s%.*s", column ? " " : "\n", word, text) - (column ? 0 : 1);
        text += word + (text[word] == ' ');
    }
    putchar('\n');
}

static void printHead(const Scene *s) {
    char text[1024];
    snprintf(text, sizeof text, "%s: %s", s->name, s->text);
    printText(text);
    printf("%-14s%-10s%4s", "engine", "setting", "sub");
    for (int k = 0; k < SCENE_MAX_ERRORS; k++)
        printf("%15s", s->errors[k].name ? s->errors[k].name : "");
    printf("%12s%12s\n", "median us", "worst us");
}

static void printGoals(const Scene *s) {
    printf("%-28s", "goal");
    for (int k = 0; k < SCENE_MAX_ERRORS && s->errors[k].name; k++)
        printf("%15.2g", s->errors[k].goal);
    putchar('\n');
}

static void printErrors(const Scene *s, const RunResult *result) {
    char text[32];
    for (int k = 0; k < SCENE_MAX_ERRORS; k++) {
        if (!s->errors[k].name)
            snprintf(text, sizeof text, "%s", "");
        else if (result->outcome == RUN_HOLDS && isfinite(result->errors[k]))
            snprintf(text, sizeof text, "%.2g", result->errors[k]);
        else if (result->outcome == RUN_HOLDS)
            snprintf(text, sizeof text, "%s", "none");
        else if (k == 0)
            snprintf(text, sizeof text, "%s %.3g s", result->outcome == RUN_FAILS ? "fails" : "too slow",
                     result->simulated);
        else
            snprintf(text, sizeof text, "%s", "");
        printf("%15s", text);
    }
}

static void printRow(const Scene *s, const Row *r) {
    printf("%-14s%-10s%4d", r->engine->name, r->engine->settings[r->setting], r->substeps);
    if (r->numRuns == 0) {
        printf("%15s %s\n", "-", r->lack);
        return;
    }
    const RunResult result = resultOf(r);
    printErrors(s, &result);
    printf("%12.1f%12.1f\n", result.median, result.worst);
}

static void writeRun(FILE *csv, const Scene *s, const Row *r, int run) {
    static const char *const outcomes[] = {"holds", "fails", "too slow"};
    const RunResult *result = &r->runs[run];
    fprintf(csv, "%s,%s,%s,%d,%d,%s,%g,%.4g,%.4g,%.4g,%.4g,%.4g", s->name, r->engine->name,
            r->engine->settings[r->setting], r->substeps, run, outcomes[result->outcome], result->simulated,
            result->median, result->p95, result->p99, result->worst, result->cpu);
    for (int k = 0; k < SCENE_MAX_ERRORS; k++)
        if (s->errors[k].name)
            fprintf(csv, ",%s,%g,%.6g", s->errors[k].name, s->errors[k].goal, result->errors[k]);
        else
            fputs(",,,", csv);
    fputs(",\n", csv);
}

/* What an engine has nothing for is a line without run. */
static void writeRow(FILE *csv, const Scene *s, const Row *r) {
    if (r->numRuns == 0)
        fprintf(csv, "%s,%s,%s,%d,,impossible,,,,,,,,,,,,,,,,%s\n", s->name, r->engine->name,
                r->engine->settings[r->setting], r->substeps, r->lack);
    for (int i = 0; i < r->numRuns; i++)
        writeRun(csv, s, r, i);
}

/* Columns are engines and settings, lines are scenes and sub-steps. */
static void writeMarkdownHead(FILE *markdown, const Options *o) {
    int columns = 2;
    fputs("| scene | sub |", markdown);
    for (int e = 0; engines[e]; e++)
        for (int k = 0; engines[e]->settings[k] && isWanted(o, engines[e]); k++, columns++)
            fprintf(markdown, " %s %s |", engines[e]->name, engines[e]->settings[k]);
    fputs("\n|", markdown);
    for (int i = 0; i < columns; i++)
        fputs("---|", markdown);
    fputc('\n', markdown);
}

/* Microseconds; tenths of them where there are few. */
static void writeTime(FILE *markdown, double us) {
    fprintf(markdown, us < 10 ? "%.1f |" : "%.0f |", us);
}

static void writeMarkdownCell(FILE *markdown, const Row *r) {
    if (r->numRuns == 0) {
        fputs(" - |", markdown);
        return;
    }
    const RunResult result = resultOf(r);
    if (result.outcome == RUN_HOLDS)
        fprintf(markdown, " %.2g, ", result.errors[0]);
    else
        fprintf(markdown, " %s, ", result.outcome == RUN_FAILS ? "fails" : "too slow");
    writeTime(markdown, result.median);
}

static void writeMarkdown(FILE *markdown, const Options *o, const Scene *s, const Row rows[], int n) {
    int substeps[MAX_SUBSTEPS];
    const int numSubsteps = chooseSubsteps(o, s, substeps);
    for (int k = 0; k < numSubsteps; k++) {
        fprintf(markdown, "| %s | %d |", s->name, substeps[k]);
        for (int i = 0; i < n; i++)
            if (rows[i].substeps == substeps[k])
                writeMarkdownCell(markdown, &rows[i]);
        fputc('\n', markdown);
    }
}

static void benchScene(const Options *o, const Scene *s, double seconds, FILE *csv, FILE *markdown) {
    Row rows[MAX_ROWS];
    const int n = makeRows(o, s, rows);
    runRows(o, s, rows, n, seconds);
    printHead(s);
    printGoals(s);
    for (int i = 0; i < n; i++) {
        printRow(s, &rows[i]);
        if (csv)
            writeRow(csv, s, &rows[i]);
    }
    if (markdown)
        writeMarkdown(markdown, o, s, rows, n);
    fflush(stdout);
}

static void printLegend(const Options *o) {
    puts("Times are of a frame of 1/60 s, sub-steps and contacts included: medians over runs of the median and of the\n"
         "worst frame. '-': the engine has nothing for it; 'fails T': broke, fell or gave up after T simulated "
         "seconds;\n"
         "'too slow T': no time was left after T; 'none': what was to be measured did not happen; sub: steps per "
         "frame;\n"
         "goal: what Karma is to reach with one step per frame.");
    for (int e = 0; engines[e]; e++)
        if (isWanted(o, engines[e]))
            printf("* %s %s: %s.\n", engines[e]->name, engines[e]->version, engines[e]->about);
    for (int i = 0; engines_absent[i]; i++)
        printf("* %s\n", engines_absent[i]);
}

/* Null where none is wanted. */
static FILE *openFile(const char *name, const char *head) {
    FILE *file = name ? fopen(name, "w") : NULL;
    if (name && !file) {
        fprintf(stderr, "bench: cannot write %s\n", name);
        exit(1);
    }
    if (file)
        fputs(head, file);
    return file;
}

static void closeFile(FILE *file) {
    if (file)
        fclose(file);
}

static int shareOf(const Scene *s) {
    return s->isCrowd ? CROWD_SHARE : 1;
}

static int countShares(const Options *o) {
    int n = 0;
    for (int i = 0; scenes[i]; i++)
        n += isWantedScene(o, scenes[i]) ? shareOf(scenes[i]) : 0;
    return n;
}

/* The rest takes as long a share as those that are done, if it is known yet, and no longer than is allowed. */
static void tellProgress(const Options *o, const Scene *s, int done, int shares, double spent) {
    const double left = done ? spent / done * (shares - done) : 0, max = o->total > 0 ? o->total - spent : INFINITY;
    fprintf(stderr, "%d %%, %s", 100 * done / shares, s->name);
    if (done)
        fprintf(stderr, ", about %.0f s left", fmax(fmin(left, max), 0));
    fputc('\n', stderr);
}

/* s, that the scene may take: its share of what is left. */
static double secondsOf(const Options *o, const Scene *s, int sharesLeft, double spent) {
    return o->total > 0 ? fmax(o->total - spent, 0) * shareOf(s) / sharesLeft : INFINITY;
}

int main(int argc, char *argv[]) {
    const Options o = readOptions(argc, argv);
    FILE *csv =
        openFile(o.csv, "scene,engine,setting,substeps,run,outcome,simulated s,median us,p95 us,p99 us,worst us,"
                        "cpu s/s,error,goal,value,error 2,goal 2,value 2,error 3,goal 3,value 3,lack\n");
    FILE *markdown = openFile(o.markdown, "");
    if (markdown)
        writeMarkdownHead(markdown, &o);
    printLegend(&o);
    const double start = now();
    const int shares = countShares(&o);
    for (int i = 0, done = 0; scenes[i]; i++)
        if (isWantedScene(&o, scenes[i])) {
            tellProgress(&o, scenes[i], done, shares, now() - start);
            benchScene(&o, scenes[i], secondsOf(&o, scenes[i], shares - done, now() - start), csv, markdown);
            done += shareOf(scenes[i]);
        }
    closeFile(csv);
    closeFile(markdown);
    return 0;
}
