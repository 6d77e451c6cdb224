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
#ifdef __cplusplus
extern "C" {
#endif
void MEAPI tick1(RRender *rc);
void MEAPI tick2(RRender *rc, void *userdata);
int MEAPI wrong1(RRender *rc);
void MEAPI wrong2(RRender *rc, int n);
void MEAPI wrong3(void);
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
    'g->m_matrix = tm; g->m_pLWMatrix = g->m_matrix;', 'RDeleteRenderContext(rc);',
    'RGraphicTextCreate(rc, "text", 0, 0, RPalette[3]);',
]
BAD = [
    'RRun();', 'RRun(rc);', 'RRun(rc, tick1, 0, 0);', 'RRun(rc, tick2, 0, 0, 0, 0);', 'RRun(rc, wrong1);',
    'RRun(rc, wrong2);', 'RRun(rc, wrong3);', 'RRun(rc, mouse, 0);', 'RRun(rc, rc);', 'RRun(rc, 5);',
    'RRenderSetUpCallBack(rc);', 'RRenderSetUpCallBack(rc, wrong1);', 'RRenderSetUpCallBack(rc, tick1, 0, 0);',
    'RRenderSetLeft2CallBack(rc, mouse);', 'RRenderSetActionNCallBack(rc, 2);',
    'RRenderSetActionNCallBack(rc, tick1);', 'RRenderSetActionNCallBack(rc, 2, wrong2, 0);',
    'RRenderSetActionNCallBack(rc, 2, tick1, 0, 0);', 'RRenderSetMouseCallBack(rc, tick2);',
    'RRenderSetMouseCallBack(rc);', 'RRenderSetJoystickCallBack(rc, mouse);',
]
LANGUAGES = [(cc, ['-std=c11', '-Wall', '-Wextra', '-Werror', '-Wpedantic'], 'c'), (cc, ['-std=gnu11'], 'c'),
             (cxx, ['-std=c++17', '-Wall', '-Wextra', '-Werror', '-Wpedantic'], 'cpp')]

failures = 0
with tempfile.TemporaryDirectory() as scratch:
    for compiler, flags, suffix in LANGUAGES:
        include = [f'-I{top}/MeViewer/include', f'-I{top}/MeGlobals/include']
        if precision == 'double':
            include.append('-D_ME_API_DOUBLE=1')
        for number, (call, good) in enumerate([(c, True) for c in GOOD] + [(c, False) for c in BAD]):
            source = pathlib.Path(scratch) / f'use{number}.{suffix}'
            source.write_text(BEFORE % call)
            run = subprocess.run([compiler, *flags, *include, '-fsyntax-only', str(source)], capture_output=True,
                                 text=True)
            if (run.returncode == 0) != good:
                failures += 1
                print(f'{compiler} {flags[0]}: {call} {"does not compile" if good else "compiles"}\n{run.stderr}')
print(f'{len(LANGUAGES) * (len(GOOD) + len(BAD))} calls, {failures} failures')
sys.exit(failures > 0)
