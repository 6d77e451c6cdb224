/* Inside MeGlobals: messages on their way to handlers. */
#ifndef MEMESSAGE_I_H
#define MEMESSAGE_I_H

#include "MeInternal.h"
#include "MeMessage.h"
#include "MePrecision.h"

/* A function that sends a message: MeWarning and its like. */
typedef void(MEAPI_CDECL *MeSender)(const int level, const char *const format, ...);

/* Whether the message waits (MeMessagesBuffer); else it is to be sent. */
MeBool me_messageBuffer(MeSender sender, int level, const char *format, va_list ap);

/* The format under which the message goes out: under the name of MeMessagesAs, where one is set. */
const char *me_messageRename(const char *format, va_list *ap, char renamed[MeMAXMESSAGE]);
/* Whether the function of MeMessagesAs has said something already. */
MeBool me_messageIsSuppressed(void);

/* Which names messages have (MeCallerSet, MeMessagesAs) is kept in the call, and none is set; is set again. */
void me_namesSave(MeProgramCall *call);
void me_namesRestore(const MeProgramCall *call);

#endif
