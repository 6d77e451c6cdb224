/* Fuzzer of calls: any public functions, one after the other, with any handles and numbers (calls.py has the table).
 *
 * A line is "Function argument ... =slot": @3 is the handle in slot 3 of its type's pool, @- null; &2:1,0,5 the array
 * of slot 2 with these numbers written to it before, &2#7 a structure filled by that seed, &2 either as it is; f1 a
 * callback, s2 a text, p1 some pointer; the result goes to a slot of its type's pool.
 *
 * Stale handles. Where the library promises to recognize them (check builds, MdtTypes.h and McdCTypes.h) they stay in
 * their pools. Else a function is not called with one: what is known of each handle's life is its owner's, its own by
 * functions named ...IsValid, and whether it has been destroyed. */
#define _DEFAULT_SOURCE /* strtok_r */
#include "fuzz_calls.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Mcd.h"
#include "Mdt.h"
#include "MeMemory.h"
#include "MeTask.h"
#include "Mst.h"

enum { SLOTS = 12, MAX_POOLS = 64, MAX_OBJECTS = 1 << 14, ARRAY_SLOTS = 8, MANY_REALS = 192 };

/* ---- handles ---- */

typedef struct Object {
    void *p;
    int pool;
    int owner[2]; /* objects that it lives no longer than; -1: none */
    MeBool isDestroyed;
} Object;

static Object objects[MAX_OBJECTS];
static int objectCount;
static int slots[MAX_POOLS][SLOTS]; /* objects; -1: empty */

static MeBool isPool(int pool, const char *name) {
    return strcmp(fuzzPoolNames[pool], name) == 0;
}

static int poolNamed(const char *name) {
    int pool = 0;
    while (!isPool(pool, name))
        pool++;
    return pool;
}

