"""test_tiles.py: pictures in tiles, `firn render --tiles`, `firn merge`. Usage: see case.py."""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    CANT_CREATE, CRACKED, DATA, NO_DRIVER, NO_INPUT, SMALL_CUBE, USAGE, WRITE, Case, long, main,
    unsanitized)
from exr_file import Exr  # noqa: E402

ICE = ('valley', '--refraction', 'bounce', '--size', '96x64', '--set', 'cracks.count=4', '--set',
       'air.count=3', '--set', 'bump.strength=0', *SMALL_CUBE, '--aov', 'Z,N,thickness', '-q')


class Tiled(Case):
    def read(self, name):
        return (self.folder / name).read_bytes()

    def draw_tiles(self, tiles, count, *more):
        names = [f'tile.{i}.exr' for i in range(1, count + 1)]
        for i, name in enumerate(names, 1):
            self.succeed('render', *ICE, *more, '--tiles', tiles, '--tile', i, '-o', name)
        return names


class Tiles(Tiled):
    """A tile is a part of the picture, with its bits."""

    def compare(self, tiles, count, *more):
        self.succeed('render', *ICE, *more, '-o', 'whole.exr', '-o', 'whole.png')
        names = self.draw_tiles(tiles, count, *more)
        self.succeed('merge', *reversed(names), '-o', 'merged.exr')
        self.assertTrue(self.read('merged.exr') == self.read('whole.exr'))
        self.succeed('render', *ICE, *more, '--tiles', tiles, '-o', 'tiled.exr', '-o', 'tiled.png')
        for kind in ('exr', 'png'):
            self.assertTrue(self.read(f'tiled.{kind}') == self.read(f'whole.{kind}'))

    @unsanitized
    def test_the_picture_in_one(self):
        for tiles, count, more in (
                ('2x2', 4, ('--set', 'cracks.refract=normals', '--set', 'bump.strength=0.5')),
                ('3x1', 3, ('--size', '97x63', '-r', 'paper')),
                ('3x2', 6, ('--size', '97x63', '-r', 'paper', '--samples', '2', '--set',
                            'tonemap.resolve=filtered')),
                ('1x2', 2, ('--samples', '2', '--aov', 'all', '-r', 'wyman', '--set',
                            'inclusions.scale=0.5', '--set', 'tonemap.dither=on'))):
            with self.subTest(tiles=tiles, more=more):
                self.compare(tiles, count, *more)

    @long
    def test_other_scenes(self):
        for words in (('room', '-r', 'bounce'), ('pool', '--set', 'pool.ice=1'),
                      ('valley', '--set', 'ice_caustics.light=sun', '--show', 'caustics')):
            words = ('render', *words, '--size', '81x60', '-q')
            self.succeed(*words, '-o', 'whole.exr', '-o', 'whole.png')
            self.succeed(*words, '--tiles', '2x2', '-o', 'tiled.exr', '-o', 'tiled.png')
            for kind in ('exr', 'png'):
                self.assertTrue(self.read(f'tiled.{kind}') == self.read(f'whole.{kind}'), words)

    def test_where_a_tile_is(self):
        """Parts begin at even pixels."""
        self.succeed('render', *ICE, '--size', '51x30', '--tiles', '2x2', '--tile', '4', '-o',
                     'tile.exr')
        tile = Exr(self.read('tile.exr'))
        self.assertEqual(tile.window('dataWindow'), (24, 14, 50, 29))
        self.assertEqual(tile.window('displayWindow'), (0, 0, 50, 29))
        self.assertEqual(tile.text('firn/tile'), '4 of 2x2')

    def test_resume(self):
        words = ('render', *ICE, '--tiles', '2x2', '--tile')
        self.succeed(*words, '2', '-o', 'tile.exr')
        self.succeed(*words, '2', '-o', 'tile.exr', '--resume', env=NO_DRIVER)
        older = self.read('tile.exr')
        self.succeed(*words, '3', '-o', 'tile.exr', '--resume')
        self.assertFalse(self.read('tile.exr') == older)
        self.assertEqual(Exr(older).text('firn/tile'), '2 of 2x2')
        self.succeed('render', *ICE, '--tiles', '2x2', '-o', 'whole.exr')
        self.succeed('render', *ICE, '-o', 'whole.exr', '--resume', env=NO_DRIVER)

    def test_bad_words(self):
        for words, names in (
                (('--tiles', '2'), ['--tiles']), (('--tiles', '0x1'), ['--tiles']),
                (('--tiles', '17x1'), ['--tiles']), (('--tile', '1'), ['--tiles']),
                (('--interleaved',), ['--tiles']),
                (('--tiles', '2x2', '--tile', '5'), ['--tile']),
                (('--tiles', '5x1', '--interleaved'), ['--tiles', '--size']),
                (('--tiles', '1x5', '--interleaved'), ['--tiles', '--size']),
                (('--tiles', '5x1', '--size', '9x64'), ['--tiles', '--size']),
                (('--tiles', '1x5', '--size', '96x9'), ['--tiles', '--size']),
                (('--tiles', '2x2', '-r', 'reference'), ['reference']),
                (('--tiles', '2x2', '--tile', '1', '-o', 'a.png'), ['--tile', '.png'])):
            self.refuse(USAGE, 'render', 'sphere', '--size', '96x64', *words, env=NO_DRIVER,
                        names=names)
        self.assertEqual(self.files(), [])


