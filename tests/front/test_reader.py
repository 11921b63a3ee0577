"""test_reader.py: tests what the processes that read files can do, and cannot.

Usage: see case.py. TAKEN_OVER: path of the stand-in for a parser that a file has taken over.
REFUSE_PRCTL: path of that for a container without prctl().
"""
import ctypes
import json
import os
import pathlib
import sys
import zlib

sys.dont_write_bytecode = True  # the source tree stays clean
from case import DATA, NO_DEVICE, NO_DRIVER, SMALL, Case, main  # noqa: E402

TENT = 'v 0 1 0\nv -1 -1 1\nv 1 -1 1\nv 0 -1 -1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n'
MAPPED_TENT = ('v 0 1 0\nv -1 -1 1\nv 1 -1 1\nv 0 -1 -1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n'
               'f 1/1 2/2 3/3\nf 1/1 3/2 4/3\nf 1/1 4/2 2/3\nf 2/1 4/2 3/3\n')
MARK = 'firn: warning: taken over'
# What only Landlock forbids.
READING = {'read-victim', 'read-passwords', 'read-parent', 'read-environment-of-parent'}
# What a process without a sandbox may do here; the others need more luck or rights.
FREE = {'read-victim', 'write-file', 'create-file', 'create-folder', 'link-file', 'truncate-file',
        'rename-file', 'unlink-file', 'fork', 'execute', 'socket', 'make-code'}


def has_landlock():
    return ctypes.CDLL(None).syscall(444, None, ctypes.c_size_t(0), 1) > 0


