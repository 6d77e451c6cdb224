#!/usr/bin/env python3
"""One name for calls with and without user data: which calls must compile, and which must not?

usage: check_interface.py <source directory> single|double <C compiler> <C++ compiler>
"""
import pathlib
import subprocess
import sys
import tempfile

top, precision, cc, cxx = pathlib.Path(sys.argv[1]), *sys.argv[2:5]

BEFORE = '''
#include "MeViewer.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif
void MEAPI tick1(RRender *rc);
void MEAPI tick2(RRender *rc, void *userdata);
struct MyApp;
void MEAPI tick0(void);
void MEAPI tickInt(RRender *rc, int *data);
void MEAPI tickConst(RRender *rc, const double *data);
void MEAPI tickApp(RRender *rc, struct MyApp *app);
int MEAPI result0(void);
int MEAPI result1(RRender *rc);
int MEAPI result2(RRender *rc, void *userdata);
void MEAPI tickAny();
int MEAPI resultAny();
void MEAPI wrong1(RRender *rc, double x);
void MEAPI wrong2(RRender *rc, int n);
void MEAPI wrong3(RRender *rc, void *a, void *b);
void MEAPI wrong4(int *data);
void MEAPI mouseApp(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                    struct MyApp *app);
int MEAPI mouseResult(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                      void *userdata);
void MEAPI joystickInt(RRender *rc, AcmeReal x, AcmeReal y, int *data);
void MEAPI wrongMouse(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event);
void MEAPI mouse(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                 void *userdata);
void MEAPI joystick(RRender *rc, AcmeReal x, AcmeReal y, void *userdata);
void use(RRender *rc, MeMatrix4Ptr tm);
#ifdef __cplusplus
}
#endif
void use(RRender *rc, MeMatrix4Ptr tm) {
    int data = 0;
    char line[] = "line", *help[] = {line, line, line};
    const char *constantHelp[] = {"line"};
    const char *const veryConstantHelp[] = {"line"};
    RMainLoopCallBack const pointer = tick2;
    RGraphic *g = RGraphicCreateEmpty(3);
    (void)rc, (void)data, (void)help, (void)constantHelp, (void)veryConstantHelp, (void)pointer, (void)tm, (void)g;
    %s
}
'''

