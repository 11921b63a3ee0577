"""_native.py: ctypes bindings of the C library libfirn. Private.

The structs and their order are those of firn.h. The first call loads the library, so that importing
firn has no side effects.
"""
import ctypes
import functools
import os
import pathlib
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int, c_int32,
                    c_size_t, c_ssize_t, c_uint32, c_uint64, c_void_p)

from .errors import Error, error_of

SONAME = 'libfirn.so.0'
FLOAT32, UINT8, UINT16, UINT32 = range(4)
TYPES = {'float32': FLOAT32, 'uint8': UINT8, 'uint16': UINT16, 'uint32': UINT32}
NO_CACHE, VALIDATE, WITHOUT_DEVICE = 1, 2, 4
CAMERA_SCENE, CAMERA_LOOK_AT, CAMERA_OPENCV, CAMERA_OPENGL = range(4)

LogFunction = CFUNCTYPE(None, c_void_p, c_int, c_char_p)
ProgressFunction = CFUNCTYPE(c_int, c_void_p, c_uint32, c_uint32)


class Sized(Structure):
    """A struct of firn.h, whose first member is its size."""
    _fields_ = [('size', c_size_t)]

    def __init__(self, **members):
        super().__init__(size=ctypes.sizeof(type(self)), **members)


def _struct(name, *fields):
    return type(name, (Sized,), {'_fields_': list(fields)})


Options = _struct('Options', ('device', c_char_p), ('log', LogFunction), ('log_user', c_void_p),
                  ('reader', c_char_p), ('cache', c_char_p), ('flags', c_uint32),
                  ('assets', c_char_p))
Setting = _struct('Setting', ('name', c_char_p), ('label', c_char_p), ('help', c_char_p),
                  ('unit', c_char_p), ('choices', POINTER(c_char_p)), ('type', c_uint32),
                  ('has_auto', c_uint32), ('initial', c_double), ('min', c_double),
                  ('max', c_double), ('loads_scene', c_uint32))
Object = _struct('Object', ('name', c_char_p), ('id', c_uint32), ('refracts', c_uint32),
                 ('box_min', c_float * 3), ('box_max', c_float * 3), ('triangle_count', c_uint32),
                 ('material', c_char_p))
Material = _struct('Material', ('name', c_char_p), ('base_color', c_float * 4),
                   ('metallic', c_float), ('roughness', c_float), ('transmission', c_float),
                   ('ior', c_float), ('dispersion', c_float), ('thickness', c_float),
                   ('attenuation_color', c_float * 3), ('attenuation_distance', c_float),
                   ('scattering', c_float), ('emission', c_float * 3), ('priority', c_int32),
                   ('flags', c_uint32), ('class_id', c_uint32))
Mesh = _struct('Mesh', ('vertex_count', c_uint32), ('index_count', c_uint32),
               ('positions', c_void_p), ('normals', c_void_p), ('uvs', c_void_p),
               ('indices', c_void_p), ('position_stride', c_size_t), ('normal_stride', c_size_t),
               ('uv_stride', c_size_t))
Instance = _struct('Instance', ('mesh', c_uint32), ('material', c_uint32), ('name', c_char_p),
                   ('world', c_float * 12))
Light = _struct('Light', ('kind', c_uint32), ('position', c_float * 3), ('direction', c_float * 3),
                ('color', c_float * 3), ('intensity', c_float), ('range', c_float),
                ('inner_cone', c_float), ('outer_cone', c_float))
Environment = _struct('Environment', ('width', c_uint32), ('height', c_uint32),
                      ('texels', c_void_p), ('row_stride', c_size_t), ('rotate_deg', c_float),
                      ('exposure', c_float))
Camera = _struct('Camera', ('kind', c_uint32), ('has_time', c_uint32), ('time', c_double),
                 ('eye', c_double * 3), ('target', c_double * 3), ('up', c_double * 3),
                 ('fov_deg', c_double), ('fx', c_double), ('fy', c_double), ('cx', c_double),
                 ('cy', c_double), ('world_from_camera', c_double * 12))
Layer = _struct('Layer', ('name', c_char_p), ('help', c_char_p), ('channels', c_uint32),
                ('averages', c_uint32), ('type', c_uint32))
RendererOptions = _struct('RendererOptions', ('width', c_uint32), ('height', c_uint32),
                          ('samples', c_uint32), ('layers', POINTER(c_char_p)),
                          ('layer_count', c_size_t))
Buffer = _struct('Buffer', ('layer', c_char_p), ('data', c_void_p), ('type', c_uint32),
                 ('channels', c_uint32), ('pixel_stride', c_ssize_t), ('row_stride', c_ssize_t))