def png_of_zeros(width, height):
    """Black pixels of one bit each, in few bytes."""
    def chunk(kind, data):
        return (len(data).to_bytes(4, 'big') + kind + data +
                zlib.crc32(kind + data).to_bytes(4, 'big'))
    head = width.to_bytes(4, 'big') + height.to_bytes(4, 'big') + bytes([1, 0, 0, 0, 0])
    texels = zlib.compress(bytes((1 + (width + 7) // 8) * height), 9)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', texels) +
            chunk(b'IEND', b''))


class Reader(Case):
    def take_over(self, *arguments):
        """What the stand-in succeeded in, and what was there before is not any more."""
        victim = self.folder / 'victim'
        victim.write_text('a secret')
        victim.chmod(0o644)
        before = self.files()
        env = {'LD_PRELOAD': os.environ['TAKEN_OVER'], 'HOME': '/root', **NO_DRIVER}
        lines = self.succeed(*arguments, env=env).stderr.decode().splitlines()
        lines = [line for line in lines if '--sandbox' not in line]
        self.assertIn(MARK, lines)
        done = {line.removeprefix(f'{MARK}: ') for line in lines if line.startswith(f'{MARK}: ')}
        unchanged = (self.files() == before and victim.read_text() == 'a secret' and
                     victim.stat().st_mode & 0o777 == 0o644)
        return done, unchanged

    def test_a_reader_that_is_taken_over(self):
        models = self.folder / 'models'
        models.mkdir()
        (models / 'tent.obj').write_text(TENT)
        self.render('a.exr', '--size', '32x16')  # as a panorama, too
        allowed = set() if has_landlock() else READING
        if allowed:
            print('no Landlock: reading other files is not tested', file=sys.stderr)
        for arguments in (('graph', 'models/tent.obj'), ('diff', 'a.exr', 'a.exr'),
                          ('graph', 'sphere', '--env', 'a.exr')):
            with self.subTest(arguments):
                done, unchanged = self.take_over(*arguments)
                self.assertLessEqual(done, allowed)
                self.assertTrue(unchanged)

    def test_without_a_sandbox(self):
        """The stand-in can do what it says that it cannot; and a line says what is missing."""
        (self.folder / 'tent.obj').write_text(TENT)
        done, unchanged = self.take_over('graph', 'tent.obj', '--sandbox=off')
        self.assertLessEqual(FREE, done)
        self.assertFalse(unchanged)
        words = self.succeed('graph', 'tent.obj', '-q', '--sandbox', 'off').stderr.decode()
        self.assertRegex(words, r'\Afirn: warning: --sandbox off: .*\n\Z')
        self.refuse(2, 'graph', 'tent.obj', '--sandbox', 'some', names=['on or off'])
        listed = self.succeed('list', 'sandbox').stdout.decode()
        self.assertEqual('Landlock       version' in listed, has_landlock())

    def test_a_container_without_prctl(self):
        """A retry would fail, too; the message names the option that disables the sandbox."""
        (self.folder / 'tent.obj').write_text(TENT)
        env = {'LD_PRELOAD': os.environ['REFUSE_PRCTL'], **NO_DRIVER}
        self.refuse(NO_DEVICE, 'graph', 'tent.obj', env=env, names=['prctl', '--sandbox off'])
        self.succeed('graph', 'tent.obj', '--sandbox', 'off', env=env)

    def test_buffers_that_are_no_files(self):
        (self.folder / 'a.gltf').write_text(json.dumps({
            'asset': {'version': '2.0'}, 'buffers': [{'byteLength': 4, 'uri': 'a.bin'}],
            'bufferViews': [{'buffer': 0, 'byteLength': 4}],
            'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 1, 'type': 'SCALAR'}]}))
        buffer = self.folder / 'a.bin'
        self.refuse(DATA, 'graph', 'a.gltf', names=['a.bin', 'file not found'])
        os.mkfifo(buffer)
        self.refuse(DATA, 'graph', 'a.gltf', names=['a.bin', 'expected a regular file'])
        buffer.unlink()
        buffer.symlink_to('/etc/passwd')
        if has_landlock():
            self.refuse(DATA, 'graph', 'a.gltf', names=['a.bin', 'expected a link'])

    def test_libraries_that_are_no_files(self):
        """An OBJ file is drawn without them, and a warning says what they are."""
        (self.folder / 'a.obj').write_text('mtllib a.mtl\n' + TENT)
        library = self.folder / 'a.mtl'

        def warns(what):
            said = self.succeed('graph', 'a.obj', '-q', env=NO_DRIVER).stderr.decode()
            self.assertRegex(said, f'^firn: warning: a.obj: refers to a.mtl: {what}[^\n]*\n$')
        os.mkfifo(library)
        warns('expected a regular file')
        library.unlink()
        library.symlink_to('/dev/zero')
        warns('expected a regular file')
        library.unlink()
        library.symlink_to('/etc/passwd')
        if has_landlock():
            warns('cannot be opened: expected a link')

    def test_many_libraries(self):
        (self.folder / 'a.obj').write_text(TENT + 'mtllib a.obj\n' * 257)
        self.refuse(DATA, 'graph', 'a.obj', names=['at most 256'])

    def test_what_a_model_may_name(self):
        """Its folder, and not what a link there leads to."""
        def name_material(name):
            (self.folder / 'models' / 'a.obj').write_text(f'mtllib {name}\n{MAPPED_TENT}')
        (self.folder / 'models' / 'deep').mkdir(parents=True)
        secret = self.folder / 'secret.mtl'
        secret.write_text('newmtl m\nmap_Kd gone.png\n')
        (self.folder / 'models' / 'deep' / 'own.mtl').write_text(secret.read_text())
        (self.folder / 'models' / 'link.mtl').symlink_to(secret)
        name_material('deep/own.mtl')
        self.assertIn('gone.png', self.firn('graph', 'models/a.obj').stderr.decode())
        if has_landlock():
            name_material('link.mtl')
            self.assertNotIn('gone.png', self.firn('graph', 'models/a.obj').stderr.decode())

    def test_names_that_look_like_others(self):
        (self.folder / 'a\\..').mkdir()
        for name in ('12:30.obj', 'a\\..\\b.obj', '..%2fb.obj', 'a\\../c.obj', 'TENT.OBJ'):
            (self.folder / name).write_text(TENT)
            with self.subTest(name):
                self.succeed('graph', name)

    def test_first_bytes(self):
        """A name alone reaches no parser of another format."""
        for name, text in (('a.glb', 'BLENDER-v279'), ('a.glb', '{"asset": {"version": "2.0"}}'),
                           ('a.gltf', 'glTF\2\0\0\0'), ('a.gltf', 'solid a\nendsolid a\n'),
                           ('a.obj', 'solid a\nendsolid a\n'), ('a.obj', 'ply\nformat ascii 1.0\n'),
                           ('a.ply', TENT), ('a.ply', 'plywood\n'), ('a.stl', 'v 0 0 0\n')):
            (self.folder / name).write_text(text)
            with self.subTest(name):
                self.refuse(DATA, 'graph', name, names=[name])

    def test_formats_that_other_programs_convert(self):
        for name in ('a.usdz', 'a.usda', 'a.fbx', 'a.blend', 'a.DAE', 'a.3ds', 'a.step'):
            (self.folder / name).write_text('any content')
            with self.subTest(name):
                self.refuse(DATA, 'graph', name, names=[name, 'export the model as glTF'])

    def test_a_small_file_of_a_large_picture(self):
        """What it would need is known before it is unpacked."""
        bomb = self.folder / 'bomb.png'
        bomb.write_bytes(png_of_zeros(16384, 16384))
        self.assertLess(bomb.stat().st_size, 60000)
        self.refuse(DATA, 'diff', 'bomb.png', 'bomb.png', names=['--load-memory'])
        used = os.wait4(os.spawnv(os.P_NOWAIT, Case.program,
                                  ['firn', 'diff', str(bomb), str(bomb)]), 0)[2].ru_maxrss
        self.assertLess(used, 512 << 10)  # KiB

    def test_pictures_that_cannot_be_read(self):
        """Whoever asks, one line tells, and nothing is lost."""
        whole = self.render('a.exr')
        (self.folder / 'a.exr').write_bytes(whole[:-100])
        self.refuse(DATA, 'merge', 'a.exr', '-o', 'm.exr', names=['a.exr'])
        self.refuse(DATA, 'diff', 'a.exr', 'a.exr', names=['a.exr'])
        done = self.firn('farm', 'status', '-o', 'a.exr', '--frames', '1')
        self.assertEqual(done.returncode, 2)
        done = self.succeed('render', 'sphere', *SMALL, '--resume', '-o', 'a.exr')
        self.assertEqual((self.folder / 'a.exr').read_bytes(), whole)
        self.assertIn('a.exr', done.stderr.decode())
        self.assertFalse(pathlib.Path(self.folder / 'm.exr').exists())


if __name__ == '__main__':
    main()
