/* ao_box_occluders.frag: fragment shader of the ambient occlusion map, seen from above (ao.c). */
#version 460
#include "lib/specialization_constants.glsl"
#include "lighting/ao.h"
#include "surroundings/surroundings.h"
#define LIT_ENVIRONMENT_BINDING SURROUNDINGS_ENVIRONMENT_LIGHT
#include "lib/environment_diffuse.glsl"
#include "lib/object_pose.glsl"

layout(set = 0, binding = AO_BINDING, scalar) uniform Occluders
{
    ao_occluders ao;
};

layout(set = 0, binding = AO_HEIGHTS) uniform sampler2D heights;
layout(set = 0, binding = AO_UNDERSIDES) uniform sampler2D undersides;

/* rgb: change in the irradiance of a white, level, diffuse surface; a: fraction of ground light
 * that objects reflect back */
layout(location = 0) out vec4 map;

const float wide_sine = 0.6;    /* minimum sine of undeflected light */
const float blur_width = 0.65;  /* prefilter lobe width for a hemisphere */
const float inner_limit = 0.15; /* relative depth inside a box at which the box stops occluding */
const float reflected = 0.3;    /* reflectance of occluding surroundings */
const int directions = 12;      /* azimuths of the horizon search */
const int azimuth_steps = 10;   /* samples per azimuth, in geometric progression */
const float first_step = 1.5 / float(AO_HEIGHTS_SIZE); /* in sides of the map */
const float full_radius = 0.6;                         /* relative radius where the fade begins */

/* Returns the term of one edge in the polygon form factor. `a` and `b` are unit directions to the
 * edge's ends. The term has length angle(a, b) / (2 pi) and the direction of cross(a, b). */
vec3 edge(vec3 a, vec3 b)
{
    vec3 normal = cross(a, b);
    float sine = length(normal);
    return sine > 1e-6 ? normal * (atan(sine, dot(a, b)) / (6.2831853 * sine)) : vec3(0.0);
}

/* Returns the vector irradiance from a box, divided by pi. Sums over the silhouette's edges
 * (Lambert 1760). `low` and `high` are the box corners relative to the receiving point. */
vec3 outline(vec3 low, vec3 high)
{
    vec3 front = vec3(greaterThan(low, vec3(0.0))), back = vec3(lessThan(high, vec3(0.0)));
    vec3 lll = normalize(low), hhh = normalize(high);
    vec3 hll = normalize(vec3(high.x, low.yz)), lhh = normalize(vec3(low.x, high.yz));
    vec3 lhl = normalize(vec3(low.x, high.y, low.z)), hlh = normalize(vec3(high.x, low.y, high.z));
    vec3 llh = normalize(vec3(low.xy, high.z)), hhl = normalize(vec3(high.xy, low.z));
    vec3 sum = (front.z - front.y) * edge(lll, hll);
    sum += (back.y - front.z) * edge(lhl, hhl);
    sum += (front.y - back.z) * edge(llh, hlh);
    sum += (back.z - back.y) * edge(lhh, hhh);
    sum += (front.x - front.z) * edge(lll, lhl);
    sum += (front.z - back.x) * edge(hll, hhl);
    sum += (back.z - front.x) * edge(llh, lhh);
    sum += (back.x - back.z) * edge(hlh, hhh);
    sum += (front.y - front.x) * edge(lll, llh);
    sum += (back.x - front.y) * edge(hll, hlh);
    sum += (front.x - back.y) * edge(lhl, lhh);
    sum += (back.y - back.x) * edge(hhl, hhh);
    return sum;
}

/* Returns the fraction of uniform environment light that box `i` blocks at a point. The result is a
 * vector towards the box. `point` and `n` (the normal) are in object space. */
vec3 blocked_by(uint i, vec3 point, vec3 n)
{
    vec3 low = ao.all[i].min - point, high = ao.all[i].max - point;
    vec3 off = max(low, -high), sides = high - low;
    float outside = max(off.x, max(off.y, off.z));
    float inner_depth = -outside / (inner_limit * max(sides.x, max(sides.y, sides.z)));
    return outside > 0.0 ? outline(low, high) : max(1.0 - inner_depth, 0.0) * n;
}

