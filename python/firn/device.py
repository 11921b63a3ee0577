"""device.py: devices, scenes, objects, materials and renderers."""
from __future__ import annotations

import collections
import ctypes
import html
import logging
import os
import sys
import weakref
from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from . import _native
from .camera import Camera, camera_of_struct
from .errors import ClosedError, Error, UsageError
from .frame import BEAUTY, Frame, buffers_of, layer_of, write_file

_logger = logging.getLogger('firn')
_LEVELS = (logging.ERROR, logging.WARNING, logging.INFO)


@_native.LogFunction
def _log(_user, level, text):
    # errors are not logged: they become exceptions
    if level != 0:
        _logger.log(_LEVELS[min(level, 2)], text.decode(errors='replace'))


def _word(value) -> str:
    """Returns a value as text in the syntax of the command line."""
    if isinstance(value, bool) or isinstance(value, np.bool_):
        return 'on' if value else 'off'
    if isinstance(value, (tuple, list, np.ndarray)):
        return ','.join(map(_word, value))
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def _option_words(options: dict) -> list:
    """Returns names and values in turn. None omits an option, True has no value, lists repeat it."""
    words = []
    for name, value in options.items():
        name = name.replace('_', '-')
        if name == 'settings':
            for setting, number in value.items():
                words += [setting, _word(number)]
        elif isinstance(value, Mapping):  # material={'Cup': 'ruby'}
            for node, text in value.items():
                words += [name, f'{node}={_word(text)}']
        elif isinstance(value, list):
            for one in value:
                words += [name, _word(one)]
        elif value is True:
            words += [name, '']
        elif value is not None and value is not False:
            words += [name, _word(value)]
    return words


class _Handle:
    """A library handle that is closed once: by close(), `with` or the garbage collector."""
    def __init__(self, handle, close, device=None):
        self._handle = handle
        self._device = device
        # The garbage collector may run in a log callback or in another thread, where closing a
        # handle would wait for itself: the device's next call closes what is collected.
        self._garbage = device._garbage if device else collections.deque()
        self._close = getattr(_native.library(), close)
        self._finalizer = weakref.finalize(self, self._garbage.append, (self._close, handle))

    @property
    def closed(self) -> bool:
        """True if close() was called."""
        return not self._finalizer.alive

    def close(self) -> None:
        """Closes the handle. Further calls do nothing."""
        if self._finalizer.detach():
            self._close(self._handle)
        self._close_garbage()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __reduce__(self):
        raise TypeError(f'a {type(self).__name__} belongs to its process; make one in each')

    def _close_garbage(self):
        while self._garbage:
            close, handle = self._garbage.popleft()
            close(handle)

    def _open_handle(self):
        if self.closed:
            raise ClosedError(f'this {type(self).__name__} is closed')
        return self._handle

    def _call(self, name, *arguments):
        device = self._device or self
        if device.closed:
            raise ClosedError('the device is closed')
        self._close_garbage()
        _native.call(name, self._open_handle(), *arguments, device=device._handle)


