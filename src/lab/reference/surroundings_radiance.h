/*
 * surroundings_radiance.h: radiance of surroundings and sky along a ray. Formulas, constants and
 * environment lighting equal those of shaders/surroundings/ and shaders/brdf.h, because comparisons
 * must show only errors of refraction. Textures are filtered bilinearly without mip levels.
 * Antialiasing them takes several samples per pixel.
 */
#ifndef FIRN_LAB_REFERENCE_SURROUNDINGS_RADIANCE_H
#define FIRN_LAB_REFERENCE_SURROUNDINGS_RADIANCE_H

#include "shaders/globals.h"
#include "shaders/object_material.h"
#include "src/scene/scene.h"

struct radiance {
    const struct scene *scene;     /* borrowed */
    const struct globals *globals; /* borrowed */
    float linear[256];             /* sRGB byte to linear, for textures */
    bool is_traced;                /* ray-traced occlusion; set by the caller */
    bool hides_sun;                /* surroundings shadow each other */
};

/* Effect of objects and water on sunlight and sky light at a point. */
struct radiance_sun {
    vec3s sky;           /* transmittance for environment light */
    float direct;        /* visibility of the sun's disc */
    vec3s refracted;     /* irradiance relative to unrefracted sunlight */
    vec3s refracted_dir; /* unit mean direction towards refracted sunlight */
};

/* Surface point to be shaded, hit by a ray of direction `dir`. */
struct radiance_point {
    const struct mesh_vertex *vertex; /* world space; normal of either side */
    const struct mesh_extra *extra;   /* interpolated; NULL without extra attributes */
    const vec3s *dp_du, *dp_dv;       /* dp/du and dp/dv; NULL if is_base */
    vec3s dir;                        /* unit length */
    const struct radiance_sun *sun;   /* NULL if no object affects light */
    float ior;                        /* of the medium outside, relative */
    bool is_base;                     /* shade the diffuse base only */
};

/* Reflectance of a surface for environment light, split by lobe. */
struct radiance_reflectance {
    vec3s diffuse, glossy; /* diffuse albedo; weight of mirror reflection */
    vec3s normal, top;     /* normals of diffuse and specular lobe */
    float roughness;
};

struct radiance radiance_of(const struct scene *scene, const struct globals *globals);

/* Samples the texture of a vertex's material as linear colour. Returns white without a texture. */
vec4s radiance_texel(const struct radiance *radiance, uint32_t material, vec2s uv);

/* Returns the radiance of sky, environment map or background colour in unit direction `dir`. */
vec3s radiance_sky(const struct radiance *radiance, vec3s dir);

/* Returns the mean radiance of sky, environment map or background colour over all directions. Of an
 * environment map, it averages every `step`th texel of every `step`th row. */
vec3s radiance_mean(const struct radiance *radiance, uint32_t step);

/* Returns a surface's textured base colour. */
vec3s radiance_albedo(const struct radiance *radiance, const struct mesh_vertex *vertex);

/* Returns the radiance that surroundings emit and reflect towards the ray's origin. */
vec3s radiance_surface(const struct radiance *radiance, const struct radiance_point *point);

/* Computes the reflectance of a surface of the surroundings. Returns false if it is unlit. */
bool radiance_reflectance_at(const struct radiance *radiance, const struct radiance_point *point,
                             struct radiance_reflectance *reflectance);

/* Returns the radiance of the sky without the sun's disc, which is sampled separately. */
vec3s radiance_at_infinity(const struct radiance *radiance, vec3s dir);

/* Returns an object's textured material at a point. `untextured` is the material without textures.
 * *normal is set to the outward normal, perturbed by the normal map. */
struct object_material radiance_material_at(const struct radiance *radiance,
                                            const struct material *material,
                                            const struct radiance_point *point,
                                            struct object_material untextured, vec3s *normal);

/* Returns a surface's transmittance: 1 in a hole of a cutout, 1 - alpha if blended, else 0. */
float radiance_transmittance(const struct radiance *radiance, const struct mesh_vertex *vertex);

#endif
