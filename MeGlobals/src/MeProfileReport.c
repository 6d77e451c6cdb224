/* Printing of the profile's results. */
#include "MeProfile_i.h"

#include "MeAssert.h"
#include "MeMath.h"
#include "MeMessage.h"

#define NAME_WIDTH 36

static MeProfileOutput output = {kMeProfileOutputNormal, NULL};

FILE *me_openReport(const char *filename, const char *function) {
    if (filename == NULL)
        return stdout;
    FILE *const file = fopen(filename, "w");
    if (file == NULL)
        MeWarning(1, "%s: cannot write the file '%s'", function, filename);
    return file;
}

void me_closeReport(FILE *file) {
    if (file != stdout)
        fclose(file);
}

double me_milliseconds(uint64_t nanoseconds) {
    return (double)nanoseconds / 1e6;
}

static void printName(FILE *file, const MeSection *s) {
    MEASSERT(s->depth >= 1);
    const int indent = 2 * (s->depth - 1);
    fprintf(file, "%*s%-*s", indent, "", MeMAX(NAME_WIDTH - indent, 0), s->name);
}

static double perFrame(double sum) {
    return me_profile.frames > 0 ? sum / me_profile.frames : 0;
}

static void printAverages(FILE *file) {
    fprintf(file, "%-*s %12s %12s %12s\n", NAME_WIDTH, "section", "calls/frame", "ms/frame", "worst ms");
    for (MeSection *s = me_sectionNext(me_profile.root); s != NULL; s = me_sectionNext(s)) {
        printName(file, s);
        fprintf(file, " %12.2f %12.4f %12.4f\n", perFrame(s->allFrames.calls),
                perFrame(me_milliseconds(s->allFrames.time)), me_milliseconds(s->worstFrame));
    }
}

static void printTotals(FILE *file) {
    fprintf(file, "%-*s %12s %12s %12s %12s\n", NAME_WIDTH, "section", "calls", "total ms", "ms/frame", "worst ms");
    for (MeSection *s = me_sectionNext(me_profile.root); s != NULL; s = me_sectionNext(s)) {
        printName(file, s);
        fprintf(file, " %12d %12.4f %12.4f %12.4f\n", s->total.calls, me_milliseconds(s->total.time),
                perFrame(me_milliseconds(s->allFrames.time)), me_milliseconds(s->worstFrame));
    }
}

static void printEvents(FILE *file) {
    fprintf(file, "%8s %12s %12s  %s\n", "frame", "begin ms", "ms", "section");
    MEASSERT(me_profile.numEvents <= me_profile.maxEvents);
    for (int i = 0; i < me_profile.numEvents; i++) {
        const MeEvent *const e = &me_profile.events[i];
        fprintf(file, "%8d %12.4f %12.4f  %*s%s\n", e->frame, me_milliseconds(e->start), me_milliseconds(e->duration),
                2 * (e->section->depth - 1), "", e->section->name);
    }
}

/* Sums the events of a frame by section, starting at the event `first`; returns the first event of a later frame. */
static int sumUpFrame(int frame, int first) {
    for (MeSection *s = me_profile.root; s != NULL; s = me_sectionNext(s))
        s->reported = 0;
    int i = first;
    for (; i < me_profile.numEvents && me_profile.events[i].frame <= frame; i++) {
        const MeEvent *const e = &me_profile.events[i];
        if (e->frame == frame)
            e->section->reported += e->duration;
    }
    return i;
}

static void printFrames(FILE *file) {
    fprintf(file, "# frame");
    for (MeSection *s = me_sectionNext(me_profile.root); s != NULL; s = me_sectionNext(s))
        fprintf(file, ", %s", s->name);
    fputc('\n', file);
    int next = 0;
    for (int frame = 1; frame <= me_profile.frames && next < me_profile.numEvents; frame++) {
        next = sumUpFrame(frame, next);
        fprintf(file, "%d", frame);
        for (MeSection *s = me_sectionNext(me_profile.root); s != NULL; s = me_sectionNext(s))
            fprintf(file, " %.4f", me_milliseconds(s->reported));
        fputc('\n', file);
    }
}

/* The formats, in the order of MeProfileOutput_enum. */
static const struct {
    void (*print)(FILE *file);
    MeBool needsEvents;
} formats[] = {{printAverages, MEFALSE}, {printEvents, METRUE}, {printTotals, MEFALSE}, {printFrames, METRUE}};

void MEAPI MeProfileSetOutputParameters(MeProfileOutput parameters) {
    if ((unsigned int)parameters.format >= sizeof formats / sizeof formats[0])
        MeWarning(1, "MeProfileSetOutputParameters: %d is not a format", (int)parameters.format);
    else
        output = parameters;
}

void MEAPI MeProfileOutputResults(void) {
    const char *const function = "MeProfileOutputResults";
    if (me_profile.root == NULL || me_profile.logging == kMeProfileDontLog) {
        MeWarning(1, "%s: nothing has been logged, see MeProfileStartTiming", function);
        return;
    }
    if (formats[output.format].needsEvents && me_profile.maxEvents == 0) {
        MeWarning(1, "%s: this format needs a section timed with kMeProfileLogAll", function);
        return;
    }
    FILE *const file = me_openReport(output.filename, function);
    if (file == NULL)
        return;
    formats[output.format].print(file);
    me_closeReport(file);
}