class Device(_Handle):
    """
    An open Vulkan device. `name` is its number or part of its name; the default is the best device.
    `vulkan=False` opens none: scenes can still be loaded, and drawn with refraction='reference'.
    `cache=False` does not cache pipelines and BVHs on disk; a path sets the cache folder.

    Only one thread at a time may use a device with its scenes and renderers. Threads may use
    different devices at the same time. A child of os.fork() cannot use the device; open one there.
    Warnings and notes are logged to logging.getLogger('firn').
    """
    def __init__(self, name=None, *, vulkan: bool = True, validate: bool = False, cache=True,
                 reader=None):
        flags = ((0 if vulkan else _native.WITHOUT_DEVICE) | (0 if cache else _native.NO_CACHE) |
                 (_native.VALIDATE if validate else 0))
        options = _native.Options(
            device=None if name is None else str(name).encode(), log=_log, flags=flags,
            reader=os.fsencode(reader) if reader else _native.beside('firn-reader'),
            assets=_native.beside('assets'),
            cache=os.fsencode(cache) if isinstance(cache, (str, os.PathLike)) else None)
        handle = ctypes.c_void_p()
        _native.call('open', options, handle)
        super().__init__(handle, 'firn_close')

    @property
    def name(self) -> str:
        """Name of the Vulkan device."""
        return _native.library().firn_device_name(self._open_handle()).decode()

    def load(self, path, **options) -> Scene:
        """
        Loads a model file (.gltf, .glb, .obj, .ply, .stl) or a built-in scene by its name.

        `options` are those of `firn render`, with underscores: env='studio', material='glass',
        material={'Cup': 'ruby'}, ground='none', quality='normal', refraction='trace', plain=True,
        settings={'refract.ior': 1.4}.
        """
        scene = ctypes.c_void_p()
        words = _native.strings(_option_words(options))
        self._call('scene_load', os.fsencode(path), words, scene)
        return Scene(scene, self)

    def scene(self, **options) -> Scene:
        """Creates an empty scene, to which meshes, materials and objects can be added."""
        scene = ctypes.c_void_p()
        self._call('scene_create', _native.strings(_option_words(options)), scene)
        return Scene(scene, self)

    def __repr__(self) -> str:
        return 'Device(closed)' if self.closed else f'Device({self.name!r})'


PRIORITY = 8  # FIRN_MATERIAL_PRIORITY


class Material:
    """
    A surface and the medium behind it, as in glTF 2.0: base_color (4 numbers), metallic, roughness,
    transmission, ior, dispersion, thickness, attenuation_color (3), attenuation_distance (metres),
    scattering, emission (3), priority, class_id. `Material('ruby:rough', ior=1.77)` modifies a preset.
    Changes to the material of a scene's object apply to the scene.
    """
    FIELDS = tuple(name for name, _ in _native.Material._fields_ if name not in ('name', 'flags'))

    def __init__(self, preset: str = '', **fields):
        self._write = None
        self._struct = _native.Material()
        _native.call('material_init', self._struct, preset.encode())
        self.set(**fields)

    @classmethod
    def _of_object(cls, struct, write) -> Material:
        material = cls.__new__(cls)
        struct.name = struct.name  # a copy: the scene's own goes when it changes
        material._struct = struct
        material._write = write
        return material

    @property
    def name(self) -> str:
        """Name of the material in its file."""
        return (self._struct.name or b'').decode(errors='replace')

    @property
    def has_priority(self) -> bool:
        """Whether a priority is stated, for overlapping objects."""
        return bool(self._struct.flags & PRIORITY)

    def set(self, **fields) -> Material:
        """Sets several fields at once."""
        for name, value in fields.items():
            if name not in self.FIELDS:
                raise UsageError(f'a material has no {name}; it has {", ".join(self.FIELDS)}')
            now = getattr(self._struct, name)
            if isinstance(now, ctypes.Array):
                value = np.asarray(value, dtype=np.float32)
                if value.shape != (len(now),):
                    raise UsageError(f'{name}: expected {len(now)} numbers, got {value.shape}')
                value = type(now)(*value)
            else:
                value = int(value) if name in ('priority', 'class_id') else float(value)
            setattr(self._struct, name, value)
            if name == 'priority':
                self._struct.flags |= PRIORITY
        if self._write and fields:
            self._write(self._struct)
        return self

    def __getattr__(self, name):
        if name not in self.FIELDS:
            raise AttributeError(f'a material has no {name}; it has {", ".join(self.FIELDS)}')
        value = getattr(self._struct, name)
        return np.array(value) if isinstance(value, ctypes.Array) else value

    def __setattr__(self, name, value):
        if name in ('_struct', '_write'):
            super().__setattr__(name, value)
        else:
            self.set(**{name: value})

    def __repr__(self) -> str:
        fields = ', '.join(f'{name}={getattr(self, name)}' for name in self.FIELDS)
        return f'Material({self.name!r}, {fields})'


