"""test_cache.py: tests the cache of compiled pipelines between runs. Usage: see case.py."""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import BARE, PLAIN, Case, main, unsanitized  # noqa: E402

COMMANDS = (('render', 'sphere', *BARE, '-o', 'a.png', '-q'),
            ('profile', 'sphere', *BARE, '--runs', '2', '--warmup', '1', '--clock', 'submits',
             '--json', 'a.json', '-q'))


class Cache(Case):
    def setUp(self):
        super().setUp()
        self.cache = self.folder / 'cache' / 'firn'

    def run_with_cache(self, *words):
        return self.succeed(*words, env={'XDG_CACHE_HOME': self.cache.parent}).stderr.decode()

    def test_a_run_leaves_one_file(self):
        for command in COMMANDS:
            self.assertEqual(self.run_with_cache(*command), '')
            self.assertEqual(len(list(self.cache.iterdir())), 1)

    @unsanitized
    def test_none_is_wanted(self):
        for command in COMMANDS:
            self.assertEqual(self.run_with_cache(*command, '--no-cache'), '')
            self.assertFalse(self.cache.exists())

    def test_what_others_can_write_is_not_read(self):
        command = COMMANDS[0]
        self.run_with_cache(*command)
        file = next(self.cache.iterdir())
        for path, mode in ((file, 0o620), (file, 0o602), (self.cache, 0o777)):
            with self.subTest(path=path, mode=oct(mode)):
                path.chmod(mode)
                words = self.run_with_cache(*command)
                self.assertEqual(words, f'firn: warning: {file}: ignored because other users can '
                                        'write it or its folder\n')
                self.cache.chmod(0o700)  # the file has been written anew
                self.assertEqual(self.run_with_cache(*command), '')

    def test_a_damaged_file_costs_one_line(self):
        command = COMMANDS[0]
        self.run_with_cache(*command)
        file = next(self.cache.iterdir())
        whole = file.read_bytes()
        for damaged in (b'', whole[:-1], whole[:20] + b'\0' + whole[21:], whole * 2, b'x' * 100000):
            with self.subTest(size=len(damaged)):
                file.write_bytes(damaged)
                words = self.run_with_cache(*command, '--no-cache')
                self.assertEqual(words, '')  # not even looked at
                words = self.run_with_cache(*command)
                self.assertEqual(len(words.splitlines()), 1, words)
                self.assertTrue(words.startswith(f'firn: warning: {file}: '), words)
                self.assertEqual(file.read_bytes(), whole)
                self.assertEqual(self.run_with_cache(*command), '')

    @unsanitized
    def test_what_is_small_is_compiled_in_less_time(self):
        """Mesa keeps what it compiled in less time apart, so that its files tell."""
        files = []
        pictures = []
        for size, chosen in (('64x48', {}), ('64x48', {'GALLIVM_PERF': 'nopt'}),
                             ('64x48', {'GALLIVM_PERF': ''}),
                             ('400x400', {'GALLIVM_PERF': ''}), ('400x400', {})):
            for _ in range(2):  # Mesa 25 adds two files when it is called again
                self.succeed('render', 'sphere', *PLAIN, '--size', size, '-o', 'a.exr', '-q', env={
                    'MESA_SHADER_CACHE_DIR': self.folder / 'mesa',
                    'MESA_DISK_CACHE_MULTI_FILE': '1', **chosen})
            pictures.append((self.folder / 'a.exr').read_bytes())
            files.append(sum(path.is_file() for path in (self.folder / 'mesa').rglob('*')))
        self.assertEqual(files[0], files[1])
        self.assertGreater(files[2], files[0])
        self.assertEqual(files[3], files[4])
        self.assertEqual(pictures[0], pictures[2])


if __name__ == '__main__':
    main()
