/* Buffered messages (MeInternal.h). */
#include "MeInternal.h"
#include "MeAssert.h"
#include "MeMessage_i.h"
#include <stdio.h>
#include <string.h>

typedef struct MeBufferedMessage {
    struct MeBufferedMessage *next;
    MeSender sender;
    int level, key;
    char text[MeMAXMESSAGE];
} MeBufferedMessage;

/* The buffer of this thread's messages; null: sent at once. */
static _Thread_local MeMessageBuffer *activeBuffer;

MeMessageBuffer *MEAPI MeMessagesBuffer(MeMessageBuffer *buffered) {
    MeMessageBuffer *const before = activeBuffer;
    activeBuffer = buffered;
    return before;
}

/* Without memory, the message is sent at once. */
MeBool me_messageBuffer(MeSender sender, int level, const char *format, va_list ap) {
    MeMessageBuffer *const buffered = activeBuffer;
    if (!buffered)
        return MEFALSE;
    activeBuffer = NULL; /* no buffering of a message about its own memory */
    MeBufferedMessage *m = MeMemoryTake(1, sizeof *m, "MeMessagesBuffer", "a message");
    activeBuffer = buffered;
    if (!m)
        return MEFALSE;
    *m = (MeBufferedMessage){.sender = sender, .level = level, .key = buffered->key};
    vsnprintf(m->text, sizeof m->text, format, ap);
    MEASSERT((buffered->first == NULL) == (buffered->last == NULL));
    if (buffered->last)
        buffered->last->next = m;
    else
        buffered->first = m;
    buffered->last = m;
    return METRUE;
}

/* Index of the first buffer with the smallest key; -1: all are empty. */
static int bufferOfMinKey(MeMessageBuffer *const buffered[], int count) {
    int min = -1;
    for (int i = 0; i < count; i++)
        if (buffered[i]->first && (min < 0 || buffered[i]->first->key < buffered[min]->first->key))
            min = i;
    return min;
}

/* Sorts a buffer, as workers process keys in any order. */
static void sortByKey(MeMessageBuffer *buffered) {
    MeBufferedMessage *sorted = NULL, *last = NULL;
    while (buffered->first) {
        MeBufferedMessage *m = buffered->first, **at = &sorted;
        buffered->first = m->next;
        while (*at && (*at)->key <= m->key)
            at = &(*at)->next;
        m->next = *at;
        *at = m;
        if (!m->next)
            last = m;
    }
    MEASSERT((sorted == NULL) == (last == NULL));
    buffered->first = sorted;
    buffered->last = last;
}

void MEAPI MeMessagesSend(MeMessageBuffer *const buffered[], int count) {
    for (int i = 0; i < count; i++)
        sortByKey(buffered[i]);
    for (int i = bufferOfMinKey(buffered, count); i >= 0; i = bufferOfMinKey(buffered, count)) {
        MeBufferedMessage *m = buffered[i]->first;
        buffered[i]->first = m->next;
        if (!m->next)
            buffered[i]->last = NULL;
        m->sender(m->level, "%s", m->text);
        MeMemoryGive(m);
    }
}