/* Plain memory, or what no function can look up. */
static MeBool isUnchecked(int pool) {
    static const char *const names[] = {
        "MdtBclLimit",         "MdtBclSingleLimit", "MdtBclContactParams", "McdModelPair", "McdModelPairContainer",
        "McdModelPairManager", "McdCullingTable",   "McdBatchContext",     "MeIDPool",     "MeChunk",
        "MeTaskPool"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (isPool(pool, names[i]))
            return METRUE;
    return !KARMA_CHECK;
}

static MeBool isConstraint(int pool) {
    return isPool(pool, "MdtBaseConstraint") || fuzzPoolIsConstraint[pool];
}

/* There is a function that says whether they live. */
static MeBool isLookedUp(int pool) {
    return isPool(pool, "MdtBody") || isPool(pool, "McdModel") || isPool(pool, "McdGeometry") || isConstraint(pool);
}

static MeBool isKnownAsLive(const Object *o) {
    if (isPool(o->pool, "MdtBody"))
        return MdtBodyIsValid(o->p);
    if (isPool(o->pool, "McdModel"))
        return McdModelIsValid(o->p);
    if (isPool(o->pool, "McdGeometry"))
        return McdGeometryIsValid(o->p);
    return !isConstraint(o->pool) || MdtConstraintIsValid(o->p);
}

static MeBool isLive(int object) {
    const Object *o = &objects[object];
    if (o->isDestroyed || !isKnownAsLive(o))
        return MEFALSE;
    for (int i = 0; i < 2; i++)
        if (o->owner[i] >= 0 && !isLive(o->owner[i]))
            return MEFALSE;
    return METRUE;
}

static void put(int pool, int slot, void *p, const int owner[2]) {
    if (!p || objectCount == MAX_OBJECTS)
        return;
    objects[objectCount] = (Object){p, pool, {owner[0], owner[1]}, MEFALSE};
    slots[pool][slot] = objectCount++;
}

/* The object in a slot, or in the next one that is not empty. -1: there is none. */
static int objectAt(int pool, int slot) {
    for (int i = 0; i < SLOTS; i++)
        if (slots[pool][(slot + i) % SLOTS] >= 0)
            return slots[pool][(slot + i) % SLOTS];
    return -1;
}

/* What is destroyed by its handle, where no function would tell. */
static void destroyed(const FuzzFunction *f, const FuzzValue *a) {
    const char *end = strstr(f->name, "Destroy");
    if (!end || end[7] != 0 || f->count == 0 || f->parameters[0].kind != FUZZ_HANDLE)
        return;
    for (int i = 0; i < objectCount; i++)
        if (objects[i].p == a[0].p && objects[i].pool == f->parameters[0].type && !isLookedUp(objects[i].pool))
            objects[i].isDestroyed = METRUE;
}

/* What was where an object has been created is destroyed, though its handle is valid again, as the new one's: what
 * belonged to the old one, such as the limit of a joint, is memory of the new one. */
static void created(const FuzzFunction *f, const void *p) {
    if (!p || !strstr(f->name, "Create"))
        return;
    for (int i = 0; i < objectCount; i++)
        if (objects[i].p == p)
            objects[i].isDestroyed = METRUE;
}

/* ---- arrays and structures of the program: they stay where they are ---- */

typedef struct Arrays {
    MeReal *reals[5][ARRAY_SLOTS];
    double *doubles[ARRAY_SLOTS];
    void *records[64][ARRAY_SLOTS];
} Arrays;

/* Of calls, and of calls within callbacks: these must not write what the call before them is reading. */
static Arrays arrays[2];
static int depth; /* of the call that is being made: 1 within callbacks */
static const int realSizes[] = {3, 4, 9, 16, MANY_REALS};

static MeReal *realsAt(int size, int slot) {
    int i = 0;
    while (i < 4 && realSizes[i] < size)
        i++;
    return arrays[depth].reals[i][slot];
}

static void makeArrays(Arrays *a, FuzzRandom *random) {
    for (int slot = 0; slot < ARRAY_SLOTS; slot++) {
        for (int i = 0; i < 5; i++)
            a->reals[i][slot] = calloc((size_t)realSizes[i], sizeof(MeReal));
        for (int i = 0; i < 16; i += 5)
            a->reals[3][slot][i] = 1;
        a->doubles[slot] = calloc(9, sizeof(double));
        for (int i = 0; i < fuzzRecordCount; i++) {
            a->records[i][slot] = calloc(1, fuzzRecords[i].size);
            fuzzRecords[i].fill(a->records[i][slot], random);
        }
        if (slot % 2) { /* contacts as they were found */
            free(a->records[FUZZ_CONTACTS][slot]);
            a->records[FUZZ_CONTACTS][slot] = fuzzContactsOf(a->records[FUZZ_RESULTS][slot]);
        }
    }
}

/* ---- writing lines ---- */

static int totalWeight;
static MeBool isChosen[4096]; /* of this run: fewer functions meet each other more often */

static MeBool isCore(const FuzzFunction *f) {
    return f->weight > 2;
}

static void chooseFunctions(FuzzRandom *random) {
    const int percent = fuzzChance(random, 50) ? 100 : 8;
    totalWeight = 0;
    for (int i = 0; i < fuzzFunctionCount; i++) {
        isChosen[i] = isCore(&fuzzFunctions[i]) || fuzzChance(random, percent);
        totalWeight += isChosen[i] ? fuzzFunctions[i].weight : 0;
    }
}

static const FuzzFunction *pickFunction(FuzzRandom *random) {
    int at = fuzzBelow(random, totalWeight), i = 0;
    for (; !isChosen[i] || at >= fuzzFunctions[i].weight; i++)
        at -= isChosen[i] ? fuzzFunctions[i].weight : 0;
    return &fuzzFunctions[i];
}

static void writeNumbers(FuzzLine *line, FuzzRandom *random, int count) {
    MeReal m[16];
    for (int i = 0; i < count && i < 16; i++)
        m[i] = (MeReal)fuzzReal(random);
    if (count == 16)
        fuzzMatrix(random, m);
    for (int i = 0; i < count; i++) {
        fuzzWrite(line, i ? "," : ":");
        fuzzWriteReal(line, (double)m[i]);
    }
}

static void writeArray(FuzzLine *line, FuzzRandom *random, const FuzzParameter *p) {
    fuzzWrite(line, "&%d", fuzzBelow(random, ARRAY_SLOTS));
    if (fuzzChance(random, 40))
        return; /* as it is */
    if (p->kind == FUZZ_RECORD || p->size > 16)
        fuzzWrite(line, "#%d", fuzzBelow(random, 1 << 20) * 64 + random->nasty);
    else
        writeNumbers(line, random, p->size);
}

static long integerFor(const FuzzParameter *p, FuzzRandom *random) {
    const long i = p->type && !fuzzIsNasty(random) ? fuzzBelow(random, 2) : fuzzInteger(random);
    return p->size > 0 && i > p->size ? p->size : i;
}

static void writeArgument(FuzzLine *line, FuzzRandom *random, const FuzzParameter *p) {
    const MeBool isNull = fuzzIsNasty(random) && fuzzChance(random, 30);
    fuzzWrite(line, " ");
    switch (p->kind) {
    case FUZZ_REAL:
        fuzzWriteReal(line, p->type && !fuzzIsNasty(random) ? 1.0 / 60 : fuzzReal(random));
        return;
    case FUZZ_INTEGER:
        fuzzWrite(line, "%ld", integerFor(p, random));
        return;
    case FUZZ_HANDLE:
        fuzzWrite(line, isNull ? "@-" : "@%d", fuzzBelow(random, SLOTS));
        return;
    case FUZZ_CALLBACK:
        fuzzWrite(line, isNull ? "f-" : "f%d", fuzzBelow(random, fuzzCallbacks[p->type].count));
        return;
    case FUZZ_TEXT:
        fuzzWrite(line, isNull ? "s-" : "s%d", fuzzBelow(random, 5));
        return;
    case FUZZ_OPAQUE:
        fuzzWrite(line, isNull ? "p-" : "p%d", fuzzBelow(random, 3));
        return;
    default:
        if (isNull)
            fuzzWrite(line, "&-");
        else
            writeArray(line, random, p);
    }
}

static void writeCall(FuzzLine *line, FuzzRandom *random, const FuzzFunction *f) {
    fuzzWrite(line, "%s", f->name);
    for (int i = 0; i < f->count; i++)
        writeArgument(line, random, &f->parameters[i]);
    if (f->result == FUZZ_HANDLE)
        fuzzWrite(line, " =%d", fuzzBelow(random, SLOTS));
}

static const FuzzFunction *functionNamed(const char *name) {
    int low = 0, high = fuzzFunctionCount - 1;
    while (low <= high) {
        const int middle = (low + high) / 2, order = strcmp(name, fuzzFunctions[middle].name);
        if (order == 0)
            return &fuzzFunctions[middle];
        *(order < 0 ? &high : &low) = order < 0 ? middle - 1 : middle + 1;
    }
    return NULL;
}

/* A run begins with a world in which something can happen. */
static const char *const opening[] = {"MstUniverseCreate",
                                      "MstUniverseGetWorld",
                                      "MstUniverseGetFramework",
                                      "MstUniverseGetSpace",
                                      "MstUniverseGetBridge",
                                      "MdtWorldSetGravity",
                                      "MstBridgeGetContactParams",
                                      "MdtContactParamsSetSurface",
                                      "McdBoxCreate",
                                      "McdSphereCreate",
                                      "McdCylinderCreate",
                                      "McdSphylCreate",
                                      "McdConeCreate",
                                      "McdConvexMeshCreateHull",
                                      "McdPlaneCreate",
                                      "McdRGHeightFieldCreate",
                                      "McdTriangleListCreate",
                                      "McdAggregateCreate",
                                      "McdAggregateAddElement",
                                      "McdAggregateAddElement",
                                      "MstModelAndBodyCreate",
                                      "MstModelAndBodyCreate",
                                      "MstModelAndBodyCreate",
                                      "MstModelAndBodyCreate",
                                      "MstModelAndBodyCreate",
                                      "MstFixedModelCreate",
                                      "MstFixedModelCreate",
                                      "McdModelGetBody",
                                      "McdModelGetBody",
                                      "McdModelGetBody",
                                      "McdModelDynamicsSetPosition",
                                      "McdModelDynamicsSetPosition",
                                      "MstUniverseStep",
                                      "MdtHingeCreate",
                                      "MdtBSJointCreate",
                                      "MdtSpringCreate",
                                      "MdtHingeSetBodies",
                                      "MdtBSJointSetBodies",
                                      "MdtSpringSetBodies",
                                      "MdtHingeEnable",
                                      "MdtBSJointEnable",
                                      "MdtSpringEnable",
                                      "MstUniverseStep",
                                      "MstUniverseStep"};

/* With one of these a run goes on: calls that programs make one after the other, and random ones seldom. */
static const char *const scenes[][12] = {
    {"McdModelSetBody", "McdModelSetBody", "McdModelSetBody", "MstUniverseStep", "McdModelDynamicsSetPosition",
     "MstUniverseStep"},
    {"McdModelCreate", "McdModelSetBody", "McdSpaceInsertModel", "McdModelDestroy", "MstUniverseStep", "MdtBodyDestroy",
     "MstUniverseStep"},
    {"MstUniverseCreate", "MstUniverseGetWorld", "MstUniverseGetWorld", "MdtBodyCreate", "MdtBodyEnable",
     "McdModelSetBody", "McdModelSetBody", "McdModelSetBody", "MstUniverseStep", "MstUniverseStep"},
    {"MstUniverseCreate", "MstUniverseGetFramework", "McdModelSetGeometry", "McdSpaceInsertModel", "MstUniverseStep"},
    {"MdtBodyGetFirstContact", "MdtBodyGetFirstContact", "MdtContactGetContactGroup", "MdtContactGroupDisable",
     "MdtContactGroupSetBodies", "MdtContactGroupSetBodies", "MdtConstraintSetBodies", "MstUniverseStep",
     "MdtBodyDestroy", "MstUniverseStep"},
    {"McdModelPairCreate", "McdHello", "McdIntersect", "McdContactGetRim", "McdContactGetRadius", "McdIntersect",
     "McdModelDestroy", "McdContactGetRim", "McdContactGetRim", "McdContactGetRadius", "McdModelPairDestroy"},
    {"McdModelDestroy", "MstUniverseStep", "McdGeometryDestroy", "MstUniverseStep", "MdtBodyDestroy",
     "MstUniverseStep"},
};

static const char *nameInScene(int scene, int index) {
    const int count = sizeof scenes[0] / sizeof scenes[0][0];
    return index < count ? scenes[scene][index] : NULL;
}

/* A function that takes what the last one gave. NULL: it gave nothing. */
static const FuzzFunction *pickFollowing(FuzzRandom *random, int pool) {
    const int start = fuzzBelow(random, fuzzFunctionCount);
    for (int i = 0; pool >= 0 && i < fuzzFunctionCount; i++) {
        const FuzzFunction *f = &fuzzFunctions[(start + i) % fuzzFunctionCount];
        for (int k = 0; k < f->count; k++)
            if (f->parameters[k].kind == FUZZ_HANDLE && f->parameters[k].type == pool)
                return f;
    }
    return NULL;
}

/* Every fourth run goes on through the table of functions where the last such one ended; others call any. */
static const FuzzFunction *functionAt(FuzzRandom *random, int index) {
    static int scene, given = -1; /* of this run: what it goes on with; the pool that the last call was to fill */
    const int count = sizeof opening / sizeof opening[0];
    if (index == 0)
        scene = fuzzBelow(random, sizeof scenes / sizeof scenes[0]);
    if (index < count)
        return functionNamed(opening[index]);
    const char *name = nameInScene(scene, index - count);
    const FuzzFunction *f = name ? functionNamed(name) : NULL;
    if (!f && random->run % 4 == 0)
        f = &fuzzFunctions[(random->run / 4 * 256 + index) % fuzzFunctionCount];
    if (!f && fuzzChance(random, 30))
        f = pickFollowing(random, given);
    if (!f)
        f = pickFunction(random);
    given = f->result == FUZZ_HANDLE ? f->pool : -1;
    return f;
}

static void generate(FuzzRandom *random, int index, FuzzLine *line) {
    if (index == 0)
        chooseFunctions(random);
    writeCall(line, random, functionAt(random, index));
}

/* ---- reading lines ---- */

/* Arithmetic (MeMath.h) checks nothing, and gives what it is given. */
static MeBool isArithmetic(const char *name) {
    return strncmp(name, "Me", 2) == 0;
}

static const char *const texts[] = {"", "a name", "%s%n%d", "Dynamics",
                                    "a text that is longer than what somebody may have thought that names are, by far"};

static void *arrayAt(const FuzzParameter *p, int slot) {
    if (p->kind == FUZZ_RECORD)
        return arrays[depth].records[p->type][slot];
    return p->kind == FUZZ_DOUBLES ? (void *)arrays[depth].doubles[slot] : (void *)realsAt(p->size, slot);
}

static void fillBySeed(const FuzzParameter *p, void *array, int seed) {
    FuzzRandom random = {(uint64_t)seed, seed % 64, 0};
    if (p->kind == FUZZ_RECORD)
        fuzzRecords[p->type].fill(array, &random);
    for (int i = 0; p->kind == FUZZ_REALS && i < p->size; i++)
        ((MeReal *)array)[i] = fuzzReal(&random);
}

static void fillByNumbers(const FuzzParameter *p, void *array, char *at) {
    for (int i = 0; i < p->size && *at; i++) {
        const double x = strtod(at, &at);
        if (p->kind == FUZZ_DOUBLES)
            ((double *)array)[i] = x;
        else
            ((MeReal *)array)[i] = x;
        at += *at == ',';
    }
}

static void *readArray(const FuzzParameter *p, char *word) {
    if (word[1] == '-')
        return NULL;
    char *at;
    void *array = arrayAt(p, (int)(strtoul(word + 1, &at, 10) % ARRAY_SLOTS));
    if (*at == '#')
        fillBySeed(p, array, atoi(at + 1));
    else if (*at == ':' && p->kind != FUZZ_RECORD)
        fillByNumbers(p, array, at + 1);
    return array;
}

/* MEFALSE: the call must not be made. */
static MeBool readHandle(const FuzzParameter *p, const char *word, FuzzValue *value, int owner[2]) {
    if (word[1] == '-')
        return METRUE;
    const int object = objectAt(p->type, (int)(strtoul(word + 1, NULL, 10) % SLOTS));
    if (object < 0)
        return METRUE;
    if (isUnchecked(p->type) && !isLive(object))
        return MEFALSE;
    value->p = objects[object].p;
    if (owner[0] < 0)
        owner[0] = object;
    else if (owner[1] < 0)
        owner[1] = object;
    return METRUE;
}

static MeBool readArgument(const FuzzParameter *p, char *word, FuzzValue *value, int owner[2]) {
    static char places[3];
    *value = (FuzzValue){NULL, 0, 0, NULL};
    const unsigned long number = strtoul(word + 1, NULL, 10);
    switch (p->kind) {
    case FUZZ_REAL:
        value->r = strtod(word, NULL);
        return METRUE;
    case FUZZ_INTEGER:
        value->i = strtol(word, NULL, 10);
        value->i = p->size > 0 && value->i > p->size ? p->size : value->i;
        return METRUE;
    case FUZZ_HANDLE:
        return readHandle(p, word, value, owner);
    case FUZZ_CALLBACK:
        value->f = word[1] == '-'
                       ? NULL
                       : fuzzCallbacks[p->type].callbacks[number % (unsigned long)fuzzCallbacks[p->type].count];
        return METRUE;
    case FUZZ_TEXT:
        value->p = word[1] == '-' ? NULL : (void *)(uintptr_t)texts[number % 5];
        return METRUE;
    case FUZZ_OPAQUE:
        value->p = word[1] == '-' ? NULL : &places[number % 3];
        return METRUE;
    default:
        value->p = readArray(p, word);
        return METRUE;
    }
}

/* ---- what must hold ---- */

/* Structures hold what the program wrote there; it may be what a function gives back. */
static MeBool takesRecord(const FuzzFunction *f) {
    for (int i = 0; i < f->count; i++)
        if (f->parameters[i].kind == FUZZ_RECORD)
            return METRUE;
    return MEFALSE;
}

static MeBool isFiniteReals(const MeReal *v, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(v[i]))
            return MEFALSE;
    return METRUE;
}

