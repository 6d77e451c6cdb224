"""What the tests of karma-sweep share: running it in a directory of its own, and finding its processes."""
import os
import pathlib
import signal
import subprocess
import time

wrong = 0


def check(what, holds, more=''):
    global wrong
    if not holds:
        wrong += 1
        print(f'WRONG: {what}\n{str(more)[:3000]}')


def children(process):
    """The processes that a process has started and that still are, by /proc."""
    found = []
    for stat in pathlib.Path('/proc').glob('[0-9]*/stat'):
        try:
            fields = stat.read_text().rpartition(')')[2].split()
        except OSError:
            continue  # it has just ended
        if fields[0] != 'Z' and int(fields[1]) == process:
            found.append(int(stat.parent.name))
    return found


def lines_of(path):
    return path.read_bytes().count(b'\n') if path.exists() else 0


def wait_for(what, holds, seconds=60):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            check(f'{what}: not within {seconds} s', False)
            return
        time.sleep(.01)


def start(command, directory, delay=0, preexec=None, **environment):
    """In a session of its own: whoever kills its group does not kill the test."""
    return subprocess.Popen(command, cwd=directory, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            preexec_fn=preexec, start_new_session=True,
                            env=os.environ | {'SWEEP_TEST_DELAY': str(delay)} | environment)


def finish(process, seconds=60):
    """-> exit code, what was said."""
    try:
        said = process.communicate(timeout=seconds)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return None, f'it does not end within {seconds} s'
    return process.returncode, said
