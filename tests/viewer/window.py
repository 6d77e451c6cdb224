"""What the tests of windows share: a virtual X server, and a program in it with a hand on its keyboard and mouse."""
import contextlib
import os
import shutil
import signal
import subprocess
import sys
import time

PATIENCE = 100  # seconds for anything to happen; a slow machine with other work needs some


def fail(what):
    print(f'FAILED: {what}')
    sys.exit(1)


class Ended(Exception):
    """The program is not there any more."""


@contextlib.contextmanager
def server():
    """A display's name: Xvfb on one that it finds free itself. A program that ends early is said there, too."""
    for tool in ('Xvfb', 'xdotool'):
        if not shutil.which(tool):
            print(f'skipped: {tool} is not installed')
            sys.exit(77)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    reader, writer = os.pipe()
    # Without -noreset the server begins anew when its last client has gone, and refuses who comes meanwhile.
    process = subprocess.Popen(['Xvfb', '-displayfd', str(writer), '-screen', '0', '1280x800x24', '-nolisten', 'tcp',
                                '-noreset'], pass_fds=[writer],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as pipe:
        number = pipe.readline().strip()  # empty if the server ends
    if not number:
        fail('Xvfb does not start')
    try:
        yield f':{number}'
    except Ended as ended:
        fail(str(ended))
    finally:
        process.terminate()
        process.wait()


class Window:
    """The program, its output, and a hand on its keyboard and mouse."""

    def __init__(self, program, display, directory, *arguments):
        self.environment = dict(os.environ, DISPLAY=display)
        self.directory = directory
        self.log = os.path.join(directory, 'log')
        with open(self.log, 'wb') as log:
            self.process = subprocess.Popen([program, *arguments], cwd=directory, env=self.environment, stdout=log,
                                            stderr=subprocess.STDOUT)

    def output(self):
        with open(self.log) as log:
            return log.read()

    def wait_for(self, what, ready):
        """Until ready() gives something; then that. A program that has ended gives nothing any more: that is said at
        once."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            ended = self.process.poll() is not None
            found = ready()
            if found:
                return found
            if ended:
                raise Ended(f'the program ended with {self.process.returncode} before {what}:\n{self.output()}')
            time.sleep(0.05)
        fail(f'{what} did not happen in {PATIENCE} s, but only:\n{self.output()}')

    def expect(self, line):
        self.wait_for(f'"{line}"', lambda: line in self.output())

    def send(self, *arguments):
        run = subprocess.run(['xdotool', *arguments], env=self.environment, capture_output=True, text=True,
                             timeout=PATIENCE)
        if run.returncode:
            fail(f'xdotool {" ".join(arguments)}: {run.stderr}')
        return run.stdout.split()

    def find(self, title='Karma viewer test'):
        """Waits for the window and puts the pointer into it: without a window manager, keys go where that is."""
        search = ['xdotool', 'search', '--onlyvisible', '--name', title]

        window = self.wait_for('there was a window',
                               lambda: subprocess.run(search, env=self.environment, capture_output=True, text=True,
                                                      timeout=PATIENCE).stdout.split())[0]
        self.send('mousemove', '--window', window, '200', '150')
        return window

    def end(self):
        try:
            return self.process.wait(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            fail(f'the program does not end:\n{self.output()}')