FORMS = ['tick0', 'tickInt', 'tickConst', 'tickApp', 'result0', 'result1', 'result2', 'tickAny', 'resultAny', '0', 'NULL']
GOOD = [
    'RRun(rc, tick1);', 'RRun(rc, tick2);', 'RRun(rc, tick1, 0);', 'RRun(rc, tick2, 0);', 'RRun(rc, tick2, &data);',
    'RRun(rc, &tick1);', 'RRun(rc, pointer, &data);', 'if (rc) RRun(rc, tick1); else RRun(rc, tick2);',
    'RRenderSetUpCallBack(rc, tick1);', 'RRenderSetDownCallBack(rc, tick2);', 'RRenderSetLeftCallBack(rc, tick2, 0);',
    'RRenderSetRightCallBack(rc, tick1, &data);', 'RRenderSetUp2CallBack(rc, tick2, &data);',
    'RRenderSetDown2CallBack(rc, tick1);', 'RRenderSetLeft2CallBack(rc, tick2);', 'RRenderSetRight2CallBack(rc, tick2);',
    'RRenderSetActionNCallBack(rc, 2, tick1);', 'RRenderSetActionNCallBack(rc, 2, tick2, 0);',
    'RRenderSetMouseCallBack(rc, mouse);', 'RRenderSetMouseCallBack(rc, mouse, &data);',
    'RRenderSetJoystickCallBack(rc, joystick, 0);', 'RRenderSetUpCallBack(rc, (RButtonPressCallBack)0);',
    'RRenderCreateUserHelp(rc, help, 3);', 'RRenderCreateUserHelp(rc, constantHelp, 1);',
    'RRenderCreateUserHelp(rc, veryConstantHelp, 1);', 'RRenderCreateUserHelp(rc, 0, 0);',
    *(f'RRun(rc, {f});' for f in FORMS), *(f'RRun(rc, {f}, &data);' for f in FORMS),
    *(f'RRenderSetUpCallBack(rc, {f});' for f in FORMS), *(f'RRenderSetActionNCallBack(rc, 2, {f}, &data);' for f in FORMS),
    *(f'RRenderSetMouseCallBack(rc, {f});' for f in ('mouseApp', 'mouseResult', 'tickAny', 'tick0', '0', 'NULL')),
    'RRenderSetMouseCallBack(rc, 0, 0);', 'RRenderSetMouseCallBack(rc, NULL, NULL);',
    *(f'RRenderSetJoystickCallBack(rc, {f}, 0);' for f in ('joystickInt', 'tickAny', 'tick0', '0', 'NULL')),
    'RRun(rc, rc ? tick2 : 0);', 'RRenderSetUpCallBack(rc, rc ? tick1 : NULL);',
    'g->m_matrix = tm; g->m_pLWMatrix = g->m_matrix;', 'RDeleteRenderContext(rc);',
    'RGraphicTextCreate(rc, "text", 0, 0, RPalette[3]);',
]
BAD = [
    'RRun();', 'RRun(rc);', 'RRun(rc, tick1, 0, 0);', 'RRun(rc, tick2, 0, 0, 0, 0);', 'RRun(rc, wrong1);',
    'RRun(rc, wrong2);', 'RRun(rc, wrong3);', 'RRun(rc, wrong4);', 'RRun(rc, mouse, 0);', 'RRun(rc, rc);', 'RRun(rc, 5);', 'RRun(rc, data);', 'RRun(rc, 1.5);',
    'RRenderSetUpCallBack(rc);', 'RRenderSetUpCallBack(rc, wrong1);', 'RRenderSetUpCallBack(rc, tick1, 0, 0);',
    'RRenderSetLeft2CallBack(rc, mouse);', 'RRenderSetActionNCallBack(rc, 2);',
    'RRenderSetActionNCallBack(rc, tick1);', 'RRenderSetActionNCallBack(rc, 2, wrong2, 0);',
    'RRenderSetActionNCallBack(rc, 2, tick1, 0, 0);', 'RRenderSetMouseCallBack(rc, tick2);',
    'RRenderSetMouseCallBack(rc);', 'RRenderSetMouseCallBack(rc, wrongMouse);', 'RRenderSetMouseCallBack(rc, 7);',
    'RRenderSetJoystickCallBack(rc, mouse);',
]
# A number where a pointer is needed is an error of its own since GCC 14; before, one has to ask for it.
LANGUAGES = [(cc, ['-std=c11', '-Wall', '-Wextra', '-Werror', '-Wpedantic'], 'c'),
             (cc, ['-std=gnu11', '-Werror=int-conversion', '-Werror=incompatible-pointer-types'], 'c'),
             (cxx, ['-std=c++17', '-Wall', '-Wextra', '-Werror', '-Wpedantic'], 'cpp')]

failures = 0
with tempfile.TemporaryDirectory() as scratch:

    def compiles(compiler, flags, suffix, calls):
        """Error messages; empty if the calls compile."""
        include = [f'-I{top}/MeViewer/include', f'-I{top}/MeGlobals/include']
        if precision == 'double':
            include.append('-D_ME_API_DOUBLE=1')
        source = pathlib.Path(scratch) / f'use.{suffix}'
        source.write_text(BEFORE % ' '.join(f'{{ {c} }}' for c in calls))
        run = subprocess.run([compiler, *flags, *include, '-fsyntax-only', str(source)], capture_output=True, text=True)
        return run.stderr if run.returncode else ''

    for language in LANGUAGES:
        for call in GOOD if compiles(*language, GOOD) else []:  # one by one only to find out which
            message = compiles(*language, [call])
            failures += message != ''
            if message:
                print(f'{language[0]} {language[1][0]}: {call} does not compile\n{message}')
        for call in BAD:
            if not compiles(*language, [call]):
                failures += 1
                print(f'{language[0]} {language[1][0]}: {call} compiles')
print(f'{len(LANGUAGES) * (len(GOOD) + len(BAD))} calls, {failures} failures')
sys.exit(failures > 0)
