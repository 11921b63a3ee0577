"""exr_file.py: reads and writes the part of the OpenEXR format (version 2, one part) that the tests
need."""
import struct
import zlib

MAGIC = b'\x76\x2f\x31\x01'
LINES_PER_CHUNK = {0: 1, 1: 1, 2: 1, 3: 16}  # compression NONE, RLE, ZIPS, ZIP
ZIP = 3
FORMATS = {'uint': 'I', 'half': 'e', 'float': 'f'}


class Damaged(Exception):
    pass


def take_string(data, at):
    end = data.index(b'\0', at)
    return data[at:end].decode('utf-8'), end + 1


def read_attributes(data):
    """({name: (type, bytes)}, offset of the chunk table)"""
    if data[:4] != MAGIC or data[4:8] not in (b'\x02\0\0\0', b'\x02\x04\0\0'):  # long names
        raise Damaged(f'begins with {data[:8].hex()}')
    attributes, at = {}, 8
    while data[at]:
        name, at = take_string(data, at)
        kind, at = take_string(data, at)
        size, = struct.unpack_from('<i', data, at)
        attributes[name] = kind, data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def read_channels(value):
    """{name: 'uint', 'half' or 'float'}, in the order of the file"""
    channels, at = {}, 0
    while value[at]:
        name, at = take_string(value, at)
        kind, = struct.unpack_from('<i', value, at)
        channels[name] = ('uint', 'half', 'float')[kind]
        at += 16
    return channels


def unzip(data, size):
    """Undoes ZIP: bytes as differences, even ones before odd ones. No smaller: as they are."""
    if len(data) == size:
        return data
    differences = zlib.decompress(data)
    if len(differences) != size:
        raise Damaged(f'a chunk of {len(differences)} bytes, not {size}')
    result, value, half = bytearray(size), 128, (size + 1) // 2
    for i, difference in enumerate(differences):
        value = value + difference - 128 & 255
        result[2 * i if i < half else 2 * (i - half) + 1] = value
    return bytes(result)


class Exr:
    def __init__(self, data):
        self.attributes, table = read_attributes(data)
        self.channels = read_channels(self.attributes['channels'][1])
        left, top, right, bottom = self.window('dataWindow')
        self.size = right - left + 1, bottom - top + 1
        lines = LINES_PER_CHUNK[self.attributes['compression'][1][0]]
        chunks = struct.unpack_from(f'<{-(-self.size[1] // lines)}Q', data, table)
        self.data, self.chunks, self.lines_per_chunk, self.top = data, chunks, lines, top
        last = max(chunks)
        self.end = last + 8 + struct.unpack_from('<i', data, last + 4)[0]  # of all chunks
        self.pixels = data[min(chunks):self.end]  # compressed

    def text(self, name):
        kind, value = self.attributes[name]
        if kind != 'string':
            raise Damaged(f'{name} is a {kind}')
        return value.decode('utf-8')

    def window(self, name):
        """left, top, right, bottom, all of them inside"""
        return struct.unpack('<4i', self.attributes[name][1])

    def matrix(self, name):
        kind, value = self.attributes[name]
        if kind != 'm44f':
            raise Damaged(f'{name} is a {kind}')
        return struct.unpack('<16f', value)

    def read_planes(self, names):
        """{name: the values of this channel, row by row}; of a file with ZIP"""
        if self.attributes['compression'][1][0] != ZIP:
            raise Damaged('not compressed with ZIP')
        width, height = self.size
        planes = {name: [] for name in names}
        for chunk in self.chunks:
            y, size = struct.unpack_from('<2i', self.data, chunk)
            lines = min(self.lines_per_chunk, self.top + height - y)
            row = ''.join(f'{width}{FORMATS[kind]}' for kind in self.channels.values())
            raw = unzip(self.data[chunk + 8:chunk + 8 + size], lines * struct.calcsize(f'<{row}'))
            for values in struct.iter_unpack(f'<{row}', raw):
                for index, name in enumerate(self.channels):
                    if name in planes:
                        planes[name] += values[index * width:(index + 1) * width]
        return planes


def attribute(name, kind, value):
    return name.encode() + b'\0' + kind.encode() + b'\0' + struct.pack('<i', len(value)) + value


def write_exr(size, planes, more=b'', at=(0, 0), display=None):
    """A file of {name: values, row by row}, as floats, not compressed; `more`: attributes; `at`:
    left, top of the data window; `display`: left, top, right, bottom, all of them inside."""
    width, height = size
    names = sorted(planes)
    channels = b''.join(name.encode() + b'\0' + struct.pack('<4i', 2, 0, 1, 1) for name in names)
    window = struct.pack('<4i', *at, at[0] + width - 1, at[1] + height - 1)
    shown = struct.pack('<4i', *display) if display else window
    head = MAGIC + struct.pack('<i', 2) + b''.join((
        attribute('channels', 'chlist', channels + b'\0'),
        attribute('compression', 'compression', b'\0'),
        attribute('dataWindow', 'box2i', window), attribute('displayWindow', 'box2i', shown),
        attribute('lineOrder', 'lineOrder', b'\0'),
        attribute('pixelAspectRatio', 'float', struct.pack('<f', 1)),
        attribute('screenWindowCenter', 'v2f', struct.pack('<2f', 0, 0)),
        attribute('screenWindowWidth', 'float', struct.pack('<f', 1)))) + more + b'\0'
    line_size = 4 * width * len(names)
    table = [len(head) + 8 * height + y * (8 + line_size) for y in range(height)]
    lines = (struct.pack('<2i', at[1] + y, line_size) + b''.join(
        struct.pack(f'<{width}f', *planes[name][y * width:(y + 1) * width]) for name in names)
        for y in range(height))
    return head + struct.pack(f'<{height}Q', *table) + b''.join(lines)
