/** @file MeCommandLine.h
 *  Command line options of a program.
 *
 *  An option is a word such as -gl, alone or with a value: "-frames 60" or "-frames=60". `arg` is the whole name of an
 *  option, with its dash; it is found in both forms. If an option is given twice, the first one is used.
 *
 *  If `eat` is true, a found option is removed, and its value as well if the function reads values. So each part of a
 *  program removes the options that it knows; the remaining words are unknown options or file names.
 *
 *  Null options stand for "no options", in which nothing is found. One object may be used by one thread at a time.
 */
#ifndef MECOMMANDLINE_H
#define MECOMMANDLINE_H

#include "MePrecision.h"

ME_BEGIN_C

/** The remaining words. Read-only: MeCommandLineOptionsEat removes words. */
typedef struct MeCommandLineOptions {
    int argc;    /**< Number of words, the program's name included. */
    char **argv; /**< argv[0] is the program's name; argv[argc] is null. */
} MeCommandLineOptions;

/**
 * Copies the arguments of main(). @a argv[0] is the program's name, "" if there is none.
 * @return options to be destroyed with MeCommandLineOptionsDestroy; null if out of memory
 */
MEPUBLIC MeCommandLineOptions *MEAPI MeCommandLineOptionsCreate(const int argc, const char **argv);
/** Frees the options and all strings returned for them. Null is allowed. */
MEPUBLIC void MEAPI MeCommandLineOptionsDestroy(MeCommandLineOptions *options);

/** Is the option given? @a eat removes only the option, in the form "-name=value" with its value. */
MEPUBLIC MeBool MEAPI MeCommandLineOptionsCheckFor(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** Is any option of a null-terminated list given? @a eat removes all options of the list. */
MEPUBLIC MeBool MEAPI MeCommandLineOptionsCheckForList(MeCommandLineOptions *options, const char *arglist[],
                                                       const MeBool eat);
/** Index of the option in argv; 0 if it is not given. */
MEPUBLIC int MEAPI MeCommandLineOptionsGetPos(MeCommandLineOptions *options, const char *arg);

/** @name The value of an option
 *  A missing option returns 0 or null. An option without a value, or with text where a number is expected, warns and
 *  returns the same. The value is the word after the option, unless that word is an option itself: begins with a dash
 *  and is not a number. After "=" any text is a value.
 *  @{ */
/** A decimal integer. */
MEPUBLIC int MEAPI MeCommandLineOptionsGetNumeric(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** A number in the form of strtod(), except infinity and NaN. */
MEPUBLIC double MEAPI MeCommandLineOptionsGetFloat(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** A string, owned by the options and valid as long as they exist, eaten or not. */
MEPUBLIC char *MEAPI MeCommandLineOptionsGetString(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** @} */

/** Removes the words at @a num_eat indices of argv, in any order. Index 0, the program's name, and indices out of range
 *  warn and are skipped. */
MEPUBLIC void MEAPI MeCommandLineOptionsEat(MeCommandLineOptions *options, const int *eat, const int num_eat);

ME_END_C

#endif
