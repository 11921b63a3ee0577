"""test_melt.py: ice that melts, in pictures and sequences. Usage: see case.py."""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DRIVER, Case, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402

SMALL = ('--size', '40x30', '--samples', '1', '-q')
# without anisotropic filtering, which differs between drivers
STILL = ('--set', 'motion.ice=0', '--set', 'motion.lights=0', '--set', 'texture.anisotropy=1')
HAS_REFERENCE = '--without' not in sys.argv


class Melt(Case):
    def draw(self, name, *words, **how):
        self.succeed('render', *words, *SMALL, *STILL, '-o', name, **how)
        return Exr((self.folder / name).read_bytes()).read_planes(['R', 'G', 'B'])

    def check_rung(self, *rung, **how):
        """A share of 0 changes no pixel; half changes many, most of them where there was ice."""
        whole = self.draw('a.exr', 'valley', *rung, **how)
        self.assertEqual(self.draw('b.exr', 'valley', *rung, '--set', 'ice.melt=0', '--set',
                                   'motion.melt=0', **how), whole)
        half = self.draw('b.exr', 'valley', *rung, '--set', 'ice.melt=0.5', **how)
        changed = [a != b for a, b in zip(whole['G'], half['G'])]
        self.assertGreater(sum(changed), 100)
        self.assertFalse(any(changed[:40]))  # the first row is sky
        return half

    @unsanitized
    def test_rungs(self):
        bounce = self.check_rung('-r', 'bounce')
        trace = self.draw('a.exr', 'valley', '-r', 'trace', '--set', 'ice.melt=0.5')
        if HAS_REFERENCE:
            true = self.check_rung('-r', 'reference', env=NO_DRIVER)
            for seen in (bounce, trace):
                error = sum(abs(a - b) for a, b in zip(seen['G'], true['G'])) / len(true['G'])
                self.assertLess(error, 0.03)

    @unsanitized
    def test_frost_is_gone(self):
        frost = ('-r', 'one-sided', '--set', 'frost.amount=0.8', '--set', 'frost.roughness=1')
        wet = self.draw('a.exr', 'valley', *frost, '--set', 'ice.melt=0.05')
        dry = self.draw('b.exr', 'valley', '-r', 'one-sided', '--set', 'ice.melt=0.05')
        self.assertEqual(wet, dry)

    def test_sequence(self):
        """Frames of a sequence are those of pictures alone, and each is another one."""
        words = ('valley', '-r', 'one-sided', '--set', 'ice.melt=0.1', '--set',
                 'motion.melt=0.5')
        self.succeed('render', *words, *SMALL, *STILL, '--frames', '0-20x10', '-o', '##.exr')
        frames = [Exr((self.folder / f'{f:02}.exr').read_bytes()).read_planes(['G'])['G']
                  for f in (0, 10, 20)]
        self.assertNotEqual(frames[0], frames[1])
        self.assertNotEqual(frames[1], frames[2])
        alone = self.draw('a.exr', *words, '--set', 'motion.time=0.8')
        self.assertEqual(alone['G'], frames[2])

    def test_only_ice_melts(self):
        done = self.succeed('render', 'sphere', '--material', 'glass', '--size', '16x12',
                            '--samples', '1', '--set', 'ice.melt=0.5', '-o', 'a.exr')
        self.assertIn(b'ice.melt, motion.melt: no effect', done.stderr)


if __name__ == '__main__':
    main()
