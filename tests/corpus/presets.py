"""presets.py: malformed files of settings: entries are name, content, what becomes of it."""
from builders import ACCEPTED, REFUSED

SOUND = b'# a look\n\nrefract.ior=1.5\n  cracks.count=2\t\r\ntonemap.curve=clip\nlandscape.flat=on'


def presets():
    """For firn graph --preset."""
    yield 'sound.txt', SOUND, ACCEPTED
    yield 'empty.txt', b'', ACCEPTED
    yield 'comments.txt', b'#' * 5000 + b'\n' * 5000, ACCEPTED
    yield 'twice.txt', b'cracks.count=2\n' * 60000, ACCEPTED
    for name, line in (
            ('word', b'cracks'), ('no-name', b'=1'), ('unknown', b'cracks.cuont=1'),
            ('no-value', b'cracks.count='), ('text', b'cracks.count=many'),
            ('fraction', b'cracks.count=1.5'), ('minus', b'cracks.count=-1'),
            ('huge', b'cracks.count=1e300'), ('nan', b'refract.ior=nan'),
            ('infinite', b'refract.ior=inf'), ('choice', b'tonemap.curve=nosuch'),
            ('switch', b'landscape.flat=1'), ('spaces', b'cracks.count = 2'),
            ('two', b'cracks.count=1 cracks.count=2'), ('nul', b'cracks.count=1\0'),
            ('nul-name', b'cracks\0.count=1'), ('escape', b'cracks.count=\x1b[2J'),
            ('bytes', b'\xff\xfe\x80=\x80'), ('long', b'a=' + b'1' * 600),
            ('long-name', b'a' * 400 + b'=1')):
        yield f'{name}.txt', SOUND + b'\n' + line + b'\n', REFUSED
    yield 'large.txt', b'\n' * (1 << 20) + b'\n', REFUSED
    yield 'lines.txt', b'\n' * 70000, REFUSED
