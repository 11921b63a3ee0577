/*
 * microfacet.h: rough surfaces of dielectrics, by one microfacet for each sample of a pixel.
 *
 * Distribution: GGX with a width of roughness squared, of which visible normals are sampled (Heitz
 * 2018, Sampling the GGX Distribution of Visible Normals). Light is reflected and refracted at the
 * microfacet (Walter and others 2007), once, in the shares that Fresnel's equations give for the
 * whole surface: what is shadowed or masked is lost, and so is the refracted share of a microfacet
 * that reflects totally. So rough surfaces are darker than they should be, as a path tracer's are
 * that scatters once: a ball of index 1.5 in light of 1 shows .99, .92 and .64 at roughness .15, .3
 * and .6.
 */
#ifndef FIRN_REFERENCE_MICROFACET_H
#define FIRN_REFERENCE_MICROFACET_H

#include <cglm/types-struct.h>
#include <stdint.h>

/* Two unit vectors perpendicular to n and to each other (Duff and others 2017). */
void microfacet_tangents(vec3s n, vec3s *first, vec3s *second);

/* Returns the microfacet's normal for light from the direction -dir, where dot(dir, n) < 0. */
vec3s microfacet_sample(vec3s n, vec3s dir, float roughness, vec2s at);

/* Returns the share of light along `out` that no other part of the surface is in the way of; n is
 * the surface's normal on either side. */
float microfacet_masking(vec3s n, vec3s out, float roughness);

/* Returns point `index` of a sequence in the unit square that fills it evenly, scrambled by `seed`
 * (Burley 2020, Practical Hash-based Owen Scrambling). Sequences of two seeds are independent. */
vec2s microfacet_point(uint32_t index, uint32_t seed);

/* Returns a number that both numbers scramble well. */
uint32_t microfacet_hash(uint32_t a, uint32_t b);

#endif
