/*
 * microfacet.h: sampling of rough dielectric surfaces: one GGX microfacet per pixel sample.
 *
 * GGX with alpha = roughness squared, sampled by visible normals (Heitz 2018, Sampling the GGX
 * Distribution of Visible Normals). Light is reflected or refracted at the microfacet (Walter et
 * al. 2007), weighted by the Fresnel reflectance of the macroscopic surface. Single scattering
 * only: shadowed, masked and totally reflected light is lost, which makes rough surfaces too dark.
 * A ball of index 1.5 in a white furnace returns .99, .92 and .64 of the light at roughness .15, .3
 * and .6.
 */
#ifndef FIRN_LAB_REFERENCE_MICROFACET_H
#define FIRN_LAB_REFERENCE_MICROFACET_H

#include <cglm/types-struct.h>
#include <stdint.h>

/* Computes two unit vectors that form an orthonormal basis with `n` (Duff et al. 2017). */
void microfacet_tangents(vec3s n, vec3s *first, vec3s *second);

/* Samples the normal of a visible microfacet for an incident ray of direction `dir`, where dot(dir,
 * n) < 0. `at` is a random point of the unit square. */
vec3s microfacet_sample(vec3s n, vec3s dir, float roughness, vec2s at);

/* Returns the Smith masking factor G1 of GGX, 0 to 1, for light leaving along `out`. */
float microfacet_masking(vec3s n, vec3s out, float roughness);

/* Returns point `index` of a two-dimensional Sobol sequence with hash-based Owen scrambling (Burley
 * 2020). Sequences with different seeds are independent. */
vec2s microfacet_point(uint32_t index, uint32_t seed);

/* Returns a hash of two numbers, to be used as a seed. */
uint32_t microfacet_hash(uint32_t a, uint32_t b);

#endif
