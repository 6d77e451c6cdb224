/* Which functions of the program the buttons and the mouse call. */
#include "r_i.h"

#include <ctype.h>
#include <stdio.h>

static void setText(char *where, size_t size, const char *text) {
    snprintf(where, size, "%s", text ? text : "");
}

static void setButton(RCallBackDataButton *b, RButtonPressCallBack func, RButtonPressCallBackNoData funcNoData,
                      void *userdata, const char *text) {
    b->m_Func = func;
    b->m_FuncNoData = funcNoData;
    b->m_pUserData = userdata;
    setText(b->m_Text, sizeof b->m_Text, text);
}

static RCallBackDataButton *button(RRender *rc, const char *function, RButtonList which) {
    if (!r_isContext(rc, function))
        return NULL;
    if ((int)which >= 0 && which < kRButtons)
        return &rc->m_CallBacks.m_Button[which];
    MeWarning(1, "%s: %d is not a button", function, (int)which);
    return NULL;
}

static RCallBackDataButton *action(RRender *rc, const char *function, int N) {
    if (!r_isContext(rc, function))
        return NULL;
    if (N >= 0 && N < NUM_ACTION_CALLBACKS)
        return &rc->m_CallBacks.m_Action[N];
    MeWarning(1, "%s: N is %d: it must be 0 to %d", function, N, NUM_ACTION_CALLBACKS - 1);
    return NULL;
}

/* What programs call: a macro picks the function by the form of the callback. */
static const char *nameOf(RButtonList which) {
    static const char *const names[] = {"RRenderSetUpCallBack",    "RRenderSetDownCallBack",  "RRenderSetLeftCallBack",
                                        "RRenderSetRightCallBack", "RRenderSetUp2CallBack",   "RRenderSetDown2CallBack",
                                        "RRenderSetLeft2CallBack", "RRenderSetRight2CallBack"};
    return (unsigned int)which < sizeof names / sizeof names[0] ? names[which] : "RRenderSetButtonCallBack";
}

void MEAPI RRenderSetButtonCallBack(RRender *rc, RButtonList which, RButtonPressCallBack func, void *userdata) {
    RCallBackDataButton *b = button(rc, nameOf(which), which);
    if (b)
        setButton(b, func, NULL, userdata, NULL);
}

void MEAPI RRenderSetButtonCallBackNoData(RRender *rc, RButtonList which, RButtonPressCallBackNoData func,
                                          void *unused) {
    (void)unused;
    RCallBackDataButton *b = button(rc, nameOf(which), which);
    if (b)
        setButton(b, NULL, func, NULL, NULL);
}

void MEAPI RRenderSetActionCallBack(RRender *rc, int N, RButtonPressCallBack func, void *userdata) {
    RCallBackDataButton *b = action(rc, "RRenderSetActionNCallBack", N);
    if (b)
        setButton(b, func, NULL, userdata, NULL);
}

void MEAPI RRenderSetActionCallBackNoData(RRender *rc, int N, RButtonPressCallBackNoData func, void *unused) {
    (void)unused;
    RCallBackDataButton *b = action(rc, "RRenderSetActionNCallBack", N);
    if (b)
        setButton(b, NULL, func, NULL, NULL);
}

void MEAPI RRenderSetActionNCallBackWithText(RRender *rc, int N, RButtonPressCallBack func, void *userdata,
                                             const char *text) {
    RCallBackDataButton *b = action(rc, __func__, N);
    if (b)
        setButton(b, func, NULL, userdata, text);
}

static void setWithText(RRender *rc, const char *function, RButtonList which, RButtonPressCallBack func, void *userdata,
                        const char *text) {
    RCallBackDataButton *b = button(rc, function, which);
    if (b)
        setButton(b, func, NULL, userdata, text);
}

void MEAPI RRenderSetUpCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonUp, func, userdata, text);
}

void MEAPI RRenderSetDownCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonDown, func, userdata, text);
}

void MEAPI RRenderSetLeftCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonLeft, func, userdata, text);
}

void MEAPI RRenderSetRightCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonRight, func, userdata, text);
}

void MEAPI RRenderSetUp2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonUp2, func, userdata, text);
}

void MEAPI RRenderSetDown2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonDown2, func, userdata, text);
}

void MEAPI RRenderSetLeft2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonLeft2, func, userdata, text);
}

void MEAPI RRenderSetRight2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata, const char *text) {
    setWithText(rc, __func__, kRButtonRight2, func, userdata, text);
}

void MEAPI RRenderSetMouseCallBackWithText(RRender *rc, RMouseCallBack func, void *userdata, const char *text) {
    if (!r_isContext(rc, text ? __func__ : "RRenderSetMouseCallBack"))
        return;
    RCallBackDataMouse *m = &rc->m_CallBacks.m_Mouse;
    m->m_Func = func;
    m->m_pUserData = userdata;
    setText(m->m_Text, sizeof m->m_Text, text);
}

void MEAPI RRenderSetJoystickCallBackWithText(RRender *rc, RJoystickCallBack func, void *userdata, const char *text) {
    if (!r_isContext(rc, text ? __func__ : "RRenderSetJoystickCallBack"))
        return;
    RCallBackDataJoystick *j = &rc->m_CallBacks.m_Joystick;
    j->m_Func = func;
    j->m_pUserData = userdata;
    setText(j->m_Text, sizeof j->m_Text, text);
}

void MEAPI RRenderSetActionNKey(RRender *rc, const unsigned int N, const char key) {
    if (!r_isContext(rc, __func__))
        return;
    if (N < 2 || N >= NUM_ACTION_CALLBACKS) {
        MeWarning(1, "%s: N is %u: it must be 2 to %d", __func__, N, NUM_ACTION_CALLBACKS - 1);
        return;
    }
    if (key < ' ' || key > '~') {
        MeWarning(1, "%s: the key of action %u must be a printable ASCII character", __func__, N);
        return;
    }
    const int code = tolower((unsigned char)key);
    int *keys = rc->m_pViewer->input.actionKey;
    for (unsigned i = 0; i < NUM_ACTION_CALLBACKS; i++) {
        if (i != N && keys[i] == code) {
            MeWarning(1, "%s: '%c' was the key of action %u, which has none now", __func__, key, i);
            keys[i] = RKEY_NONE;
        }
    }
    keys[N] = code;
}

void MEAPI RRenderSetKeyCallBack(RRender *rc, char key, RButtonPressCallBack func, void *userdata, const char *text) {
    if (!r_isContext(rc, __func__))
        return;
    if (key < ' ' || key > '~') {
        MeWarning(1, "%s: the key must be a printable ASCII character", __func__);
        return;
    }
    RInput *in = &rc->m_pViewer->input;
    const int code = tolower((unsigned char)key);
    size_t i = 0;
    while (i < in->extraKeys.count && in->extraKeys.items[i].key != code)
        i++;
    if (i == in->extraKeys.count) {
        if (!r_grow(in->extraKeys, 1))
            return;
        in->extraKeys.count++;
    }
    in->extraKeys.items[i].key = code;
    setButton(&in->extraKeys.items[i].button, func, NULL, userdata, text);
}

void MEAPI RRenderLeaveMouse(RRender *rc) {
    if (r_isContext(rc, __func__))
        rc->m_pViewer->input.mouseLeft = true;
}
