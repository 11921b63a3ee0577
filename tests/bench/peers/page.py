"""page.py: pages of other engines in headless Chromium, from a server of their own."""
import contextlib
import http.server
import json
import pathlib
import queue
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).parent
# name: a file that tells whether it is there; what its page needs besides its own module
ENGINES = {
    'three': ('three/build/three.module.js',
              '<script type="importmap">{"imports": {"three": '
              '"/modules/three/build/three.module.js"}}</script>'),
    'babylon': ('@babylonjs/core/Engines/engine.js',
                '<script type="importmap">{"imports": {"@babylonjs/core/": '
                '"/modules/@babylonjs/core/"}}</script>'),
    'filament': ('filament/filament.wasm', '<script src="/modules/filament/filament.js"></script>'),
}
PAGE = '''<!DOCTYPE html><meta charset="utf-8"><body>
<script>window.SCENE = %s;</script>
%s
<script type="module" src="/here/%s.mjs"></script></body>
'''
CHROMIUM = ['--headless=new', '--no-sandbox', '--use-gl=angle', '--use-angle=gl-egl',
            '--ignore-gpu-blocklist', '--disable-gpu-watchdog', '--no-first-run',
            '--disable-background-networking', '--disable-component-update', '--disable-sync']
TYPES = {'.mjs': 'text/javascript', '.js': 'text/javascript', '.wasm': 'application/wasm'}
SECONDS = 300


class Handler(http.server.BaseHTTPRequestHandler):
    def answer(self, code, kind='text/plain', body=b''):
        with contextlib.suppress(ConnectionError):  # it was closed before it has heard
            self.send_response(code)
            self.send_header('Content-Type', kind)
            self.send_header('Content-Length', str(len(body)))
            self.end_headers()
            self.wfile.write(body)

    def do_GET(self):
        if self.path == '/':
            self.answer(200, 'text/html', self.server.page)
            return
        root, _, path = self.path.split('?')[0][1:].partition('/')
        folder = {'here': HERE, 'modules': self.server.modules}.get(root)
        file = folder / path if folder and '..' not in path else None
        if file and file.is_file():
            self.answer(200, TYPES.get(file.suffix, 'text/plain'), file.read_bytes())
        else:
            self.answer(404)

    def do_POST(self):
        now = time.monotonic()
        body = self.rfile.read(int(self.headers['Content-Length']))
        self.server.posted.put((self.path, now, body))
        self.answer(200)

    def log_message(self, *_):
        pass


def wait_for(server, path):
    """when it was posted, and what"""
    end = time.monotonic() + SECONDS
    while True:
        posted, now, body = server.posted.get(timeout=max(0, end - time.monotonic()))
        if posted in (path, '/result'):
            result = json.loads(body)
            if 'error' in result:
                sys.exit(f'peers.py: {server.peer}: {result["error"]}')
            return now, result


def show(chromium, modules, peer, scene, folder):
    """Seconds until the first image, and what the page posts at the end. In `folder` are caches."""
    engine = peer.split('-')[0]
    environment = {'LIBGL_ALWAYS_SOFTWARE': '1', 'GALLIUM_DRIVER': 'llvmpipe',
                   'HOME': str(folder), 'PATH': '/usr/bin:/bin'}
    with http.server.ThreadingHTTPServer(('127.0.0.1', 0), Handler) as server:
        server.peer, server.modules, server.posted = peer, modules.resolve(), queue.Queue()
        server.page = (PAGE % (json.dumps(scene), ENGINES[engine][1], engine)).encode()
        threading.Thread(target=server.serve_forever, daemon=True).start()
        begin = time.monotonic()
        browser = subprocess.Popen(
            [chromium, *CHROMIUM, f'--user-data-dir={folder}/profile',
             f'http://127.0.0.1:{server.server_address[1]}/'],
            env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            first = wait_for(server, '/first')[0]
            result = wait_for(server, '/result')[1]
        except queue.Empty:
            sys.exit(f'peers.py: {peer}: the page says nothing')
        finally:
            browser.terminate()
            browser.wait()
            server.shutdown()
    return first - begin, result
