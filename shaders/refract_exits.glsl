/*
 * refract_exits.glsl: gathers the light that leaves a body through several faces.
 *
 * Where a ray inside meets a face it leaves with the share 1 - F of its light, and the share F goes
 * on inside to the next face. So the way inside a body never branches: it is one chain of faces,
 * and each that does not reflect totally is an exit. What remains after the last one, or after the
 * last reflection, would leave in a direction that nobody knows: it sees the mean of the
 * surroundings. A single exit gets all that remains.
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
#define EXITS 1u
#else
#define EXITS constant_refract_exits
#endif

#define REFRACT_MARCH params.march
#include "refract_march.glsl"

#include "refract_cracks.glsl"

/* Places at which a ray only seems to leave, at most. */
const uint exits_mistakes = 2u;

/* Share of a pixel's light below which it is reflected at one more face, at most. Chains of total
 * reflections are long in a cube, and all rays of a vector unit wait for the longest. */
const float exits_weak = 0.1;

/* A ray inside. */
struct exits_ray {
    float crack;     /* length to a crack that mirrors it; within_none: none does any more */
    vec3 crack_n;    /* unit normal there */
    refract_way way; /* its direction is that towards the face */
    vec3 n;          /* outward normal of the face; 0 where none was found */
    float share;     /* that is reflected there */
    uint faces;      /* that have reflected it */
#ifdef REFRACT_CLOUD
    float straight; /* share of its light that no cloud has scattered */
    vec3 scattered; /* light of clouds on the way to the face */
#endif
#ifdef REFRACT_DRESS
    vec3 tint; /* of light that leaves there */
#endif
};

/*
 * Follows a ray to a face through which it leaves: at the latest, after the last reflection.
 *
 * A ray seems to leave where another part of the body hides its way, and beside a surface that it
 * has just left, because texels are coarse. There the room jumps, or the face looks the other way;
 * the ray goes on behind the face that hides it.
 */
void exits_next(march_space space, float inverse_eta, bool is_weak, inout exits_ray ray)
{
    const uint bounces = space.march.bounces;
    const uint last = is_weak ? min(ray.faces + 1u, bounces) : bounces;
    const uint most = space.march.bounces + exits_mistakes + constant_cracks_met;
    uint mistakes = 0u;
    bool hidden = false;
    ray.share = 0.0;
#ifdef REFRACT_DRESS
    ray.tint = vec3(1.0);
#endif
#ifdef REFRACT_CLOUD
    ray.scattered = vec3(0.0);
#endif
    ray.n = vec3(0.0);
    for (uint i = 0u; ray.faces <= last && i <= most; i++) {
        bool near_front, jumps;
        float t = march_seek(space, ray.way.point, ray.way.dir, hidden, near_front, jumps);
        bool is_mirrored = ray.crack < t;
        t = min(t, ray.crack);
#ifdef REFRACT_CLOUD
        ray.scattered += exp(-refract_frame.absorb * ray.way.path) *
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
        ray.faces++;
        ray.way.dir = reflect(ray.way.dir, n);
    }
}

/*
 * Lets a ray that has entered meet a crack. The greater part of its light, whose shares are
 * returned, is followed: mirrored or straight on. `other` is the light of the lesser one, which
 * sees the environment cube at once.
 */
vec3 exits_meet_crack(march_space space, inout exits_ray ray, out vec3 other)
{
    cracks_hit hit = cracks_find(space, ray.way.point, ray.way.dir);
    float c = -dot(hit.n, ray.way.dir);
    vec3 shares = cracks_reflectance(c, frame.outside_in_air / refract_frame.eta, hit.width);
    bool is_mirrored = dot(shares, vec3(1.0)) > 1.5;
    vec3 mirrored = optics_reflect(ray.way.dir, hit.n);
    other = (is_mirrored ? 1.0 - shares : shares) *
            textureLod(env_cube, is_mirrored ? ray.way.dir : mirrored, 0.0).rgb;
    vec3 followed = is_mirrored ? shares : 1.0 - shares;
    if (hit.t >= within_none) {
        other = vec3(0.0);
        followed = vec3(1.0);
    } else if (is_mirrored) {
        ray.crack = hit.t;
        ray.crack_n = hit.n;
    }
    return followed;
}

vec3 refract_gather(vec3 e, vec3 n_f, int channel, out refract_way way)
{
    float eta = refract_frame.etas[channel];
    march_space space = march_space_of_frame();
    exits_ray ray;
    ray.way = refract_leave_at_front(optics_refract(e, n_f, eta));
    ray.faces = 0u;
    ray.crack = within_none;
    ray.crack_n = vec3(0.0);
    vec3 other = vec3(0.0), followed = vec3(1.0);
    if (constant_cracks_met != 0u)
        followed = exits_meet_crack(space, ray, other);
#ifdef REFRACT_CLOUD
    ray.straight = 1.0;
#endif
    way = ray.way;
    vec3 light = vec3(0.0);
    float left = 1.0;
    for (uint i = 1u; i <= EXITS; i++) {
        exits_next(space, 1.0 / eta, left < exits_weak, ray);
        refract_way leaving = ray.way;
        leaving.dir = optics_refract(ray.way.dir, -ray.n, 1.0 / eta);
        if (i == 1u)
            way = leaving;
        bool is_trapped = ray.faces > space.march.bounces;
        bool is_last =
            i == EXITS || ray.faces >= space.march.bounces || left * ray.share < params.least;
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
        seen = ray.straight * seen + ray.scattered;
#endif
        light += left * seen;
        if (is_last)
            break;
        left *= ray.share;
        ray.faces++;
        ray.way.dir = reflect(ray.way.dir, ray.n);
    }
    return other + followed * light;
}

#endif
