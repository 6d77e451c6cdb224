/* Fuzzer of files and texts: valid ones with some bytes changed, read by whatever of the libraries reads such.
 *
 * A line is "Kind change ...", a change "place:count:bytes": so many bytes at a place of the kind's example (readers)
 * are replaced by these, in hexadecimal. */
#define _DEFAULT_SOURCE /* strtok_r, mkdtemp */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "MeCommandLine.h"
#include "MeMemory.h"
#include "MeSimpleFile.h"
#include "MeStream.h"
#if FUZZ_VIEWER
#include "MeViewer.h"
#include "RMesh.h"
#include "r_i.h"
#endif

enum { MAX = 1 << 14, CHANGES = 8, WORDS = 64 };

/* What is read: an example, changed; in memory, and in a file. */
typedef struct Text {
    char bytes[MAX];
    int size;
} Text;

static char directory[] = "/tmp/karma-fuzz-XXXXXX", path[80];

static MeBool writeFile(const Text *t, const char *extension) {
    snprintf(path, sizeof path, "%s/file.%s", directory, extension);
    FILE *file = fopen(path, "wb");
    const MeBool isWritten = file && fwrite(t->bytes, 1, (size_t)t->size, file) == (size_t)t->size;
    return (!file || fclose(file) == 0) && isWritten;
}

/* ---- streams and files ---- */

static void readStream(MeStream stream, const Text *t) {
    char line[100];
    size_t total = 0;
    for (int n = 2; stream && MeStreamReadLine(line, n, stream); n = n % 90 + 7) {
        if ((int)strlen(line) >= n)
            fuzzFail("MeStreamReadLine wrote %d bytes for %d", (int)strlen(line), n);
        total += strlen(line);
    }
    if (total > (size_t)t->size)
        fuzzFail("a stream is longer than its file");
    MeStreamRewind(stream);
    for (int i = 1; MeStreamRead(line, (size_t)i, 3, stream) == 3; i = i % 30 + 1) {
    }
    MeStreamClose(stream);
}

static void readLines(Text *t) {
    if (!writeFile(t, "txt"))
        return;
    MeStream stream = MeStreamOpen(path, kMeOpenModeRDONLY);
    if (stream)
        readStream(stream, t);
    stream = MeStreamCreateFromMemBuffer(t->bytes, (unsigned)t->size, MAX);
    if (stream)
        readStream(stream, t);
}

static void readWhole(Text *t) {
    int size = -1;
    if (!writeFile(t, "txt"))
        return;
    const int file = MeOpen(path, kMeOpenModeRDONLY);
    char *whole = MeLoadWholeFileHandle(file, &size);
    if (whole && (size != t->size || memcmp(whole, t->bytes, (size_t)size) != 0 || whole[size] != 0))
        fuzzFail("MeLoadWholeFileHandle reads something else");
    if (whole)
        MeMemoryAPI.destroy(whole);
    MeClose(file);
}

/* ---- command lines ---- */

/* Words that begin at spaces; argv as main() has it. */
static int split(Text *t, const char *words[WORDS + 1]) {
    int count = 0;
    char *rest, *word = strtok_r(t->bytes, " ", &rest);
    for (; word && count < WORDS; word = strtok_r(NULL, " ", &rest))
        words[count++] = word;
    words[count] = NULL;
    return count;
}

static void readCommandLine(Text *t) {
    static const char *names[] = {"-a", "-name", "-n=5", "", "-", "--", "-x", NULL};
    const char *words[WORDS + 1];
    const int count = split(t, words);
    MeCommandLineOptions *o = MeCommandLineOptionsCreate(count, words);
    for (int i = 0; o && names[i]; i++) {
        const MeBool eat = i % 2;
        MeCommandLineOptionsCheckFor(o, names[i], eat);
        MeCommandLineOptionsGetPos(o, names[i]);
        MeCommandLineOptionsGetNumeric(o, names[i], eat);
        if (isnan(MeCommandLineOptionsGetFloat(o, names[i], eat)))
            fuzzFail("MeCommandLineOptionsGetFloat returns NaN");
        const char *text = MeCommandLineOptionsGetString(o, names[i], eat);
        if (text && strlen(text) > (size_t)t->size)
            fuzzFail("MeCommandLineOptionsGetString returns more than there is");
        MeCommandLineOptionsEat(o, &(int){i - 2}, 1);
    }
    MeCommandLineOptionsCheckForList(o, names, METRUE);
    MeCommandLineOptionsDestroy(o);
}

static const char textExample[] = "# a text\nfirst line 1 2 3\r\n\n\tlast 1e30 -nan";
static const char lineExample[] = "program -a 5 -name a=b -x=3.25e2 file -n 7 -a=-5 -- --help -";

