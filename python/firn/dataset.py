"""
dataset.py: data sets of transparent objects: random views and variations by seed, and writers.

    with firn.dataset.Writer('out', formats=('exr', 'coco'), seed=7) as writer:
        for index in writer.missing(range(20)):
            rng = writer.rng(index)
            firn.dataset.vary(scene, rng, ior=(1.3, 1.7), attenuation=(0, 2))
            camera = firn.dataset.random_camera(rng, scene, size=(640, 480))
            writer.write(index, renderer.render(camera), scene)

An image depends only on the seed and its index, so that a set can be resumed, and distributed over
processes: each one draws `firn.dataset.share(range(20), number, count)`.
"""
from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import pathlib
import re
import zipfile
from collections.abc import Iterable

import numpy as np

from .camera import Camera
from .device import Material, settings
from .errors import UsageError
from .frame import Frame, png_bytes, write_exr, write_file
from .tabletop import tabletop  # noqa: F401, part of this module's interface

NOTHING = 0  # object number of the background
OPAQUE = 1e-6  # transmission of objects that opaque() changes


# ---- variation ----

def share(indices: Iterable, number: int | None = None, count: int | None = None) -> list:
    """
    Returns the indices for process `number` of `count`: every count-th, starting at `number` (0 for
    the first). The default is the task of a Slurm array job, or all indices outside of one.
    """
    if number is None:
        number = int(os.environ.get('SLURM_ARRAY_TASK_ID', 0))
        number -= int(os.environ.get('SLURM_ARRAY_TASK_MIN', 0))
        count = int(os.environ.get('SLURM_ARRAY_TASK_COUNT', 1))
    if not count or not 0 <= number < count:
        raise UsageError(f'share: expected 0 <= number < count, got {number} of {count}')
    return list(indices)[number::count]


def _bounds(scene, refractive_only=True):
    objects = [one for one in scene.objects.all() if one.refracts or not refractive_only]
    if not objects:
        raise UsageError('the scene has no refractive object; name a centre and a radius')
    low = np.min([one.box[0] for one in objects], axis=0)
    high = np.max([one.box[1] for one in objects], axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low)) / 2


def random_camera(rng, scene, size, *, fov=(20, 40), elevation=(5, 60), distance=(1.1, 1.8),
                  shift=0.1) -> Camera:
    """
    Returns a camera that looks at the refractive objects from a random direction. `elevation` is in
    degrees above the horizon. `distance` 1 is that at which their bounding sphere fills the image.
    `shift` is the maximum random offset of the target, as a fraction of the sphere's radius.
    """
    centre, radius = _bounds(scene)
    angle = rng.uniform(*fov)
    aspect = min(1.0, size[0] / size[1])
    half = np.arctan(np.tan(np.radians(angle) / 2) * aspect)
    away = radius / np.sin(half) * rng.uniform(*distance)
    # uniform on the sphere between both elevations
    height = rng.uniform(*np.sin(np.radians(elevation)))
    turn = rng.uniform(0, 2 * np.pi)
    flat = np.sqrt(1 - height * height)
    direction = np.array([flat * np.sin(turn), height, flat * np.cos(turn)])
    target = centre + rng.uniform(-1, 1, 3) * radius * shift
    return Camera.look_at(target + away * direction, target, angle, size)


VARIATIONS = {  # material properties that vary() changes
    'ior': 'refractive index of all refractive objects',
    'dispersion': 'dispersion, 20 / Abbe number',
    'roughness': 'roughness, 0 to 1',
    'scattering': 'optical depth of scattering across the object',
    'attenuation': 'optical depth of a random colour across 1 cm',
}
OPTIONS = ('env_rotate', 'env_exposure')  # options of the panorama, in degrees and stops


def vary(scene, rng, **ranges) -> dict:
    """
    Sets material properties of each refractive object, and settings of the scene, to uniform random
    values between (low, high). Names are those of VARIATIONS, OPTIONS, and settings with '_' for
    '.'. Returns the chosen values, for the data set's metadata.
    """
    chosen = {}
    material_ranges = {name: ranges.pop(name) for name in list(ranges) if name in VARIATIONS}
    for one in (each for each in scene.objects.all() if each.refracts):
        fields = {name: float(rng.uniform(*limits)) for name, limits in material_ranges.items()}
        if 'attenuation' in fields:
            color = np.exp(-fields.pop('attenuation') * rng.uniform(0, 1, 3))
            fields.update(attenuation_color=color.tolist(), attenuation_distance=0.01)
        if fields:
            one.material.set(**fields)
            chosen[f'{one.id} {one.name}'.strip()] = fields
    known = {setting['name'].replace('.', '_'): setting for setting in settings()}
    known.update({name: {'name': name.replace('_', '-'), 'type': 'float'} for name in OPTIONS})
    for name, limits in ranges.items():
        if name not in known:
            raise UsageError(f'vary: no value or setting {name!r}; see firn.dataset.VARIATIONS and '
                             'firn.settings()')
        is_whole = known[name]['type'] == 'count'
        value = int(rng.integers(*limits, endpoint=True)) if is_whole else rng.uniform(*limits)
        chosen[known[name]['name']] = value
        scene.set(known[name]['name'], value)
    return chosen