/* All bodies that are known are at a place, and move at a speed. */
static void checkBodies(const char *name) {
    const int pool = poolNamed("MdtBody");
    for (int slot = 0; slot < SLOTS; slot++) {
        const int object = slots[pool][slot];
        if (object < 0 || !MdtBodyIsValid(objects[object].p))
            continue;
        MeMatrix4 tm;
        MeVector3 v, w;
        MdtBodyGetTransform(objects[object].p, tm);
        MdtBodyGetLinearVelocity(objects[object].p, v);
        MdtBodyGetAngularVelocity(objects[object].p, w);
        if (!isFiniteReals(&tm[0][0], 16) || !isFiniteReals(v, 3) || !isFiniteReals(w, 3))
            fuzzFail("a body is not finite after %s", name);
    }
}

typedef struct Before {
    MeReal reals[FUZZ_PARAMETERS][16];
} Before;

static void keep(Before *before, const FuzzFunction *f, const FuzzValue *a) {
    for (int i = 0; i < f->count; i++)
        if (f->parameters[i].kind == FUZZ_REALS && f->parameters[i].size <= 16 && a[i].p)
            memcpy(before->reals[i], a[i].p, (size_t)f->parameters[i].size * sizeof(MeReal));
}

static void checkResults(const Before *before, const FuzzFunction *f, const FuzzValue *a, const FuzzValue *result) {
    if (isArithmetic(f->name))
        return;
    if (f->result == FUZZ_REAL && isnan(result->r) && !takesRecord(f))
        fuzzFail("%s returns NaN", f->name);
    for (int i = 0; i < f->count; i++) {
        const FuzzParameter *p = &f->parameters[i];
        for (int k = 0; p->kind == FUZZ_REALS && a[i].p && p->size <= 16 && k < p->size; k++)
            if (isnan(((const MeReal *)a[i].p)[k]) && !isnan(before->reals[i][k]))
                fuzzFail("%s writes NaN", f->name);
    }
    if (strstr(f->name, "Step"))
        checkBodies(f->name);
}

