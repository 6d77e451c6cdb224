/* Culling tables: one bit for each unordered pair of indices says that two kinds of models do not collide. */
#include "McdCullingTable.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include <string.h>

struct McdCullingTable {
    MeU32 size;
    unsigned char bits[];
};

/* The index of a pair's bit in the lower triangle, row by row. */
static size_t bitOf(MeU32 a, MeU32 b) {
    const size_t row = a > b ? a : b, column = a > b ? b : a;
    return row * (row + 1) / 2 + column;
}

static MeBool checkTable(const McdCullingTable *table, MeU32 a, MeU32 b, const char *function) {
    if (table && a < table->size && b < table->size)
        return METRUE;
    if (!table)
        MeWarning(1, "%s: no table", function);
    else
        MeWarning(1, "%s: indices are %lu and %lu: they must be below %lu", function, (unsigned long)a,
                  (unsigned long)b, (unsigned long)table->size);
    return MEFALSE;
}

McdCullingTable *MEAPI McdCullingTableCreate(int size) {
    enum { MAX_SIZE = 32768 };
    if (size < 1 || size > MAX_SIZE) {
        MeWarning(1, "McdCullingTableCreate: size is %d: it must be 1 .. %d", size, MAX_SIZE);
        return 0;
    }
    const MeU32 last = (MeU32)size - 1;
    const size_t bytes = sizeof(McdCullingTable) + bitOf(last, last) / 8 + 1;
    McdCullingTable *table = MeMemoryTakeZeroed(1, bytes, "McdCullingTableCreate", "a culling table");
    if (table)
        table->size = (MeU32)size;
    return table;
}

void MEAPI McdCullingTableDestroy(McdCullingTable *const table) {
    MeMemoryGive(table);
}

void MEAPI McdCullingTableSet(McdCullingTable *const table, MeU32 a, MeU32 b, MeBool flag) {
    if (!checkTable(table, a, b, "McdCullingTableSet"))
        return;
    const size_t bit = bitOf(a, b);
    const unsigned mask = 1u << bit % 8;
    table->bits[bit / 8] = (unsigned char)(flag ? table->bits[bit / 8] | mask : table->bits[bit / 8] & ~mask);
}

MeBool MEAPI McdCullingTableGet(const McdCullingTable *const table, MeU32 a, MeU32 b) {
    if (!checkTable(table, a, b, "McdCullingTableGet"))
        return MEFALSE;
    const size_t bit = bitOf(a, b);
    return table->bits[bit / 8] >> bit % 8 & 1;
}

int MEAPI McdCullingTableGetSize(const McdCullingTable *const table) {
    return table ? (int)table->size : 0;
}