@contextlib.contextmanager
def opaque(scene, color=(0.8, 0.8, 0.8)):
    """
    Makes all refractive objects of a scene opaque within a `with` block. They keep their numbers and
    shapes, so the same view before and inside the block is a pair. `color` is linear.
    """
    before = [(one, one.material) for one in scene.objects.all() if one.refracts]
    for one, material in before:  # objects without transmission would become surroundings
        fields = ('thickness', 'ior', 'class_id') + ('priority',) * material.has_priority
        one.material = Material(base_color=(*color, 1), metallic=0, roughness=0,
                                transmission=OPAQUE,
                                **{name: getattr(material, name) for name in fields})
    try:
        yield
    finally:
        for one, material in before:
            one.material = material


# ---- masks ----

def visible_masks(frame: Frame) -> dict:
    """Returns boolean masks (h, w) of the visible parts by object number, from layer `object`."""
    layer = frame['object']
    return {int(number): layer == number for number in np.unique(layer) if number != NOTHING}


def amodal_masks(frame: Frame) -> dict:
    """
    Returns boolean masks (h, w) of whole objects by number, from layer `objects`: also where other
    objects hide them, unless more than 8 surfaces are in front.
    """
    layers = frame['objects']
    if 'object' in frame:  # rasterised silhouettes may differ by a pixel
        layers = np.concatenate([layers, frame['object'][..., None]], axis=-1)
    return {int(number): (layers == number).any(axis=-1)
            for number in np.unique(layers) if number != NOTHING}


def visible_fractions(frame: Frame) -> dict:
    """Returns the visible fraction of each object by its number, from `object` and `objects`."""
    return {number: int((frame['object'] == number).sum()) / int(mask.sum())
            for number, mask in amodal_masks(frame).items()}


def rle(mask) -> dict:
    """Encodes a mask (h, w) as COCO's compressed run lengths: {'size': [h, w], 'counts': text}."""
    mask = np.asarray(mask, dtype=bool)
    flat = np.concatenate([[False], mask.ravel(order='F'), [False]])
    edges = np.flatnonzero(flat[1:] != flat[:-1])
    runs = np.diff(np.concatenate([[0], edges, [mask.size]]))
    if mask.size and mask.ravel(order='F')[-1]:
        runs = runs[:-1]  # omit the empty last run
    text = []
    for i, run in enumerate(runs):
        value = int(run) - (int(runs[i - 2]) if i > 2 else 0)
        more = True
        while more:  # 5 bits per character, lowest bits first
            bits = value & 31
            value >>= 5
            more = value != (-1 if bits & 16 else 0)
            text.append(chr(bits + (32 if more else 0) + 48))
    return {'size': list(mask.shape), 'counts': ''.join(text)}


def box_of(mask) -> list:
    """Returns COCO's box [x, y, width, height] of a mask, in pixels; zeros if it is empty."""
    rows, columns = np.flatnonzero(np.any(mask, axis=1)), np.flatnonzero(np.any(mask, axis=0))
    if not len(rows):
        return [0, 0, 0, 0]
    return [int(columns[0]), int(rows[0]), int(columns[-1] - columns[0] + 1),
            int(rows[-1] - rows[0] + 1)]


# ---- writers ----

def _dump(path, value) -> None:
    write_file(path, (json.dumps(value, indent=1) + '\n').encode())


def _folder(path) -> pathlib.Path:
    path.mkdir(parents=True, exist_ok=True)
    return path


def _write_exr(folder, index, frame, _entry):
    path = _folder(folder / 'exr') / f'{index:06}.exr'
    write_exr(path, frame._layers)
    return [path]


def _write_npz(folder, index, frame, _entry):
    path = _folder(folder / 'npz') / f'{index:06}.npz'
    data = io.BytesIO()
    with zipfile.ZipFile(data, 'w', zipfile.ZIP_DEFLATED) as archive:
        for name, array in frame._layers.items():
            text = io.BytesIO()
            np.lib.format.write_array(text, array)
            # unlike numpy.savez(), ZipInfo has a fixed date, so files are reproducible
            archive.writestr(zipfile.ZipInfo(f'{name}.npy'), text.getvalue(),
                             zipfile.ZIP_DEFLATED)
    write_file(path, data.getvalue())
    return [path]


