"""browser.py: controls a headless Chromium by its DevTools protocol through a pair of pipes.

Messages, network requests and exceptions of a page are recorded; keys are sent as from a keyboard.
When the pipes close, because the test has ended in any way, the browser exits, too.
"""
import base64
import fcntl
import json
import os
import subprocess

FLAGS = ('--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
         '--no-first-run', '--disable-background-networking', '--disable-component-update',
         '--host-resolver-rules=MAP * ~NOTFOUND', '--remote-debugging-pipe',
         '--disable-frame-rate-limit', '--disable-gpu-vsync')
KEYS = {'Tab': 9, 'Enter': 13, 'Escape': 27, 'PageUp': 33, 'PageDown': 34, 'End': 35, 'Home': 36,
        'ArrowLeft': 37, 'ArrowUp': 38, 'ArrowRight': 39, 'ArrowDown': 40, ' ': 32}


class Browser:
    """`folder`: for its profile; the caller removes it after close()."""
    def __init__(self, program, folder):
        commands, self.write = os.pipe()
        self.read, answers = os.pipe()

        def give_pipes():  # the browser reads from 3 and writes to 4
            ends = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in (commands, answers)]
            for end, number in zip(ends, (3, 4)):
                os.dup2(end, number)

        self.process = subprocess.Popen(
            [program, *FLAGS, f'--user-data-dir={folder}', 'about:blank'], preexec_fn=give_pipes,
            close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, env={'PATH': os.environ['PATH'], 'HOME': str(folder)})
        os.close(commands)
        os.close(answers)
        self.buffer, self.last_id, self.session = b'', 0, None
        self.events, self.shape = [], None
        targets = self.call('Target.getTargets')['targetInfos']
        page = next(target for target in targets if target['type'] == 'page')
        self.session = self.call('Target.attachToTarget', targetId=page['targetId'],
                                 flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log', 'Network', 'Accessibility'):
            self.call(f'{domain}.enable')
        self.call('Emulation.setFocusEmulationEnabled', enabled=True)

    def close(self):
        self.session = None
        self.call('Browser.close')
        self.process.wait()
        os.close(self.write)
        os.close(self.read)

    def message(self):
        while b'\0' not in self.buffer:
            data = os.read(self.read, 1 << 16)
            if not data:
                raise RuntimeError('the browser has gone away')
            self.buffer += data
        text, self.buffer = self.buffer.split(b'\0', 1)
        return json.loads(text)

    def call(self, method, **parameters):
        """The result of a command; what happens until then is kept in events."""
        self.last_id += 1
        command = {'id': self.last_id, 'method': method, 'params': parameters}
        if self.session:
            command['sessionId'] = self.session
        os.write(self.write, json.dumps(command).encode() + b'\0')
        while True:
            message = self.message()
            if message.get('id') == self.last_id:
                if 'error' in message:
                    raise RuntimeError(f'{method}: {message["error"]}')
                return message['result']
            self.events.append(message)

    def named(self, *methods):
        return [event['params'] for event in self.events if event['method'] in methods]

    def open(self, path, width=1200, height=900, dark=False):
        """Loads a file from scratch, and forgets what was said before."""
        self.navigate('about:blank')
        if self.shape != (width, height, dark):
            self.shape = (width, height, dark)
            self.resize(width, height)
            scheme = {'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}
            self.call('Emulation.setEmulatedMedia', features=[scheme])
        self.navigate(path.as_uri())

    def navigate(self, url):
        self.events = []
        self.call('Page.navigate', url=url)
        while not self.named('Page.loadEventFired'):
            self.events.append(self.message())

    def resize(self, width, height):
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height,
                  deviceScaleFactor=1, mobile=False)

    def run(self, expression):
        """The value of a JavaScript expression, as JSON has it."""
        done = self.call('Runtime.evaluate', expression=expression, returnByValue=True,
                         awaitPromise=True, userGesture=True)
        if 'exceptionDetails' in done:
            raise RuntimeError(done['exceptionDetails']['exception'].get('description'))
        return done['result'].get('value')

    def press(self, *keys):
        for key in keys:
            shift = 8 if key.startswith('Shift+') else 0
            name = key.removeprefix('Shift+')
            what = {'key': name, 'code': name, 'modifiers': shift}
            if name in KEYS:
                what['windowsVirtualKeyCode'] = KEYS[name]
            text = {'Enter': '\r'}.get(name, name if len(name) == 1 else '')
            self.call('Input.dispatchKeyEvent', type='keyDown', text=text, **what)
            self.call('Input.dispatchKeyEvent', type='keyUp', **what)
        self.settle()

    def settle(self):
        """Once a frame has been drawn."""
        self.run('new Promise(done => requestAnimationFrame(() => setTimeout(done)))')

    def complaints(self):
        """Everything on the console, and what was thrown."""
        return self.named('Runtime.consoleAPICalled', 'Runtime.exceptionThrown', 'Log.entryAdded')

    def requests(self):
        return [event['request']['url'] for event in self.named('Network.requestWillBeSent')]

    def pdf(self):
        return base64.b64decode(self.call('Page.printToPDF', preferCSSPageSize=True,
                                          printBackground=False)['data'])
