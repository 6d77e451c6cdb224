/* The structure of a sparse factor (kea_structure_i.h): columns in the order of elimination, their rows, and the
 * columns that update each of them. It is computed from the graph and its order of elimination, in time proportional to
 * its size. */
#include "inner/kea_structure_i.h"
#include "MeAssert.h"
#include <string.h>

/* ---- memory ---- */

size_t kea_structureLayOut(KeaFactor *f, char *memory) {
    const size_t n = (size_t)f->numNodes, m = (size_t)f->numEdges, k = (size_t)f->numEntries;
    KeaArena a = {memory, 0};
    KEA_CARVE(&a, f->size, n);
    KEA_CARVE(&a, f->edges, m);
    KEA_CARVE(&a, f->offset, n + 1);
    KEA_CARVE(&a, f->node, n);
    KEA_CARVE(&a, f->start, n + 1);
    KEA_CARVE(&a, f->entry, k);
    KEA_CARVE(&a, f->sourceStart, n + 1);
    KEA_CARVE(&a, f->source, k);
    KEA_CARVE(&a, f->diagonalAt, n);
    KEA_CARVE(&a, f->edgeAt, m);
    return a.used;
}

size_t kea_structureLayOutNumbers(KeaFactor *f, char *memory) {
    KeaArena a = {memory, 0};
    KEA_CARVE(&a, f->diagonal, f->diagonalSize);
    KEA_CARVE(&a, f->upperInput, f->inputSize);
    KEA_CARVE(&a, f->lowerInput, f->inputSize);
    KEA_CARVE(&a, f->pivot, f->diagonalSize);
    KEA_CARVE(&a, f->upper, f->factorSize);
    KEA_CARVE(&a, f->lower, f->factorSize);
    KEA_CARVE(&a, f->exchange, (size_t)f->offset[f->numNodes]);
    KEA_CARVE(&a, f->place, (size_t)f->numNodes);
    return a.used;
}

/* ---- the plan ---- */

/* Adds the size of node i's blocks, and its part of the work of a Cholesky factorization: the sum of the squared
 * lengths of its scalar columns. */
static void measureColumn(KeaFactor *f, const KeaOrder *o, const int size[], int i) {
    MEASSERT(size[i] >= 1 && size[i] <= KEA_FACTOR_MAX_BLOCK);
    const int t = o->turn[i];
    double length = 0;
    for (int k = o->start[t]; k < o->start[t + 1]; k++) {
        f->factorSize += (size_t)(size[i] * size[o->row[k]]);
        length += size[o->row[k]];
    }
    for (int r = 0; r < size[i]; r++)
        f->flops += (length + r + 1) * (length + r + 1);
    f->diagonalSize += (size_t)(size[i] * size[i]);
}

size_t kea_structurePlan(KeaFactor *f, const KeaOrder *o, const int size[], int numEdges, const int (*edges)[2]) {
    *f = (KeaFactor){.numNodes = o->numNodes, .numEdges = numEdges, .numEntries = o->start[o->numNodes]};
    for (int i = 0; i < o->numNodes; i++)
        measureColumn(f, o, size, i);
    for (int e = 0; e < numEdges; e++)
        f->inputSize += (size_t)(size[edges[e][0]] * size[edges[e][1]]);
    return kea_structureLayOut(f, NULL);
}

/* ---- writing ---- */

/* Copies the graph, and finds the places of unknowns and given blocks. */
static void copyGraph(KeaFactor *f, const int size[], const int (*edges)[2]) {
    size_t diagonal = 0, input = 0;
    f->offset[0] = 0;
    for (int i = 0; i < f->numNodes; i++) {
        f->size[i] = size[i];
        f->offset[i + 1] = f->offset[i] + size[i];
        f->diagonalAt[i] = diagonal;
        diagonal += (size_t)(size[i] * size[i]);
    }
    for (int e = 0; e < f->numEdges; e++) {
        f->edges[e][0] = edges[e][0];
        f->edges[e][1] = edges[e][1];
        f->edgeAt[e] = input;
        input += (size_t)(size[edges[e][0]] * size[edges[e][1]]);
    }
    MEASSERT(input == f->inputSize && diagonal == f->diagonalSize);
}

