/* Memory and checks of arguments. */
#include "r_i.h"

#include <string.h>

void *r_alloc(size_t bytes) {
    void *block = MeMemoryAPI.create(bytes);
    if (!block) {
        MeFatalError(0, "MeViewer: out of memory (%zu bytes)", bytes);
        return NULL;
    }
    return memset(block, 0, bytes);
}

void r_free(void *block) {
    if (block)
        MeMemoryAPI.destroy(block);
}

char *r_copyText(const char *text) {
    const size_t bytes = strlen(text) + 1;
    char *copy = r_alloc(bytes);
    return copy ? memcpy(copy, text, bytes) : NULL;
}

bool r_growBytes(void **items, size_t *capacity, size_t needed, size_t size) {
    MEASSERT((*items != NULL) == (*capacity > 0));
    if (needed <= *capacity)
        return true;
    size_t more = *capacity ? *capacity * 2 : 16;
    if (more < needed)
        more = needed;
    void *block = r_alloc(more * size);
    if (!block)
        return false;
    if (*items)
        memcpy(block, *items, *capacity * size);
    r_free(*items);
    *items = block;
    *capacity = more;
    return true;
}

bool r_isGraphic(const RGraphic *rg, const char *function) {
    if (!rg)
        MeWarning(1, "%s: the graphic is null", function);
    return rg != NULL;
}

bool r_isPointer(const void *pointer, const char *function, const char *argument) {
    if (!pointer)
        MeWarning(1, "%s: %s is null", function, argument);
    return pointer != NULL;
}

bool r_isNumber(AcmeReal value, const char *function, const char *argument) {
    if (!isfinite(value))
        MeWarning(1, "%s: %s is not a finite number", function, argument);
    return isfinite(value);
}

bool r_isFinite(const AcmeReal *values, int n, const char *function, const char *argument) {
    if (!r_isPointer(values, function, argument))
        return false;
    for (int i = 0; i < n; i++) {
        if (!isfinite(values[i])) {
            MeWarning(1, "%s: %s[%d] is not a finite number", function, argument, i);
            return false;
        }
    }
    return true;
}

bool r_isSize(AcmeReal value, const char *function, const char *argument) {
    if (isfinite(value) && value > 0)
        return true;
    MeWarning(1, "%s: %s is %g: it must be a finite number above 0", function, argument, (double)value);
    return false;
}