class Interleaved(Tiled):
    """A tile is a small picture of all that the picture shows."""

    @long
    def test_merged_is_what_one_process_draws(self):
        for tiles, count, samples in (('2x2', 4, '1'), ('3x1', 3, '2')):
            with self.subTest(tiles=tiles, samples=samples):
                more = ('--samples', samples, '--interleaved')
                names = self.draw_tiles(tiles, count, *more)
                self.succeed('merge', *reversed(names), '-o', 'merged.exr')
                self.succeed('render', *ICE, *more, '--tiles', tiles, '-o', 'whole.exr')
                self.assertTrue(self.read('merged.exr') == self.read('whole.exr'))
                self.assertEqual(len({self.read(name) for name in names}), count)
                size = Exr(self.read(names[0])).size
                self.assertEqual(size, (96 // int(tiles[0]), 64 // int(tiles[2])))

    def test_one_tile_is_the_picture(self):
        self.succeed('render', *ICE, '-o', 'whole.exr', '-o', 'whole.png')
        self.succeed('render', *ICE, '--tiles', '1x1', '--interleaved', '-o', 'tiled.exr', '-o',
                     'tiled.png')
        self.assertTrue(Exr(self.read('whole.exr')).pixels == Exr(self.read('tiled.exr')).pixels)

    @long
    def test_near_the_picture_in_one(self):
        """Maps are coarser and numbers round in another way: no pixel is misplaced."""
        for scene, rung, tiles, limit in (('valley', 'bounce', '2x2', 0.03),
                                          ('room', 'paper', '3x1', 0.02),
                                          ('pool', 'paper', '1x2', 0.02)):
            words = (scene, '-r', rung, '--size', '96x72', '--samples', '2', *CRACKED, '-q')
            self.succeed('render', *words, '-o', 'whole.exr', '-o', 'whole.png')
            self.succeed('render', *words, '--tiles', tiles, '--interleaved', '-o', 'tiled.exr',
                         '-o', 'tiled.png')
            for kind in ('exr', 'png'):
                self.succeed('diff', f'whole.{kind}', f'tiled.{kind}', '--fail-above',
                             f'flip={limit}')

    def test_the_picture_decides_the_cubes_size(self):
        words = ('render', 'valley', '--plain', '--size', '144x144', '-r', 'paper', '--tiles',
                 '2x2', '--interleaved', '--tile', '1', '-q', '-o')
        pixels = []
        for size in ('auto', '256', '128'):
            self.succeed(*words, f'{size}.exr', '--set', f'env_cube.size={size}')
            pixels.append(Exr(self.read(f'{size}.exr')).pixels)
        self.assertTrue(pixels[0] == pixels[1])
        self.assertFalse(pixels[0] == pixels[2])

    def test_is_said_in_the_file(self):
        words = ('render', *ICE, '--tiles', '2x2', '--interleaved')
        self.succeed(*words, '-o', 'whole.exr')
        self.assertIn(' interleaved=2x2 ', Exr(self.read('whole.exr')).text('firn/settings'))
        self.succeed(*words, '--tile', '2', '-o', 'tile.exr')
        self.succeed(*words, '--tile', '2', '-o', 'tile.exr', '--resume', env=NO_DRIVER)
        self.assertEqual(Exr(self.read('tile.exr')).text('firn/tile'), '2 of 2x2 interleaved')


class Merge(Tiled):
    def setUp(self):
        super().setUp()
        self.names = self.draw_tiles('2x1', 2)

    def refuse_merge(self, code, *words, names=()):
        self.refuse(code, 'merge', *words, '-o', 'merged.exr', names=names)
        self.assertNotIn('merged.exr', self.files())

    def test_what_is_wrong(self):
        self.refuse_merge(USAGE, names=['tiles'])
        self.refuse_merge(NO_INPUT, 'gone.exr', names=['gone.exr'])
        self.refuse_merge(NO_INPUT, 'tile.1.exr', names=['tile 2 of 2x1'])
        self.refuse_merge(DATA, *self.names, 'tile.1.exr', names=['tile.1.exr'])
        self.refuse(CANT_CREATE, 'merge', *self.names, '-o', 'gone/a.exr', names=['gone/a.exr'])
        self.refuse(USAGE, 'merge', *self.names, '-o', 'a.png', names=['a.png'])
        (self.folder / 'bad.exr').write_bytes(b'no picture')
        self.refuse_merge(DATA, 'tile.1.exr', 'bad.exr', names=['bad.exr'])

    @long
    def test_of_other_pictures(self):
        self.succeed('render', *ICE, '-o', 'whole.exr')
        self.refuse_merge(DATA, 'tile.1.exr', 'whole.exr', names=['whole.exr'])
        for more in (('--fov', '40'), ('--aov', 'P'), ('--size', '98x64')):
            self.succeed('render', *ICE, '--tiles', '2x1', '--tile', '2', *more, '-o', 'other.exr')
            self.refuse_merge(DATA, 'tile.1.exr', 'other.exr', names=['other.exr'])
        for more in (('2x2',), ('2x1', '--interleaved')):
            self.succeed('render', *ICE, '--tile', '2', '-o', 'other.exr', '--tiles', *more)
            self.refuse_merge(DATA, 'tile.1.exr', 'other.exr', names=['other.exr', '2x1'])

    def test_from_elsewhere(self):
        """What it says of itself, and where its pixels are, must agree."""
        for old, new in ((b'2 of 2x1', b'1 of 2x1'), (b'2 of 2x1', b'2 of 2x '),
                         (b'2 of 2x1', b'2 of 1x2'), (b'2 of 2x1', b'3 of 2x1')):
            data = self.read('tile.2.exr')
            self.assertEqual(data.count(old), 1)
            (self.folder / 'other.exr').write_bytes(data.replace(old, new))
            self.refuse_merge(DATA, 'tile.1.exr', 'other.exr', names=['other.exr'])

    def test_damaged(self):
        data = self.read('tile.2.exr')
        for size in (len(data) - 1, len(data) // 2, 100, 0):
            (self.folder / 'tile.2.exr').write_bytes(data[:size])
            self.refuse_merge(DATA, *self.names, names=['tile.2.exr'])

    def test_to_stdout(self):
        done = self.succeed('merge', *self.names, '-q', '-o', '-')
        self.assertEqual(done.stderr, b'')
        self.succeed('merge', *self.names)
        self.assertTrue(self.read('merged.exr') == done.stdout)
        with open('/dev/full', 'wb') as full:
            self.assertEqual(self.firn('merge', *self.names, '-o', '-', stdout=full).returncode,
                             WRITE)


if __name__ == '__main__':
    main()
