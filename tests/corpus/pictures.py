"""pictures.py: kinds of malformed pictures, panoramas, tiles of pictures and profiles: entries are
name, content, what becomes of it, files beside it."""
import json
import struct
import zlib

from builders import (
    ACCEPTED, DRAWN, EITHER, REFUSED, attribute, exr, exr_head, exr_parts, exr_tiles, glb, hdr,
    hdr_line, png, png_head, png_of)

FLOAT_MAX, TINY = 3.4028234663852886e38, 1e-45
NAN, INFINITY = float('nan'), float('inf')


def windows():
    top = (1 << 31) - 1
    yield 'good.exr', exr(), DRAWN
    for name, window in (('all', (-top - 1, -top - 1, top, top)), ('wide', (0, 0, top, 3)),
                         ('high', (0, 0, 7, top)), ('wraps', (-top, 0, top, 3)),
                         ('inside-out', (7, 3, 0, 0)), ('less', (0, 0, 65535, 65535)),
                         ('area', (0, 0, 60000, 4400)), ('far', (top - 7, top - 3, top, top))):
        yield f'{name}.exr', exr(window=window), REFUSED
    yield 'no-channels.exr', exr(channels=''), REFUSED
    yield 'many-channels.exr', exr(channels=[f'c{i:04}' for i in range(5000)]), REFUSED
    yield 'other-channels.exr', exr(channels='XYZ'), EITHER
    yield 'twice.exr', exr(channels='RRR'), REFUSED
    yield 'kind.exr', exr(kind=9), REFUSED
    yield 'compression.exr', exr(compression=99), REFUSED
    for compression in range(1, 10):
        yield f'compression-{compression}.exr', exr(compression=compression), EITHER
    yield 'sampling.exr', exr(sampling=0), REFUSED
    yield 'sampling-2.exr', exr(sampling=2), REFUSED
    yield 'tiles.exr', exr(tiles=(0xffffffff, 0xffffffff, 0), flags=0x200), REFUSED
    yield 'tiles-0.exr', exr(tiles=(0, 0, 0), flags=0x200), REFUSED
    yield 'tiles-of-lines.exr', exr(tiles=(8, 4, 0)), REFUSED
    yield 'deep.exr', exr(flags=0x800), REFUSED
    yield 'parts.exr', exr(flags=0x1000), REFUSED


def parts():
    lines, deep = 'scanlineimage', 'deepscanline'
    yield 'first.exr', exr_parts(('BGR', lines), ('Z', lines)), EITHER
    yield 'second.exr', exr_parts(('Z', lines), ('BGR', lines)), ACCEPTED
    yield 'deep-second.exr', exr_parts(('BGR', lines), ('Z', deep)), EITHER
    yield 'deep-first.exr', exr_parts(('BGR', deep), ('BGR', lines)), ACCEPTED
    yield 'type.exr', exr_parts(('BGR', 'nothing')), REFUSED
    yield 'many.exr', exr_parts(*[('BGR', lines)] * 300), EITHER
    yield 'tiles.exr', exr_tiles(), ACCEPTED
    yield 'levels.exr', exr_tiles(level=1), EITHER
    yield 'ripmap.exr', exr_tiles(level=2), EITHER
    yield 'level.exr', exr_tiles(level=0x57), EITHER
    yield 'tiles-unsaid.exr', exr_tiles(flags=0), REFUSED
    for order in (1, 2, 9):
        yield f'order-{order}.exr', exr(order=order), EITHER
    for name in ('dataWindow', 'channels', 'compression'):
        yield f'no-{name}.exr', exr(without=(name,)), REFUSED
    yield 'no-displayWindow.exr', exr(without=('displayWindow',)), EITHER
    yield 'windows.exr', exr(display=(7, 3, 0, 0)), EITHER
    for name, display in (('less', (0, 1, 3, 2)), ('more', (-4, -2, 11, 5)),
                          ('apart', (100, 100, 107, 103))):
        yield f'display-{name}.exr', exr(display=display), DRAWN
    yield 'display-wide.exr', exr(display=(0, 0, 65535, 32767)), REFUSED
    yield 'display-other.exr', exr(display=(0, 0, 8, 3)), REFUSED
    yield 'envmap.exr', exr(display=(0, 0, 8, 3), more=attribute('envmap', 'envmap', b'\0')), DRAWN
    layers = [f'{layer}.{c}' for layer in ('a', 'b.c', '', '.') for c in 'BGR']
    yield 'layers.exr', exr(channels=layers), ACCEPTED
    yield 'layer-parts.exr', exr_parts(('Z', lines), (layers[:3], lines)), ACCEPTED
    yield 'layer-cut.exr', exr(channels=layers[1:3] + layers[3:5]), REFUSED
    yield 'chroma.exr', exr(channels=('BY', 'RY', 'Y')), REFUSED
    yield 'twice.exr', exr(more=attribute('dataWindow', 'box2i', bytes(16))), EITHER
    yield 'name-long.exr', exr(more=attribute('n' * 250, 'int', bytes(4)), flags=0x400), EITHER
    yield 'attribute-large.exr', exr(more=attribute('a', 'string', b'x' * (1 << 20))), ACCEPTED
    yield 'attribute-cut.exr', exr(more=b'a\0string\0\xff\xff\xff\x7f'), EITHER
    yield 'attribute-minus.exr', exr(more=b'a\0string\0\xff\xff\xff\xff'), EITHER
    yield 'attribute-type.exr', exr(more=attribute('a', 'nothing', b'abc')), EITHER
    yield 'strings.exr', exr(more=attribute('a', 'stringvector', b'\xff\xff\xff\x7f')), EITHER
    yield 'preview.exr', exr(more=attribute('preview', 'preview', b'\xff' * 8)), EITHER
    for name, numbers in (('0', [0] * 8), ('nan', [NAN] * 8), ('huge', [FLOAT_MAX] * 8),
                          ('tiny', [TINY] * 8), ('other', [.7, .3, .2, .8, .1, .1, .3, .3])):
        yield f'chromaticities-{name}.exr', exr(more=attribute(
            'chromaticities', 'chromaticities', struct.pack('<8f', *numbers))), DRAWN
    yield 'cube.exr', exr(size=(2, 12)), DRAWN
    yield 'cube-said.exr', exr(more=attribute('envmap', 'envmap', b'\1')), EITHER
    yield 'high.exr', exr(size=(4, 5)), REFUSED
    yield 'one-texel.exr', exr(size=(1, 1)), REFUSED
    yield 'least.exr', exr(size=(2, 1)), DRAWN
    yield 'gray.exr', exr(channels='Y'), ACCEPTED
    yield 'red.exr', exr(channels='R'), REFUSED
    yield 'whole.exr', exr(kind=0), EITHER
    for name, value in (('nan', NAN), ('infinity', INFINITY), ('negative', -1.0),
                        ('largest', FLOAT_MAX), ('tiny', TINY)):
        yield f'{name}.exr', exr(value=value), DRAWN


