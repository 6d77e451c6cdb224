/* Messages that wait until the program may be told (MeInternal.h). */
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <stdio.h>
#include <string.h>

typedef struct MeHeldMessage {
    struct MeHeldMessage *next;
    MeSender sender;
    int level, key;
    char text[MeMAXMESSAGE];
} MeHeldMessage;

/* Null: this thread's messages do not wait. */
static _Thread_local MeHeldMessages *holder;

MeHeldMessages *MEAPI MeMessagesHold(MeHeldMessages *held) {
    MeHeldMessages *const before = holder;
    holder = held;
    return before;
}

/* Where there is no memory to keep it in, it does not wait. */
MeBool me_messageHold(MeSender sender, int level, const char *format, va_list ap) {
    MeHeldMessages *const held = holder;
    if (!held)
        return MEFALSE;
    holder = NULL; /* of memory nothing is said twice */
    MeHeldMessage *m = MeMemoryTake(1, sizeof *m, "MeMessagesHold", "a message");
    holder = held;
    if (!m)
        return MEFALSE;
    *m = (MeHeldMessage){.sender = sender, .level = level, .key = held->key};
    vsnprintf(m->text, sizeof m->text, format, ap);
    if (held->last)
        held->last->next = m;
    else
        held->first = m;
    held->last = m;
    return METRUE;
}

/* The first of those with the least key; -1: none waits. */
static int leastOf(MeHeldMessages *const held[], int count) {
    int least = -1;
    for (int i = 0; i < count; i++)
        if (held[i]->first && (least < 0 || held[i]->first->key < held[least]->first->key))
            least = i;
    return least;
}

/* A worker takes keys in any order. */
static void sortByKey(MeHeldMessages *held) {
    MeHeldMessage *sorted = NULL, *last = NULL;
    while (held->first) {
        MeHeldMessage *m = held->first, **at = &sorted;
        held->first = m->next;
        while (*at && (*at)->key <= m->key)
            at = &(*at)->next;
        m->next = *at;
        *at = m;
        if (!m->next)
            last = m;
    }
    held->first = sorted;
    held->last = last;
}

void MEAPI MeMessagesSend(MeHeldMessages *const held[], int count) {
    for (int i = 0; i < count; i++)
        sortByKey(held[i]);
    for (int i = leastOf(held, count); i >= 0; i = leastOf(held, count)) {
        MeHeldMessage *m = held[i]->first;
        held[i]->first = m->next;
        if (!m->next)
            held[i]->last = NULL;
        m->sender(m->level, "%s", m->text);
        MeMemoryGive(m);
    }
}