/* Containers refer to pairs, which are the program's. */
static void forgetPairs(void) {
    const int pool = poolNamed("McdModelPairContainer");
    for (int i = 0; i < objectCount; i++)
        if (objects[i].pool == pool && isLive(i))
            McdModelPairContainerReset(objects[i].p);
}

static void finish(const FuzzFunction *f, const FuzzValue *a, const FuzzValue *result, const char *word,
                   const int owner[2]) {
    destroyed(f, a);
    created(f, f->result == FUZZ_HANDLE ? result->p : NULL);
    if (f->result != FUZZ_HANDLE || !word || word[0] != '=')
        return;
    const int slot = (int)(strtoul(word + 1, NULL, 10) % SLOTS);
    put(f->pool, slot, result->p, owner);
    if (fuzzPoolIsConstraint[f->pool])
        put(poolNamed("MdtBaseConstraint"), slot, result->p, owner);
}

static uint64_t hashOf(const char *text) {
    uint64_t hash = 0xcbf29ce484222325ull;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3ull;
    return hash;
}

static void makeCall(char *line) {
    char *rest;
    const FuzzFunction *f = functionNamed(strtok_r(line, " ", &rest));
    FuzzValue a[FUZZ_PARAMETERS], result = {NULL, 0, 0, NULL};
    Before before;
    int owner[2] = {-1, -1};
    for (int i = 0; f && i < f->count; i++) {
        char *word = strtok_r(NULL, " ", &rest);
        if (!word || !readArgument(&f->parameters[i], word, &a[i], owner))
            return;
        if (f->parameters[i].kind == FUZZ_REALS && !a[i].p && isArithmetic(f->name))
            return;
    }
    if (!f)
        return;
    if (strcmp(f->name, "McdModelPairDestroy") == 0)
        forgetPairs();
    keep(&before, f, a);
    f->call(a, &result);
    checkResults(&before, f, a, &result);
    finish(f, a, &result, strtok_r(NULL, " ", &rest), owner);
}