def _write_png(folder, index, frame, _entry):
    path = _folder(folder / 'rgb') / f'{index:06}.png'
    write_file(path, png_bytes(frame.srgb()))
    return [path]


def _annotate_coco(folder, index, frame, entry):
    entry['annotations'] = [
        {'object_id': number, 'bbox': box_of(mask), 'area': int(mask.sum()), 'iscrowd': 0,
         'segmentation': rle(mask)}
        for number, mask in visible_masks(frame).items()]
    if 'objects' in frame:
        whole = amodal_masks(frame)
        for one in entry['annotations']:
            mask = whole[one['object_id']]
            one.update(amodal_bbox=box_of(mask), amodal_segmentation=rle(mask),
                       visible_fraction=one['area'] / int(mask.sum()))
    return _write_png(folder, index, frame, entry)


def _category(entry, annotation):
    """Returns the name of the annotated object in its image, without a number at the end."""
    number = annotation['object_id']
    name = entry['names'].get(str(number), '')
    return re.sub(r'[ ._-]*\d+$', '', name) or name or f'object {number}'


def _finish_coco(writer, entries):
    found = [(entry, one, _category(entry, one)) for entry in entries
             for one in entry['annotations']]
    names = sorted({name for _, _, name in found}
                   if writer.categories is None else writer.categories)
    images = [{'id': entry['index'], 'file_name': f'rgb/{entry["index"]:06}.png',
               'width': entry['size'][0], 'height': entry['size'][1]} for entry in entries]
    annotations = [{'image_id': entry['index'], 'category_id': 1 + names.index(name), **one}
                   for entry, one, name in found if name in names]
    _dump(writer.folder / 'coco.json', {
        'info': {'description': 'rendered by firn'}, 'images': images,
        'annotations': [{'id': number, **one} for number, one in enumerate(annotations, 1)],
        'categories': [{'id': number, 'name': name} for number, name in enumerate(names, 1)]})


def _write_bop(folder, index, frame, entry):
    scene = folder / 'bop' / '000001'
    depth = np.where(frame['Z'] < 1e9, frame['Z'], 0) * 10000  # 0.1 mm; 0 for the background
    if depth.max() > 65535:
        raise UsageError('BOP: depths above 6.5 m do not fit into 16 bits')
    files = {_folder(scene / 'rgb') / f'{index:06}.png': frame.srgb(),
             _folder(scene / 'depth') / f'{index:06}.png': np.round(depth).astype(np.uint16)}
    entry['bop'] = []
    visible = visible_masks(frame)
    whole = amodal_masks(frame) if 'objects' in frame else visible
    for place, (number, mask) in enumerate(whole.items()):
        seen = visible.get(number, np.zeros_like(mask))
        name = f'{index:06}_{place:06}.png'
        files[_folder(scene / 'mask_visib') / name] = np.uint8(255) * seen
        counts = {'obj_id': number, 'bbox_visib': box_of(seen), 'px_count_visib': int(seen.sum()),
                  'px_count_valid': int((seen & (depth > 0)).sum())}
        if 'objects' in frame:
            files[_folder(scene / 'mask') / name] = np.uint8(255) * mask
            counts.update(bbox_obj=box_of(mask), px_count_all=int(mask.sum()),
                          visib_fract=int(seen.sum()) / int(mask.sum()))
        entry['bop'].append(counts)
    for path, pixels in files.items():
        write_file(path, png_bytes(pixels))
    return list(files)


def _finish_bop(writer, entries):
    """Writes BOP's files, in millimetres. Objects are in world space, so poses are the camera's."""
    cameras, poses, infos = {}, {}, {}
    for entry in entries:
        key, camera = str(entry['index']), entry['camera']
        rotation = list(np.ravel(camera['R']))
        position = [1000 * x for x in camera['t']]
        cameras[key] = {'cam_K': list(np.ravel(camera['K'])), 'depth_scale': 0.1,
                        'cam_R_w2c': rotation, 'cam_t_w2c': position}
        poses[key] = [{'cam_R_m2c': rotation, 'cam_t_m2c': position, 'obj_id': one['obj_id']}
                      for one in entry['bop']]
        infos[key] = [{k: v for k, v in one.items() if k != 'obj_id'} for one in entry['bop']]
    scene = writer.folder / 'bop' / '000001'
    for name, value in (('camera', cameras), ('gt', poses), ('gt_info', infos)):
        _dump(scene / f'scene_{name}.json', value)


