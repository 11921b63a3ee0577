/* ray_layers.h: values of layers that the CPU traces through pixel centres, with all refraction
 * models: ordered surfaces along the unrefracted camera ray, and the end of the refracted path. */
#ifndef FIRN_TECH_OUTPUT_RAY_LAYERS_H
#define FIRN_TECH_OUTPUT_RAY_LAYERS_H

#include "shaders/abi.h"

enum {
    RAY_LAYER_SURFACES = 8, /* maximum number of surfaces along a camera ray */
    RAY_LAYER_RANKS = 4,    /* of a Cryptomatte: pairs of an ID and its coverage */
};

/* Classification of a pixel by its four neighbours: layer `boundary`. */
enum ray_layer_boundary {
    RAY_LAYER_INTERIOR,
    RAY_LAYER_OCCLUSION, /* another object is visible next to it, at another depth */
    RAY_LAYER_CONTACT,   /* another object is visible next to it, and the surfaces touch */
};

/* Values of a pixel. The layers' `first_channel` counts floats from the beginning. */
struct ray_layer_values {
    /* Surfaces of objects and surroundings along the unrefracted camera ray, front to back. Skips
     * texels that alpha masks cut out, and blended surfaces with alpha below 0.5. */
    float depths[RAY_LAYER_SURFACES];  /* view depth, metres; 1e10 past the last one */
    float objects[RAY_LAYER_SURFACES]; /* object IDs of layer `object`; 0 past the last */
    /* the first surface */
    float material; /* index into model.materials + 1; 0 if there is none */
    float class_id; /* material.class_id */
    float boundary; /* enum ray_layer_boundary */
    /* End of the path that is refracted at every surface, or reflected at total reflection: the
     * first opaque surface, or the background at infinity. Uses the refractive index for green, and
     * ignores roughness and scattering. */
    vec3s position;     /* world space, metres; 0 at infinity */
    float z;            /* view depth of `position`, metres; 1e10 at infinity */
    float object;       /* number of layer `object`; 0 at infinity */
    vec2s uv;           /* first texture coordinates; 0 at infinity */
    vec2s motion;       /* of `position`, projected without refraction, pixels since last frame */
    vec2s flow;         /* projection of the end point without refraction - pixel centre; pixels */
    vec3s transmission; /* throughput of the path; 0 if it does not end */
    /* Cryptomatte IDs and coverages of the first surfaces of all samples, in descending order. */
    float object_matte[2 * RAY_LAYER_RANKS], material_matte[2 * RAY_LAYER_RANKS];
};

#endif