def runs():
    good = hdr_line(16, b'\x90\x80')
    yield 'good.hdr', hdr(good * 8), DRAWN
    yield 'beyond.hdr', hdr(hdr_line(16, b'\xff\x80') * 2), REFUSED
    yield 'none.hdr', hdr(hdr_line(16, b'\x00' * 40) * 8), REFUSED
    yield 'other-width.hdr', hdr(hdr_line(99, b'\x90\x80') * 8), REFUSED
    yield 'bright.hdr', hdr(hdr_line(16, b'\x90\xff') * 8), DRAWN
    yield 'vast.hdr', hdr(good, width=1 << 31, height=1 << 31), REFUSED
    yield 'wide.hdr', hdr(good, width=65536, height=65536), REFUSED
    yield 'negative.hdr', hdr(good, width=-16, height=-2), REFUSED
    yield 'zero.hdr', hdr(good, width=0, height=0), REFUSED
    yield 'form.hdr', hdr(good, form='32-bit_rle_rgb'), REFUSED
    yield 'xyz.hdr', hdr(good * 8, form='32-bit_rle_xyze'), DRAWN
    yield 'turned.hdr', hdr(good * 8, resolution='+X {1} -Y {0}'), REFUSED
    yield 'endless-header.hdr', b'#?RADIANCE\n' + b'A=1\n' * 10000, REFUSED
    yield 'no-line.hdr', b'#?RADIANCE\n' + b'x' * 100000, REFUSED
    yield 'rgbe.hdr', hdr(good * 8).replace(b'RADIANCE', b'RGBE'), ACCEPTED
    yield 'flat.hdr', hdr(b'\x80\x40\x20\x81' * 18, width=6, height=3), ACCEPTED
    yield 'flat-wide.hdr', hdr(b'\x80\x40\x20\x81' * 40000, width=40000, height=1), REFUSED
    yield 'old-runs.hdr', hdr(b'\x80\x40\x20\x81' + b'\1\1\1\x07' * 11, width=6, height=3), EITHER
    texel = b'\x80\x40\x20\x81'
    yield 'old-runs-good.hdr', hdr((texel + b'\1\1\1\x0f') * 8), ACCEPTED
    yield 'old-runs-first.hdr', hdr(b'\1\1\1\x10' * 8), REFUSED
    yield 'old-runs-shift.hdr', hdr((texel + b'\1\1\1\0' * 9 + b'\1\1\1\x0f') * 8), REFUSED
    yield 'columns.hdr', hdr(hdr_line(8, b'\x88\x80') * 16, resolution='-X {1} +Y {0}'), DRAWN
    yield 'axes.hdr', hdr(good * 8, resolution='-Y {} +Y {}'), REFUSED
    yield 'rows-mixed.hdr', hdr(good * 7 + b'\x80\x40\x20\x81' * 16), EITHER
    yield 'words.hdr', hdr(good * 8, resolution='-Y {}x +X {}'), EITHER
    yield 'exposure.hdr', hdr(good * 8).replace(b'FORMAT', b'EXPOSURE=1e39\nFORMAT'), EITHER
    for name, line in (('exposure-0', 'EXPOSURE=0'), ('colors', 'COLORCORR=1e9 nan'),
                       ('primaries', 'PRIMARIES=' + '0 ' * 8),
                       ('primaries-other', 'PRIMARIES=.7 .3 .2 .8 .1 .1 .3 .3')):
        yield f'{name}.hdr', hdr(good * 8).replace(b'FORMAT', line.encode() + b'\nFORMAT'), DRAWN
    yield 'returns.hdr', hdr(good * 8).replace(b'RADIANCE\n', b'RADIANCE\r\n'), EITHER


