#version 460
#extension GL_GOOGLE_include_directive : require
/* A square on the level of the objects' foot, seen from above (src/tech/contact.c). */
#include "background.h"
#include "contact.h"
#include "lib/constants.glsl"
#define LIT_AROUND BACKGROUND_LIGHT
#include "lib/lit_around.glsl"
#include "lib/pose.glsl"

layout(set = 0, binding = CONTACT_BINDING, scalar) uniform Contact
{
    contact_bodies contact;
};

layout(set = 0, binding = CONTACT_HEIGHTS) uniform sampler2D heights;
layout(set = 0, binding = CONTACT_BELOW) uniform sampler2D undersides;

/* rgb: what is added to the light on a level matt white surface; a: what of the light of the ground
 * itself is added, too */
layout(location = 0) out vec4 map;

const float wide_sine = 0.6;      /* of a body so wide that it bends no light aside */
const float blur_width = 0.65;    /* of the distribution that blurs as a disc of sine 1 */
const float deep_share = 0.15;    /* depth in a box, of its sides, from which on it hides nothing */
const float mirrored_share = 0.3; /* of light, by surroundings that hide others */
const int directions = 12;        /* in which the horizon is looked for, each in: */
const int directed_steps = 10;    /* of which each is longer by more than half */
const float first_step = 1.5 / float(CONTACT_FINE); /* of the map's side */
const float flat_share = 0.6;                       /* of the map, in which effects are whole */

/* Returns what an edge between unit directions adds to a sum over an outline: half of the angle
 * that it is seen in, by pi, square to its plane. */
vec3 edge(vec3 a, vec3 b)
{
    vec3 square = cross(a, b);
    float sine = length(square);
    return sine > 1e-6 ? square * (atan(sine, dot(a, b)) / (6.2831853 * sine)) : vec3(0.0);
}

/* Returns the sum over the outline of a box (Lambert 1760): the integral of the directions to it,
 * by pi. `low` and `high` are from the point to its corners. */
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

/* Returns the light of an even environment that comes from where body `i` is, as a vector along the
 * direction to it, for a point and a normal in the objects' space. */
vec3 cover_of(uint i, vec3 point, vec3 n)
{
    vec3 low = contact.all[i].min - point, high = contact.all[i].max - point;
    vec3 off = max(low, -high), sides = high - low;
    float outside = max(off.x, max(off.y, off.z));
    float deep = -outside / (deep_share * max(sides.x, max(sides.y, sides.z)));
    return outside > 0.0 ? outline(low, high) : max(1.0 - deep, 0.0) * n;
}

/* Returns the light of the environment where a body is, as blurred as that is wide; `sine`: of half
 * of its width. */
vec3 light_there(vec3 dir, vec3 around, float sine)
{
    if (constant_background != GLOBALS_ENVIRONMENT)
        return around;
    vec2 at = background_uv(dir, constant_environment_turn);
    float layer = sqrt(min(blur_width * sine, 1.0)) * float(LIT_ROUGH_LAYERS);
    float first = clamp(floor(layer), 1.0, float(LIT_ROUGH_LAYERS - 1));
    return mix(textureLod(environment_light, vec3(at, first - 1.0), 0.0).rgb,
               textureLod(environment_light, vec3(at, first), 0.0).rgb, max(layer - first, 0.0));
}

/* Returns the height of what stands at a place of the map above the foot, metres: 0 where the room
 * below it is higher than itself, as below a table. */
float height_at(vec2 uv)
{
    float top = textureLod(heights, uv, 0.0).r, below = textureLod(undersides, uv, 0.0).r;
    bool stands = below >= 1.0 || below < top - below;
    return stands ? CONTACT_HIGH * contact.height * top : 0.0;
}

/* Returns the share of an even sky that surroundings hide from what is highest there: that below
 * the horizon of each direction (Max 1988). */
float hidden_by_surroundings(vec2 uv)
{
    float own = height_at(uv);
    float sum = 0.0;
    for (int i = 0; i < directions; i++) {
        float turn = 6.2831853 * (float(i) + 0.5) / float(directions);
        vec2 along = vec2(cos(turn), sin(turn));
        float steepest = 0.0;
        for (int k = 0; k < directed_steps; k++) {
            float far = first_step * pow(1.6, float(k));
            float rise = height_at(uv + far * along) - own;
            steepest = max(steepest, rise / (2.0 * contact.half_side * far));
        }
        sum += steepest * steepest / (1.0 + steepest * steepest);
    }
    return sum / float(directions);
}

/* What goes through a body nearly straight shows what is behind it, but for what is bright and
 * small: that is bent aside. */
void main()
{
    const vec3 up = vec3(0.0, 1.0, 0.0);
    vec2 at = 2.0 * gl_FragCoord.xy / float(CONTACT_SIDE) - 1.0;
    vec3 point = contact.middle + contact.half_side * vec3(at.x, 0.0, at.y);
    vec3 own = pose_to_object(point), own_up = transpose(mat3(frame.world_from_object)) * up;
    vec3 around = lit_matt(up), light = around;
    float of_ground = 0.0;
    for (uint i = 0u; i < contact.count; i++) {
        vec3 cover = mat3(frame.world_from_object) * cover_of(i, own, own_up);
        float far = clamp(length(cover), 1e-6, 1.0);
        float sine = sqrt(far); /* of half of its width, if it is a disc */
        /* Of a disc, cut at the horizon (Hill and Heitz 2017). */
        float hidden = far * max((far * far + cover.y / far) / (far + 1.0), 0.0);
        vec3 there = light_there(cover / far, around, sine);
        vec3 bent = min(there, mix(around, there, min(sine / wide_sine, 1.0)));
        vec3 sky = contact.all[i].sky * mix(around, bent, contact.all[i].straight);
        light = max(light - hidden * there, 0.0) + hidden * sky;
        of_ground += hidden * dot(contact.all[i].ground, vec3(1.0 / 3.0));
    }
    float closed = contact.count > 0u ? hidden_by_surroundings(0.5 + 0.5 * at) : 0.0;
    light *= 1.0 - (1.0 - mirrored_share) * closed;
    float fade = contact.strength * (1.0 - smoothstep(flat_share, 1.0, length(at)));
    map = fade * vec4(light - around, of_ground);
}
