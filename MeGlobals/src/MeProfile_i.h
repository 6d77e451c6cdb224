/* Data of the profile: a tree of sections and a log of calls. */
#ifndef MEPROFILE_I_H
#define MEPROFILE_I_H

#include "MeProfile.h"
#include <stdint.h>
#include <stdio.h>

typedef struct {
    int calls;
    uint64_t time; /* nanoseconds */
} MeTally;

/* A section in the tree. */
typedef struct MeSection {
    struct MeSection *parent, *firstChild, *lastChild, *next;
    int depth;          /* 0 for the root, which is not a section */
    MeBool isRecursive; /* inside a section of the same name, whose time includes its own */
    MeBool isAutoStop;  /* the call in progress was begun with autoStop */
    uint64_t start;     /* begin of the time not counted yet, of the call in progress */
    MeTally thisFrame, lastFrame, allFrames, total;
    uint64_t worstFrame;
    uint64_t reported; /* temporary sum of a frame's report */
    char name[];
} MeSection;

/* A call, or its part inside one frame. */
typedef struct {
    MeSection *section;
    uint64_t start, duration; /* nanoseconds */
    int frame;                /* number from 1; 0 outside of frames */
} MeEvent;

typedef struct {
    MeProfileLogModes_enum logging;
    uint64_t start;     /* begin of timing */
    MeSection *root;    /* null when there are no results */
    MeSection *current; /* the innermost section in progress, or the root */
    int frames;         /* finished */
    MeBool isInFrame;
    MeBool hasWarned; /* about an unmatched end */
    MeEvent *events;
    int numEvents, maxEvents;
} MeProfileState;

extern MeProfileState me_profile;

uint64_t me_now(void);

/* Creates a section as the last child of the parent, or the root if that is null; null if out of memory. */
MeSection *me_sectionCreate(MeSection *parent, const char *name);
/* The child of that name, created if needed; null if out of memory. */
MeSection *me_sectionChild(MeSection *parent, const char *name);
/* Destroys a section with all inner ones. Null is allowed. */
void me_sectionDestroy(MeSection *section);
/* The next section in pre-order; null after the last. */
MeSection *me_sectionNext(MeSection *section);

/* Opens a file for writing, stdout for null; returns null, with a warning that names the function, on failure. */
FILE *me_openReport(const char *filename, const char *function);
void me_closeReport(FILE *file);
double me_milliseconds(uint64_t nanoseconds);

#endif
