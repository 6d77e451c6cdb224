/* Files by descriptors of the system. */
#define _POSIX_C_SOURCE 200809L
#include "MeSimpleFile.h"

#include "MeAssert.h"
#include "MeFile_i.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_NAME = 4096 }; /* Linux' PATH_MAX: longer names cannot be opened */

/* ---- opening ---- */

static int flagsOf(MeOpenMode_enum mode) {
    switch (mode) {
    case kMeOpenModeWRONLY:
        return O_WRONLY | O_CREAT | O_TRUNC;
    case kMeOpenModeRDWR:
        return O_RDWR | O_CREAT;
    case kMeOpenModeRDONLY:
    case kMeOpenModeRDBINARY:
        return O_RDONLY;
    }
    return -1;
}

static int openFile(const char *filename, MeOpenMode_enum mode, const char *function) {
    const int flags = flagsOf(mode);
    if (flags < 0) {
        MeWarning(1, "%s: there is no mode %d", function, (int)mode);
        return -1;
    }
    const int file = open(filename, flags, 0666);
    struct stat status;
    if (file < 0 || (fstat(file, &status) == 0 && !S_ISDIR(status.st_mode)))
        return file;
    close(file);
    return -1;
}

static void replaceBackslashes(char *name) {
    for (; *name; name++)
        if (*name == '\\')
            *name = '/';
}

static int openWithAnySlashes(const char *filename, MeOpenMode_enum mode, const char *function) {
    char name[MAX_NAME];
    const size_t length = strlen(filename);
    /* existing files may have backslashes in their names, but none is created with such a name */
    const MeBool isForeign = strchr(filename, '\\') != NULL && length < sizeof name;
    const MeBool mayBeThere = !isForeign || flagsOf(mode) == O_RDONLY;
    const int file = mayBeThere ? openFile(filename, mode, function) : -1;
    if (file >= 0 || !isForeign)
        return file;
    memcpy(name, filename, length + 1);
    replaceBackslashes(name);
    return openFile(name, mode, function);
}

int MEAPI MeOpenRaw(const char *filename, MeOpenMode_enum mode) {
    return me_isGiven(filename, "name", __func__) ? openFile(filename, mode, __func__) : -1;
}

int me_open(const char *filename, MeOpenMode_enum mode, const char *function) {
    return me_isGiven(filename, "name", function) ? openWithAnySlashes(filename, mode, function) : -1;
}

int MEAPI MeOpen(const char *filename, MeOpenMode_enum mode) {
    return me_open(filename, mode, __func__);
}

const char *MEAPI MeGetDefaultFileLocation(int i) {
    static const char *const places[] = {"resources", "../resources", "../../resources", "..", "../.."};
    const char *own = getenv("KARMA_FILES");
    const int first = own && *own ? 1 : 0;
    if (first && i == 0)
        return own;
    return i >= first && i - first < (int)(sizeof places / sizeof *places) ? places[i - first] : NULL;
}

/* Opens a file by its name relative to a directory. */
static int openInDirectory(const char *directory, const char *name, MeOpenMode_enum mode, const char *function) {
    char path[MAX_NAME];
    const int length = snprintf(path, sizeof path, "%s/%s", directory, name);
    return length < (int)sizeof path ? openFile(path, mode, function) : -1;
}

static int searchFor(const char *filename, MeOpenMode_enum mode, const char *function) {
    char name[MAX_NAME];
    if (strlen(filename) >= sizeof name)
        return -1;
    strcpy(name, filename);
    replaceBackslashes(name);
    const char *slash = strrchr(name, '/'), *last = slash ? slash + 1 : name;
    int file = -1;
    for (int i = 0; file < 0 && MeGetDefaultFileLocation(i); i++) {
        if (name[0] != '/')
            file = openInDirectory(MeGetDefaultFileLocation(i), name, mode, function);
        if (file < 0 && last != name && *last)
            file = openInDirectory(MeGetDefaultFileLocation(i), last, mode, function);
    }
    return file;
}