static void execute(char *line) {
    fuzzCallbackRandom = (FuzzRandom){hashOf(line), 20, 0};
    depth = 0;
    makeCall(line);
}

/* ---- within callbacks ---- */

static int changing[1024], changingCount; /* functions that change what the library may be about to use */

static void findChanging(void) {
    static const char *const words[] = {"Destroy", "Remove", "Reset",  "Step",   "SetBody", "SetBodies", "SetGeometry",
                                        "Size",    "Insert", "Freeze", "Enable", "Disable", "Create",    "Update"};
    for (int i = 0; i < fuzzFunctionCount; i++)
        for (size_t k = 0; k < sizeof words / sizeof words[0]; k++)
            if (strstr(fuzzFunctions[i].name, words[k]) && changingCount < 1024) {
                changing[changingCount++] = i;
                break;
            }
}

void fuzzMisuse(void) {
    char text[4096];
    FuzzLine line = {text, sizeof text, 0};
    FuzzRandom *const random = &fuzzCallbackRandom;
    if (depth > 0 || fuzzChance(random, 85))
        return;
    const int any = fuzzBelow(random, fuzzFunctionCount), change = changing[fuzzBelow(random, changingCount)];
    writeCall(&line, random, &fuzzFunctions[fuzzChance(random, 30) ? any : change]);
    depth = 1;
    fuzzNote(text);
    makeCall(text);
    depth = 0;
}

