/*
 * radiance.h: radiance of the surroundings and the sky along a ray, as surroundings.c renders them.
 *
 * Formulas and constants are shared with the shaders (shaders/surroundings/sky.h,
 * shaders/surroundings/surroundings.h, shaders/brdf.h), and environment lighting uses the same
 * prefiltered tables as the refraction models, so that a comparison shows errors of refraction
 * alone. Textures are filtered bilinearly, without mip levels; only the samples of a pixel
 * antialias them.
 */
#ifndef FIRN_REFERENCE_RADIANCE_H
#define FIRN_REFERENCE_RADIANCE_H

#include "shaders/globals.h"
#include "shaders/object_material.h"
#include "src/scene/scene.h"

struct radiance {
    const struct scene *scene;     /* borrowed */
    const struct globals *globals; /* borrowed */
    float linear[256];             /* linear value of each sRGB byte, for textures */
    bool is_traced; /* rays find occluders, occlusion maps are ignored; set by the caller */
    bool hides_sun; /* surroundings cast shadows on each other; set by the caller */
};

/* How objects and water change the light that arrives at a point. */
struct radiance_sun {
    vec3s sky;         /* transmittance for light of the surroundings and the sky */
    float own;         /* visibility of the sun's disc, 0 to 1 */
    vec3s through;     /* irradiance of refracted sunlight; 1: perpendicular direct sunlight */
    vec3s through_dir; /* unit vector towards the mean source of `through` */
};

/* A surface point hit by a ray of direction `dir`. */
struct radiance_point {
    const struct mesh_vertex *vertex; /* interpolated, in world space, unit normal of either side */
    const struct mesh_extra *extra;   /* interpolated; NULL if the mesh has none */
    const vec3s *u_dir, *along_v;     /* position derivatives per uv set; may be NULL if is_base */
    vec3s dir;                        /* unit length */
    const struct radiance_sun *sun;   /* NULL if no object affects the light */
    float ior;    /* index of the medium on the surface, relative to that around the objects */
    bool is_base; /* evaluate the diffuse base only, because reflections are traced */
};

/* Reflectance of a surface for environment light, split by lobe. */
struct radiance_reflectance {
    vec3s diffuse, glossy; /* albedo of the diffuse lobe; weight of mirror reflection */
    vec3s normal, top;     /* shading normals of the diffuse base and the specular lobe */
    float roughness;
};

struct radiance radiance_of(const struct scene *scene, const struct globals *globals);

/* Samples a vertex material's texture; the result is linear, and white if there is no texture. */
vec4s radiance_texel(const struct radiance *radiance, uint32_t material, vec2s uv);

/* Returns the radiance of sky, environment map or background colour in the unit direction `dir`. */
vec3s radiance_sky(const struct radiance *radiance, vec3s dir);

/* Returns the mean radiance of the environment map over all directions. */
vec3s radiance_mean(const struct radiance *radiance);

/* Returns the base colour of a surface, texture included. */
vec3s radiance_albedo(const struct radiance *radiance, const struct mesh_vertex *vertex);

/* Returns the radiance that a surface of the surroundings emits and reflects towards the ray. */
vec3s radiance_surface(const struct radiance *radiance, const struct radiance_point *point);

/* Computes the reflectance of a surface of the surroundings. Returns false if the surface is unlit.
 */
bool radiance_reflectance_at(const struct radiance *radiance, const struct radiance_point *point,
                             struct radiance_reflectance *shares);

/* Returns the radiance at infinity without the sun's disc, which is sampled separately. */
vec3s radiance_at_infinity(const struct radiance *radiance, vec3s dir);

/* Evaluates the textures of an object's material at a point; `own` has its values without textures.
 * *normal becomes the outward normal, perturbed by the normal map. */
struct object_material radiance_material_at(const struct radiance *radiance,
                                            const struct material *material,
                                            const struct radiance_point *point,
                                            struct object_material own, vec3s *normal);

/* Returns the transmittance of a surface: 1 in a cutout's hole, 1 - alpha where blended, else 0. */
float radiance_transmittance(const struct radiance *radiance, const struct mesh_vertex *vertex);

#endif
