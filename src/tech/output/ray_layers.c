/* ray_layers.c: table of the layers that the CPU traces through pixel centres (ray_layers.h). */
#include "src/tech/output/ray_layers.h"
#include <stddef.h>
#include "src/tech/technique.h"

/* Channels of a Cryptomatte of 4 ranks. */
#define MATTE(name) \
    { \
        name "00.R", name "00.G", name "00.B", name "00.A", name "01.R", name "01.G", name "01.B", \
            name "01.A" \
    }

#define VALUE(field) \
    .first_channel = (uint32_t)(offsetof(struct ray_layer_values, field) / sizeof(float)), \
    .is_traced = true

static const struct frame_layer layers[] = {
    {
        .name = "depths",
        .planes = { "depths.0", "depths.1", "depths.2", "depths.3", "depths.4", "depths.5",
                    "depths.6", "depths.7" },
        VALUE(depths),
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "distance along the view axis of the first 8 surfaces on the camera ray, front "
                "and back faces, metres; 1e10 past the last one",
    },
    {
        .name = "objects",
        .planes = { "objects.0", "objects.1", "objects.2", "objects.3", "objects.4", "objects.5",
                    "objects.6", "objects.7" },
        VALUE(objects),
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "numbers of the objects of layer depths, as in layer object; 0 past the last one",
    },
    {
        .name = "material",
        .planes = { "material.Z" },
        VALUE(material),
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of the first visible surface's material (names: firn/materials); 0 if "
                "there is none",
    },
    {
        .name = "class",
        .planes = { "class.Z" },
        VALUE(class_id),
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "extras.class of the first visible surface's material; 0 if there is none",
    },
    {
        .name = "boundary",
        .planes = { "boundary.Z" },
        VALUE(boundary),
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "edges of visible objects: 1 if a neighbour pixel shows another object at another "
                "depth (occlusion), 2 if only objects that touch it (contact), else 0",
    },
    {
        .name = "refracted.P",
        .planes = { "refracted.P.X", "refracted.P.Y", "refracted.P.Z" },
        VALUE(position),
        .shown = FRAME_SHOWN_POSITION,
        .help = "position of the first opaque surface on the refracted path, world space, metres; "
                "0 if there is none",
    },
    {
        .name = "refracted.Z",
        .planes = { "refracted.Z" },
        VALUE(z),
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "distance of refracted.P along the view axis, metres; 1e10 if there is none",
    },
    {
        .name = "refracted.object",
        .planes = { "refracted.object.Z" },
        VALUE(object),
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of the object at refracted.P, as in layer object; 0 if there is none",
    },
    {
        .name = "refracted.uv",
        .planes = { "refracted.uv.X", "refracted.uv.Y" },
        VALUE(uv),
        .shown = FRAME_SHOWN_POSITION,
        .help = "texture coordinates at refracted.P; 0 if there is none",
    },
    {
        .name = "refracted.motion",
        .planes = { "refracted.motion.X", "refracted.motion.Y" },
        VALUE(motion),
        .shown = FRAME_SHOWN_POSITION,
        .help = "motion of the point refracted.P, projected without refraction, since the previous "
                "frame, pixels right and down; 0 if there is none",
    },
    {
        .name = "flow.refract",
        .planes = { "flow.refract.X", "flow.refract.Y" },
        VALUE(flow),
        .shown = FRAME_SHOWN_POSITION,
        .help = "refractive flow: offset to the pixel in which refracted.P, or the background at "
                "infinity, would be without refraction, pixels right and down; NaN outside the "
                "image",
    },
    {
        .name = "transmittance",
        .planes = { "transmittance.R", "transmittance.G", "transmittance.B" },
        VALUE(transmission),
        .help = "fraction of light that the refracted path transmits (Fresnel, tint, absorption); "
                "1 without glass, 0 if the path does not end",
    },
    {
        .name = "crypto.object",
        .planes = MATTE("CryptoObject"),
        VALUE(object_matte),
        .mean = true,
        .help = "Cryptomatte of the visible objects: 4 pairs of ID and coverage by all samples",
    },
    {
        .name = "crypto.material",
        .planes = MATTE("CryptoMaterial"),
        VALUE(material_matte),
        .mean = true,
        .help = "Cryptomatte of the visible materials: 4 pairs of ID and coverage by all samples",
    },
    { 0 },
};

const struct technique ray_layers = {
    .name = "ray_layers",
    .help = "layers traced by the CPU: ordered surfaces, end of the refracted path",
    .layers = layers,
};
