/* Files by numbers, and streams: of files and of memory. */
#define _POSIX_C_SOURCE 200809L
#include "MeMemory.h"
#include "MeStream.h"
#include "karma_test.h"
#include <sys/stat.h>
#include <unistd.h>

static char directory[] = "/tmp/karma-files-XXXXXX";
static char home[4096];
static char text[] = "first\nsecond, a longer one\n\nlast";

static void setUp(void) {
    strcpy(strrchr(directory, '-'), "-XXXXXX");
    ck_assert_ptr_nonnull(getcwd(home, sizeof home));
    ck_assert_ptr_nonnull(mkdtemp(directory));
    ck_assert(chdir(directory) == 0 && mkdir("work", 0777) == 0 && mkdir("resources", 0777) == 0);
    ck_assert(mkdir("own", 0777) == 0 && mkdir("own/deep", 0777) == 0 && chdir("work") == 0);
}

static void tearDown(void) {
    char command[4200];
    unsetenv("KARMA_FILES");
    ck_assert_int_eq(chdir(home), 0);
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    ck_assert_int_eq(system(command), 0);
}
TEST_FIXTURE(setUp, tearDown)

static void makeFile(const char *name, const char *content) {
    const int f = MeOpenRaw(name, kMeOpenModeWRONLY);
    ck_assert_int_ge(f, 0);
    MeSaveWholeFileHandle(f, content, (int)strlen(content));
    ck_assert_int_eq(MeClose(f), 0);
}

static char *contentOf(int f) {
    static char content[100];
    const int count = f < 0 ? -1 : MeRead(f, content, sizeof content - 1);
    if (count < 0)
        return NULL;
    content[count] = 0;
    MeClose(f);
    return content;
}

/* ---- files ---- */

TEST(what_is_written_is_read) {
    char part[10];
    int f = MeOpen("file", kMeOpenModeRDWR), size;
    ck_assert_int_eq(MeWrite(f, text, sizeof text - 1), (int)sizeof text - 1);
    ck_assert_int_eq(MeRead(f, part, 1), 0);
    ck_assert_int_eq(MeLseek(f, 6, kMeSeekSET), 6);
    ck_assert_int_eq(MeRead(f, part, 6), 6);
    ck_assert_int_eq(memcmp(part, "second", 6), 0);
    ck_assert_int_eq(MeLseek(f, -6, kMeSeekCUR), 6);
    ck_assert_int_eq(MeLseek(f, -4, kMeSeekEND), (int)sizeof text - 5);
    ck_assert_int_eq(MeRead(f, part, 10), 4);
    ck_assert_int_eq(MeLseek(f, -1, kMeSeekSET), -1);
    char *all = MeLoadWholeFileHandle(f, &size);
    ck_assert(strcmp(all, text) == 0 && size == (int)sizeof text - 1);
    MeMemoryAPI.destroy(all);
    MeSaveWholeFileHandle(f, "short", 5);
    ck_assert_int_eq(MeClose(f), 0);
    ck_assert_str_eq(contentOf(MeOpen("file", kMeOpenModeRDBINARY)), "short");
    f = MeOpen("file", kMeOpenModeRDWR);
    ck_assert_str_eq(contentOf(f), "short");
    f = MeOpen("file", kMeOpenModeWRONLY);
    ck_assert_int_eq(MeClose(f), 0);
    ck_assert_str_eq(contentOf(MeOpen("file", kMeOpenModeRDONLY)), "");
}

TEST(a_file_that_is_not_there_is_no_message) {
    ck_assert_int_eq(MeOpen("none", kMeOpenModeRDONLY), -1);
    ck_assert_int_eq(MeOpenWithSearch("none/of/them", kMeOpenModeRDONLY), -1);
    ck_assert_int_eq(MeOpenRaw(".", kMeOpenModeRDONLY), -1);
    ck_assert_int_eq(MeOpen("no/such/place", kMeOpenModeWRONLY), -1);
}

