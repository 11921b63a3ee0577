/* ice_caustics_photons.frag: photon pass, with one photon per light-space texel of the ice's front
 * faces. Writes the energy and landing point in the caustic map of each photon's three branches:
 * the first exit, the exit after one internal Fresnel reflection, and the reflection by the front
 * face. Reads the faces from depth and normal maps. With REFRACT_BUMP, the faces are rasterised
 * again with bump mapping. */
#version 460
#ifndef REFRACT_BUMP
#define REFRACT_PHOTONS
#endif
#define REFRACT_BOUNCE
#define REFRACT_MARCH push.march
#define MARCH_GROUND
#include "lib/specialization_constants.glsl"
#include "lib/sun_light_space.glsl"

layout(push_constant, scalar) uniform Push
{
    ice_caustics_push push;
};

#include "refract/refract_march_path.glsl"

layout(set = 0, binding = ICE_CAUSTICS_GROUND) uniform sampler2D ground;
#ifdef REFRACT_PHOTONS
layout(location = 0) in vec3 ray; /* view ray at view-space depth 1 */
#endif

/* xy: landing point in the caustic map; z: fraction of the photon's energy that arrives */
layout(location = 0) out vec4 landing_red;
layout(location = 1) out vec4 landing_green;
layout(location = 2) out vec4 landing_blue;
/* rgb: fraction of each channel's energy that arrives; a: index of the landing texel */
layout(location = 3) out vec4 landing_reflected;
layout(location = 4) out vec4 landing_later;

const float ground_none = 1.0; /* greater than differences of depth */
const int ground_steps = 24;
const int ground_secants = 3;         /* refinements by the secant method */
const int ground_refinements = 12;    /* refinements at most */
const float ground_precision = 0.002; /* of landing points, in bounding radii */
const float ground_first = 0.02;      /* first step, in bounding radii */
const float ground_last = 64.0;       /* maximum ray length, in bounding radii */

/* Returns two random numbers from 0 to 1 for a texel (pcg2d, Jarzynski and Olano 2020). */
vec2 random(uvec2 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return vec2(v >> 8u) / 16777216.0;
}

