"""ice_cube.py: model of an ice cube on wet slate: slate.py simplified for all refraction models.

The ice is the only refractive object. Its cloudy core is a material property, and firn adds the
bubbles and cracks. The meltwater is an opaque, smooth material layer over dark stone.
"""
from files import Model, lit
from shapes import Mesh, dot
from slate import (ANGLE, BUMPS, EYE, ICE, TARGET, VIEW, block, meltwater, pieces, slab,
                   stone, slab_uvs, albedo)


def without_walls(mesh):
    """Returns only the upper side of a closed shell."""
    kept = [i for i, p in enumerate(mesh.points) if p[1] > -0.001]
    number = {i: at for at, i in enumerate(kept)}
    faces = [face for face in mesh.faces if number.keys() >= set(face)]
    return Mesh([mesh.points[i] for i in kept], [tuple(number[i] for i in f) for f in faces])


def water(ice):
    mesh = without_walls(meltwater(ice, 112))
    mesh.uvs = slab_uvs(mesh)
    return mesh.painted(lambda p, n: albedo(p[0], p[2]))


def below_water(dry):
    """Material of stone under a water layer: specular reflection with the water's index."""
    colors = {'baseColorTexture': dry['pbrMetallicRoughness']['baseColorTexture']}
    return {**lit('wet slate', 0.04, **colors),
            'normalTexture': {**dry['normalTexture'], 'scale': BUMPS},
            'extensions': {'KHR_materials_ior': {'ior': 1.333}}, 'extras': {'film': True}}


def make():
    model = Model()
    model.used.add('KHR_texture_transform')
    ice, dry = block(40), stone(model)
    for name, mesh, material in (('slab', slab(60, 50).join(pieces(9, 3, (0.6, 1), 100)), dry),
                                 ('water', water(ice), below_water(dry)),
                                 ('cube', ice, ICE)):
        model.add(name, mesh.placed(VIEW, (0, 0, 0)), material)
    eye, target = (tuple(dot(row, p) for row in VIEW) for p in (EYE, TARGET))
    model.camera(eye, target, ANGLE)
    return model.file()
