"""frame.py: the layers of a rendered image as NumPy arrays."""
from __future__ import annotations

import ctypes
import os
import struct
import zlib
from collections.abc import Mapping

import numpy as np

from . import _native
from .camera import Camera
from .errors import UsageError

ALIASES = {'depth': 'Z'}
BEAUTY = {'rgb': slice(0, 3), 'rgba': slice(0, 4), 'alpha': 3}  # parts of the layer beauty


def layer_of(name: str) -> str:
    """Returns the layer of the C library that contains the array of this name."""
    return 'beauty' if name in BEAUTY else ALIASES.get(name, name)


def png_bytes(pixels: np.ndarray) -> bytes:
    """Encodes uint8 or uint16 pixels (h, w) or (h, w, 3) as PNG."""
    pixels = np.ascontiguousarray(pixels)
    if pixels.dtype not in (np.uint8, np.uint16) or pixels.shape[2:] not in ((), (3,)):
        raise UsageError(f'PNG: expected uint8 or uint16 and 1 or 3 channels, got {pixels.dtype} '
                         f'and {pixels.shape}')

    def chunk(kind, data):
        return (struct.pack('>I', len(data)) + kind + data +
                struct.pack('>I', zlib.crc32(kind + data)))
    height, width = pixels.shape[:2]
    bits = 8 * pixels.itemsize
    rows = pixels.astype(pixels.dtype.newbyteorder('>')).reshape(height, -1).view(np.uint8)
    filtered = np.hstack([np.zeros((height, 1), np.uint8), rows])
    header = struct.pack('>IIBBBBB', width, height, bits, 2 if pixels.ndim == 3 else 0, 0, 0, 0)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) +
            chunk(b'IDAT', zlib.compress(filtered.tobytes(), 6)) + chunk(b'IEND', b''))


class Frame(Mapping):
    """
    A rendered image: layers by name, as arrays (height, width) or (height, width, channels).

    Row 0 is the top row. Arrays own their memory, so they stay valid when the renderer is closed.
    They are uint32 for numbers of objects and materials, uint8 for `display`, otherwise float32.
    `frame['Z']` and `frame.Z` are the same. `rgb` and `alpha` are parts of the layer `beauty`:
    linear Rec.709 radiance and coverage. `depth` is `Z`, in metres along the viewing direction.
    """
    def __init__(self, layers: dict, camera: Camera | None, aliases=()):
        self._layers = layers
        self._aliases = tuple(aliases)
        self.camera = camera  # None if it is orthographic

    @property
    def size(self) -> tuple:
        """Width and height in pixels."""
        height, width = next(iter(self._layers.values())).shape[:2]
        return width, height

    def __getitem__(self, name: str) -> np.ndarray:
        layer = self._layers[layer_of(name)]
        return layer[..., BEAUTY[name]] if name in BEAUTY else layer

    def __getattr__(self, name: str) -> np.ndarray:
        if name.startswith('_'):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f'no layer {name}; there are {", ".join(self)}') from None

    def __iter__(self):
        return iter([*self._layers, *(a for a in self._aliases if a not in self._layers)])

    def __len__(self) -> int:
        return len(list(iter(self)))

    def srgb(self) -> np.ndarray:
        """
        Returns the image as sRGB, uint8 (height, width, 3): the tone-mapped layer `display` if the
        renderer has it, else `beauty` clamped to 0..1.
        """
        if 'display' in self._layers:
            return np.ascontiguousarray(self._layers['display'][..., :3])
        linear = np.clip(np.nan_to_num(self['rgb']), 0, 1)
        coded = np.where(linear <= 0.0031308, 12.92 * linear,
                         1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)
        return np.round(255 * coded).astype(np.uint8)

    def save(self, path) -> None:
        """
        Writes an EXR file with all layers, or a PNG file of srgb(), atomically.
        """
        path = os.fspath(path)
        if path.lower().endswith('.exr'):
            write_exr(path, self._layers)
        elif path.lower().endswith('.png'):
            write_file(path, png_bytes(self.srgb()))
        else:
            raise UsageError(f'{path}: expected a name that ends with .exr or .png')

    def _repr_png_(self) -> bytes:
        return png_bytes(self.srgb())

    def __repr__(self) -> str:
        layers = ', '.join(f'{name} {array.shape[2:] or ""}{array.dtype}'
                           for name, array in self._layers.items())
        return f'Frame({self.size[0]}x{self.size[1]}: {layers})'