class SceneObject:
    """An object of a scene: `name`, `id` (its number in the layer `object`), `refracts`, `box`."""
    def __init__(self, scene: Scene, index: int, struct):
        self._scene, self._index = scene, index
        self.name: str = struct.name.decode(errors='replace')  # may be cut within a character
        self.id: int = struct.id
        self.refracts: bool = bool(struct.refracts)
        self.triangle_count: int = struct.triangle_count
        self.box = np.array([struct.box_min, struct.box_max])  # (2, 3), metres, world space

    @property
    def material(self) -> Material:
        """The material. Changed fields take effect with the next render."""
        struct = _native.Material()
        self._scene._call('scene_material', self._index, struct)
        return Material._of_object(
            struct, lambda new: self._scene._call('scene_set_material', self._index, new))

    @material.setter
    def material(self, material) -> None:
        if isinstance(material, str):
            material = Material(material)
        self._scene._call('scene_set_material', self._index, material._struct)

    def __repr__(self) -> str:
        return f'SceneObject({self.name!r}, id={self.id}, refracts={self.refracts})'


class Objects(Mapping):
    """The objects of a scene, by name or by their index."""
    def __init__(self, scene: Scene):
        count = ctypes.c_uint32()
        scene._call('scene_object_count', count)
        self._all = []
        for index in range(count.value):
            struct = _native.Object()
            scene._call('scene_object', index, struct)
            self._all.append(SceneObject(scene, index, struct))

    def __getitem__(self, name) -> SceneObject:
        if isinstance(name, int):
            return self._all[name]
        found = [one for one in self._all if one.name == name]
        if not found:
            raise KeyError(f'no object {name!r}; there are {[one.name for one in self._all]}')
        return found[0]

    def __iter__(self):
        return iter(dict.fromkeys(one.name for one in self._all))

    def __len__(self) -> int:
        return len(list(iter(self)))

    def all(self) -> list:
        """Returns all objects, including those without a name or with the same name."""
        return list(self._all)


class Settings(collections.abc.MutableMapping):
    """The settings of a scene by the names of `firn list settings`, as text."""
    def __init__(self, scene: Scene):
        self._scene = scene

    def __getitem__(self, name: str) -> str:
        text = ctypes.create_string_buffer(256)
        try:
            self._scene._call('scene_get', name.encode(), text, len(text))
        except UsageError as error:
            raise KeyError(str(error)) from None
        return text.value.decode()

    def __setitem__(self, name: str, value) -> None:
        self._scene.set(name, value)

    def __delitem__(self, name: str) -> None:
        raise UsageError(f'{name}: settings cannot be removed')

    def __iter__(self):
        return iter([setting['name'] for setting in settings()])

    def __len__(self) -> int:
        return len(settings())


