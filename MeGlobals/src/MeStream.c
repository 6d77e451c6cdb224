/* Streams: files by the C library, or blocks of memory. */
#define _POSIX_C_SOURCE 200809L
#include "MeStream.h"

#include "MeAssert.h"
#include "MeFile_i.h"
#include "MeMath.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef enum Use { NEITHER, READS, WRITES } Use;

struct _MeStream {
    FILE *file;  /* null: memory */
    Use lastUse; /* of the file: C requires a seek between reading and writing */
    char *memory;
    size_t length, size, place; /* bytes of content, capacity, and present position */
    MeBool isOwn, growsSlowly;
};

static MeBool isStream(MeStream stream, const char *function) {
    if (!me_isGiven(stream, "stream", function))
        return MEFALSE;
    MEASSERT(stream->file || (stream->length <= stream->size && stream->place <= stream->length));
    return METRUE;
}

static MeStream create(const char *function) {
    return MeMemoryTakeZeroed(1, sizeof(struct _MeStream), function, "a stream");
}

/* ---- life ---- */

static MeStream openFileStream(int file, MeOpenMode_enum mode, const char *function) {
    if (file < 0)
        return NULL;
    MeStream stream = create(function);
    if (stream)
        stream->file = fdopen(file, mode == kMeOpenModeWRONLY ? "wb" : mode == kMeOpenModeRDWR ? "r+b" : "rb");
    if (stream && stream->file)
        return stream;
    MeClose(file);
    MeStreamClose(stream);
    return NULL;
}

MeStream MEAPI MeStreamOpen(const char *filename, MeOpenMode_enum mode) {
    return openFileStream(me_open(filename, mode, __func__), mode, __func__);
}

MeStream MEAPI MeStreamOpenWithSearch(const char *filename, MeOpenMode_enum mode) {
    return openFileStream(me_openWithSearch(filename, mode, __func__), mode, __func__);
}

MeStream MEAPI MeStreamOpenAsMemBuffer(unsigned int initialSize) {
    MeStream stream = create(__func__);
    if (!stream)
        return NULL;
    stream->isOwn = METRUE;
    stream->size = initialSize;
    stream->memory = initialSize ? MeMemoryTake(initialSize, 1, __func__, "a stream") : NULL;
    if (stream->memory || !initialSize)
        return stream;
    MeMemoryGive(stream);
    return NULL;
}

MeStream MEAPI MeStreamCreateFromMemBuffer(char *buffer, unsigned int bufLength, unsigned int bufSize) {
    if (!buffer || bufLength > bufSize) {
        MeWarning(1, "MeStreamCreateFromMemBuffer: the buffer is %p, bufLength is %u, which must be <= bufSize, %u",
                  (void *)buffer, bufLength, bufSize);
        return NULL;
    }
    MeStream stream = create(__func__);
    if (!stream)
        return NULL;
    stream->memory = buffer;
    stream->length = bufLength;
    stream->size = bufSize;
    return stream;
}

void MEAPI MeStreamClose(MeStream stream) {
    if (!stream)
        return;
    if (stream->file && fclose(stream->file))
        MeWarning(1, "MeStreamClose: the file has not taken all that was written");
    if (stream->isOwn)
        MeMemoryGive(stream->memory);
    MeMemoryGive(stream);
}

/* ---- memory ---- */

/* Moves the contents into a block of another size, none for 0; false without memory. */
static MeBool reallocate(MeStream stream, size_t size, const char *function) {
    MEASSERT(size >= stream->length);
    char *memory = size ? MeMemoryTake(size, 1, function, "a stream") : NULL;
    if (size && !memory)
        return MEFALSE;
    if (stream->length)
        memcpy(memory, stream->memory, stream->length);
    if (stream->isOwn)
        MeMemoryGive(stream->memory);
    stream->isOwn = METRUE;
    stream->memory = memory;
    stream->size = size;
    return METRUE;
}