def write_file(path, data: bytes) -> None:
    """Writes a file atomically: under a temporary name, which is replaced when it is complete."""
    temporary = f'{os.fspath(path)}.{os.getpid()}.part'  # of this process: sets are shared
    try:
        with open(temporary, 'wb') as file:
            file.write(data)
        os.replace(temporary, path)
    except BaseException:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise


def buffers_of(layers: dict):
    """Returns C buffers for arrays by layer name, and their number."""
    def buffer(name, array):
        strides = array.strides
        if array.dtype.name not in _native.TYPES or array.ndim not in (2, 3):
            raise UsageError(f'{name}: expected float32, uint8, uint16 or uint32 and 2 or 3 '
                             f'dimensions, got {array.dtype} and {array.shape}')
        return _native.Buffer(
            layer=name.encode(), data=array.ctypes.data, type=_native.TYPES[array.dtype.name],
            channels=array.shape[2] if array.ndim == 3 else 1,
            pixel_stride=strides[1], row_stride=strides[0])
    found = [buffer(*entry) for entry in layers.items()]
    return (_native.Buffer * len(found))(*found), len(found)


def write_exr(path, layers: dict) -> None:
    """
    Writes arrays (height, width[, channels]) as layers of an EXR file: float32 as FLOAT, unsigned
    integers as UINT channels. The layer `beauty` becomes the channels R, G, B and A.
    """
    layers = {name: np.ascontiguousarray(
        array.astype(np.uint32) if array.dtype in (np.uint8, np.uint16) else array)
        for name, array in layers.items() if name != 'display'}
    shapes = {array.shape[:2] for array in layers.values()}
    if len(shapes) != 1:
        raise UsageError(f'{path}: layers of one size are expected, got {sorted(shapes)}')
    (height, width), = shapes
    buffers, count = buffers_of(layers)
    _native.call('write_exr', os.fsencode(path), width, height, buffers, count)


def diff(reference, test, errors: bool = False):
    """
    Measures the error of an image relative to a reference, as `firn diff` does.

    Both are arrays (height, width, 3 or 4): uint8 sRGB, or float32 linear. Returns a dict with mae,
    mae_clipped, rmse, relmse, flip and largest; with `errors`, also the map of FLIP errors (height,
    width).
    """
    def image(name, pixels):
        pixels = np.ascontiguousarray(pixels)
        if (pixels.ndim != 3 or pixels.shape[2] not in (3, 4) or
                pixels.dtype not in (np.uint8, np.float32)):
            raise UsageError(f'{name}: expected (height, width, 3 or 4) of uint8 or float32, got '
                             f'{pixels.shape} of {pixels.dtype}')
        return pixels, _native.Image(width=pixels.shape[1], height=pixels.shape[0],
                                     data=pixels.ctypes.data,
                                     type=_native.TYPES[pixels.dtype.name],
                                     channels=pixels.shape[2])
    reference, a = image('reference', reference)
    test, b = image('test', test)
    found = _native.Difference()
    errors_map = np.empty(reference.shape[:2], np.float32) if errors else None
    pointer = errors_map.ctypes.data_as(ctypes.POINTER(ctypes.c_float)) if errors else None
    _native.call('diff', a, b, found, pointer)
    result = {name: getattr(found, name) for name, _ in _native.Difference._fields_}
    if errors:
        result['errors'] = errors_map
    return result
