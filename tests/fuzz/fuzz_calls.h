/* What the fuzzer of calls is made of: values, and the table of functions that calls.py writes. */
#ifndef FUZZ_CALLS_H
#define FUZZ_CALLS_H

#include "fuzz.h"

typedef enum FuzzKind {
    FUZZ_NOTHING,
    FUZZ_HANDLE,   /* type: the pool */
    FUZZ_REAL,     /* type: whether it is a time step */
    FUZZ_INTEGER,  /* type: whether it is a MeBool; size: the most, or 0 */
    FUZZ_REALS,    /* size: how many; isConst */
    FUZZ_DOUBLES,  /* the same */
    FUZZ_RECORD,   /* type: of fuzzRecords */
    FUZZ_CALLBACK, /* type: of fuzzCallbacks */
    FUZZ_TEXT,
    FUZZ_OPAQUE,
    FUZZ_OTHER
} FuzzKind;

typedef void (*FuzzCallback)(void);

typedef struct FuzzValue {
    void *p;
    double r;
    long i;
    FuzzCallback f;
} FuzzValue;

typedef struct FuzzParameter {
    FuzzKind kind;
    int type, size, isConst;
} FuzzParameter;

enum { FUZZ_PARAMETERS = 12 };

typedef struct FuzzFunction {
    const char *name;
    void (*call)(const FuzzValue *arguments, FuzzValue *result);
    FuzzKind result;
    int pool; /* of the result */
    int weight;
    int count;
    FuzzParameter parameters[FUZZ_PARAMETERS];
} FuzzFunction;

/* By name. */
extern const FuzzFunction fuzzFunctions[];
extern const int fuzzFunctionCount, fuzzPoolCount;
extern const char *const fuzzPoolNames[];
extern const int fuzzPoolIsConstraint[];      /* whether its handles are MdtConstraintIDs */
extern const char *const fuzzExceptions[][2]; /* functions that are not called, and why; to null */

/* Structures of the program, several in an array, as functions want them. */
typedef struct FuzzRecordType {
    size_t size;
    void (*fill)(void *record, FuzzRandom *random);
} FuzzRecordType;
extern const FuzzRecordType fuzzRecords[];
enum { FUZZ_CONTACTS, FUZZ_RESULTS }; /* the first two */
void *fuzzContactsOf(void *results);

typedef struct FuzzCallbackType {
    const FuzzCallback *callbacks;
    int count;
} FuzzCallbackType;
extern const FuzzCallbackType fuzzCallbacks[];
extern const int fuzzRecordCount, fuzzCallbackCount;
/* What callbacks choose by: begins anew with each call. */
extern FuzzRandom fuzzCallbackRandom;
/* Makes a call within a callback, now and then; mostly one that changes or destroys something. */
void fuzzMisuse(void);

#endif
