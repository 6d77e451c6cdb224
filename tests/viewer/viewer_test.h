/* What the viewer's tests share: contexts from a line of options, and scratch files. */
#ifndef VIEWER_TEST_H
#define VIEWER_TEST_H

#include "MeViewer.h"
#include "karma_test.h"

#define RED    ((const float[4]){0.8f, 0.1f, 0.1f, 1})
#define GREEN  ((const float[4]){0.1f, 0.7f, 0.1f, 1})
#define BLUE   ((const float[4]){0.1f, 0.2f, 0.8f, 1})
#define WHITE  ((const float[4]){1, 1, 1, 1})
#define BROKEN ((const float[4]){1, NAN, 0, 1})

/* Options from a text such as "-null -frames 3"; to be destroyed. */
static inline MeCommandLineOptions *make_options(const char *line) {
    char words[512];
    const char *argv[32] = {"test"};
    int argc = 1;
    snprintf(words, sizeof words, "%s", line);
    for (char *word = strtok(words, " "); word && argc < 32; word = strtok(NULL, " "))
        argv[argc++] = word;
    return MeCommandLineOptionsCreate(argc, argv);
}

/* A context with these options. */
static inline RRender *make_context(const char *line) {
    MeCommandLineOptions *options = make_options(line);
    RRender *rc = RRenderContextCreate(options, NULL, 0);
    MeCommandLineOptionsDestroy(options);
    ck_assert_ptr_nonnull(rc);
    return rc;
}

/* A file in the working directory with these bytes. */
static inline void make_file(const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(name, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(bytes, 1, size, file), size);
    ck_assert_int_eq(fclose(file), 0);
}

#endif