class Scene(_Handle):
    """A scene from a file or from arrays, created by Device.load() or Device.scene()."""
    def __init__(self, handle, device: Device):
        super().__init__(handle, 'firn_scene_close', device)

    @property
    def settings(self) -> Settings:
        """Settings by name: scene.settings['refract.ior'] = 1.4."""
        return Settings(self)

    @property
    def objects(self) -> Objects:
        """The objects by name: scene.objects['Cup'].material.ior = 1.52."""
        return Objects(self)

    def set(self, name: str, value) -> None:
        """Sets an option or a setting, as in Device.load()."""
        self._call('scene_set', name.encode(), os.fsencode(_word(value)))

    def renderer(self, layers: Iterable = ('rgb',), samples: int = 0) -> Renderer:
        """
        Creates a renderer for these layers (names of firn.layers(), and `rgb`, `alpha`, `depth`).
        `samples` is the number per pixel; 0 for the option `samples` or the scene's quality level.
        """
        return Renderer(self, layers, samples)

    def add_material(self, material) -> int:
        """Adds a Material, or the material of a text such as 'glass'. Returns its number."""
        if isinstance(material, str):
            material = Material(material)
        number = ctypes.c_uint32()
        self._call('scene_add_material', material._struct, number)
        return number.value

    def add_mesh(self, positions, indices, normals=None, uvs=None) -> int:
        """
        Adds a mesh: positions (n, 3) in metres, indices (m, 3) counter-clockwise from outside,
        normals (n, 3), uvs (n, 2) with (0, 0) at the top left. Returns the number of the mesh.
        """
        def array(name, value, dtype, width):
            if value is None:
                return None
            value = np.ascontiguousarray(value, dtype=dtype)
            if value.ndim != 2 or value.shape[1] != width:
                raise UsageError(f'{name}: expected shape (n, {width}), got {value.shape}')
            return value
        positions = array('positions', positions, np.float32, 3)
        normals = array('normals', normals, np.float32, 3)
        uvs = array('uvs', uvs, np.float32, 2)
        if np.asarray(indices).size and np.min(indices) < 0:
            raise UsageError('indices: a negative one')
        indices = array('indices', indices, np.uint32, 3)
        for name, value in (('normals', normals), ('uvs', uvs)):
            if value is not None and len(value) != len(positions):
                raise UsageError(f'{name}: expected {len(positions)} rows, got {len(value)}')
        mesh = _native.Mesh(vertex_count=len(positions), index_count=indices.size,
                            positions=positions.ctypes.data, indices=indices.ctypes.data,
                            normals=None if normals is None else normals.ctypes.data,
                            uvs=None if uvs is None else uvs.ctypes.data)
        number = ctypes.c_uint32()
        self._call('scene_add_mesh', mesh, number)
        return number.value

    def add(self, mesh: int, material: int, name: str = '', world=None) -> None:
        """Adds an object: a mesh, a material and a mesh-to-world matrix (3, 4) or (4, 4)."""
        matrix = np.eye(4) if world is None else np.asarray(world, dtype=np.float64)
        if matrix.shape not in ((3, 4), (4, 4)):
            raise UsageError(f'world: expected shape (3, 4) or (4, 4), got {matrix.shape}')
        instance = _native.Instance(mesh=mesh, material=material, name=name.encode(),
                                    world=(ctypes.c_float * 12)(*matrix[:3].ravel()))
        self._call('scene_add_instance', instance)

    def add_light(self, kind: str, *, position=(0, 0, 0), direction=(0, -1, 0), color=(1, 1, 1),
                  intensity: float = 1.0, range: float = 0.0, inner_cone: float = 0.0,
                  outer_cone: float = 0.785) -> None:
        """Adds a 'directional' (lux), 'point' or 'spot' light (candela) of KHR_lights_punctual."""
        kinds = ('directional', 'point', 'spot')
        if kind not in kinds:
            raise UsageError(f'light {kind!r}: expected one of {", ".join(kinds)}')
        three = ctypes.c_float * 3
        self._call('scene_add_light', _native.Light(
            kind=kinds.index(kind), position=three(*position), direction=three(*direction),
            color=three(*color), intensity=intensity, range=range, inner_cone=inner_cone,
            outer_cone=outer_cone))

    def set_environment(self, texels, rotate: float = 0.0, exposure: float = 0.0) -> None:
        """
        Sets the environment to an equirectangular panorama: float32 (h, 2 h, 3), linear radiance,
        row 0 at the zenith. `rotate` in degrees about +Y, `exposure` in stops.
        """
        texels = np.ascontiguousarray(texels, dtype=np.float32)
        if texels.ndim != 3 or texels.shape[2] != 3:
            raise UsageError(f'texels: expected shape (h, 2 h, 3), got {texels.shape}')
        self._call('scene_set_environment', _native.Environment(
            width=texels.shape[1], height=texels.shape[0], texels=texels.ctypes.data,
            rotate_deg=rotate, exposure=exposure))


