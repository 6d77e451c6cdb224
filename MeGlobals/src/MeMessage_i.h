/* Inside MeGlobals: processing of messages before handlers get them. */
#ifndef MEMESSAGE_I_H
#define MEMESSAGE_I_H

#include "MeInternal.h"
#include "MeMessage.h"
#include "MePrecision.h"

/* A function that sends a message, such as MeWarning. */
typedef void(MEAPI_CDECL *MeSender)(const int level, const char *const format, ...);

/* Buffers a message if the thread has a buffer (MeMessagesBuffer). False: the message must be sent now. */
MeBool me_messageBuffer(MeSender sender, int level, const char *format, va_list ap);

/* The format of a message, with its name replaced by that of MeMessagesAs if one is set. */
const char *me_messageRename(const char *format, va_list *ap, char renamed[MeMAXMESSAGE]);
/* Whether a message is to be dropped, as one was sent under the same name of MeMessagesAs already. */
MeBool me_messageIsSuppressed(void);

/* Whether p is not null. False: with the warning "function: the `what` is null". */
MeBool me_isGiven(const void *p, const char *what, const char *function);

/* Save the names for messages (MeCallerSet, MeMessagesAs) in a call and clear them; restore them. */
void me_namesSave(MeProgramCall *call);
void me_namesRestore(const MeProgramCall *call);

#endif
