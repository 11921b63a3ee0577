"""camera.py: pinhole cameras, from OpenCV or OpenGL matrices, or from eye and target."""
from __future__ import annotations

import json
import math

import numpy as np

from . import _native
from .errors import UsageError

_FLIP = np.diag([1.0, -1.0, -1.0])  # converts between the camera axes of OpenCV and OpenGL


def _array(name, value, shape):
    array = np.asarray(value, dtype=np.float64)
    if array.shape != shape or not np.all(np.isfinite(array)):
        raise UsageError(f'{name}: expected {shape} finite numbers, got shape {array.shape}')
    return array


def _rotation(name, value):
    matrix = _array(name, value, (3, 3))
    if np.abs(matrix @ matrix.T - np.eye(3)).max() > 1e-4 or np.linalg.det(matrix) < 0:
        raise UsageError(f'{name}: not a rotation matrix (orthonormal rows, determinant 1)')
    return matrix


class Camera:
    """
    A pinhole camera for an image of `size` (width, height) in pixels.

    `K` is the intrinsic matrix; `R` (3, 3) and `t` (3,) transform world space (metres) to OpenCV
    camera space (+X right, +Y down, +Z forward). A point X is projected to K (R X + t). The
    centre of the top left pixel is (0, 0). `time` is the animation time in seconds, or None.
    """
    def __init__(self, K, R, t, size, time=None):
        self.K = _array('K', K, (3, 3))
        self.R = _rotation('R', R)
        self.t = _array('t', np.ravel(t), (3,))
        width, height = (int(n) for n in size)
        if width < 1 or height < 1:
            raise UsageError(f'size: expected a width and a height in pixels, got {size}')
        self.size = (width, height)
        self.time = None if time is None else float(time)
        fx, fy = self.K[0, 0], self.K[1, 1]
        if fx <= 0 or fy <= 0 or np.abs(self.K - [[fx, 0, self.K[0, 2]], [0, fy, self.K[1, 2]],
                                                 [0, 0, 1]]).max() > 1e-9 * max(fx, fy):
            raise UsageError('K: expected [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]; skew is not drawn')

    @classmethod
    def opencv(cls, K, R, t, size, time=None) -> Camera:
        """Creates a camera from OpenCV's K, R, t: world to camera, top left pixel centre (0, 0)."""
        return cls(K, R, t, size, time)

    @classmethod
    def opengl(cls, K, world_from_camera, size, time=None) -> Camera:
        """
        Creates a camera from a camera-to-world matrix (4, 4) or (3, 4) with the axes of OpenGL and
        Blender (+Y up, -Z forward). In `K`, (0, 0) is the top left corner of the image and +v points
        down.
        """
        pose = np.asarray(world_from_camera, dtype=np.float64)[:3]
        pose = _array('world_from_camera', pose, (3, 4))
        K = np.array(K, dtype=np.float64)
        K[:2, 2] -= 0.5
        R = (_rotation('world_from_camera', pose[:, :3]) @ _FLIP).T
        return cls(K, R, -R @ pose[:, 3], size, time)

    @classmethod
    def look_at(cls, eye, target, fov, size, up=(0, 1, 0), time=None) -> Camera:
        """Creates a camera from eye, target and the vertical field of view in degrees."""
        eye, target = _array('eye', eye, (3,)), _array('target', target, (3,))
        up = _array('up', up, (3,))
        forward = target - eye
        right = np.cross(forward, up)
        if not np.linalg.norm(forward) or not np.linalg.norm(right):
            raise UsageError('look_at: the eye is at the target, or the view is parallel to `up`')
        if not 1 <= fov <= 170:
            raise UsageError(f'fov: expected 1 to 170 degrees, got {fov}')
        forward, right = forward / np.linalg.norm(forward), right / np.linalg.norm(right)
        R = np.stack([right, np.cross(forward, right), forward])
        f = size[1] / 2 / math.tan(math.radians(fov) / 2)
        K = [[f, 0, (size[0] - 1) / 2], [0, f, (size[1] - 1) / 2], [0, 0, 1]]
        return cls(K, R, -R @ eye, size, time)

    @classmethod
    def from_colmap(cls, model, parameters, quaternion, translation, size) -> Camera:
        """Creates a camera from COLMAP's (SIMPLE_)PINHOLE and a quaternion (w, x, y, z)."""
        if model not in ('SIMPLE_PINHOLE', 'PINHOLE'):
            raise UsageError(f'model {model}: expected SIMPLE_PINHOLE or PINHOLE; undistort first')
        *f, cx, cy = parameters
        K = [[f[0], 0, cx - 0.5], [0, f[-1], cy - 0.5], [0, 0, 1]]
        w, x, y, z = np.asarray(quaternion, dtype=np.float64) / np.linalg.norm(quaternion)
        R = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
             [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
             [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
        return cls(K, R, translation, size)

    @classmethod
    def from_bop(cls, cam_K, cam_R_w2c, cam_t_w2c, size) -> Camera:
        """Creates a camera from an entry of BOP's scene_camera.json (in millimetres)."""
        return cls(np.reshape(cam_K, (3, 3)), np.reshape(cam_R_w2c, (3, 3)),
                   np.asarray(cam_t_w2c, dtype=np.float64) / 1000, size)

    @property
    def position(self) -> np.ndarray:
        """Position of the camera in world space, metres, shape (3,)."""
        return -self.R.T @ self.t

    @property
    def world_from_camera(self) -> np.ndarray:
        """Camera-to-world matrix (4, 4) with the axes of OpenCV."""
        pose = np.eye(4)
        pose[:3, :3] = self.R.T
        pose[:3, 3] = self.position
        return pose

    @property
    def quaternion(self) -> np.ndarray:
        """The rotation R as a quaternion (w, x, y, z) with w >= 0, as in COLMAP."""
        R = self.R
        # matrix of Bar-Itzhack (2000): the eigenvector of its largest eigenvalue is (x, y, z, w)
        k = np.array([
            [R[0, 0] - R[1, 1] - R[2, 2], 0, 0, 0],
            [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0, 0],
            [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0],
            [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)]]) / 3
        x, y, z, w = np.linalg.eigh(k)[1][:, 3]
        return np.array([w, x, y, z]) * (1 if w >= 0 else -1)

    def project(self, points) -> np.ndarray:
        """Projects world-space points (n, 3) to pixel coordinates (n, 2); NaN behind the camera."""
        points = np.asarray(points, dtype=np.float64) @ self.R.T + self.t
        z = np.where(points[..., 2:] > 0, points[..., 2:], np.nan)
        return (points[..., :2] / z) * np.diag(self.K)[:2] + self.K[:2, 2]

    def to_json(self) -> str:
        """Returns JSON with K, R, t, size and the camera-to-world matrix with OpenGL's axes."""
        opengl = self.world_from_camera @ np.diag([1.0, -1.0, -1.0, 1.0])
        return json.dumps({
            'K': self.K.tolist(), 'R': self.R.tolist(), 't': self.t.tolist(),
            'size': list(self.size), 'time': self.time, 'world_from_camera_opengl': opengl.tolist(),
            'convention': 'OpenCV: x_camera = R x_world + t in metres; pixel centres are integers',
        }, indent=1)

    def __repr__(self) -> str:
        return f'Camera(size={self.size}, position={np.round(self.position, 6).tolist()})'

    def _struct(self):
        fx, fy = np.diag(self.K)[:2]
        pose = self.world_from_camera[:3].ravel()
        return _native.Camera(
            kind=_native.CAMERA_OPENCV, has_time=self.time is not None, time=self.time or 0.0,
            fx=fx, fy=fy, cx=self.K[0, 2], cy=self.K[1, 2],
            world_from_camera=(_native.c_double * 12)(*pose))


def camera_of_struct(struct, size) -> Camera:
    """Returns the Camera of a C struct of kind CAMERA_OPENCV."""
    pose = np.array(struct.world_from_camera).reshape(3, 4)
    R = pose[:, :3].T
    K = [[struct.fx, 0, struct.cx], [0, struct.fy, struct.cy], [0, 0, 1]]
    return Camera(K, R, -R @ pose[:, 3], size, struct.time if struct.has_time else None)
