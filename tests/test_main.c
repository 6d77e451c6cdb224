/* The program of a file of tests, but for those with a main() of their own. */
#include "karma_test.h"

int main(int argc, char **argv) {
    const char *const slash = argc > 0 ? strrchr(argv[0], '/') : NULL;
    return test_main(slash ? slash + 1 : "tests");
}
