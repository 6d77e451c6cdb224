/* tic: a stopwatch of consecutive sections. */
#include "MeProfile_i.h"

static MeSection *ticRoot;    /* null when off */
static MeSection *ticCurrent; /* null between sections */

void MEAPI ticCleanup(void) {
    me_sectionDestroy(ticRoot);
    ticRoot = ticCurrent = NULL;
}

void MEAPI ticInit(void) {
    ticCleanup();
    ticRoot = me_sectionCreate(NULL, "");
}

void MEAPI tic(const char *name) {
    if (ticRoot == NULL)
        return;
    const uint64_t now = me_now();
    if (ticCurrent != NULL)
        ticCurrent->total.time += now - ticCurrent->start;
    ticCurrent = name != NULL ? me_sectionChild(ticRoot, name) : NULL;
    if (ticCurrent != NULL) {
        ticCurrent->start = now;
        ticCurrent->total.calls++;
    }
}

void MEAPI ticOutputResults(const char *filename) {
    if (ticRoot == NULL)
        return;
    FILE *const file = me_openReport(filename, "ticOutputResults");
    if (file == NULL)
        return;
    for (const MeSection *s = ticRoot->firstChild; s != NULL; s = s->next)
        fprintf(file, "%-36s %12d %12.4f ms\n", s->name, s->total.calls, me_milliseconds(s->total.time));
    me_closeReport(file);
}