TEST(files_are_searched_for) {
    makeFile("../resources/near", "near");
    makeFile("../beside", "beside");
    makeFile("../own/deep/far", "far");
    makeFile("../own/far", "last part");
    makeFile("here", "here");
    makeFile("../resources/here", "not this");
    ck_assert_int_eq(MeOpen("near", kMeOpenModeRDONLY), -1);
    ck_assert_str_eq(contentOf(MeOpenWithSearch("here", kMeOpenModeRDONLY)), "here");
    ck_assert_str_eq(contentOf(MeOpenWithSearch("near", kMeOpenModeRDONLY)), "near");
    ck_assert_str_eq(contentOf(MeOpenWithSearch("C:\\game\\near", kMeOpenModeRDBINARY)), "near");
    ck_assert_str_eq(contentOf(MeOpenWithSearch("/opt/game/beside", kMeOpenModeRDONLY)), "beside");
    ck_assert_int_eq(MeOpenWithSearch("deep/far", kMeOpenModeRDONLY), -1);
    setenv("KARMA_FILES", "../own", 1);
    ck_assert_str_eq(MeGetDefaultFileLocation(0), "../own");
    ck_assert_str_eq(contentOf(MeOpenWithSearch("deep\\far", kMeOpenModeRDONLY)), "far");
    ck_assert_str_eq(contentOf(MeOpenWithSearch("other/far", kMeOpenModeRDONLY)), "last part");
    ck_assert_str_eq(contentOf(MeOpenWithSearch("near", kMeOpenModeRDONLY)), "near");
    int i = 0;
    while (MeGetDefaultFileLocation(i))
        i++;
    ck_assert(i == 6 && !MeGetDefaultFileLocation(-1) && !MeGetDefaultFileLocation(100));
}

TEST(backslashes_are_slashes_unless_there_is_such_a_file) {
    makeFile("../own/file", "in own");
    ck_assert_str_eq(contentOf(MeOpen("..\\own\\file", kMeOpenModeRDONLY)), "in own");
    ck_assert_int_eq(MeOpenRaw("..\\own\\file", kMeOpenModeRDONLY), -1);
    makeFile("a\\b", "odd");
    ck_assert_str_eq(contentOf(MeOpen("a\\b", kMeOpenModeRDONLY)), "odd");
    ck_assert_int_eq(MeClose(MeOpen("..\\own\\made", kMeOpenModeWRONLY)), 0);
    ck_assert_str_eq(contentOf(MeOpenRaw("../own/made", kMeOpenModeRDONLY)), "");
}

TEST(bad_calls_for_files_warn) {
    char byte;
    makeFile("file", "text");
    const int f = MeOpen("file", kMeOpenModeRDONLY);
    ck_assert(MeOpen(NULL, kMeOpenModeRDONLY) == -1 && MeOpenRaw(NULL, kMeOpenModeRDONLY) == -1);
    assert_warned("MeOpenRaw");
    ck_assert_int_eq(MeOpenWithSearch(NULL, kMeOpenModeRDONLY), -1);
    assert_warned("MeOpenWithSearch");
    ck_assert_int_eq(MeOpen("file", (MeOpenMode_enum)7), -1);
    assert_warned("mode 7");
    ck_assert(MeRead(f, NULL, 3) == -1 && MeRead(f, &byte, -1) == -1);
    assert_warned("MeRead");
    ck_assert_int_eq(MeRead(-1, &byte, 1), -1);
    assert_warned("MeRead");
    ck_assert_int_eq(MeWrite(f, &byte, 1), -1);
    assert_warned("MeWrite");
    ck_assert_int_eq(MeLseek(f, 0, (MeSeekOrigin_enum)3), -1);
    assert_warned("origin 3");
    ck_assert_int_eq(MeLseek(-1, 0, kMeSeekSET), -1);
    assert_warned("MeLseek");
    assert_refused(MeSaveWholeFileHandle, f, text, 3);
    ck_assert_int_eq(MeClose(f), 0);
    ck_assert_int_eq(MeClose(-1), -1);
    assert_warned("MeClose");
    assert_none(MeLoadWholeFileHandle, -1, NULL);
    ck_assert_str_eq(contentOf(MeOpen("file", kMeOpenModeRDONLY)), "text");
}

/* ---- streams ---- */

/* Reads the text by lines, and by records. */
static void readText(MeStream s) {
    char line[100];
    ck_assert_str_eq(MeStreamReadLine(line, 100, s), "first\n");
    ck_assert_str_eq(MeStreamReadLine(line, 8, s), "second,");
    ck_assert_str_eq(MeStreamReadLine(line, 100, s), " a longer one\n");
    ck_assert_str_eq(MeStreamReadLine(line, 100, s), "\n");
    ck_assert_str_eq(MeStreamReadLine(line, 100, s), "last");
    ck_assert_ptr_null(MeStreamReadLine(line, 100, s));
    MeStreamRewind(s);
    ck_assert_uint_eq(MeStreamRead(line, 5, 1, s), 1);
    ck_assert_int_eq(memcmp(line, "first", 5), 0);
    ck_assert_uint_eq(MeStreamRead(line, 20, 10, s), 1);
    ck_assert_uint_eq(MeStreamRead(line, 20, 0, s), 0);
}