class _NativeRenderer(_Handle):
    """The renderer of one size."""
    def __init__(self, scene: Scene, layers, size, samples: int):
        names = _native.strings(list(layers))
        options = _native.RendererOptions(width=size[0], height=size[1], samples=samples,
                                          layers=names, layer_count=len(layers))
        handle = ctypes.c_void_p()
        scene._call('renderer_create', options, handle)
        super().__init__(handle, 'firn_renderer_close', scene._device)
        self.size = size


def _find_unshared(arrays, shape, dtype):
    """
    Returns a writable array of this shape and type that only `arrays` refers to, or None. The count
    of its references depends on the version of CPython and on debuggers: it is that of an object to
    which only a list refers.
    """
    single = [object()]
    item = single[0]
    count = sys.getrefcount(item)
    for k in range(len(arrays)):
        item = arrays[k]
        if (sys.getrefcount(item) == count and item.shape == shape and item.dtype == dtype and
                item.flags.writeable and item.flags.c_contiguous):
            return item
    return None


class Renderer:
    """
    Draws views of a scene. Consecutive views of one size share a compiled frame and an uploaded
    scene; a view of another size creates both again.
    """
    def __init__(self, scene: Scene, layers: Iterable, samples: int):
        self._scene, self._samples = scene, samples
        self._asked = [layers] if isinstance(layers, str) else list(layers)
        known = _layer_table()
        names = dict.fromkeys(map(layer_of, self._asked))
        for name in names:
            if name not in known:
                raise UsageError(f'no layer {name!r}; there are {", ".join(known)}')
        self._layers = {name: known[name] for name in names}
        self._recent = {name: collections.deque(maxlen=2) for name in names}
        self._native = None
        self._closed = False

    def close(self) -> None:
        """Frees the renderer."""
        self._closed = True
        self._recent.clear()
        if self._native:
            self._native.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __reduce__(self):
        raise TypeError('a Renderer belongs to its process; make one in each')

    def _of_size(self, size) -> _NativeRenderer:
        if self._closed:
            raise ClosedError('this Renderer is closed')
        if not self._native or self._native.size != tuple(size):
            if self._native:
                self._native.close()
            self._native = _NativeRenderer(self._scene, self._layers, tuple(size), self._samples)
        return self._native

    def camera(self, size) -> Camera:
        """
        Returns the scene's camera: of its options or file, else one that frames the objects. Raises
        UsageError if it is orthographic.
        """
        renderer = self._of_size(size)
        struct = _native.Camera(kind=_native.CAMERA_OPENCV)
        renderer._call('camera_convert', _native.Camera(kind=_native.CAMERA_SCENE), struct)
        return camera_of_struct(struct, size)

    def _arrays(self, size) -> dict:
        """
        Returns arrays for a frame. Arrays of the last two frames are reused once nothing else
        refers to them or to views of them: page faults of new memory cost up to a quarter of a
        frame's time.
        """
        def array(name, layer):
            shape = (size[1], size[0]) + ((layer['channels'],) if layer['channels'] > 1 else ())
            recent = self._recent[name]
            found = _find_unshared(recent, shape, layer['dtype'])
            if found is None:
                found = np.empty(shape, layer['dtype'])
                recent.append(found)
            return found
        return {name: array(name, layer) for name, layer in self._layers.items()}

    def _frame(self, arrays: dict, camera: Camera) -> Frame:
        return Frame(arrays, camera, [name for name in self._asked if layer_of(name) != name])

    def render(self, camera: Camera | None = None, size=None, progress=None) -> Frame:
        """
        Draws a view. Without a camera, draws the view of the scene's camera in the given size: the
        image of `firn render`. `progress(done, all)` is called after each sample; Ctrl+C and
        exceptions of `progress` cancel the rendering and leave the renderer usable.
        """
        if (camera is None) == (size is None):
            raise UsageError('render: expected either a camera or a size')
        struct = camera._struct() if camera else _native.Camera(kind=_native.CAMERA_SCENE)
        size = camera.size if camera else tuple(size)
        native = self._of_size(size)
        arrays = self._arrays(size)
        buffers, count = buffers_of(arrays)
        raised = []

        @_native.ProgressFunction
        def after_sample(_user, done, total):
            try:  # Python handles signals such as Ctrl+C here
                if progress:
                    progress(done, total)
            except BaseException as error:
                raised.append(error)
            return len(raised)
        try:
            native._call('render', struct, buffers, count, after_sample, None)
        except Exception:
            if raised:
                raise raised[0] from None
            raise
        if raised:
            raise raised[0]
        if not camera:
            try:
                camera = self.camera(size)
            except UsageError:  # orthographic: it has no K
                pass
        return self._frame(arrays, camera)

    def iter(self, cameras: Iterable) -> Iterator:
        """Yields a frame for each camera, in order. Up to two views are in flight meanwhile."""
        pending = collections.deque()

        def fetch():
            native, camera, ticket = pending.popleft()
            arrays = self._arrays(camera.size)
            buffers, count = buffers_of(arrays)
            native._call('fetch', ticket, buffers, count)
            return self._frame(arrays, camera)
        try:
            for camera in cameras:
                while pending and (len(pending) == 2 or pending[-1][1].size != camera.size):
                    yield fetch()
                native = self._of_size(camera.size)
                ticket = ctypes.c_uint64()
                native._call('submit', camera._struct(), ticket)
                pending.append((native, camera, ticket))
            while pending:
                yield fetch()
        finally:  # if the caller ends the iteration early
            self.cancel()
            while pending:
                try:
                    fetch()
                except Error:
                    pass

    def _plan_html(self, size) -> str:
        text = ctypes.c_char_p()
        self._of_size(size)._call('renderer_plan', ctypes.byref(text))
        return text.value.decode()

    def cancel(self) -> None:
        """Cancels the view that is being drawn; another thread may call it."""
        if self._native and not self._native.closed:
            _native.library().firn_cancel(self._native._handle)