#if FUZZ_VIEWER

/* ---- the viewer ---- */

static RRender *makeContext(int count, const char **words) {
    MeCommandLineOptions *o = MeCommandLineOptionsCreate(count, words);
    RRender *rc = RRenderContextCreate(o, NULL, 1);
    MeCommandLineOptionsDestroy(o);
    return rc;
}

/* Nothing but the values of options changes: others open windows, write files, or end the program. */
static void readOptions(Text *t) {
    static const char *const names[] = {"-size",   "-scale",   "-ground", "-camera",
                                        "-frames", "-quality", "-key",    "-rate"};
    const char *values[WORDS + 1], *words[2 + 2 * 8 + 1] = {"program", "-null"};
    const int count = split(t, values);
    int used = 2;
    for (int i = 0; i < count && i < 8; i++) {
        words[used++] = names[i];
        words[used++] = values[i][0] == '-' ? values[i] + 1 : values[i];
    }
    RRenderContextDestroy(makeContext(used, words));
}

static RRender *nowhere(void) {
    return makeContext(2, (const char *[]){"program", "-null", NULL});
}

static void checkGraphic(const RGraphic *g) {
    for (int i = 0; g && i < (int)g->m_pObject->m_nNumVertices; i++)
        if (isnan(g->m_pVertices[i].m_X + g->m_pVertices[i].m_NX))
            fuzzFail("a graphic has a vertex that is NaN");
}

static void readAse(Text *t) {
    static const float colour[4] = {1, 1, 1, 1};
    RRender *rc = nowhere();
    if (rc && writeFile(t, "ASE")) {
        checkGraphic(RGraphicLoadASE(rc, path, 1, 1, 1, colour, NULL));
        RGraphicLoadASENoMCD(rc, path, 2, 1, 1, colour, NULL);
        RGraphicCreate(rc, path, 1, 1, 1, colour, NULL, 0, 1);
    }
    RRenderContextDestroy(rc);
}

static void readPicture(const Text *t, const char *extension) {
    RPicture picture = {0, 0, NULL};
    if (writeFile(t, extension) && r_imageRead(path, &picture)) {
        if (picture.width < 1 || picture.height < 1 || !picture.rgba)
            fuzzFail("a picture of %d x %d pixels", picture.width, picture.height);
        volatile uint8_t last = picture.rgba[4 * (size_t)picture.width * (size_t)picture.height - 1];
        (void)last;
        free(picture.rgba);
    }
}

static void readPng(Text *t) {
    readPicture(t, "png");
}

static void readBmp(Text *t) {
    readPicture(t, "bmp");
}

static const char optionsExample[] = "640x480 1.5 checker 10,0.5,1 3 2 F1@30,Enter@60,Ctrl+Left@61,a@70,Up@10-70 60";
static const char aseExample[] =
    "*3DSMAX_ASCIIEXPORT 200\n*COMMENT \"a { *MESH } in a name\"\n*GEOMOBJECT {\n*NODE_NAME \"square\"\n*MESH {\n"
    "*MESH_NUMVERTEX 4\n*MESH_VERTEX_LIST {\n*MESH_VERTEX 0 -1.0 -1.0 0.0\n*MESH_VERTEX 1 1.0 -1.0 0.0\n"
    "*MESH_VERTEX 2 1.0 1.0 0.0\n*MESH_VERTEX 3 -1.0 1.0 0.0\n}\n*MESH_FACE_LIST {\n"
    "*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1 BC: 1 CA: 0 *MESH_SMOOTHING 1 *MESH_MTLID 0\n"
    "*MESH_FACE 1: A: 0 B: 2 C: 3 AB: 1 BC: 1 CA: 0\n}\n*MESH_TVERTLIST {\n*MESH_TVERT 0 0.25 0.75 0.0\n"
    "*MESH_TVERT 1 1.0 0.0 0.0\n}\n*MESH_TFACELIST {\n*MESH_TFACE 0 0 1 0\n}\n*MESH_NORMALS {\n"
    "*MESH_FACENORMAL 0 0 0 1\n*MESH_VERTEXNORMAL 0 0.0 2.0 0.0\n*MESH_VERTEXNORMAL 1 1.0 0.0 0.0\n}\n}\n}\n";
#endif

/* ---- examples ---- */

static Text png, bmp;

static const struct Reader {
    const char *name, *example; /* null: `bytes` */
    const Text *bytes;
    void (*read)(Text *t);
} readers[] = {
    {"Lines", textExample, NULL, readLines},
    {"Whole", textExample, NULL, readWhole},
    {"CommandLine", lineExample, NULL, readCommandLine},
#if FUZZ_VIEWER
    {"Options", optionsExample, NULL, readOptions},
    {"Ase", aseExample, NULL, readAse},
    {"Png", NULL, &png, readPng},
    {"Bmp", NULL, &bmp, readBmp},
#endif
};
enum { READERS = sizeof readers / sizeof readers[0] };