static MeBool reserve(MeStream stream, size_t bytes, const char *function) {
    const size_t needed = stream->place + bytes;
    if (needed <= stream->size)
        return METRUE;
    return reallocate(stream, stream->growsSlowly ? needed : MeMAX(needed, 2 * stream->size), function);
}

static MeBool isMemory(MeStream stream, const char *function) {
    if (!isStream(stream, function))
        return MEFALSE;
    if (stream->file)
        MeWarning(1, "%s: the stream is a file", function);
    return !stream->file;
}

void MEAPI MeStreamMemBufferFreeSlackSpace(MeStream stream) {
    if (isMemory(stream, __func__) && stream->isOwn && stream->length < stream->size)
        reallocate(stream, stream->length, __func__);
}

void MEAPI MeStreamMemBufferUseConservativeGrowth(MeStream stream, MeBool bConsGrowth) {
    if (isMemory(stream, __func__))
        stream->growsSlowly = bConsGrowth;
}

/* ---- reading and writing ---- */

static MeBool isBuffer(const void *buffer, size_t size, size_t count, const char *function) {
    if (!size || !count)
        return MEFALSE;
    if (buffer && count <= SIZE_MAX / 2 / size)
        return METRUE;
    MeWarning(1, "%s: %zu records of %zu bytes at %p", function, count, size, buffer);
    return MEFALSE;
}

static void setUse(MeStream stream, Use use) {
    if (stream->lastUse != NEITHER && stream->lastUse != use)
        fseek(stream->file, 0, SEEK_CUR);
    stream->lastUse = use;
}

size_t MEAPI MeStreamRead(void *buffer, size_t size, size_t count, MeStream stream) {
    if (!isStream(stream, __func__) || !isBuffer(buffer, size, count, __func__))
        return 0;
    if (stream->file) {
        setUse(stream, READS);
        return fread(buffer, size, count, stream->file);
    }
    const size_t whole = MeMIN(count, (stream->length - stream->place) / size);
    if (whole)
        memcpy(buffer, stream->memory + stream->place, whole * size);
    stream->place += whole * size;
    return whole;
}

size_t MEAPI MeStreamWrite(void *buffer, size_t size, size_t count, MeStream stream) {
    if (!isStream(stream, __func__) || !isBuffer(buffer, size, count, __func__))
        return 0;
    if (stream->file) {
        setUse(stream, WRITES);
        return fwrite(buffer, size, count, stream->file);
    }
    if (!reserve(stream, size * count, __func__))
        return 0;
    MEASSERT(stream->place + size * count <= stream->size);
    memcpy(stream->memory + stream->place, buffer, size * count);
    stream->place += size * count;
    stream->length = MeMAX(stream->length, stream->place);
    return count;
}

static char *readLineFromMemory(MeStream stream, char *string, int n) {
    const size_t there = stream->length - stream->place, max = MeMIN(there, (size_t)n - 1);
    if (!there)
        return NULL;
    const char *from = stream->memory + stream->place, *end = memchr(from, '\n', max);
    const size_t length = end ? (size_t)(end - from) + 1 : max;
    MEASSERT(length < (size_t)n && stream->place + length <= stream->length);
    memcpy(string, from, length);
    string[length] = 0;
    stream->place += length;
    return string;
}

char *MEAPI MeStreamReadLine(char *string, int n, MeStream stream) {
    if (!isStream(stream, __func__))
        return NULL;
    if (!string || n < 1) {
        MeWarning(1, "MeStreamReadLine: %d bytes at %p", n, (void *)string);
        return NULL;
    }
    if (!stream->file)
        return readLineFromMemory(stream, string, n);
    setUse(stream, READS);
    return fgets(string, n, stream->file);
}

void MEAPI MeStreamRewind(MeStream stream) {
    if (!isStream(stream, __func__))
        return;
    stream->place = 0;
    stream->lastUse = NEITHER;
    if (stream->file)
        rewind(stream->file);
}
