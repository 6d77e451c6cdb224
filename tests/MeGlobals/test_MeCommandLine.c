/* Options: finding, eating, values, misuse. */
#include "karma_test.h"

#include "MeCommandLine.h"

/* A literal list of words, the program's name first, as options. */
#define OPTIONS(...)                                                                                                   \
    create((const char *[]){"program", __VA_ARGS__}, sizeof((const char *[]){"program", __VA_ARGS__}) / sizeof(char *))

static MeCommandLineOptions *create(const char **words, size_t count) {
    MeCommandLineOptions *const options = MeCommandLineOptionsCreate((int)count, words);
    ck_assert_ptr_nonnull(options);
    return options;
}

static void destroy(MeCommandLineOptions *options) {
    assert_silent();
    MeCommandLineOptionsDestroy(options);
}

/* What is left after the program's name is exactly this, separated by spaces. */
static void assertLeft(const MeCommandLineOptions *options, const char *expected) {
    char left[256] = "";
    for (int i = 1; i < options->argc; i++) {
        strcat(left, i > 1 ? " " : "");
        strcat(left, options->argv[i]);
    }
    ck_assert_str_eq(left, expected);
    ck_assert_str_eq(options->argv[0], "program");
    ck_assert_ptr_null(options->argv[options->argc]);
}

TEST(words_are_copied) {
    char name[] = "program", word[] = "-gl";
    const char *argv[] = {name, word, NULL};
    MeCommandLineOptions *const o = create(argv, 2);
    memset(name, 'x', 3);
    memset(word, 'x', 3);
    argv[1] = NULL;
    assertLeft(o, "-gl");
    destroy(o);
}

TEST(no_words_at_all) {
    const char *argv[] = {"program", "a", NULL, "b"};
    for (int argc = -1; argc <= 0; argc++) {
        MeCommandLineOptions *const o = MeCommandLineOptionsCreate(argc, argv);
        ck_assert_int_eq(o->argc, 1);
        ck_assert_str_eq(o->argv[0], "");
        ck_assert(!MeCommandLineOptionsCheckFor(o, "a", 1));
        MeCommandLineOptionsDestroy(o);
    }
    MeCommandLineOptions *const o = MeCommandLineOptionsCreate(5, NULL);
    ck_assert_int_eq(o->argc, 1);
    MeCommandLineOptionsDestroy(o);
    MeCommandLineOptions *const p = MeCommandLineOptionsCreate(4, argv); /* stops at the null */
    ck_assert_int_eq(p->argc, 2);
    destroy(p);
}

TEST(options_are_found_and_eaten) {
    MeCommandLineOptions *const o = OPTIONS("-gl", "-frames=60", "-profile", "-gl");
    ck_assert(MeCommandLineOptionsCheckFor(o, "-profile", 0));
    ck_assert(!MeCommandLineOptionsCheckFor(o, "-prof", 0));
    ck_assert(!MeCommandLineOptionsCheckFor(o, "-profiles", 0));
    ck_assert(!MeCommandLineOptionsCheckFor(o, "program", 1));
    ck_assert(!MeCommandLineOptionsCheckFor(o, NULL, 1));
    assertLeft(o, "-gl -frames=60 -profile -gl");
    ck_assert(MeCommandLineOptionsCheckFor(o, "-gl", 1));
    assertLeft(o, "-frames=60 -profile -gl");
    ck_assert(MeCommandLineOptionsCheckFor(o, "-gl", 1));
    ck_assert(!MeCommandLineOptionsCheckFor(o, "-gl", 1));
    ck_assert(MeCommandLineOptionsCheckFor(o, "-frames", 1));
    assertLeft(o, "-profile");
    destroy(o);
}

TEST(positions) {
    MeCommandLineOptions *const o = OPTIONS("a", "-gl", "-size=3", "-gl");
    ck_assert_int_eq(MeCommandLineOptionsGetPos(o, "-gl"), 2);
    ck_assert_int_eq(MeCommandLineOptionsGetPos(o, "-size"), 3);
    ck_assert_int_eq(MeCommandLineOptionsGetPos(o, "-siz"), 0);
    ck_assert_int_eq(MeCommandLineOptionsGetPos(o, "program"), 0);
    destroy(o);
}

TEST(lists) {
    const char *renderers[] = {"-gl", "-d3d", "-null", NULL}, *empty[] = {NULL}, *others[] = {"-x", "-y", NULL};
    MeCommandLineOptions *const o = OPTIONS("-null", "file", "-gl", "-quiet");
    ck_assert(MeCommandLineOptionsCheckForList(o, renderers, 0));
    assertLeft(o, "-null file -gl -quiet");
    ck_assert(!MeCommandLineOptionsCheckForList(o, others, 1));
    ck_assert(!MeCommandLineOptionsCheckForList(o, empty, 1));
    ck_assert(!MeCommandLineOptionsCheckForList(o, NULL, 1));
    ck_assert(MeCommandLineOptionsCheckForList(o, renderers, 1));
    assertLeft(o, "file -quiet");
    ck_assert(!MeCommandLineOptionsCheckForList(o, renderers, 1));
    destroy(o);
}