Image = _struct('Image', ('width', c_uint32), ('height', c_uint32), ('data', c_void_p),
                ('type', c_uint32), ('channels', c_uint32), ('pixel_stride', c_ssize_t),
                ('row_stride', c_ssize_t))
Difference = _struct('Difference', ('mae', c_double), ('mae_clipped', c_double),
                     ('rmse', c_double), ('relmse', c_double), ('flip', c_double),
                     ('largest', c_double))

_STRINGS = POINTER(c_char_p)
_HANDLE = c_void_p
_OUT = POINTER(c_void_p)
_NUMBER = POINTER(c_uint32)
_FUNCTIONS = {
    'version': (c_char_p,),
    'open': (c_int, POINTER(Options), _OUT),
    'close': (None, _HANDLE),
    'error': (c_char_p, _HANDLE),
    'device_name': (c_char_p, _HANDLE),
    'scene_load': (c_int, _HANDLE, c_char_p, _STRINGS, _OUT),
    'scene_create': (c_int, _HANDLE, _STRINGS, _OUT),
    'scene_close': (None, _HANDLE),
    'scene_set': (c_int, _HANDLE, c_char_p, c_char_p),
    'scene_get': (c_int, _HANDLE, c_char_p, c_char_p, c_size_t),
    'scene_object_count': (c_int, _HANDLE, _NUMBER),
    'scene_object': (c_int, _HANDLE, c_uint32, POINTER(Object)),
    'scene_material': (c_int, _HANDLE, c_uint32, POINTER(Material)),
    'scene_set_material': (c_int, _HANDLE, c_uint32, POINTER(Material)),
    'scene_add_mesh': (c_int, _HANDLE, POINTER(Mesh), _NUMBER),
    'scene_add_material': (c_int, _HANDLE, POINTER(Material), _NUMBER),
    'scene_add_instance': (c_int, _HANDLE, POINTER(Instance)),
    'scene_add_light': (c_int, _HANDLE, POINTER(Light)),
    'scene_set_environment': (c_int, _HANDLE, POINTER(Environment)),
    'setting_get': (c_int, c_uint32, POINTER(Setting)),
    'layer_get': (c_int, c_uint32, POINTER(Layer)),
    'material_init': (c_int, POINTER(Material), c_char_p),
    'camera_convert': (c_int, _HANDLE, POINTER(Camera), POINTER(Camera)),
    'renderer_create': (c_int, _HANDLE, POINTER(RendererOptions), _OUT),
    'renderer_close': (None, _HANDLE),
    'renderer_plan': (c_int, _HANDLE, _STRINGS),
    'render': (c_int, _HANDLE, POINTER(Camera), POINTER(Buffer), c_size_t, ProgressFunction,
               c_void_p),
    'submit': (c_int, _HANDLE, POINTER(Camera), POINTER(c_uint64)),
    'fetch': (c_int, _HANDLE, c_uint64, POINTER(Buffer), c_size_t),
    'cancel': (None, _HANDLE),
    'write_exr': (c_int, c_char_p, c_uint32, c_uint32, POINTER(Buffer), c_size_t),
    'diff': (c_int, POINTER(Image), POINTER(Image), POINTER(Difference), POINTER(c_float)),
}


@functools.lru_cache(maxsize=None)
def library():
    """
    Loads libfirn: the file $FIRN_LIBRARY, the one beside this module (in a wheel), or the system's.
    """
    here = pathlib.Path(__file__).parent / SONAME
    path = os.environ.get('FIRN_LIBRARY') or (str(here) if here.exists() else SONAME)
    try:
        loaded = ctypes.CDLL(path)
    except OSError as error:
        raise Error(f'cannot load {path}: {error}; install libfirn0, or name the file in '
                    '$FIRN_LIBRARY') from None
    for name, (result, *arguments) in _FUNCTIONS.items():
        function = getattr(loaded, f'firn_{name}')
        function.restype = result
        function.argtypes = arguments
    return loaded


def beside(name):
    """Returns the path of a wheel's file beside this module, as bytes; None without one."""
    path = pathlib.Path(__file__).parent / name
    return os.fsencode(path) if path.exists() else None


def call(name, *arguments, device=None):
    """Calls a function that returns a status. Raises the exception of the status if it failed."""
    status = getattr(library(), f'firn_{name}')(*arguments)
    if status:
        raise error_of(status, library().firn_error(device).decode(errors='replace'))


def strings(words):
    """Returns an array of C strings that ends with NULL."""
    return (c_char_p * (len(words) + 1))(*map(os.fsencode, words), None)


def list_all(name, struct):
    """Returns all entries of a list such as that of settings."""
    found = []
    get = getattr(library(), f'firn_{name}')
    while True:
        entry = struct()
        if get(len(found), entry):
            return found
        found.append(entry)