def chunks():
    """Compared with themselves, without a device."""
    head, end = png_head(4, 4), (b'IEND', b'')
    texels = b'IDAT', zlib.compress((b'\0' + b'\x80\x40\x20' * 4) * 4)
    zeros = zlib.compress(bytes(50 << 20), 9)  # 50 KB
    yield 'good.png', png(4, 4), ACCEPTED
    # the header says 4 GiB, 1 GiB
    yield 'bomb.png', png_of(png_head(65536, 65536, 1, 0), (b'IDAT', zeros), end), REFUSED
    yield 'bomb-cut.png', png_of(png_head(16384, 16384), (b'IDAT', zeros[:1000]), end), REFUSED
    yield 'vast.png', png(60000, 60000, b'\0'), REFUSED
    yield 'bomb-more.png', png_of(head, (b'IDAT', zeros), end), EITHER
    yield 'bomb-text.png', png_of(head, (b'zTXt', b'a\0\0' + zeros), texels, end), EITHER
    yield 'bomb-profile.png', png_of(head, (b'iCCP', b'a\0\0' + zeros), texels, end), EITHER
    yield 'texts.png', png_of(head, *[(b'tEXt', b'a\0b')] * 20000, texels, end), EITHER
    yield ('bomb-chunk.png', png_of(head) + b'\x7f\xff\xff\xf0tEXt' + b'\0' * 16, REFUSED)
    yield 'head-twice.png', png_of(head, head, texels, end), REFUSED
    yield 'head-none.png', png_of(texels, end), REFUSED
    yield 'no-texels.png', png_of(head, end), REFUSED
    yield 'after-end.png', png_of(head, end, texels), REFUSED
    yield 'end-none.png', png_of(head, texels), EITHER
    yield 'checksum.png', png(4, 4)[:-14] + b'\0\0' + png(4, 4)[-12:], REFUSED
    yield 'depth.png', png_of(png_head(4, 4, 3), texels, end), REFUSED
    yield 'color.png', png_of(png_head(4, 4, 8, 5), texels, end), REFUSED
    yield 'deep.png', png_of(png_head(4, 4, 16), (b'IDAT', zlib.compress(
        (b'\0' + b'\xff\x80' * 12) * 4)), end), ACCEPTED
    yield 'interlaced-cut.png', png_of(png_head(4, 4, 8, 2, 1), texels, end), EITHER
    indexed = png_head(4, 4, 8, 3)
    pixels = b'IDAT', zlib.compress((b'\0' + b'\0\1\2\xff') * 4)
    yield 'palette.png', png_of(indexed, (b'PLTE', bytes(9)), pixels, end), EITHER
    yield 'palette-none.png', png_of(indexed, pixels, end), REFUSED
    yield 'palette-long.png', png_of(indexed, (b'PLTE', bytes(3000)), pixels, end), REFUSED
    yield 'alpha-long.png', png_of(indexed, (b'PLTE', bytes(9)), (b'tRNS', bytes(300)), pixels,
                                   end), EITHER
    yield 'gamma-0.png', png_of(head, (b'gAMA', bytes(4)), texels, end), EITHER
    yield 'white-0.png', png_of(head, (b'cHRM', bytes(32)), texels, end), EITHER
    yield 'unknown.png', png_of(head, (b'ABCD', b'x'), texels, end), REFUSED


def tile(words, name='firn/tile', kind='string', size=(8, 4), **more):
    texts = b''.join(attribute(key, 'string', b'a') for key in ('firn/version', 'firn/settings'))
    return exr(more=attribute(name, kind, words) + texts, size=size, **more)


