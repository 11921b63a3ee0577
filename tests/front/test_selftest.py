"""test_selftest.py: command `firn selftest`. Usage: see case.py."""
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DEVICE, NO_DRIVER, USAGE, Case, environment, main, unsanitized  # noqa: E402

GOLDENS = pathlib.Path(__file__).resolve().parents[1] / 'golden' / 'pictures'
NAMES = ('paper', 'sphere', 'teapot', 'pool', 'bounce')


class Selftest(Case):
    @unsanitized
    def test_this_machine(self):
        text = self.succeed('selftest').stdout.decode()
        self.assertRegex(text, r'\Afirn \d+\.\d+\.\d+\ndevices:\n  0  \S.*\nsandbox:\n')
        for name in NAMES:
            self.assertRegex(text, rf'(?m)^  {name} +ok, FLIP error ')
        self.assertTrue(text.endswith('\n5 passed, 0 failed\n'), text)

    def test_wrong_images(self):
        shutil.copytree(GOLDENS, self.folder / 'assets' / 'selftest')
        folder = self.folder / 'assets' / 'selftest'
        shutil.copy(folder / 'ice-cube-one-sided.exr', folder / 'ice-cube.exr')
        (folder / 'sphere.exr').write_bytes(b'not an image')
        done = self.firn('selftest', env={'FIRN_ASSETS': str(self.folder / 'assets')})
        text = done.stdout.decode()
        self.assertRegex(text, r'(?m)^  paper +FAILED, FLIP error 0\.0\d+, limit 0\.003$')
        self.assertRegex(text, r'(?m)^  sphere +FAILED$')
        self.assertTrue(text.endswith('\n3 passed, 2 failed\n'), text)
        self.assertEqual(done.returncode, 1)

    def test_no_device(self):
        done = self.firn('selftest', env=NO_DRIVER)
        self.assertEqual(done.returncode, NO_DEVICE)
        self.assertIn(b'\n  none: install a Vulkan driver', done.stdout)

    def test_fallback_driver(self):
        """If the system has no usable device, the bundled driver in lib/lavapipe is used."""
        driver = environment({}).get('VK_DRIVER_FILES')
        if not driver:
            self.skipTest('no lavapipe')
        for folder in ('bin', 'lib/lavapipe'):
            (self.folder / folder).mkdir(parents=True)
        program = shutil.copy(Case.program, self.folder / 'bin')
        env = {'PATH': '/usr/bin:/bin', 'VK_LOADER_DRIVERS_DISABLE': '*_icd*'}
        for manifest in (None, self.folder / 'lib/lavapipe/icd.json'):
            if manifest:
                shutil.copy(driver, manifest)
            text = subprocess.run([program, 'list', 'devices'], env=env, check=True,
                                  capture_output=True).stdout
            self.assertIn(b'llvmpipe' if manifest else b'none: install', text)

    def test_arguments(self):
        self.refuse(USAGE, 'selftest', 'sphere', names=['sphere'])
        self.refuse(USAGE, 'selftest', '--size', '8x8', names=['--size'])


if __name__ == '__main__':
    main()