TEST(a_stream_of_a_file_is_read_and_written) {
    MeStream s = MeStreamOpen("stream", kMeOpenModeRDWR);
    ck_assert_uint_eq(MeStreamWrite(text, 1, sizeof text - 1, s), sizeof text - 1);
    MeStreamRewind(s);
    readText(s);
    MeStreamRewind(s);
    char five[5];
    ck_assert_uint_eq(MeStreamRead(five, 5, 1, s), 1);
    ck_assert_uint_eq(MeStreamWrite("!", 1, 1, s), 1);
    ck_assert_uint_eq(MeStreamRead(five, 5, 1, s), 1);
    ck_assert_int_eq(memcmp(five, "secon", 5), 0);
    MeStreamClose(s);
    ck_assert_int_eq(memcmp(contentOf(MeOpen("stream", kMeOpenModeRDONLY)), "first!second", 12), 0);
    makeFile("../resources/found", text);
    ck_assert_ptr_null(MeStreamOpen("found", kMeOpenModeRDONLY));
    s = MeStreamOpenWithSearch("found", kMeOpenModeRDONLY);
    readText(s);
    MeStreamClose(s);
}

TEST(a_stream_of_memory_is_read_and_written) {
    for (int slow = 0; slow < 2; slow++) {
        MeStream s = MeStreamOpenAsMemBuffer(slow ? 10 : 0);
        MeStreamMemBufferUseConservativeGrowth(s, slow);
        for (size_t i = 0; i < sizeof text - 1; i++)
            ck_assert_uint_eq(MeStreamWrite(text + i, 1, 1, s), 1);
        MeStreamMemBufferFreeSlackSpace(s);
        MeStreamRewind(s);
        readText(s);
        MeStreamRewind(s);
        MeStreamWrite("FIRST", 5, 1, s);
        char line[100];
        MeStreamRewind(s);
        ck_assert_str_eq(MeStreamReadLine(line, 100, s), "FIRST\n");
        MeStreamClose(s);
    }
}

TEST(a_stream_of_the_programs_memory_leaves_it_when_it_is_full) {
    char buffer[8] = "abcd", line[100];
    MeStream s = MeStreamCreateFromMemBuffer(buffer, 4, 8);
    ck_assert_str_eq(MeStreamReadLine(line, 100, s), "abcd");
    MeStreamWrite("efgh", 1, 4, s);
    ck_assert_int_eq(memcmp(buffer, "abcdefgh", 8), 0);
    MeStreamWrite("ij", 1, 2, s);
    MeStreamRewind(s);
    MeStreamWrite("A", 1, 1, s);
    ck_assert_int_eq(memcmp(buffer, "abcdefgh", 8), 0);
    MeStreamRewind(s);
    ck_assert_str_eq(MeStreamReadLine(line, 100, s), "Abcdefghij");
    MeStreamClose(s);
    s = MeStreamCreateFromMemBuffer(text, sizeof text - 1, sizeof text - 1);
    readText(s);
    MeStreamClose(s);
}

TEST(bad_calls_for_streams_warn) {
    char line[4];
    ck_assert_ptr_null(MeStreamOpen("none", kMeOpenModeRDONLY));
    assert_silent();
    assert_none(MeStreamOpen, NULL, kMeOpenModeRDONLY);
    assert_none(MeStreamOpenWithSearch, NULL, kMeOpenModeRDONLY);
    ck_assert(!MeStreamCreateFromMemBuffer(NULL, 0, 4) && !MeStreamCreateFromMemBuffer(line, 5, 4));
    assert_warned("MeStreamCreateFromMemBuffer");
    ck_assert(!MeStreamRead(line, 1, 1, NULL) && !MeStreamWrite(line, 1, 1, NULL) && !MeStreamReadLine(line, 4, NULL));
    assert_warned("MeStreamReadLine");
    assert_refused(MeStreamRewind, NULL);
    MeStreamClose(NULL);
    assert_silent();
    makeFile("file", text);
    MeStream s = MeStreamOpen("file", kMeOpenModeRDONLY);
    ck_assert(!MeStreamReadLine(line, 0, s) && !MeStreamReadLine(NULL, 4, s));
    assert_warned("MeStreamReadLine");
    assert_none(MeStreamRead, NULL, 1, 1, s);
    assert_none(MeStreamRead, line, SIZE_MAX / 2, 4, s);
    assert_refused(MeStreamMemBufferFreeSlackSpace, s);
    assert_refused(MeStreamMemBufferUseConservativeGrowth, s, 1);
    MeStreamClose(s);
}
