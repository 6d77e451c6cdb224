/* The fast solver's loops, and in what order their chunks may run (kea_loops_i.h). */
#include "fast/kea_loops_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

/* One loop: over the chunks of one colour, of all, or of bodies. */
typedef struct Chunks {
    KeaLoops *loops;
    KeaChunkWork work;
    void *context;
    int first, size, end;        /* the first group or body, of a chunk at most, behind the last */
    float (*partial)[KEA_LANES]; /* of the first chunk; null: bodies */
} Chunks;

static int chunksOf(int count, int size) {
    return (count + size - 1) / size;
}

int kea_loopsPlan(KeaLoops *l) {
    l->firstChunk[0] = 0;
    for (int c = 0; c < KEA_COLOURS; c++) {
        const int groups = l->firstGroup[c + 1] - l->firstGroup[c];
        MEASSERT(groups >= 0);
        l->firstChunk[c + 1] = l->firstChunk[c] + (c == KEA_ALONE ? groups > 0 : chunksOf(groups, KEA_CHUNK));
    }
    return l->firstChunk[KEA_COLOURS];
}

static void MEAPI doChunk(void *context, int item, int worker) {
    Chunks *c = context;
    const int first = c->first + item * c->size, count = c->end - first < c->size ? c->end - first : c->size;
    (void)worker;
    if (c->partial)
        memset(c->partial[item], 0, sizeof c->partial[item]);
    c->work(c->context, first, count, c->partial ? c->partial[item] : NULL);
}

static void doColour(KeaLoops *l, int colour, KeaChunkWork work, void *context) {
    const int first = l->firstGroup[colour], end = l->firstGroup[colour + 1];
    Chunks c = {l,
                work,
                context,
                first,
                colour == KEA_ALONE ? end - first : KEA_CHUNK,
                end,
                l->partial + l->firstChunk[colour]};
    MeTeamRun(l->team, l->firstChunk[colour + 1] - l->firstChunk[colour], doChunk, &c);
}

void kea_overColours(KeaLoops *l, KeaChunkWork work, void *context, float sum[KEA_LANES]) {
    for (int colour = 0; colour < KEA_COLOURS; colour++)
        if (l->firstGroup[colour + 1] > l->firstGroup[colour])
            doColour(l, colour, work, context);
    for (int i = 0; sum && i < l->firstChunk[KEA_COLOURS]; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            sum[lane] += l->partial[i][lane];
}

/* There are at least as many chunks by colour as there are of all groups together. Returns how many these are. */
static int doGroups(KeaLoops *l, KeaChunkWork work, void *context) {
    Chunks c = {l, work, context, 0, KEA_CHUNK, l->firstGroup[KEA_COLOURS], l->partial};
    const int chunks = chunksOf(c.end, KEA_CHUNK);
    MeTeamRun(l->team, chunks, doChunk, &c);
    return chunks;
}

void kea_overGroups(KeaLoops *l, KeaChunkWork work, void *context) {
    doGroups(l, work, context);
}

void kea_mostOverGroups(KeaLoops *l, KeaChunkWork work, void *context, float most[KEA_LANES]) {
    const int chunks = doGroups(l, work, context);
    for (int i = 0; i < chunks; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            most[lane] = l->partial[i][lane] > most[lane] ? l->partial[i][lane] : most[lane];
}

void kea_overBodies(KeaLoops *l, int count, KeaChunkWork work, void *context) {
    Chunks c = {l, work, context, 0, KEA_BODY_CHUNK, count, NULL};
    MeTeamRun(l->team, chunksOf(count, KEA_BODY_CHUNK), doChunk, &c);
}
