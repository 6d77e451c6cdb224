/** @file MeMessage.h
 *  Messages: information, debugging, logs, warnings, fatal errors (User Guide ch. 6 mentions the warnings).
 *
 *  A message goes through two replaceable functions: its handler formats it, its show function prints the text.
 *  Replace the handler to see every message of a kind with its arguments; replace the show function to put the
 *  finished text elsewhere. The level says how important a message is: 0 is the most important. A message whose
 *  level is above the kind's limit (MeWarningLevel and so on) is dropped before its handler is called.
 *
 *  The functions may be called from several threads; the handlers are process-wide and are set before use.
 *
 *  A message may come in the middle of anything. Handlers and show functions may read, and must not create, destroy,
 *  enable or step anything of Karma: such calls are refused, with a warning that names them (docs/simulation.md,
 *  "Callbacks"). A message of the kind that is being handled goes to the standard handler meanwhile.
 */
#ifndef MEMESSAGE_H
#define MEMESSAGE_H

#include "MeCall.h"
#include <stdarg.h>

ME_BEGIN_C

#define MeMAXMESSAGE 1024 /**< Bytes of the longest message text, its end included; longer texts are cut. */

#if defined(__GNUC__)
#define ME_PRINTF_LIKE(text, first) __attribute__((__format__(__printf__, text, first)))
#else
#define ME_PRINTF_LIKE(text, first)
#endif

/** Formats a message and shows it. What handlers may do is said above. */
typedef void(MEAPI *MeHandler)(const int level, const char *const format, va_list ap);
/** Prints a finished text, e.g. "Karma warning: ...", which ends without a newline. */
typedef void(MEAPI *MeShow)(const int level, const char *const string);

/** Runs a statement that reports something, such as a call of MeInfo, in every build. */
#define ME_REPORT(...)                                                                                                 \
    do {                                                                                                               \
        __VA_ARGS__;                                                                                                   \
    } while (0)

/** Something that the user may like to know. Shown on stdout by default. */
MEPUBLIC void MEAPI_CDECL MeInfo(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/** Something that the developer of Karma or of a program may like to know. Not shown by default (MeDebugLevel). */
MEPUBLIC void MEAPI_CDECL MeDebug(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/** A line for a log. Shown on stderr by default. */
MEPUBLIC void MEAPI_CDECL MeLog(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/**
 * Misuse or trouble that Karma has dealt with; the program goes on. Shown on stderr by default.
 * Every Karma function that is given bad input says so here and then does what its documentation promises. The default
 * handler shows a text twice and not again, unless 64 others came between; a handler of your own gets each of them.
 */
MEPUBLIC void MEAPI_CDECL MeWarning(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/**
 * The program cannot go on (out of memory, for instance). The default handler shows the message on stderr and
 * calls abort(). With a handler that returns, MeFatalError returns, and so does the function that called it, with
 * its neutral result.
 */
MEPUBLIC void MEAPI_CDECL MeFatalError(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);

/** @name Limits: messages of a higher level are dropped
 *  @{ */
extern MEPUBLIC int MeInfoLevel;       /**< Default 1. */
extern MEPUBLIC int MeDebugLevel;      /**< Default -1: none. */
extern MEPUBLIC int MeLogLevel;        /**< Default 1. */
extern MEPUBLIC int MeWarningLevel;    /**< Default 5. */
extern MEPUBLIC int MeFatalErrorLevel; /**< Default 5. */
/** @} */

/** @name The handlers in use; set them with the functions below
 *  @{ */
extern MEPUBLIC MeHandler MeInfoHandler, MeDebugHandler, MeLogHandler, MeWarningHandler, MeFatalErrorHandler;
extern MEPUBLIC MeShow MeInfoShow, MeDebugShow, MeLogShow, MeWarningShow, MeFatalErrorShow;
/** @} */

/** @name Replacing a handler or a show function
 *  Each returns the one that was in use. Null brings the default back.
 *  @{ */
MEPUBLIC MeHandler MEAPI MeSetInfoHandler(MeHandler n);
MEPUBLIC MeHandler MEAPI MeSetDebugHandler(MeHandler n);
MEPUBLIC MeHandler MEAPI MeSetLogHandler(MeHandler n);
MEPUBLIC MeHandler MEAPI MeSetWarningHandler(MeHandler n);
MEPUBLIC MeHandler MEAPI MeSetFatalErrorHandler(MeHandler n);
MEPUBLIC MeShow MEAPI MeSetInfoShow(MeShow n);
MEPUBLIC MeShow MEAPI MeSetDebugShow(MeShow n);
MEPUBLIC MeShow MEAPI MeSetLogShow(MeShow n);
MEPUBLIC MeShow MEAPI MeSetWarningShow(MeShow n);
MEPUBLIC MeShow MEAPI MeSetFatalErrorShow(MeShow n);
/** @} */

/** @name The default handlers: format, then show
 *  @{ */
MEPUBLIC void MEAPI MeHandlerInfo(const int level, const char *const format, va_list ap);
MEPUBLIC void MEAPI MeHandlerDebug(const int level, const char *const format, va_list ap);
MEPUBLIC void MEAPI MeHandlerLog(const int level, const char *const format, va_list ap);
MEPUBLIC void MEAPI MeHandlerWarning(const int level, const char *const format, va_list ap);
MEPUBLIC void MEAPI MeHandlerFatalError(const int level, const char *const format, va_list ap);
/** @} */

/** @name Show functions to choose from
 *  The dialog and the two "Crt" ones have no counterpart on this platform and print on stderr.
 *  @{ */
MEPUBLIC void MEAPI MeShowStdout(const int level, const char *const string);
MEPUBLIC void MEAPI MeShowStderr(const int level, const char *const string);
MEPUBLIC void MEAPI MeShowDialog(const int level, const char *const string);
MEPUBLIC void MEAPI MeShowCrtErr(const int level, const char *const string);
MEPUBLIC void MEAPI MeShowCrtWarn(const int level, const char *const string);
/** @} */

/** The part of @a path after its last directory separator: a pointer into @a path. Null for null. */
MEPUBLIC char *MEAPI MeShortenPath(char *path);

ME_END_C

#endif
