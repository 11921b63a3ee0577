/*
 * refract_exits.glsl: gathers the light that leaves a body through several faces.
 *
 * Where a ray inside meets a face it leaves with the share 1 - F of its light, and the share F goes
 * on inside to the next face. So the way inside a body never branches: it is one chain of faces,
 * and each that does not reflect totally is an exit. What remains after the last one, or after the
 * last reflection, would leave in a direction that nobody knows: it sees the mean of the
 * surroundings. A single exit gets all that remains.
 *
 * Cracks are met before the first face, and with REFRACT_BOUNCE_BENT_ALL before each other one,
 * too. There a way does branch: the greater part of the light is followed, and once in a pixel the
 * lesser one, too, to a single exit, if it is params.branch of the pixel's light. Others see the
 * environment cube at once.
 *
 * Both loops test their limit at the beginning and have another way out at the end. With a single
 * way out at the end, lavapipe gives rays that have left the values of a later iteration (Mesa
 * 22.3).
 */
#ifndef REFRACT_EXITS_GLSL
#define REFRACT_EXITS_GLSL
#include "refract_bounce.h"

layout(push_constant, scalar) uniform Push
{
    refract_bounce_params params;
};

layout(location = REFRACT_SEEN_MEAN) flat in vec3 mean; /* radiance of the surroundings */

#ifdef REFRACT_MIRRORED /* the rest is a small share of an image that is faint itself */
#define EXITS        1u
#define EXITS_BRANCH 1.0
#else
#define EXITS        constant_refract_exits
#define EXITS_BRANCH params.branch
#endif

#define REFRACT_MARCH params.march
#include "refract_march.glsl"

#include "refract_cracks.glsl"

/* Places at which a ray only seems to leave, at most. */
const uint exits_mistakes = 2u;

/* Cracks that mirror a ray between two exits, at most. */
const uint exits_mirrors = 3u;

/* A ray that comes from a crack meets no other whose normal is nearer to that crack's than this
 * cosine: it is the same one, which the map shows beside the ray's beginning. */
const float exits_same_crack = 0.9;

/* Share of a pixel's light below which it is reflected at one more face, at most. Chains of total
 * reflections are long in a cube, and all rays of a vector unit wait for the longest. */
const float exits_weak = 0.1;

/* A ray inside. */
struct exits_ray {
    vec3 weight;     /* share of the pixel's light that it brings */
    float crack;     /* length to a crack that mirrors it; within_none: none does */
    vec3 crack_n;    /* unit normal of the last crack before the next face; 0: none */
    refract_way way; /* its direction is that towards the face */
    vec3 n;          /* outward normal of the face; 0 where none was found */
    float share;     /* that is reflected there */
    uint faces;      /* that have reflected it */
#ifdef REFRACT_CLOUD
    float straight; /* share of its light that no cloud has scattered */
#endif
#ifdef REFRACT_DRESS
    vec3 tint; /* of light that leaves there */
#endif
};

/* A pixel's light, and what is yet to be followed. */
struct exits_pixel {
    vec3 light;
    exits_ray other; /* its weight is below 0 before there is one, and 0 once it is followed */
};

float exits_mean(vec3 weight)
{
    return dot(weight, vec3(1.0 / 3.0));
}

/* Lets a ray meet a crack before its next face, and leaves to it the greater part of its light. */
void exits_meet_crack(march_space space, inout exits_ray ray, inout exits_pixel pixel)
{
    cracks_hit hit = cracks_find(space, ray.way.point, ray.way.dir);
    if (hit.t >= within_none || abs(dot(hit.n, ray.crack_n)) > exits_same_crack)
        return;
    float c = -dot(hit.n, ray.way.dir);
    vec3 shares = cracks_reflectance(c, frame.outside_in_air / refract_frame.eta, hit.width);
    bool is_mirrored = exits_mean(shares) > 0.5;
    vec3 lesser = (is_mirrored ? 1.0 - shares : shares) * ray.weight;
    ray.crack_n = hit.n;
    if (exits_mean(pixel.other.weight) < 0.0 && exits_mean(lesser) > EXITS_BRANCH) {
        pixel.other = ray;
        pixel.other.weight = lesser;
        pixel.other.crack = is_mirrored ? within_none : hit.t;
    } else {
        vec3 dir = is_mirrored ? ray.way.dir : optics_reflect(ray.way.dir, hit.n);
        pixel.light += lesser * textureLod(env_cube, dir, 0.0).rgb;
    }
    ray.weight -= lesser;
    ray.crack = is_mirrored ? hit.t : within_none;
}

void exits_reflect(inout exits_ray ray, vec3 n)
{
    ray.faces++;
    ray.way.dir = reflect(ray.way.dir, n);
    ray.crack_n = vec3(0.0);
}

/*
 * Follows a ray to a face through which it leaves: at the latest, after the last reflection.
 *
 * A ray seems to leave where another part of the body hides its way, and beside a surface that it
 * has just left, because texels are coarse. There the room jumps, or the face looks the other way;
 * the ray goes on behind the face that hides it.
 */