class Plan:
    """
    The compiled plan of a renderer's frames: passes, images, barriers and memory, as an HTML page.
    Notebooks show it. `size` is that of the image.
    """
    def __init__(self, renderer: Renderer, size):
        self.html: str = renderer._plan_html(tuple(size))

    def save(self, path) -> None:
        """Writes the page to a file."""
        write_file(path, self.html.encode())

    def _repr_html_(self) -> str:
        page = html.escape(self.html, quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 40em; border: 0"></iframe>'


def _layer_table() -> dict:
    dtypes = {_native.FLOAT32: np.float32, _native.UINT8: np.uint8, _native.UINT16: np.uint16,
              _native.UINT32: np.uint32}
    return {layer.name.decode(): {'channels': layer.channels, 'help': layer.help.decode(),
                                  'averages': bool(layer.averages), 'dtype': dtypes[layer.type]}
            for layer in _native.list_all('layer_get', _native.Layer)}


def layers() -> dict:
    """Returns the layers by name: help, channels, dtype, and whether they average the samples."""
    aliases = {name: dict(_layer_table()['beauty'], help=f'part of beauty: {name}',
                          channels=1 if name == 'alpha' else int(part.stop))
               for name, part in BEAUTY.items()}
    return {**_layer_table(), **aliases}


def settings() -> list:
    """Returns dicts of name, label, help, unit, choices, type, initial, min and max."""
    types = ('float', 'count', 'switch', 'choice')

    def choices(setting):
        found = []
        while setting.choices and setting.choices[len(found)] is not None:
            found.append(setting.choices[len(found)].decode())
        return found
    return [{'name': s.name.decode(), 'label': s.label.decode(), 'help': s.help.decode(),
             'unit': s.unit.decode() if s.unit else None, 'choices': choices(s),
             'type': types[s.type], 'initial': s.initial, 'min': s.min, 'max': s.max}
            for s in _native.list_all('setting_get', _native.Setting)]