def tiles():
    """For firn merge, one file each."""
    yield 'good.exr', tile(b'1 of 1x1'), ACCEPTED
    yield 'apart.exr', tile(b'1 of 1x1 interleaved'), ACCEPTED
    for name, words in (
            ('first', b'0 of 1x1'), ('beyond', b'2 of 1x1'), ('none', b'1 of 0x0'),
            ('many', b'1 of 65536x65536'), ('wraps', b'1 of 4294967297x1'),
            ('minus', b'1 of -1x-1'), ('words', b'one of 1x1'),
            ('more', b'1 of 1x1 interleaved or not'), ('empty', b''),
            ('zeros', bytes(20)), ('long', b'1' * 100000 + b' of 1x1')):
        yield f'{name}.exr', tile(words), REFUSED
    yield 'kind.exr', tile(struct.pack('<i', 1), kind='int'), REFUSED
    yield 'no-text.exr', exr(), REFUSED
    yield 'outside.exr', tile(b'1 of 1x1', display=(1, 0, 8, 3)), REFUSED
    yield 'elsewhere.exr', tile(b'1 of 1x1', display=(0, 0, 15, 7)), REFUSED
    most = (1 << 31) - 1
    yield 'vast.exr', tile(b'1 of 1x1', display=(-most - 1, -most - 1, most, most)), REFUSED
    yield 'wide.exr', tile(b'1 of 1x1', display=(0, 0, most - 1, most - 1)), REFUSED
    yield 'cut.exr', tile(b'1 of 1x1')[:-9], REFUSED
    yield 'tiles.exr', exr_tiles(more=attribute('firn/tile', 'string', b'1 of 1x1')), ACCEPTED


def profile(**changes):
    """A profile of one pass in one run, as JSON."""
    row = {'technique': '', 'repetition': 0, 'repetition_count': 1, 'width': 8, 'height': 8,
           'target_bytes': 0, 'vertices': 0, 'triangles': 0, 'fragments': 0, 'invocations': 0,
           'covered': 0, 'ms': [1], 'begin_ms': [0], 'record_ms': [0]}
    rows = [{'name': name, 'kind': kind, **row} for name, kind in (
        ('gbuffer.draw', 'raster'), ('record', 'host'), ('submit', 'host'),
        ('unattributed', 'rest'))]
    texts = ('command', 'scene', 'rung', 'material', 'device', 'driver', 'host', 'clock')
    numbers = ('warmup', 'time', 'time_step', 'upload', 'compile', 'realise',
               'first_frame', 'memory_used', 'memory_without_aliasing', 'memory_bound',
               'memory_persistent')
    document = {
        'type': 'profile', 'format': 2, **{name: 'a' for name in texts},
        **{name: 0 for name in numbers}, 'width': 8, 'height': 8, 'has_statistics': False,
        'run_count': 1, 'pass_count': 1,
        'settings': [{'name': 'a.b', 'value': '1'}],
        'residents': [{'name': 'a', 'first_pass': 0, 'last_pass': 0, 'block': 0, 'offset': 0,
                       'size': 1}],
        'rows': rows, 'frame': {'ms': [4]}, 'plain': {'ms': [4]}, 'wait': {'ms': [0]}}
    return json.dumps({**document, **changes}).encode()


def profiles():
    """For firn profile --baseline."""
    yield 'empty.json', b'', REFUSED
    yield 'cut.json', profile()[:-40], REFUSED
    yield 'nothing.json', b'{}', REFUSED
    yield 'deep.json', b'{"rows":' + b'[' * 100000 + b']' * 100000 + b'}', REFUSED
    yield 'twice.json', profile()[:-1] + b',"width":8}', REFUSED
    yield 'bytes.json', profile(scene='b').replace(b'"b"', b'"\xff\xfe"'), REFUSED
    for name, changes in (
            ('runs', {'run_count': 4294967295}), ('rows', {'rows': [1, 2, 3, 4]}),
            ('number', {'upload': 1e300}), ('fraction', {'width': 0.5}), ('minus', {'width': -8}),
            ('name', {'rung': 'a' * 1000}), ('format', {'format': 1 << 60})):
        yield f'{name}.json', profile(**changes), REFUSED


def other_formats():
    """The bytes of one format in a file of another's name."""
    good = hdr(hdr_line(16, b'\x90\x80') * 8)
    yield 'hdr.exr', good, REFUSED
    yield 'png.exr', png(4, 4), REFUSED
    yield 'exr.hdr', exr(), REFUSED
    yield 'png.hdr', png(4, 4), REFUSED
    yield 'glb.hdr', glb(), REFUSED
    yield 'exr.png', exr(), REFUSED
    yield 'jpeg.png', b'\xff\xd8\xff\xe0\0\x10JFIF\0' + bytes(100), REFUSED
    yield 'head.exr', exr_head(), REFUSED