/* Restores the starts after all lists have been filled, which has advanced each start to the end of its list. */
static void restoreStarts(int starts[], int n) {
    memmove(starts + 1, starts, (size_t)n * sizeof *starts);
    starts[0] = 0;
}

/* Adds each column to the source lists of its rows. Columns are visited by ascending turn, so that the lists ascend. */
static void listSources(KeaFactor *f, const KeaOrder *o) {
    memset(f->sourceStart, 0, (size_t)(f->numNodes + 1) * sizeof *f->sourceStart);
    for (int k = 0; k < f->numEntries; k++)
        f->sourceStart[o->turn[o->row[k]] + 1]++;
    for (int t = 0; t < f->numNodes; t++) /* from numbers of sources to starts */
        f->sourceStart[t + 1] += f->sourceStart[t];
    MEASSERT(f->sourceStart[f->numNodes] == f->numEntries);
    for (int t = 0; t < f->numNodes; t++)
        for (int k = o->start[t]; k < o->start[t + 1]; k++)
            f->source[f->sourceStart[o->turn[o->row[k]]]++].turn = t;
    restoreStarts(f->sourceStart, f->numNodes);
}

/* Adds each row to the columns of its sources. Rows are visited by ascending turn, so that the columns ascend. */
static void writeColumns(KeaFactor *f, const KeaOrder *o) {
    memcpy(f->node, o->node, (size_t)f->numNodes * sizeof *f->node);
    memcpy(f->start, o->start, (size_t)(f->numNodes + 1) * sizeof *f->start);
    for (int row = 0; row < f->numNodes; row++)
        for (int s = f->sourceStart[row]; s < f->sourceStart[row + 1]; s++) {
            f->source[s].entry = f->start[f->source[s].turn]++;
            f->entry[f->source[s].entry] = (KeaFactorEntry){.row = row, .edge = -1};
        }
    restoreStarts(f->start, f->numNodes);
    size_t at = 0;
    for (int t = 0; t < f->numNodes; t++)
        for (int k = f->start[t]; k < f->start[t + 1]; k++) {
            f->entry[k].at = at;
            at += (size_t)(f->size[f->node[t]] * f->size[f->node[f->entry[k].row]]);
        }
    MEASSERT(at == f->factorSize);
}

/* Finds the entry of each edge, by bisection in its column. */
static void placeEdges(KeaFactor *f, const KeaOrder *o) {
    for (int e = 0; e < f->numEdges; e++) {
        const int a = o->turn[f->edges[e][0]], b = o->turn[f->edges[e][1]];
        const int column = a < b ? a : b, row = a < b ? b : a;
        int low = f->start[column], high = f->start[column + 1] - 1;
        while (low < high) {
            const int middle = (low + high) / 2;
            if (f->entry[middle].row < row)
                low = middle + 1;
            else
                high = middle;
        }
        MEASSERT(f->entry[low].row == row);
        f->entry[low].edge = e;
        f->entry[low].flip = a > b;
    }
}

/* Checks that the rows of each column come after it, in the order of their turns, and that blocks do not overlap. */
static inline MeBool hasSortedColumns(const KeaFactor *f) {
    size_t at = 0;
    for (int t = 0; t < f->numNodes; t++)
        for (int k = f->start[t]; k < f->start[t + 1]; k++) {
            const int before = k > f->start[t] ? f->entry[k - 1].row : t;
            if (f->entry[k].row <= before || f->entry[k].row >= f->numNodes || f->entry[k].at != at)
                return MEFALSE;
            at += (size_t)(f->size[f->node[t]] * f->size[f->node[f->entry[k].row]]);
        }
    return at == f->factorSize;
}

void kea_structureWrite(KeaFactor *f, char *memory, const KeaOrder *o, const int size[], const int (*edges)[2]) {
    kea_structureLayOut(f, memory);
    copyGraph(f, size, edges);
    listSources(f, o);
    writeColumns(f, o);
    placeEdges(f, o);
    MEVALIDATE(hasSortedColumns(f));
}
