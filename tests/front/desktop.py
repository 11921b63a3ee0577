"""desktop.py: a private screen for tests of windows: Xvfb, a window manager, simulated input."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

XDND = pathlib.Path(__file__).with_name('xdnd.py')
PATIENCE = 120  # seconds until an event that should happen is considered missing
HANG = 10 * PATIENCE  # seconds until a program of the desktop is considered to hang


def wait_until(what, happens, words=lambda: '', patience=PATIENCE, act=None, again=PATIENCE / 4):
    """
    Returns the first true value of happens(). A failure quotes words(). Calls act() first, and
    again after `again` seconds in vain, because on a busy machine a key or a click now and then
    reaches no window. Only time asleep counts: act() and happens() take longer there, too.
    """
    waited = next_act = 0.0
    while waited < patience:
        if act and waited >= next_act:
            next_act = waited + again
            act()
        value = happens()
        if value:
            return value
        pause = min(0.02 + waited / 10, 0.2)
        time.sleep(pause)
        waited += pause
    raise AssertionError(f'{what}: not after {patience:.0f} seconds\n{words()}')


class Desktop:
    """Ends what it has started, by its process, in close()."""
    def __init__(self, width=800, height=600):
        self.processes = []
        read, write = os.pipe()
        self.start('Xvfb', '-displayfd', str(write), '-nolisten', 'tcp',
                   '-screen', '0', f'{width}x{height}x24', pass_fds=[write])
        os.close(write)
        with os.fdopen(read) as numbers:
            number = numbers.readline().strip()
        if not number:
            self.close()
            raise AssertionError('Xvfb does not start')
        self.env = {**os.environ, 'DISPLAY': f':{number}'}
        self.manage()

    def manage(self):
        """
        Starts a window manager, and waits until it says that it has started: before, GLFW 3.3.8 can
        hang. On a busy machine openbox now and then hangs as it starts: then there is another.
        """
        with tempfile.TemporaryDirectory() as folder:
            started = pathlib.Path(folder) / 'started'
            for _ in range(3):
                self.start('openbox', '--sm-disable', '--startup', f'touch {started}',
                           env=self.env)
                try:
                    wait_until('a window manager', started.exists, patience=PATIENCE / 3)
                    return
                except AssertionError:
                    self.end(self.processes.pop())
        self.close()
        raise AssertionError('no window manager starts')

    def start(self, *command, **how):
        self.processes.append(subprocess.Popen(command, stdin=subprocess.DEVNULL,
                                               stdout=subprocess.DEVNULL,
                                               stderr=subprocess.DEVNULL, **how))

    @staticmethod
    def end(process):
        process.terminate()
        try:
            process.wait(timeout=PATIENCE / 12)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait(timeout=HANG)

    def close(self):
        for process in reversed(self.processes):
            self.end(process)

    def ask(self, *command):
        return subprocess.run(command, env=self.env, capture_output=True, text=True,
                              timeout=HANG, check=False).stdout

    def do(self, *words):
        """xdotool"""
        subprocess.run(['xdotool', *map(str, words)], env=self.env, timeout=HANG, check=True,
                       stdout=subprocess.DEVNULL)

    def find(self, title):
        """The number of the window of this title, when it is there."""
        return wait_until(f'a window called {title!r}', lambda: self.ask(
            'xdotool', 'search', '--onlyvisible', '--name', f'^{title}$').split()[:1])[0]

    def pixels(self, window):
        """RGB bytes of what the screen shows of it."""
        return subprocess.run(['import', '-window', window, '-depth', '8', 'rgb:-'], env=self.env,
                              capture_output=True, timeout=HANG, check=True).stdout

    def drop(self, window, *files):
        """Whether it takes the files."""
        return subprocess.run([sys.executable, XDND, window, *map(str, files)], env=self.env,
                              timeout=HANG, check=False).returncode == 0

    def leave(self, window):
        """Drags something over it, and is gone before it answers."""
        subprocess.run([sys.executable, XDND, window, '--leave'], env=self.env, timeout=HANG,
                       check=True)
