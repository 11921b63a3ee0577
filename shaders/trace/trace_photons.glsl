/*
 * trace_photons.glsl: photon tracing from the sun, one photon per texel of the caustic map's light
 * space. A photon chooses reflection or refraction at random at each surface and lands on
 * surroundings; ice_caustics.c splats it. src/lab/reference/photons.c has the equivalent C code.
 *
 * Scattering media deflect photons isotropically at the reduced scattering coefficient, (1 - g)
 * times extinction. Photons end at the first surface of surroundings, even in alpha-tested holes.
 */
#ifndef TRACE_PHOTONS_GLSL
#define TRACE_PHOTONS_GLSL
#include "lib/sun_light_space.glsl"
#include "lighting/diffuse_sampling.h"

layout(push_constant, scalar) uniform Push
{
    ice_caustics_push push;
};

layout(set = 0, binding = ICE_CAUSTICS_GROUND) uniform sampler2D ground;

/* xy: landing point in the caustic map; z: fraction of the photon's energy that arrives */
layout(location = 0) out vec4 landing_red;
layout(location = 1) out vec4 landing_green;
layout(location = 2) out vec4 landing_blue;
layout(location = 3) out vec4 landing_reflected; /* unused: paths choose a branch at random */
layout(location = 4) out vec4 landing_later;

const uint photon_texel_seed = 50u;
const uint photon_sun_seed = 51u;
const uint photon_choice_seed = 52u;
const uint photon_scatter_seed = 53u;

/* Starts a photon at a random point of its texel, in front of the objects' bounding sphere. */
void photon_begin(uint seed)
{
    vec4 row_x = transpose(light.clip_from_world)[0], row_y = transpose(light.clip_from_world)[1];
    vec3 x = normalize(row_x.xyz), y = normalize(row_y.xyz);
    path = trace_path(vec3(0.0), vec3(0.0), vec3(1.0), uvec4(0u), -1,
                      trace_has(TRACE_HAS_CULLING) ? -1.0 : 0.0, 1e30, seed, 0.0,
                      trace_segments_max, false, true, 0.0, vec3(0.0), vec3(0.0), false);
    vec2 texel = floor(gl_FragCoord.xy) + path_random_point(photon_texel_seed);
    vec2 at = ICE_CAUSTICS_MARGIN * (2.0 * texel / float(ICE_CAUSTICS_PHOTONS) - 1.0);
    float radius = 0.5 * radians(push.sun);
    vec3 up = diffuse_sampling_disc_dir(frame.sun_dir, radius, path_random_point(photon_sun_seed));
    path.origin = frame.center + frame.radius * (1.01 * up + at.x * x + at.y * y);
    path.dir = -up;
    is_first = true;
    is_main = false;
    sets_last = false;
}

/* Returns the reduced optical depth of scattering media along a segment of length `t`. */
float photon_reduced_depth(float t)
{
    bool is_clear = !trace_has(TRACE_HAS_SCATTERING) || !trace_is_in(path) || path.is_in_bubble;
    float tint_w =
        is_clear ? 0.0 : trace_medium(trace_current_medium(path.medium_stack), TRACE_TINT).w;
    medium_field field = trace.scattering_media[int(max(-1.0 - tint_w, 0.0))];
    float sum = 0.0, step_length = t / float(medium_steps);
    int iterations = tint_w < 0.0 ? medium_steps : 0;
    while (iterations > 0) {
        iterations--;
        vec3 point = path.origin + (float(iterations) + 0.5) * step_length * path.dir;
        sum += step_length * medium_density(field, trace_unposed_point(point, BVH_OBJECTS));
    }
    return (1.0 - frame.medium_g) * field.extinction * sum;
}

/* Continues the photon's path at an object's surface by reflection or refraction. */
void photon_scatter(trace_hit hit, trace_crossing c)
{
    trace_fresnel_split p = trace_fresnel_at(c);
    object_material material = trace_material_at(c);
    vec3 through =
        vec3(p.refracted_weight * (trace_has(TRACE_HAS_OPACITY) ? 1.0 - material.opacity : 1.0));
    if (trace_has(TRACE_HAS_MEDIA | TRACE_HAS_TINT | TRACE_HAS_TEXTURED_OBJECTS))
        through *= material.tint;
    bool is_back = path_random_point(photon_choice_seed).x < p.fresnel;
    vec3 throughput = path.throughput * (is_back ? vec3(p.reflected_weight) : through);
    path = trace_continue(path, hit, c, is_back ? p.reflected : p.refracted, !is_back);
    path.throughput = throughput;
    path.seed = microfacet_hash(path.seed, photon_choice_seed);
    is_first = false;
}

/* Moves the photon along one segment to its hit. Returns true if the photon's path has ended. */
bool photon_step(trace_hit hit, trace_crossing c)
{
    vec2 chance = path_random_point(photon_scatter_seed);
    bool is_scattered = hit.t < 1e30 && chance.x > exp(-photon_reduced_depth(hit.t));
    path.throughput = hit.t < 1e30 ? trace_absorb(path, hit.t) : path.throughput;
    path.left--;
    bool crosses = !is_scattered && c.is_hit && path.left >= 0;
    if (is_scattered) {
        path.origin += chance.y * hit.t * path.dir;
        path.seed = microfacet_hash(path.seed, photon_scatter_seed);
        path.dir = normalize(diffuse_sampling_sphere(path_random_point(photon_scatter_seed)));
        path.from = -1;
    } else if (crosses && !c.is_real) {
        path = trace_continue(path, hit, c, path.dir, true);
    } else if (crosses) {
        photon_scatter(hit, c);
    }
    float max_throughput = max(path.throughput.r, max(path.throughput.g, path.throughput.b));
    return path.left < 0 || !(crosses || is_scattered) || max_throughput < trace_branch_min;
}

/* Follows a photon to its end. Returns its landing point in the caustic map. */
vec2 photon_follow(int channel)
{
    bool is_going = true;
    trace_hit hit;
    do {
        trace_contact contact;
        hit = contact_next_hit(path, true, contact);
        trace_crossing c = trace_crossing_at(path, hit, contact, channel);
        is_going = !photon_step(hit, c);
    } while (is_going);
    bool is_surroundings = hit.bvh == BVH_SURROUNDINGS || hit.bvh == BVH_MOVERS;
    vec4 clip = ice_light_clip(path.origin + hit.t * path.dir);
    if (hit.triangle < 0 || !is_surroundings || is_first || ice_light_is_hidden(ground, clip))
        path.throughput = vec3(0.0);
    return ice_light_uv(clip);
}

void main()
{
    uint seed = microfacet_hash(uint(gl_FragCoord.x), uint(gl_FragCoord.y));
    vec4 landed[3];
#ifdef TRACE_DISPERSION
    for (int channel = 0; channel < 3; channel++) {
        photon_begin(seed);
        vec2 at = photon_follow(channel);
        landed[channel] = vec4(at, path.throughput[channel], 0.0);
    }
#else
    photon_begin(seed);
    vec2 at = photon_follow(1);
    for (int channel = 0; channel < 3; channel++)
        landed[channel] = vec4(at, path.throughput[channel], 0.0);
#endif
    landing_reflected = vec4(0.0);
    landing_later = vec4(0.0);
    landing_red = landed[0];
    landing_green = landed[1];
    landing_blue = landed[2];
}

#endif