void exits_next(march_space space, float inverse_eta, inout exits_ray ray, inout exits_pixel pixel)
{
    const bool is_weak = exits_mean(ray.weight) < exits_weak;
    const uint bounces = space.march.bounces;
    const uint last = is_weak ? min(ray.faces + 1u, bounces) : bounces;
    const bool meets = constant_cracks_met != 0u && !is_weak;
    const bool meets_all = params.bent == REFRACT_BOUNCE_BENT_ALL;
    const uint most = space.march.bounces + exits_mistakes + exits_mirrors * constant_cracks_met;
    uint mistakes = 0u;
    bool hidden = false;
    ray.share = 0.0;
#ifdef REFRACT_DRESS
    ray.tint = vec3(1.0);
#endif
    ray.n = vec3(0.0);
    for (uint i = 0u; ray.faces <= last && i <= most; i++) {
        bool near_front, jumps;
        if (meets && !hidden && (meets_all || ray.faces == 0u))
            exits_meet_crack(space, ray, pixel);
        float t = march_seek(space, ray.way.point, ray.way.dir, hidden, near_front, jumps);
        bool is_mirrored = ray.crack < t;
        t = min(t, ray.crack);
#ifdef REFRACT_CLOUD
        pixel.light += ray.weight * exp(-refract_frame.absorb * ray.way.path) *
                       refract_cloud(frame.cloud, ray.way.point, ray.way.dir, t, ray.straight);
#endif
        ray.way.point += t * ray.way.dir;
        ray.way.path += t;
        ray.crack = within_none;
        if (is_mirrored) {
            ray.way.dir = reflect(ray.way.dir, ray.crack_n);
            continue;
        }
        vec3 n = march_nearer_normal(space, ray.way.point, near_front);
        bool is_found = dot(n, ray.way.dir) > 0.0;
        hidden = (!is_found || jumps) && mistakes < exits_mistakes;
        mistakes += hidden ? 1u : 0u;
        if (hidden)
            continue;
        float share = is_found ? optics_fresnel(ray.way.dir, n, inverse_eta) : 0.0;
        if (refract_is_in_ground(ray.way.point)) {
            n = normalize(ray.way.point - frame.cube_center);
            ray.way.dir = n;
            is_found = true;
            share = 0.0;
        }
        if (share < 1.0) {
            ray.share = share;
            ray.n = is_found ? n : ray.n;
#ifdef REFRACT_DRESS
            ray.tint = march_dress(space, ray.way.point, near_front);
#endif
            break;
        }
        ray.way.tir = ray.faces == 0u ? 1.0 : ray.way.tir;
        ray.way.bounces += 1.0;
        exits_reflect(ray, n);
    }
}

vec3 refract_gather(vec3 e, vec3 n_f, int channel, out refract_way way)
{
    float eta = refract_frame.etas[channel];
    march_space space = march_space_of_frame();
    exits_ray ray;
    ray.weight = vec3(1.0);
    ray.crack = within_none;
    ray.crack_n = vec3(0.0);
    ray.way = refract_leave_at_front(optics_refract(e, n_f, eta));
    ray.faces = 0u;
#ifdef REFRACT_CLOUD
    ray.straight = 1.0;
#endif
    exits_pixel pixel;
    pixel.light = vec3(0.0);
    pixel.other = ray;
    pixel.other.weight = vec3(-1.0);
    way = ray.way;
    bool is_first = true;
    for (uint i = 1u; i <= EXITS; i++) {
        exits_next(space, 1.0 / eta, ray, pixel);
        refract_way leaving = ray.way;
        leaving.dir = optics_refract(ray.way.dir, -ray.n, 1.0 / eta);
        if (is_first)
            way = leaving;
        is_first = false;
        bool is_trapped = ray.faces > space.march.bounces;
        bool is_last = i == EXITS || ray.faces >= space.march.bounces ||
                       exits_mean(ray.weight) * ray.share < params.least;
        vec3 seen = refract_transmitted(leaving);
        float share = is_trapped ? 0.0 : 1.0 - ray.share; /* that leaves here */
        if (EXITS == 1u)
            share = 1.0;
        float rest = is_last ? 1.0 - share : 0.0;
        seen = share * seen + rest * mean * exp(-refract_frame.absorb * ray.way.path);
#ifdef REFRACT_DRESS
        seen *= ray.tint;
#endif
#ifdef REFRACT_CLOUD
        seen *= ray.straight;
#endif
        pixel.light += ray.weight * seen;
        if (is_last && exits_mean(pixel.other.weight) <= 0.0)
            break;
        if (is_last) { /* the lesser part of the light has one exit */
            ray = pixel.other;
            pixel.other.weight = vec3(0.0);
            i = EXITS - 1u;
            continue;
        }
        ray.weight *= ray.share;
        exits_reflect(ray, ray.n);
    }
    return pixel.light;
}

#endif
