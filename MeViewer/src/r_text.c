/* Text: variables in it, its characters, and text as a graphic. */
#include "r_i.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* One more byte of the output, if there is room for it and for the end. */
static void append(char *out, int size, int *length, const char *text, int n) {
    for (int i = 0; i < n && *length < size - 1; i++)
        out[(*length)++] = text[i];
}

/* What a variable stands for; false if it is none. */
static bool lookUp(const RRender *rc, const char *name, int length, char *value, size_t size) {
    static const char *const buttons[] = {"UP", "DOWN", "LEFT", "RIGHT", "UP2", "DOWN2", "LEFT2", "RIGHT2"};
    static const int keys[] = {RKEY_UP, RKEY_DOWN, RKEY_LEFT, RKEY_RIGHT, 'w', 's', 'a', 'd'};
    for (int i = 0; i < kRButtons; i++) {
        if ((int)strlen(buttons[i]) == length && strncmp(name, buttons[i], (size_t)length) == 0) {
            r_keyName(keys[i], value, size);
            return true;
        }
    }
    if (length == 7 && strncmp(name, "ACTION", 6) == 0 && name[6] >= '1' && name[6] < '0' + NUM_ACTION_CALLBACKS) {
        r_keyName(rc->m_pViewer->input.actionKey[name[6] - '0'], value, size);
        return true;
    }
    if (length == 5 && strncmp(name, "MOUSE", 5) == 0) {
        snprintf(value, size, "Left mouse button");
        return true;
    }
    if (length == 7 && strncmp(name, "APPNAME", 7) == 0) {
        snprintf(value, size, "%s", rc->m_AppName);
        return true;
    }
    return false;
}

void MEAPI RParseText(RRender *rc, const char *text_in, char *text_out, int outbuffersize) {
    if (!r_isContext(rc, __func__) || !r_isPointer(text_in, __func__, "text_in") ||
        !r_isPointer(text_out, __func__, "text_out"))
        return;
    if (outbuffersize < 1) {
        MeWarning(1, "%s: outbuffersize is %d: there must be room for the text's end", __func__, outbuffersize);
        return;
    }
    int length = 0;
    while (*text_in) {
        int name = 0;
        char value[64];
        if (*text_in == '$')
            while (isupper((unsigned char)text_in[1 + name]) || isdigit((unsigned char)text_in[1 + name]))
                name++;
        if (name && lookUp(rc, text_in + 1, name, value, sizeof value)) {
            append(text_out, outbuffersize, &length, value, (int)strlen(value));
        } else {
            append(text_out, outbuffersize, &length, text_in, 1 + name);
        }
        text_in += 1 + name;
    }
    text_out[length] = 0;
}

uint32_t r_nextCharacter(const char **text) {
    const unsigned char *s = (const unsigned char *)*text;
    const int more = s[0] >= 0xf0 ? 3 : s[0] >= 0xe0 ? 2 : s[0] >= 0xc0 ? 1 : 0;
    uint32_t code = more == 3 ? s[0] & 7u : more == 2 ? s[0] & 15u : more == 1 ? s[0] & 31u : s[0];
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xc0) != 0x80) { /* Not UTF-8: take it as Latin-1. */
            *text += 1;
            return s[0];
        }
        code = code << 6 | (s[i] & 63u);
    }
    *text += 1 + more;
    return code;
}

RGraphic *MEAPI RGraphicTextCreate(RRender *rc, const char *text, AcmeReal orig_x, AcmeReal orig_y,
                                   const float color[4]) {
    char parsed[1024];
    if (!r_isContext(rc, __func__) || !r_isPointer(text, __func__, "text") || !r_isNumber(orig_x, __func__, "orig_x") ||
        !r_isNumber(orig_y, __func__, "orig_y"))
        return NULL;
    RParseText(rc, text, parsed, sizeof parsed);
    RGraphic *rg = r_graphicCreate(__func__, 0, rText);
    if (!rg)
        return NULL;
    rg->m_pPart->text = r_copyText(parsed);
    rg->m_pPart->x = orig_x;
    rg->m_pPart->y = orig_y;
    return r_graphicFinish(__func__, rc, rg, color, NULL, true);
}
