"""png_file.py: reads the PNG files that firn writes: not interlaced, colours of 8 or 16 bits."""
import struct
import zlib


def paeth(left, up, corner):
    guess = left + up - corner
    distances = abs(guess - left), abs(guess - up), abs(guess - corner)
    return (left, up, corner)[distances.index(min(distances))]


def unfilter(kind, line, above, step):
    """Undoes the filter of a row, in place."""
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        add = (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]
        line[i] = (line[i] + add) & 255


class Png:
    def __init__(self, data):
        self.chunks, at = {}, 8
        while at < len(data):
            size, kind = struct.unpack_from('>I4s', data, at)
            content = data[at + 8:at + 8 + size]
            if zlib.crc32(kind + content) != struct.unpack_from('>I', data, at + 8 + size)[0]:
                raise ValueError(f'{kind} is damaged')
            self.chunks[kind.decode()] = self.chunks.get(kind.decode(), b'') + content
            at += 12 + size
        width, height, self.bits, kind = struct.unpack_from('>IIBB', self.chunks['IHDR'])
        self.size, self.channels = (width, height), {2: 3, 6: 4}[kind]
        step = self.channels * self.bits // 8
        raw, above, self.values = zlib.decompress(self.chunks['IDAT']), bytes(step * width), []
        for y in range(height):
            start = y * (1 + step * width)
            line = bytearray(raw[start + 1:start + 1 + step * width])
            unfilter(raw[start], line, above, step)
            above = bytes(line)
            self.values += struct.unpack(f'>{self.channels * width}{"BH"[self.bits == 16]}', above)