int me_openWithSearch(const char *filename, MeOpenMode_enum mode, const char *function) {
    const int file = me_open(filename, mode, function);
    return file < 0 && filename && flagsOf(mode) == O_RDONLY ? searchFor(filename, mode, function) : file;
}

int MEAPI MeOpenWithSearch(const char *filename, MeOpenMode_enum mode) {
    return me_openWithSearch(filename, mode, __func__);
}

int MEAPI MeClose(int file) {
    const int answer = close(file);
    if (answer)
        MeWarning(1, "MeClose: %d is no open file", file);
    return answer;
}

/* ---- reading and writing ---- */

/* Reads or writes until all bytes are transferred or the file ends; returns their number, -1 for an error at the
 * first. */
static int transferAll(int file, char *bytes, int count, MeBool isRead, const char *function) {
    int done = 0;
    while (done < count) {
        const size_t left = (size_t)(count - done);
        const ssize_t moved = isRead ? read(file, bytes + done, left) : write(file, bytes + done, left);
        if (moved < 0 && errno == EINTR)
            continue;
        if (moved < 0) {
            MeWarning(1, "%s: file %d: %s", function, file, strerror(errno));
            return done ? done : -1;
        }
        if (moved == 0)
            break;
        done += (int)moved;
    }
    MEASSERT(done <= count);
    return done;
}

static MeBool isBuffer(const void *buf, int count, const char *function) {
    if (count >= 0 && (buf || count == 0))
        return METRUE;
    MeWarning(1, "%s: %d bytes at %p", function, count, buf);
    return MEFALSE;
}

int MEAPI MeRead(int file, void *buf, int count) {
    return isBuffer(buf, count, __func__) ? transferAll(file, buf, count, METRUE, __func__) : -1;
}

int MEAPI MeWrite(int file, void *buf, int count) {
    return isBuffer(buf, count, __func__) ? transferAll(file, buf, count, MEFALSE, __func__) : -1;
}

int MEAPI MeLseek(int file, int offset, MeSeekOrigin_enum origin) {
    static const int whence[] = {SEEK_SET, SEEK_CUR, SEEK_END};
    if ((int)origin < 0 || (int)origin > 2) {
        MeWarning(1, "MeLseek: there is no origin %d", (int)origin);
        return -1;
    }
    const off_t place = lseek(file, offset, whence[origin]);
    if (place < 0 && errno == EBADF)
        MeWarning(1, "MeLseek: %d is no open file", file);
    return place > INT_MAX ? -1 : (int)place;
}

char *MEAPI MeLoadWholeFileHandle(const int f, int *size) {
    struct stat status;
    if (size)
        *size = 0;
    if (fstat(f, &status) || status.st_size >= INT_MAX || lseek(f, 0, SEEK_SET) < 0) {
        MeWarning(1, "MeLoadWholeFileHandle: file %d is not open, not a plain file, or has 2 GB", f);
        return NULL;
    }
    char *text = MeMemoryTake((size_t)status.st_size + 1, 1, __func__, "the file");
    const int count = text ? transferAll(f, text, (int)status.st_size, METRUE, __func__) : -1;
    if (count < 0) {
        MeMemoryGive(text);
        return NULL;
    }
    text[count] = 0;
    if (size)
        *size = count;
    return text;
}

void MEAPI MeSaveWholeFileHandle(const int f, const char *data, const int size) {
    if (!isBuffer(data, size, __func__))
        return;
    if (lseek(f, 0, SEEK_SET) < 0 || ftruncate(f, 0))
        MeWarning(1, "MeSaveWholeFileHandle: file %d is not open for writing, or not a plain file", f);
    else if (transferAll(f, (char *)(size_t)data, size, MEFALSE, __func__) != size)
        MeWarning(1, "MeSaveWholeFileHandle: file %d has not taken all of %d bytes", f, size);
}
