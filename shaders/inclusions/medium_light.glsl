/*
 * medium_light.glsl: single-segment approximation of light scattered by a medium
 * (medium_density.h).
 *
 * A segment of optical depth t transmits exp(-t) unscattered. With the Henyey-Greenstein phase
 * function of parameter g, a fraction exp(-(1 - g) t) - exp(-t) comes from about the ray's
 * direction, the rest from all directions. The fractions add up to 1, so that the medium is
 * invisible in uniform light. Sunlight is attenuated along a straight shadow ray; multiple
 * scattering widens the phase function with optical depth (Wrenninge, Kulla and Lundqvist 2013, Oz:
 * The Great and Volumetric). Scaling the optical depth by 1 - g (similarity relation) replaces the
 * simulation of multiple forward scattering.
 *
 * Error: the environment's light is taken as infinitely distant and unoccluded; sunlight is neither
 * refracted at the surface nor shadowed.
 */
#ifndef MEDIUM_LIGHT_GLSL
#define MEDIUM_LIGHT_GLSL
#include "inclusions/medium_density.h"
#include "lib/environment_diffuse.glsl"

layout(set = 0, binding = MEDIUM_TEXELS) uniform sampler2DArray densities;

const int medium_sun_steps = 3;       /* shadow ray steps; each is twice as long as the last */
const float medium_blur = 4.55 - 1.0; /* prefiltered layer for the forward lobe */

/* Returns the relative density, 0 to 1, of a field at an object-space point. */
float medium_density(medium_field field, vec3 point)
{
    vec3 at = (point - field.min_corner) * field.texels_per_metre;
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(MEDIUM_SIZE))))
        return 0.0;
    float z = clamp(at.z - 0.5, 0.0, float(MEDIUM_SIZE) - 1.0);
    float layer = min(floor(z), float(MEDIUM_SIZE) - 2.0);
    vec3 texel = vec3(at.xy / float(MEDIUM_SIZE), field.first_layer + layer);
    vec2 both = textureLod(densities, texel, 0.0).rg;
    return mix(both.x, both.y, z - layer);
}

/* Returns the optical depth from a point towards the sun. */
float medium_sun_depth(medium_field field, vec3 point, vec3 to_sun)
{
    float sum = 0.0, from = 0.0, length = 0.06 * float(MEDIUM_SIZE) / field.texels_per_metre.x;
    for (int i = 0; i < medium_sun_steps; i++) {
        sum += length * medium_density(field, point + (from + 0.5 * length) * to_sun);
        from += length;
        length *= 2.0;
    }
    return sum * field.extinction;
}

/* Fits x + y u + z u^2 to the optical depth towards the sun along a segment, for u from 0 to 1.
 * Returns x, y and z. Three shadow rays suffice, because the optical depth is smooth. */
vec3 medium_sun_depth_fit(medium_field field, vec3 from, vec3 segment, vec3 to_sun)
{
    float near = medium_sun_depth(field, from + segment / 6.0, to_sun);
    float center = medium_sun_depth(field, from + 0.5 * segment, to_sun);
    float far = medium_sun_depth(field, from + segment / 1.2, to_sun);
    float slope = 1.5 * (far - near);
    float curvature = 4.5 * (near - 2.0 * center + far);
    return vec3(center - 0.5 * slope + 0.25 * curvature, slope - curvature, curvature);
}

/* Returns the in-scattered sunlight relative to the sunlight on a white diffuse surface. `depth` is
 * the optical depth towards the sun: it attenuates the light and widens the phase function. */
float medium_sun_scattering(float cosine, float depth)
{
    float g = frame.medium_g;
    float widened = sign(g) * pow(abs(g), 1.0 + depth);
    return 0.25 * medium_phase(cosine, widened) * exp(-(1.0 - g) * depth);
}

/* Returns the environment light scattered into a ray. `ahead` is the weight of light from around
 * the ray's direction. `anywhere` is the weight of the mean light of all directions. */
vec3 medium_environment_scattering(vec3 dir, float ahead, float anywhere)
{
    vec3 forward = lit_diffuse(dir);
    vec3 mean = 0.5 * (forward + lit_diffuse(-dir));
    if (constant_background == GLOBALS_ENVIRONMENT) {
        vec2 at = surroundings_equirect_uv(dir, constant_environment_turn);
        float layer = floor(medium_blur);
        vec3 sharper = textureLod(environment_light, vec3(at, layer), 0.0).rgb;
        vec3 blurred = textureLod(environment_light, vec3(at, layer + 1.0), 0.0).rgb;
        forward = mix(sharper, blurred, medium_blur - layer);
    }
    return ahead * forward + anywhere * mean;
}

/* Scattering along one segment of a path. */
struct medium_segment {
    float depth; /* optical depth */
    float sun;   /* in-scattered sunlight relative to frame.sun_light */
};

/* Returns the ray parameters at which a ray enters and leaves the box of non-zero densities. */
vec2 medium_bounds(medium_field field, vec3 from, vec3 along)
{
    vec3 safe = mix(along, vec3(1e-6), lessThan(abs(along), vec3(1e-6)));
    vec3 t_low = (field.from - from) / safe, t_high = (field.to - from) / safe;
    vec3 enter = min(t_low, t_high), leave = max(t_low, t_high);
    return vec2(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
}

/* Ray-marches a segment of length `t` from the object-space point `from`. Returns its optical depth
 * and in-scattered sunlight. `remaining` is equal to `steps`, or 0 to skip the segment. */
medium_segment medium_march(medium_field field, vec3 from, vec3 along, vec3 to_sun, float cosine,
                            float t, int steps, int remaining)
{
    medium_segment result = medium_segment(0.0, 0.0);
    vec2 between = clamp(medium_bounds(field, from, along), 0.0, t);
    vec3 first = from + between.x * along, segment = (between.y - between.x) * along;
    float step_length = (between.y - between.x) / float(steps);
    bool is_lit = frame.sun_light != vec3(0.0) && remaining > 0 && step_length > 0.0;
    vec3 sun_depths = vec3(0.0);
    /* a loop instead of a branch, of which lavapipe executes both sides */
    for (int fits = is_lit ? min(remaining, 1) : 0; fits > 0; fits--)
        sun_depths = medium_sun_depth_fit(field, first, segment, to_sun);
    remaining = step_length > 0.0 ? remaining : 0;
    while (remaining > 0) {
        remaining--;
        float u = (float(remaining) + 0.5) / float(steps);
        float depth_here =
            medium_density(field, first + u * segment) * field.extinction * step_length;
        float sun_depth = max(sun_depths.x + u * (sun_depths.y + u * sun_depths.z), 0.0);
        float transmittance = exp(-depth_here), reduced = exp(-(1.0 - frame.medium_g) * depth_here);
        result.sun *= reduced;
        if (is_lit && depth_here > 0.0)
            result.sun += (1.0 - transmittance) * medium_sun_scattering(cosine, sun_depth);
        result.depth += depth_here;
    }
    return result;
}

/* Returns the radiance that a segment adds to the path by in-scattering. */
vec3 medium_light(medium_segment result, vec3 dir)
{
    float transmittance = exp(-result.depth), reduced = exp(-(1.0 - frame.medium_g) * result.depth);
    return medium_environment_scattering(dir, reduced - transmittance, 1.0 - reduced) +
           result.sun * frame.sun_light;
}

#endif
