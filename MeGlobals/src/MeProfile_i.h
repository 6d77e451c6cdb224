/* How the profile is stored: a tree of sections and a log of calls. */
#ifndef MEPROFILE_I_H
#define MEPROFILE_I_H

#include "MeProfile.h"
#include <stdint.h>
#include <stdio.h>

typedef struct {
    int calls;
    uint64_t time; /* nanoseconds */
} MeTally;

/* A section at one place in the tree. */
typedef struct MeSection {
    struct MeSection *parent, *firstChild, *lastChild, *next;
    int depth;          /* 0 for the root, which is no section itself */
    MeBool isRecursive; /* it is inside one of the same name, whose time contains its own */
    MeBool isAutoStop;  /* the call in progress was begun so */
    uint64_t start;     /* since when the time of the call in progress has not been counted */
    MeTally thisFrame, lastFrame, allFrames, total;
    uint64_t worstFrame;
    uint64_t reported; /* for the report of a frame that is being made */
    char name[];
} MeSection;

/* A call, or the part of one on one side of a frame's end. */
typedef struct {
    MeSection *section;
    uint64_t start, duration; /* nanoseconds */
    int frame;                /* from 1; 0 outside of frames */
} MeEvent;

typedef struct {
    MeProfileLogModes_enum logging;
    uint64_t start;     /* when timing started */
    MeSection *root;    /* null when there are no results */
    MeSection *current; /* the innermost section in progress, or the root */
    int frames;         /* finished */
    MeBool isInFrame;
    MeBool hasWarned; /* of a mismatched end */
    MeEvent *events;
    int numEvents, maxEvents;
} MeProfileState;

extern MeProfileState me_profile;

uint64_t me_now(void);

/* A new last child of the parent, or a root if that is null; null if out of memory. */
MeSection *me_sectionCreate(MeSection *parent, const char *name);
/* The child of that name, created if need be; null if out of memory. */
MeSection *me_sectionChild(MeSection *parent, const char *name);
/* With all that is in it. Null is allowed. */
void me_sectionDestroy(MeSection *section);
/* The next of a tree, each before what is in it; null after the last. */
MeSection *me_sectionNext(MeSection *section);

/* stdout for null; null, with a warning that names the function, if the file cannot be written. */
FILE *me_openReport(const char *filename, const char *function);
void me_closeReport(FILE *file);
double me_milliseconds(uint64_t nanoseconds);

#endif