/* Returns a random direction of light from the sun's disc for each texel and sample. */
vec3 sun_ray(vec3 e)
{
    vec2 u = fract(random(uvec2(gl_FragCoord.xy)) + vec2(push.sun_x, push.sun_y));
    vec3 a = normalize(cross(e, abs(e.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 b = cross(e, a);
    float away = tan(0.5 * radians(push.sun)) * sqrt(u.x);
    float angle = 6.28318530718 * u.y;
    return normalize(e + away * (cos(angle) * a + sin(angle) * b));
}

/* Returns a ray's distance to the caustic map's edge (|x| = w or |y| = w in clip space). */
float length_to_map_edge(vec4 clip, vec4 dir_clip)
{
    float limit = ground_last * frame.radius;
    for (int axis = 0; axis < 2; axis++) {
        for (float side = -1.0; side < 2.0; side += 2.0) {
            float gap = clip.w - side * clip[axis];
            float closing = side * dir_clip[axis] - dir_clip.w;
            if (closing > 0.0)
                limit = min(limit, gap / closing);
        }
    }
    return limit;
}

/* Returns the difference of depth between a position and the ground behind it: positive in front of
 * the ground; ground_none where there is none. */
float ground_gap(vec4 clip)
{
    float depth = refract_depth_at_uv(ground, ice_light_uv(clip));
    return depth > 0.0 ? clip.z / clip.w - depth : ground_none;
}

bool march_is_in_ground(vec3 point)
{
    return ground_gap(ice_light_clip(point)) <= 0.0;
}

/* Intersects a ray with the ground's depth map by growing steps, then by the secant method, which
 * is exact on a plane, and bisection. xy are map coordinates, and z is 1 for a hit, otherwise 0.
 * The map counts as solid: a ray that passes behind a surface hits that surface. */
vec3 land(vec3 point, vec3 dir)
{
    vec4 clip = ice_light_clip(point);
    vec4 dir_clip = light.clip_from_world * vec4(dir, 0.0);
    float first = ground_first * frame.radius;
    float exact = ground_precision * frame.radius;
    float reach = max(length_to_map_edge(clip, dir_clip), first);
    float growth = pow(reach / first, 1.0 / float(ground_steps));
    float next = first;
    float above = 0.0, below = 0.0;
    float gap_above = 0.0, gap_below = ground_gap(clip);
    for (int i = 0; i <= ground_steps && gap_below > 0.0; i++) {
        above = below;
        gap_above = gap_below;
        below = next;
        gap_below = ground_gap(clip + below * dir_clip);
        next *= growth;
    }
    bool found = gap_below <= 0.0;
    for (int i = 0; i < ground_refinements && found && below - above > exact; i++) {
        float slope = (gap_above - gap_below) / (below - above);
        bool has_ground = gap_above < ground_none;
        float t =
            has_ground && i < ground_secants ? above + gap_above / slope : 0.5 * (above + below);
        float gap = ground_gap(clip + t * dir_clip);
        if (has_ground && abs(gap) < slope * exact) {
            below = t;
            break;
        }
        above = gap > 0.0 ? t : above;
        gap_above = gap > 0.0 ? gap : gap_above;
        below = gap > 0.0 ? below : t;
        gap_below = gap > 0.0 ? gap_below : gap;
    }
    return vec3(ice_light_uv(clip + below * dir_clip), found ? 1.0 : 0.0);
}

#ifdef REFRACT_PHOTONS
/* Reads the front face at this texel. Returns false if there is none. */
bool find_front()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_front, texel, 0).r;
    eye_to_point = frame.clip_from_world[3][2] / depth * ray;
    normal = normalize(texelFetch(normal_front, texel, 0).xyz);
    return depth > 0.0;
}
#endif

/* Returns the output of a branch that carries all channels along one path. */
vec4 landing_of(vec3 point, vec3 dir, vec3 energy)
{
    vec3 landing = land(point, dir);
    vec2 texel = floor(landing.xy * float(ICE_CAUSTICS_SIZE));
    bool is_in_map = all(greaterThanEqual(texel, vec2(0.0))) &&
                     all(lessThan(texel, vec2(ICE_CAUSTICS_SIZE))) && landing.z > 0.0;
    return is_in_map ? vec4(energy, texel.x + float(ICE_CAUSTICS_SIZE) * texel.y) : vec4(0.0);
}

/* Continues the path of the green channel, which has left with transmittance `leaving`, by internal
 * reflection to its next exit. `entered` is the energy that has entered the ice. */
vec4 land_later(refract_path exit_ray, float leaving, float entered)
{
    const int channel = 1;
    float leaving_later;
    refract_path later = exit_ray;
    later.dir = march_reflected;
    march_continue(march_space_of_frame(), frame.etas[channel], later, leaving_later);
    float energy = leaving > 0.0 ? entered * (1.0 - leaving) * leaving_later : 0.0;
    return landing_of(later.point, later.dir, energy * exp(-frame.absorb * later.path));
}

void main()
{
#ifdef REFRACT_PHOTONS
    if (!find_front())
        discard;
#endif
    vec3 e = sun_ray(normalize(eye_to_point));
    vec3 n_f = refract_front_normal();
    vec4 landed[3];
    float reflectance = optics_fresnel(e, n_f, frame.etas[1]);
    refract_path exit_ray;
    float leaving;
    vec3 landing;
    for (uint i = 0u; i < 3u; i++) {
        int channel = int(i + 1u) % 3;
        if (i < constant_refract_colors) {
            exit_ray = march_path(e, n_f, channel, leaving);
            landing = land(exit_ray.point, exit_ray.dir);
            if (i == 0u)
                landing_later = land_later(exit_ray, leaving, 1.0 - reflectance);
            leaving *= 1.0 - optics_fresnel(e, n_f, frame.etas[channel]);
        }
        float energy = leaving * exp(-frame.absorb[channel] * exit_ray.path);
        landed[channel] = vec4(landing.xy, landing.z * energy, 0.0);
    }
    landing_reflected = landing_of(refract_front_point(), reflect(e, n_f), vec3(reflectance));
    landing_red = landed[0];
    landing_green = landed[1];
    landing_blue = landed[2];
}
