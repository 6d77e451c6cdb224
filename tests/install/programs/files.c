/* A program's own data file, found by its last part in a directory beside it, read by bytes and by lines. */
#define _DEFAULT_SOURCE
#include "Mst.h"
#include "MeSimpleFile.h"
#include "MeStream.h"
#include <sys/stat.h>

int main(void) {
    char line[32];
    int size = 0;
    if (mkdir("resources", 0777))
        return 1;
    MeStream out = MeStreamOpen("resources/track.txt", kMeOpenModeWRONLY);
    char text[] = "2\n1.5 2.5\n";
    MeStreamWrite(text, 1, strlen(text), out);
    MeStreamClose(out);

    int f = MeOpenWithSearch("D:\\game\\track.txt", kMeOpenModeRDONLY);
    if (f < 0 || MeOpenWithSearch("none.txt", kMeOpenModeRDONLY) != -1)
        return 2;
    if (MeLseek(f, 2, kMeSeekSET) != 2 || MeRead(f, line, 3) != 3 || memcmp(line, "1.5", 3))
        return 3;
    char *all = MeLoadWholeFileHandle(f, &size);
    if (size != (int)strlen(text) || strcmp(all, text))
        return 4;
    MeMemoryAPI.destroy(all);
    MeClose(f);

    MeStream in = MeStreamOpenWithSearch("track.txt", kMeOpenModeRDBINARY);
    double a = 0, b = 0;
    if (!MeStreamReadLine(line, sizeof line, in) || atoi(line) != 2 || !MeStreamReadLine(line, sizeof line, in))
        return 5;
    sscanf(line, "%lf %lf", &a, &b);
    const int atEnd = !MeStreamReadLine(line, sizeof line, in);
    MeStreamClose(in);
    return a != 1.5 || b != 2.5 || !atEnd;
}
