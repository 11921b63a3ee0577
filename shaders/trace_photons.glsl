/*
 * trace_photons.glsl: main() of photons of the sun, one per texel of its view, which go through the
 * objects as the ways of a pixel do, by one way at each surface, chosen by chance, and land on what
 * is around them. ice_caustics.c counts them; src/reference/photons.c does the same.
 *
 * A cloud turns a photon as often as its light loses its direction, into any other. Photons end at
 * the first surface around the objects, also where it has holes.
 */
#ifndef TRACE_PHOTONS_GLSL
#define TRACE_PHOTONS_GLSL
#include "ground.h"
#include "lib/ice_light.glsl"

layout(push_constant, scalar) uniform Push
{
    ice_caustics_push push;
};

layout(set = 0, binding = ICE_CAUSTICS_GROUND) uniform sampler2D ground;

/* xy: position in the map; z: share of the photon's energy that arrives */
layout(location = 0) out vec4 landed_red;
layout(location = 1) out vec4 landed_green;
layout(location = 2) out vec4 landed_blue;

const uint photon_place_seed = 50u;
const uint photon_sun_seed = 51u;
const uint photon_choice_seed = 52u;
const uint photon_turn_seed = 53u;

vec2 photon_random(uint own)
{
    return microfacet_point(trace.sample_index, microfacet_hash(way.seed, own));
}

/* Starts a photon anywhere in its texel, before the objects' sphere. */
void photon_begin(uint seed)
{
    vec4 row_x = transpose(light.clip_from_world)[0], row_y = transpose(light.clip_from_world)[1];
    vec3 x = normalize(row_x.xyz), y = normalize(row_y.xyz);
    way = trace_way(vec3(0.0), vec3(0.0), vec3(1.0), uvec4(0u), -1,
                    trace_has(TRACE_HAS_CULLING) ? -1.0 : 0.0, 1e30, seed, 0.0, trace_length_max,
                    false, true, 0.0, vec3(0.0), vec3(0.0));
    vec2 texel = floor(gl_FragCoord.xy) + photon_random(photon_place_seed);
    vec2 at = ICE_CAUSTICS_MARGIN * (2.0 * texel / float(ICE_CAUSTICS_PHOTONS) - 1.0);
    float radius = 0.5 * radians(push.sun);
    vec3 up = ground_disc_dir(frame.sun_dir, radius, photon_random(photon_sun_seed));
    way.origin = frame.center + frame.radius * (1.01 * up + at.x * x + at.y * y);
    way.dir = -up;
    is_first = true;
    is_main = false;
    is_straight = false;
}

/* Returns the cloud's scatterings on a straight part, each counted as much as it turns light. */
float photon_turns(float t)
{
    bool is_clear = !trace_has(TRACE_HAS_CLOUD) || !trace_is_in(way) || way.is_in_bubble;
    float own = is_clear ? 0.0 : trace_medium(trace_top(way.inside), TRACE_TINT).w;
    cloud_place cloud = trace.clouds[int(max(-1.0 - own, 0.0))];
    float sum = 0.0, part = t / float(cloud_steps);
    int turns = own < 0.0 ? cloud_steps : 0;
    while (turns > 0) {
        turns--;
        vec3 point = way.origin + (float(turns) + 0.5) * part * way.dir;
        sum += part * cloud_density(cloud, trace_unposed_point(point, TREE_OBJECTS));
    }
    return (1.0 - frame.cloud_cosine) * cloud.extinction * sum;
}

/* Makes the way go on from the surface of an object. */
void photon_cross(trace_hit hit, trace_cross c)
{
    trace_parting p = trace_part_at(c);
    dress own = trace_dress_of(c);
    vec3 through = vec3(p.refracted_share * (trace_has(TRACE_HAS_SHINE) ? 1.0 - own.shine : 1.0));
    if (trace_has(TRACE_HAS_MEDIA | TRACE_HAS_TINT | TRACE_HAS_DRESS))
        through *= own.tint;
    bool is_back = photon_random(photon_choice_seed).x < p.fresnel;
    vec3 weight = way.weight * (is_back ? vec3(p.reflected_share) : through);
    way = trace_leave(way, hit, c, is_back ? p.reflected : p.refracted, !is_back);
    way.weight = weight;
    way.seed = microfacet_hash(way.seed, photon_choice_seed);
    is_first = false;
}

/* Goes on to the next surface. Returns whether the way has ended. */
bool photon_step(trace_hit hit, trace_cross c)
{
    vec2 chance = photon_random(photon_turn_seed);
    bool is_turned = hit.t < 1e30 && chance.x > exp(-photon_turns(hit.t));
    way.weight = hit.t < 1e30 ? trace_absorbed(way, hit.t) : way.weight;
    way.left--;
    bool crosses = !is_turned && c.is_met && way.left >= 0;
    if (is_turned) {
        way.origin += chance.y * hit.t * way.dir;
        way.seed = microfacet_hash(way.seed, photon_turn_seed);
        way.dir = normalize(ground_sphere(photon_random(photon_turn_seed)));
        way.from = -1;
    } else if (crosses && !c.is_real) {
        way = trace_leave(way, hit, c, way.dir, true);
    } else if (crosses) {
        photon_cross(hit, c);
    }
    float most = max(way.weight.r, max(way.weight.g, way.weight.b));
    return way.left < 0 || !(crosses || is_turned) || most < trace_branch_min;
}

/* Follows a photon. Returns where it lands in the map. */
vec2 photon_follow(int channel)
{
    bool is_going = true;
    trace_hit hit;
    do {
        hit = trace_meet(trace_start_of(way), true);
        trace_cross c = trace_cross_at(way, hit, channel);
        is_going = !photon_step(hit, c);
    } while (is_going);
    bool is_around = hit.part == TREE_SURROUNDINGS || hit.part == TREE_MOVERS;
    vec4 clip = ice_light_clip(way.origin + hit.t * way.dir);
    if (hit.triangle < 0 || !is_around || is_first || ice_light_is_hidden(ground, clip))
        way.weight = vec3(0.0);
    return ice_light_uv(clip);
}

void main()
{
    uint seed = microfacet_hash(uint(gl_FragCoord.x), uint(gl_FragCoord.y));
    vec4 landed[3];
#ifdef TRACE_COLORS
    for (int channel = 0; channel < 3; channel++) {
        photon_begin(seed);
        vec2 at = photon_follow(channel);
        landed[channel] = vec4(at, way.weight[channel], 0.0);
    }
#else
    photon_begin(seed);
    vec2 at = photon_follow(1);
    for (int channel = 0; channel < 3; channel++)
        landed[channel] = vec4(at, way.weight[channel], 0.0);
#endif
    landed_red = landed[0];
    landed_green = landed[1];
    landed_blue = landed[2];
}

#endif