TEST(numbers_in_both_forms) {
    MeCommandLineOptions *const o = OPTIONS("-frames", "60", "-seed=-7", "-step", "-0.25", "-scale=1e3", "-n", "-5");
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-frames", 0), 60);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-seed", 0), -7);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-n", 0), -5);
    ck_assert(MeCommandLineOptionsGetFloat(o, "-step", 0) == -0.25);
    ck_assert(MeCommandLineOptionsGetFloat(o, "-scale", 0) == 1000);
    ck_assert(MeCommandLineOptionsGetFloat(o, "-frames", 0) == 60);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-missing", 1), 0);
    ck_assert(MeCommandLineOptionsGetFloat(o, "-missing", 1) == 0);
    assertLeft(o, "-frames 60 -seed=-7 -step -0.25 -scale=1e3 -n -5");
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-frames", 1), 60);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-seed", 1), -7);
    ck_assert(MeCommandLineOptionsGetFloat(o, "-step", 1) == -0.25);
    assertLeft(o, "-scale=1e3 -n -5");
    destroy(o);
}

TEST(texts_outlive_being_eaten) {
    MeCommandLineOptions *const o = OPTIONS("-out", "a b.png", "-title=x=y", "-empty=", "-in", "-");
    char *const out = MeCommandLineOptionsGetString(o, "-out", 1);
    char *const title = MeCommandLineOptionsGetString(o, "-title", 1);
    char *const empty = MeCommandLineOptionsGetString(o, "-empty", 1);
    ck_assert_ptr_null(MeCommandLineOptionsGetString(o, "-missing", 1));
    assertLeft(o, "-in -");
    ck_assert_str_eq(out, "a b.png");
    ck_assert_str_eq(title, "x=y");
    ck_assert_str_eq(empty, "");
    destroy(o);
}

TEST(missing_values_warn) {
    MeCommandLineOptions *const o = OPTIONS("-in", "-out", "-5", "-frames");
    ck_assert_ptr_null(MeCommandLineOptionsGetString(o, "-in", 0)); /* -out is an option */
    assert_warned("-in");
    ck_assert_str_eq(MeCommandLineOptionsGetString(o, "-out", 0), "-5");
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-frames", 0), 0);
    assert_warned("MeCommandLineOptionsGetNumeric: option -frames has no value: write -frames VALUE");
    assert_none(MeCommandLineOptionsGetFloat, o, "-frames", 1);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-in", 1), 0);
    assert_warned("-in");
    assertLeft(o, "-out -5");
    destroy(o);
}

TEST(garbage_warns) {
    static const char *garbage[] = {"",    "x",           "60x",          "6 0",        "1.5", "0x10",
                                    "--5", "99999999999", "-99999999999", "2147483648", "1e2", "99999999999999999999"};
    for (size_t i = 0; i < sizeof garbage / sizeof garbage[0]; i++) {
        char word[64];
        snprintf(word, sizeof word, "-n=%s", garbage[i]);
        MeCommandLineOptions *const o = OPTIONS(word, "-n", "7");
        ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-n", 1), 0);
        assert_warned("whole number");
        assertLeft(o, "-n 7");
        ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-n", 1), 7);
        destroy(o);
    }
    static const char *noFloats[] = {"", "x", "1.5x", "nan", "inf", "1e999", "1,5"};
    for (size_t i = 0; i < sizeof noFloats / sizeof noFloats[0]; i++) {
        MeCommandLineOptions *const o = OPTIONS("-x", noFloats[i], "left");
        ck_assert(MeCommandLineOptionsGetFloat(o, "-x", 1) == 0);
        assert_warned("'");
        assertLeft(o, "left");
        destroy(o);
    }
}

TEST(extreme_numbers) {
    MeCommandLineOptions *const o = OPTIONS("-a=2147483647", "-b=-2147483648", "-c=1e-300");
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-a", 0), 2147483647);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(o, "-b", 0), -2147483647 - 1);
    ck_assert(MeCommandLineOptionsGetFloat(o, "-c", 0) == 1e-300);
    destroy(o);
}

TEST(positions_are_eaten_in_any_order) {
    MeCommandLineOptions *const o = OPTIONS("a", "b", "c", "d", "e");
    const int places[] = {4, 1, 4, 2};
    MeCommandLineOptionsEat(o, places, 4);
    assertLeft(o, "c e");
    MeCommandLineOptionsEat(o, places, 0);
    MeCommandLineOptionsEat(o, NULL, 0);
    assertLeft(o, "c e");
    destroy(o);
}

TEST(impossible_positions_warn) {
    MeCommandLineOptions *const o = OPTIONS("a", "b");
    static const int places[] = {0, -1, 3, 1000000};
    for (int i = 0; i < 4; i++) {
        assert_refused(MeCommandLineOptionsEat, o, &places[i], 1);
        assertLeft(o, "a b");
    }
    destroy(o);
}

TEST(null_options_are_no_options) {
    const char *list[] = {"-gl", NULL};
    const int place = 1;
    ck_assert(!MeCommandLineOptionsCheckFor(NULL, "-gl", 1));
    ck_assert(!MeCommandLineOptionsCheckForList(NULL, list, 1));
    ck_assert_int_eq(MeCommandLineOptionsGetPos(NULL, "-gl"), 0);
    ck_assert_int_eq(MeCommandLineOptionsGetNumeric(NULL, "-gl", 1), 0);
    ck_assert(MeCommandLineOptionsGetFloat(NULL, "-gl", 1) == 0);
    ck_assert_ptr_null(MeCommandLineOptionsGetString(NULL, "-gl", 1));
    MeCommandLineOptionsEat(NULL, &place, 1);
    MeCommandLineOptionsDestroy(NULL);
}
