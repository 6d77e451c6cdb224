/** @file MeMessage.h
 *  Messages: information, debugging, logs, warnings, fatal errors.
 *
 *  A message passes two replaceable functions: its handler formats it, its show function prints the text. Replace the
 *  handler to get all messages of a kind with their arguments; replace the show function to redirect the text. The
 *  level is the importance of a message: 0 is the most important. Messages with a level above their kind's limit
 *  (MeWarningLevel and so on) are dropped before the handler is called.
 *
 *  The functions are thread-safe; handlers are process-wide and must be set before use.
 *
 *  A message may be sent in the middle of any operation. Handlers and show functions may read, but must not create,
 *  destroy, enable or step anything of Karma: such calls are refused, with a warning that names them
 *  (docs/simulation.md, "Callbacks"). While a message is handled, further ones of its kind go to the standard handler.
 */
#ifndef MEMESSAGE_H
#define MEMESSAGE_H

#include "MeCall.h"
#include <stdarg.h>

ME_BEGIN_C

#define MeMAXMESSAGE 1024 /**< Maximum size of a message text in bytes, terminator included; longer texts are cut. */

#if defined(__GNUC__)
#define ME_PRINTF_LIKE(text, first) __attribute__((__format__(__printf__, text, first)))
#else
#define ME_PRINTF_LIKE(text, first)
#endif

/** Formats a message and shows it. See above for restrictions. */
typedef void(MEAPI *MeHandler)(const int level, const char *const format, va_list ap);
/** Prints a finished text, e.g. "Karma warning: ...", which ends without a newline. */
typedef void(MEAPI *MeShow)(const int level, const char *const string);

/** Runs a statement that reports something, such as a call of MeInfo, in every build. */
#define ME_REPORT(...)                                                                                                 \
    do {                                                                                                               \
        __VA_ARGS__;                                                                                                   \
    } while (0)

/** Information for the user. Shown on stdout by default. */
MEPUBLIC void MEAPI_CDECL MeInfo(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/** Information for developers of Karma or of a program. Not shown by default (MeDebugLevel). */
MEPUBLIC void MEAPI_CDECL MeDebug(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/** A line for a log. Shown on stderr by default. */
MEPUBLIC void MEAPI_CDECL MeLog(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/**
 * Misuse or a problem that Karma has handled; the program continues. Shown on stderr by default. Every Karma function
 * that gets bad input sends one, and then does what its documentation promises. The default handler shows a text twice
 * only, unless 64 other texts came in between; a handler of your own gets all of them.
 */
MEPUBLIC void MEAPI_CDECL MeWarning(const int level, const char *const format, ...) ME_PRINTF_LIKE(2, 3);
/**
 * The program cannot continue (out of memory, for instance). The default handler shows the message on stderr and calls
 * abort(). If a replaced handler returns, MeFatalError returns, and so does the function that called it, with its
 * neutral result.
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
 *  Each returns the previous one. Null restores the default.
 *  @{ */
/** Of MeInfo. */
MEPUBLIC MeHandler MEAPI MeSetInfoHandler(MeHandler n);
/** Of MeDebug. */
MEPUBLIC MeHandler MEAPI MeSetDebugHandler(MeHandler n);
/** Of MeLog. */
MEPUBLIC MeHandler MEAPI MeSetLogHandler(MeHandler n);
/** Of MeWarning. The default one shows a text twice only. */
MEPUBLIC MeHandler MEAPI MeSetWarningHandler(MeHandler n);
/** Of MeFatalError. The default one ends the program; if yours returns, functions return their neutral results. */
MEPUBLIC MeHandler MEAPI MeSetFatalErrorHandler(MeHandler n);
/** Of MeInfo; by default MeShowStdout. */
MEPUBLIC MeShow MEAPI MeSetInfoShow(MeShow n);
/** Of MeDebug. */
MEPUBLIC MeShow MEAPI MeSetDebugShow(MeShow n);
/** Of MeLog; by default MeShowStderr. */
MEPUBLIC MeShow MEAPI MeSetLogShow(MeShow n);
/** Of MeWarning; by default MeShowStderr. */
MEPUBLIC MeShow MEAPI MeSetWarningShow(MeShow n);
/** Of MeFatalError; by default MeShowStderr. */
MEPUBLIC MeShow MEAPI MeSetFatalErrorShow(MeShow n);
/** @} */

/** @name The default handlers: format, then show
 *  @{ */
/** Of MeInfo. */
MEPUBLIC void MEAPI MeHandlerInfo(const int level, const char *const format, va_list ap);
/** Of MeDebug. */
MEPUBLIC void MEAPI MeHandlerDebug(const int level, const char *const format, va_list ap);
/** Of MeLog. */
MEPUBLIC void MEAPI MeHandlerLog(const int level, const char *const format, va_list ap);
/** Of MeWarning: shows a text twice only, unless 64 other texts came in between. */
MEPUBLIC void MEAPI MeHandlerWarning(const int level, const char *const format, va_list ap);
/** Of MeFatalError: calls abort() after the text. */
MEPUBLIC void MEAPI MeHandlerFatalError(const int level, const char *const format, va_list ap);
/** @} */

/** @name Available show functions
 *  The dialog and the two "Crt" ones have no counterpart on this platform and print on stderr.
 *  @{ */
/** Prints the text and a newline on stdout. */
MEPUBLIC void MEAPI MeShowStdout(const int level, const char *const string);
/** Prints the text and a newline on stderr. */
MEPUBLIC void MEAPI MeShowStderr(const int level, const char *const string);
/** MeShowStderr. */
MEPUBLIC void MEAPI MeShowDialog(const int level, const char *const string);
/** MeShowStderr. */
MEPUBLIC void MEAPI MeShowCrtErr(const int level, const char *const string);
/** MeShowStderr. */
MEPUBLIC void MEAPI MeShowCrtWarn(const int level, const char *const string);
/** @} */

/** The part of @a path after its last directory separator: a pointer into @a path. Null for null. */
MEPUBLIC char *MEAPI MeShortenPath(char *path);

ME_END_C

#endif