/* Returns the environment light behind an occluder, prefiltered over the occluder's solid angle.
 * `sine` is the sine of half the angle under which the occluder appears. */
vec3 light_behind(vec3 dir, vec3 unoccluded, float sine)
{
    if (constant_background != GLOBALS_ENVIRONMENT)
        return unoccluded;
    vec2 at = surroundings_equirect_uv(dir, constant_environment_turn);
    float layer = sqrt(min(blur_width * sine, 1.0)) * float(LIT_ROUGH_LAYERS);
    float first = clamp(floor(layer), 1.0, float(LIT_ROUGH_LAYERS - 1));
    return mix(textureLod(environment_light, vec3(at, first - 1.0), 0.0).rgb,
               textureLod(environment_light, vec3(at, first), 0.0).rgb, max(layer - first, 0.0));
}

/* Returns the surroundings' height in metres above the objects' base. Below a thin overhang, such
 * as a table top, returns 0. Thin means thinner than the free space below. */
float height_at(vec2 uv)
{
    float top = textureLod(heights, uv, 0.0).r, below = textureLod(undersides, uv, 0.0).r;
    bool is_solid = below >= 1.0 || below < top - below;
    return is_solid ? AO_HEIGHTS_RANGE * ao.height * top : 0.0;
}

/* Returns the fraction of a uniform sky that surroundings hide (horizon mapping, Max 1988). */
float occluded_by_surroundings(vec2 uv)
{
    float height = height_at(uv);
    float sum = 0.0;
    for (int i = 0; i < directions; i++) {
        float azimuth = 6.2831853 * (float(i) + 0.5) / float(directions);
        vec2 along = vec2(cos(azimuth), sin(azimuth));
        float steepest = 0.0;
        for (int k = 0; k < azimuth_steps; k++) {
            float offset = first_step * pow(1.6, float(k));
            float rise = height_at(uv + offset * along) - height;
            steepest = max(steepest, rise / (2.0 * ao.half_side * offset));
        }
        sum += steepest * steepest / (1.0 + steepest * steepest);
    }
    return sum / float(directions);
}

/* Computes how objects change the irradiance at a texel. Hardly deflected light has the
 * radiance behind the object. Small objects refract the light of bright sources aside. */
void main()
{
    const vec3 up = vec3(0.0, 1.0, 0.0);
    vec2 at = 2.0 * gl_FragCoord.xy / float(AO_MAP_SIZE) - 1.0;
    vec3 point = ao.center + ao.half_side * vec3(at.x, 0.0, at.y);
    vec3 object_point = pose_to_object(point),
         object_up = transpose(mat3(frame.world_from_object)) * up;
    vec3 unoccluded = lit_diffuse(up), light = unoccluded;
    float of_ground = 0.0;
    for (uint i = 0u; i < ao.count; i++) {
        vec3 cover = mat3(frame.world_from_object) * blocked_by(i, object_point, object_up);
        float form_factor = clamp(length(cover), 1e-6, 1.0);
        float sine = sqrt(form_factor); /* half-angle of an equivalent disc */
        /* Form factor of a sphere clipped at the horizon (Hill and Heitz 2017). */
        float blocked =
            form_factor *
            max((form_factor * form_factor + cover.y / form_factor) / (form_factor + 1.0), 0.0);
        vec3 behind = light_behind(cover / form_factor, unoccluded, sine);
        vec3 refracted = min(behind, mix(unoccluded, behind, min(sine / wide_sine, 1.0)));
        vec3 sky = ao.all[i].sky * mix(unoccluded, refracted, ao.all[i].undeviated);
        light = max(light - blocked * behind, 0.0) + blocked * sky;
        of_ground += blocked * dot(ao.all[i].ground, vec3(1.0 / 3.0));
    }
    float occluded = ao.count > 0u ? occluded_by_surroundings(0.5 + 0.5 * at) : 0.0;
    light *= 1.0 - (1.0 - reflected) * occluded;
    float fade = ao.strength * (1.0 - smoothstep(full_radius, 1.0, length(at)));
    map = fade * vec4(light - unoccluded, of_ground);
}