def _finish_colmap(writer, entries):
    cameras, images = [], []
    for number, entry in enumerate(entries, 1):
        camera = Camera(*(entry['camera'][name] for name in ('K', 'R', 't', 'size')))
        (fx, _, cx), (_, fy, cy), _ = camera.K
        width, height = camera.size
        cameras.append(f'{number} PINHOLE {width} {height} {fx!r} {fy!r} {cx + .5!r} {cy + .5!r}')
        pose = ' '.join(repr(float(x)) for x in (*camera.quaternion, *camera.t))
        images.append(f'{number} {pose} {number} {entry["index"]:06}.png\n')
    path = _folder(writer.folder / 'colmap')
    write_file(path / 'cameras.txt', ('\n'.join(cameras) + '\n').encode())
    write_file(path / 'images.txt', ('\n'.join(images) + '\n').encode())
    write_file(path / 'points3D.txt', b'')


# functions by format: for each image, and for the whole set at its end
_FORMATS = {
    'exr': (_write_exr, None),
    'npz': (_write_npz, None),
    'png': (_write_png, None),
    'coco': (_annotate_coco, _finish_coco),
    'bop': (_write_bop, _finish_bop),
    'colmap': (_write_png, _finish_colmap),
}


def _metas(folder):
    """Returns the paths of the images' meta files, in the order of their indices."""
    return sorted((folder / 'meta').glob('*.json'))


def _meta(path):
    """Returns the contents of a meta file, or None if it is missing or damaged."""
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return None


class Writer:
    """
    Writes a data set into a folder. Values of `formats`:

    exr     exr/000000.exr with all layers
    npz     npz/000000.npz with all layers
    png     rgb/000000.png
    coco    coco.json with boxes and visible masks, and rgb/; needs the layer `object`; with
            `objects` also whole (amodal) boxes and masks, and visible fractions. An object's
            category is its name without a number at the end; `categories` are those to keep
    bop     bop/000001/, lengths in millimetres, visible masks; needs `object` and `Z`; with
            `objects` also whole masks and visible fractions
    colmap  colmap/*.txt with the cameras, and rgb/

    meta/000000.json contains the camera, the variation and SHA-256 hashes of an image's files. It
    is written last, so an image that has it is complete. dataset.json lists all images.
    """
    def __init__(self, folder, formats=('exr',), seed: int = 0,
                 categories: Iterable[str] | None = None):
        unknown = [name for name in formats if name not in _FORMATS]
        if unknown:
            raise UsageError(f'no format {unknown[0]!r}; there are {", ".join(_FORMATS)}')
        self.folder = pathlib.Path(folder)
        self.formats, self.seed = tuple(formats), int(seed)
        self.categories = None if categories is None else set(categories)
        _folder(self.folder / 'meta')
        old = next((entry for entry in map(_meta, _metas(self.folder)) if entry), {})
        if old.get('seed', self.seed) != self.seed:
            raise UsageError(f'{self.folder}: has images of seed {old["seed"]}; use another folder '
                             f'for seed {self.seed}, or delete these images')

    def rng(self, index: int) -> np.random.Generator:
        """Returns the random number generator of an image, seeded by the seed and the index."""
        return np.random.default_rng([self.seed, index])

    def _meta_path(self, index: int) -> pathlib.Path:
        return self.folder / 'meta' / f'{index:06}.json'

    def missing(self, indices: Iterable) -> list:
        """Returns the indices without a complete image in these formats."""
        def is_there(index):
            entry = _meta(self._meta_path(index))
            return entry is not None and entry['formats'] == list(self.formats)
        return [index for index in indices if not is_there(index)]

    def write(self, index: int, frame: Frame, scene=None, variation: dict | None = None) -> None:
        """Writes an image in all formats. `scene` gives the names of the objects in it."""
        names = {} if scene is None else {one.id: one.name for one in scene.objects.all()}
        entry = {'index': index, 'seed': self.seed, 'formats': list(self.formats),
                 'size': list(frame.size), 'camera': json.loads(frame.camera.to_json()),
                 'variation': variation or {}, 'names': names}
        files = dict.fromkeys(path for name in self.formats
                              for path in _FORMATS[name][0](self.folder, index, frame, entry))
        entry['sha256'] = {str(path.relative_to(self.folder)):
                           hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
        _dump(self._meta_path(index), entry)

    def close(self) -> None:
        """Writes dataset.json and the files of formats that list all images."""
        entries = [json.loads(path.read_text()) for path in _metas(self.folder)]
        for finish in dict.fromkeys(_FORMATS[name][1] for name in self.formats):
            if finish:
                finish(self, entries)
        _dump(self.folder / 'dataset.json', {
            'seed': self.seed, 'formats': list(self.formats),
            'images': [{'index': entry['index'], 'objects': entry['names'],
                        'sha256': entry['sha256']} for entry in entries]})

    def __enter__(self) -> Writer:
        return self

    def __exit__(self, kind, *_) -> None:
        if kind is None:  # the next run finishes an interrupted set
            self.close()
