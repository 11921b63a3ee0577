/*
 * radiance.h: radiance of the object's surroundings along a ray, as background.c draws them.
 *
 * Formulas and constants are those of shaders/sky.h, shaders/background.h and shaders/lit.h, and
 * the environment's light is that of the rungs' table. Textures are filtered bilinearly; only the
 * samples of a pixel antialias them.
 */
#ifndef FIRN_REFERENCE_RADIANCE_H
#define FIRN_REFERENCE_RADIANCE_H

#include "shaders/dress.h"
#include "shaders/globals.h"
#include "src/scene/scene.h"

struct radiance {
    const struct scene *scene;     /* borrowed */
    const struct globals *globals; /* borrowed */
    float linear[256];             /* linear values of the textures' bytes */
    bool is_traced; /* ground.h finds what hides the light around, so textures of occlusion do not
                       count; set by the caller */
    bool hides_sun; /* surroundings keep the sun from each other; set by the caller */
};

/* What objects make of the light at a point. */
struct radiance_sun {
    vec3s sky;         /* share of the light of what is around */
    float own;         /* share of the sun's direct light */
    vec3s through;     /* irradiance by the sun's other light; 1: the sun's, square to it */
    vec3s through_dir; /* unit, where that comes from, on the whole */
};

/* A point of a surface, as a ray along `dir` meets it. */
struct radiance_point {
    const struct mesh_vertex *vertex; /* interpolated; a unit normal of either side in the world */
    const struct mesh_extra *extra;   /* interpolated; NULL: none */
    const vec3s *along_u, *along_v; /* derivatives of the world position by the two uv; may be NULL
                                         where is_base */
    vec3s dir;                      /* unit */
    const struct radiance_sun *sun; /* NULL: no objects are in the way of light */
    float ior;    /* of the medium that is on it, relative to that around the objects */
    bool is_base; /* only the light of the matt base is asked for: reflections are traced */
};

/* What a surface makes of the light around it. */
struct radiance_shares {
    vec3s matt, glossy; /* shares of the light on a matt white surface, and of what is mirrored */
    vec3s normal, top;  /* with bumps, on the ray's side: of the matt base, of what mirrors */
    float roughness;
};

struct radiance radiance_of(const struct scene *scene, const struct globals *globals);

/* Returns the linear texel of a material's texture, or white if it has none. */
vec4s radiance_texel(const struct radiance *radiance, uint32_t material, vec2s uv);

/* Returns the radiance of the sky, environment or background colour; `dir` is unit. */
vec3s radiance_sky(const struct radiance *radiance, vec3s dir);

/* Returns the mean of the environment picture over all directions. */
vec3s radiance_mean(const struct radiance *radiance);

/* Returns the base colour of a surface. */
vec3s radiance_albedo(const struct radiance *radiance, const struct mesh_vertex *vertex);

/* Returns the radiance of a surface of the surroundings. */
vec3s radiance_surface(const struct radiance *radiance, const struct radiance_point *point);

/* Returns whether light falls on a surface of the surroundings, and in *shares what it makes of
 * it. */
bool radiance_shares_at(const struct radiance *radiance, const struct radiance_point *point,
                        struct radiance_shares *shares);

/* Returns the radiance of what is infinitely far away, without the sun's disc. */
vec3s radiance_open(const struct radiance *radiance, vec3s dir);

/* Returns what textures make of a point of an object's surface, whose own values are `own`; the
 * normal of *point, of the outer side, is bent into *normal. */
struct dress radiance_dress(const struct radiance *radiance, const struct material *material,
                            const struct radiance_point *point, struct dress own, vec3s *normal);

/* Returns the share of light that passes a surface of the surroundings: 1 in a hole, and what the
 * alpha of a blended surface leaves. */
float radiance_passing(const struct radiance *radiance, const struct mesh_vertex *vertex);

#endif
