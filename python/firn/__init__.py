"""
firn renders ice, glass and water, with noise-free layers: depth, normals, masks, refractive flow.

    import firn
    with firn.Device() as device, device.load('cup.glb', env='studio') as scene:
        renderer = scene.renderer(layers=('rgb', 'depth', 'object'))
        camera = firn.Camera.look_at((0, .1, .4), (0, .05, 0), fov=30, size=(640, 480))
        frame = renderer.render(camera)
        frame.save('cup.exr')

Importing firn opens no device, so worker processes may be forked before the first Device. World
space is right-handed with +Y up, in metres.
"""
from . import dataset
from .camera import Camera
from .device import (Device, Material, Objects, Plan, Renderer, Scene, SceneObject, layers,
                     settings)
from .errors import (Cancelled, ClosedError, DataError, Error, InputError, NoDeviceError,
                     OutputError, TryAgainError, UsageError)
from .frame import Frame, diff, write_exr


def version() -> str:
    """Returns the version of the C library."""
    from . import _native
    return _native.library().firn_version().decode()


__all__ = [
    'Camera', 'Cancelled', 'ClosedError', 'DataError', 'Device', 'Error', 'Frame', 'InputError',
    'Material', 'NoDeviceError', 'Objects', 'OutputError', 'Plan', 'Renderer', 'Scene', 'SceneObject',
    'TryAgainError', 'UsageError', 'dataset', 'diff', 'layers', 'settings', 'version', 'write_exr',
]
