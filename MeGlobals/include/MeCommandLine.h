/** @file MeCommandLine.h
 *  The options that a program was started with (User Guide app. B, "Initializing the Renderer").
 *
 *  An option is a word such as -gl, alone or with a value: "-frames 60" or "-frames=60". The functions find
 *  an option by its whole name, as `arg` gives it with its dash, in both forms. Of an option given twice they
 *  see the first.
 *
 *  With `eat` an option that was found is removed, and its value with it when the function is one that reads
 *  values. So each part of a program takes what it knows, and what is left at the end is unknown, or a file
 *  name.
 *
 *  Programs pass null options for "no options", and then nothing is ever found. All functions are for one
 *  thread at a time per options.
 */
#ifndef MECOMMANDLINE_H
#define MECOMMANDLINE_H

#include "MePrecision.h"

ME_BEGIN_C

/** The words that have not been eaten. Read them here; to remove one use MeCommandLineOptionsEat. */
typedef struct MeCommandLineOptions {
    int argc;    /**< How many words, the program's name included. */
    char **argv; /**< argv[0] is the program's name; argv[argc] is null. */
} MeCommandLineOptions;

/**
 * Copies the arguments of main(). @a argv[0] is taken for the program's name, and is "" when there is none.
 * @return options to be destroyed with MeCommandLineOptionsDestroy; null if out of memory
 */
MEPUBLIC MeCommandLineOptions *MEAPI MeCommandLineOptionsCreate(const int argc, const char **argv);
/** Frees the options and all texts that came from them. Null is allowed. */
MEPUBLIC void MEAPI MeCommandLineOptionsDestroy(MeCommandLineOptions *options);

/** Is the option there? @a eat removes the option alone, in the form "-name=value" with its value. */
MEPUBLIC MeBool MEAPI MeCommandLineOptionsCheckFor(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** Is any option of a list there, which ends with a null? @a eat removes each of the list that is there. */
MEPUBLIC MeBool MEAPI MeCommandLineOptionsCheckForList(MeCommandLineOptions *options, const char *arglist[],
                                                       const MeBool eat);
/** Where in argv the option is; 0 if it is not there. */
MEPUBLIC int MEAPI MeCommandLineOptionsGetPos(MeCommandLineOptions *options, const char *arg);

/** @name The value of an option
 *  An option that is not there gives 0 or null. One without a value warns and gives the same, and so does one
 *  with something else than a number where a number must stand. A value is the word after the option, unless
 *  that is an option itself: begins with a dash and is no number. With "=" a value may be anything.
 *  @{ */
/** A whole number, decimal. */
MEPUBLIC int MEAPI MeCommandLineOptionsGetNumeric(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** A number as strtod() reads it, but for infinity and NaN. */
MEPUBLIC double MEAPI MeCommandLineOptionsGetFloat(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** A text, which is the options' and lives as long as they do, eaten or not. */
MEPUBLIC char *MEAPI MeCommandLineOptionsGetString(MeCommandLineOptions *options, const char *arg, const MeBool eat);
/** @} */

/** Removes the words at @a num_eat places of argv, given in any order. The program's name and places where no
 *  word is cannot be removed: that warns. */
MEPUBLIC void MEAPI MeCommandLineOptionsEat(MeCommandLineOptions *options, const int *eat, const int num_eat);

ME_END_C

#endif