static void makePictures(void) {
    memcpy(bmp.bytes, (char[54]){'B', 'M', [10] = 54, [14] = 40, [18] = 3, [22] = 2, [26] = 1, [28] = 24}, 54);
    bmp.size = 54 + 24;
#if FUZZ_VIEWER
    uint8_t pixels[4 * 12];
    for (int i = 0; i < 48; i++)
        pixels[i] = (uint8_t)(i * 5);
    snprintf(path, sizeof path, "%s/file.png", directory);
    r_writePng(path, &(RPicture){4, 3, pixels});
    FILE *file = fopen(path, "rb");
    png.size = file ? (int)fread(png.bytes, 1, MAX, file) : 0;
    if (file)
        fclose(file);
#endif
}

static void takeExample(const struct Reader *r, Text *t) {
    if (r->bytes)
        *t = *r->bytes;
    else
        t->size = snprintf(t->bytes, MAX, "%s", r->example);
}

/* ---- changes ---- */

static int digitOf(char c) {
    return c >= 'a' ? c - 'a' + 10 : c - '0';
}

static void change(Text *t, const char *word) {
    int place, count, used = 0;
    if (sscanf(word, "%d:%d:%n", &place, &count, &used) < 2 || place < 0 || count < 0)
        return;
    const int more = used ? (int)strlen(word + used) / 2 : 0;
    place = place > t->size ? t->size : place;
    count = count > t->size - place ? t->size - place : count;
    if (t->size - count + more >= MAX)
        return;
    memmove(t->bytes + place + more, t->bytes + place + count, (size_t)(t->size - place - count));
    for (int i = 0; i < more; i++)
        t->bytes[place + i] = (char)(16 * digitOf(word[used + 2 * i]) + digitOf(word[used + 2 * i + 1]));
    t->size += more - count;
    t->bytes[t->size] = 0;
}

static void execute(char *line) {
    static Text text;
    char *rest;
    const char *name = strtok_r(line, " ", &rest);
    for (int i = 0; name && i < READERS; i++) {
        if (strcmp(name, readers[i].name) != 0)
            continue;
        takeExample(&readers[i], &text);
        for (char *word = strtok_r(NULL, " ", &rest); word; word = strtok_r(NULL, " ", &rest))
            change(&text, word);
        readers[i].read(&text);
    }
}

static void writeBytes(FuzzLine *line, FuzzRandom *random) {
    static const char *const words[] = {
        "-1", "4294967296", "1e999", "nan", "2147483647",          "0", "-", "=", "{", "}", "\"", "*MESH",
        "@",  "\n",         "%n",    " ",   "99999999999999999999"};
    if (fuzzChance(random, 50)) {
        const char *word = words[fuzzBelow(random, sizeof words / sizeof words[0])];
        for (; *word; word++)
            fuzzWrite(line, "%02x", (unsigned)(unsigned char)*word);
        return;
    }
    const int count = fuzzChance(random, 10) ? fuzzBelow(random, 300) : fuzzBelow(random, 5);
    const int same = fuzzChance(random, 30) ? fuzzBelow(random, 256) : -1;
    for (int i = 0; i < count; i++)
        fuzzWrite(line, "%02x", (unsigned)(same >= 0 ? same : fuzzBelow(random, 256)));
}

static void generate(FuzzRandom *random, int index, FuzzLine *line) {
    static Text text;
    const struct Reader *r = &readers[(random->run * 7 + index) % READERS];
    takeExample(r, &text);
    fuzzWrite(line, "%s", r->name);
    for (int i = fuzzBelow(random, CHANGES); i >= 0; i--) {
        fuzzWrite(line, " %d:%d:", fuzzBelow(random, text.size + 1),
                  fuzzChance(random, 10) ? MAX : fuzzBelow(random, 6));
        writeBytes(line, random);
    }
}

static void begin(void) {
    makePictures();
}

static void end(void) {}

/* Files are read one after the other: they have one directory, which goes with the program. */
int main(int argc, char **argv) {
    static const FuzzTarget target = {"files", 40, 5, begin, generate, execute, end};
    static const char *const extensions[] = {"txt", "ASE", "png", "bmp"};
    if (!mkdtemp(directory))
        return 2;
    const int status = fuzzMain(argc, argv, &target);
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "%s/file.%s", directory, extensions[i]);
        remove(path);
    }
    rmdir(directory);
    return status;
}