/* ---- a run ---- */

static void begin(void) {
    static MeChunk chunk;
    const int none[2] = {-1, -1};
    memset(slots, -1, sizeof slots);
    FuzzRandom random = {0, 0, 0};
    makeArrays(&arrays[0], &random);
    makeArrays(&arrays[1], &random);
    findChanging();
    MeChunkInit(&chunk, 16);
    put(poolNamed("MeChunk"), 0, &chunk, none);
    put(poolNamed("MeTaskPool"), 0, MeTaskPoolCreate(2), none);
}

/* What the program has made goes in the order in which it came, universes with all that is in them. */
static void end(void) {
    const int universes = poolNamed("MstUniverse"), worlds = poolNamed("MdtWorld");
    for (int i = 0; i < objectCount; i++)
        if (objects[i].pool == universes && isLive(i)) {
            MstUniverseDestroy(objects[i].p);
            objects[i].isDestroyed = METRUE;
        }
    for (int i = 0; i < objectCount; i++)
        if (objects[i].pool == worlds && isLive(i))
            MdtWorldDestroy(objects[i].p);
}

static int list(void) {
    for (int i = 0; i < fuzzFunctionCount; i++)
        printf("%s\n", fuzzFunctions[i].name);
    for (int i = 0; fuzzExceptions[i][0]; i++)
        printf("not %s: %s\n", fuzzExceptions[i][0], fuzzExceptions[i][1]);
    return 0;
}

int main(int argc, char **argv) {
    static const FuzzTarget target = {"calls", 300, 5, begin, generate, execute, end};
    return argc == 2 && strcmp(argv[1], "--list") == 0 ? list() : fuzzMain(argc, argv, &target);
}
