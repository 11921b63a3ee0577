/*
 * refract_gather_exits.glsl: gathers the light that leaves an object through several faces.
 *
 * At each face a ray inside transmits the fraction 1 - F of its light (F: Fresnel reflectance) and
 * continues with F. The path inside never branches: it is one chain of faces, and each face without
 * total internal reflection is an exit. What remains after the last exit or reflection is given the
 * mean radiance of the surroundings. With a single exit, that exit gets everything.
 *
 * Rays are tested for cracks before the first face and, with REFRACT_BOUNCE_INCLUSIONS_ALL, before
 * every face. There paths do branch: the stronger branch is followed, and once per pixel the weaker
 * one, to a single exit, if its throughput exceeds params.branch. Others look up the environment.
 *
 * Both loops test their limit at the beginning and have another exit at the end. With a single exit
 * at the end, lavapipe gives finished rays values of later iterations (Mesa 22.3).
 */
#ifndef REFRACT_GATHER_EXITS_GLSL
#define REFRACT_GATHER_EXITS_GLSL
#include "refract/refract_bounce.h"

layout(push_constant, scalar) uniform Push
{
    refract_bounce_params params;
};

layout(location = REFRACT_FULLSCREEN_MEAN) flat in vec3 mean; /* surroundings' radiance */

#ifdef REFRACT_SSR /* one exit for faint reflections */
#define EXITS        1u
#define EXITS_BRANCH 1.0
#else
#define EXITS        constant_refract_exits
#define EXITS_BRANCH params.branch
#endif

#define REFRACT_MARCH params.march
#include "refract/refract_march_path.glsl"

#include "refract/refract_bubbles.glsl"
#include "refract/refract_cracks.glsl"

/* Maximum number of false exits of a ray, where depth maps show an exit but there is no face. */
const uint exits_false_max = 2u;

/* Maximum number of reflections by cracks between two exits. */
const uint exits_crack_reflections = 3u;

/* Minimum cosine between the normals of two successive hits that count as one crack. Without this
 * limit, a ray that leaves a crack would hit the image of this crack again. */
const float exits_same_crack = 0.9;

/* Throughput below which a ray is reflected at most once more. The limit cuts long chains of total
 * internal reflection, as in cubes, because a whole SIMD unit would wait for them. */
const float exits_weak_throughput = 0.1;

/* State of a path inside the object. */
struct exits_ray {
    vec3 weight;       /* path throughput, relative to the pixel */
    float crack;       /* distance to reflecting crack, or inclusion_none */
    vec3 crack_n;      /* last crack's normal, or 0 */
    refract_path path; /* up to the next face */
    vec3 n;            /* next face's outward normal, or 0 */
    float reflectance; /* Fresnel reflectance of the face */
    uint faces;        /* number of internal reflections so far */
    float width;       /* width of the footprint, metres */
    bool is_reflected; /* has been reflected inside the object */
#ifdef REFRACT_MEDIUM
    float transmittance; /* transmittance of the scattering medium */
#endif
#ifdef REFRACT_MATERIAL
    vec3 tint; /* tint of light through the face */
#endif
};

/* Radiance of a pixel, its refract_backdrop, and a split path that is followed later. */
struct exits_pixel {
    vec3 light, backdrop;
    /* second branch; its weight is negative if there is none, and 0 once the branch is followed */
    exits_ray other;
};

float exits_mean(vec3 weight)
{
    return dot(weight, vec3(1.0 / 3.0));
}

/* Splits a path at a crack in front of the next face. The path follows the stronger branch. The
 * weaker branch is stored in `pixel`, or only its environment light is added to `pixel.light`. */
void exits_hit_crack(march_space space, inout exits_ray ray, inout exits_pixel pixel)
{
    cracks_hit hit = cracks_find(space, ray.path.point, ray.path.dir);
    if (hit.t >= inclusion_none || abs(dot(hit.n, ray.crack_n)) > exits_same_crack)
        return;
    float c = -dot(hit.n, ray.path.dir);
    vec3 reflectance = cracks_reflectance(c, frame.outside_in_air / refract_frame.eta, hit.width);
    bool is_reflected = exits_mean(reflectance) > 0.5;
    vec3 weaker = (is_reflected ? 1.0 - reflectance : reflectance) * ray.weight;
    ray.crack_n = hit.n;
    if (exits_mean(pixel.other.weight) < 0.0 && exits_mean(weaker) > EXITS_BRANCH) {
        pixel.other = ray;
        pixel.other.weight = weaker;
        pixel.other.crack = is_reflected ? inclusion_none : hit.t;
    } else {
        vec3 dir = is_reflected ? ray.path.dir : optics_reflect(ray.path.dir, hit.n);
        pixel.light += weaker * textureLod(env_cube, dir, 0.0).rgb;
    }
    ray.weight -= weaker;
    ray.crack = is_reflected ? hit.t : inclusion_none;
}

/* Adds the light of bubbles and the scattering medium up to the distance `t`. The path keeps its
 * direction and loses the throughput that they take. */
void exits_gather_segment(inout exits_ray ray, inout exits_pixel pixel, float t)
{
    bubbles_segment segment;
    segment.from = ray.path.point;
    segment.dir = ray.path.dir;
    segment.t = t;
    segment.width = ray.width;
    segment.eta = frame.outside_in_air / refract_frame.eta;
    segment.absorb = refract_frame.absorb;
    float transmittance = 1.0;
#ifdef REFRACT_MEDIUM
    segment.medium = frame.medium;
    transmittance = ray.transmittance;
#endif
    vec3 weight = ray.weight * exp(-refract_frame.absorb * ray.path.path);
    ray.weight *= bubbles_gather(segment, weight, transmittance, pixel.light);
#ifdef REFRACT_MEDIUM
    ray.transmittance = transmittance;
#endif
}

void exits_reflect(inout exits_ray ray, vec3 n)
{
    ray.faces++;
    ray.is_reflected = true;
    ray.path.dir = reflect(ray.path.dir, n);
    ray.crack_n = vec3(0.0);
}

/*
 * Follows a path to the next face that transmits light, at most to its last reflection.
 *
 * Some exits are false: where another part of the object hides the path, and next to the surface
 * that the ray just left, because texels are coarse. There the depth is discontinuous or the face's
 * normal points the wrong way; the ray then continues behind the occluding face.
 */
void exits_next(march_space space, float inverse_eta, inout exits_ray ray, inout exits_pixel pixel)
{
    const bool is_weak = exits_mean(ray.weight) < exits_weak_throughput;
    const uint last = is_weak ? min(ray.faces + 1u, space.march.bounces) : space.march.bounces;
    const bool hits_cracks = constant_cracks_traced != 0u && !is_weak;
    const bool hits_all = params.inclusions == REFRACT_BOUNCE_INCLUSIONS_ALL;
    const uint segments_max =
        space.march.bounces + exits_false_max + exits_crack_reflections * constant_cracks_traced;
    uint false_exits = 0u;
    bool hidden = false, near_front, jumps;
    ray.reflectance = 0.0;
#ifdef REFRACT_MATERIAL
    ray.tint = vec3(1.0);
#endif
    ray.n = vec3(0.0);
    for (uint i = 0u; ray.faces <= last && i <= segments_max; i++) {
        if (hits_cracks && !hidden && (hits_all || ray.faces == 0u))
            exits_hit_crack(space, ray, pixel);
        float t = march_find_exit(space, ray.path.point, ray.path.dir, hidden, near_front, jumps);
        bool is_reflected = ray.crack < t;
        t = min(t, ray.crack);
        exits_gather_segment(ray, pixel, t);
        ray.path.point += t * ray.path.dir;
        ray.path.path += t;
        ray.crack = inclusion_none;
        if (is_reflected) {
            ray.path.dir = reflect(ray.path.dir, ray.crack_n);
            ray.is_reflected = true;
            continue;
        }
        vec3 n = march_nearer_normal(space, ray.path.point, near_front);
        bool is_found = dot(n, ray.path.dir) > 0.0;
        hidden = (!is_found || jumps) && false_exits < exits_false_max;
        false_exits += hidden ? 1u : 0u;
        if (hidden)
            continue;
        float reflectance = is_found ? optics_fresnel(ray.path.dir, n, inverse_eta) : 0.0;
        if (refract_is_below_ground(ray.path.point)) {
            n = normalize(ray.path.point - frame.cube_center);
            ray.path.dir = n;
            is_found = true;
            reflectance = 0.0;
        }
        if (reflectance < 1.0) {
            ray.reflectance = reflectance;
            ray.n = is_found ? n : ray.n;
#ifdef REFRACT_MATERIAL
            ray.tint = march_transmittance(space, ray.path.point, near_front);
#endif
            break;
        }
        ray.path.tir = ray.faces == 0u ? 1.0 : ray.path.tir;
        ray.path.bounces += 1.0;
        exits_reflect(ray, n);
    }
}

vec3 refract_radiance(vec3 e, vec3 n_f, int channel, out refract_path path)
{
    float eta = refract_frame.etas[channel];
    march_space space = march_space_of_frame();
    exits_ray ray;
    ray.weight = vec3(1.0);
    ray.crack = inclusion_none;
    ray.crack_n = vec3(0.0);
    ray.path = refract_leave_at_front(optics_refract(e, n_f, eta));
    ray.faces = 0u;
    ray.width = bubbles_pixel_width(ray.path.point);
    ray.is_reflected = false;
#ifdef REFRACT_MEDIUM
    ray.transmittance = 1.0;
#endif
    exits_pixel pixel = exits_pixel(vec3(0.0), vec3(0.0), ray);
    pixel.other.weight = vec3(-1.0);
    path = ray.path;
    bool is_first = true;
    for (uint i = 1u; i <= EXITS; i++) {
        exits_next(space, 1.0 / eta, ray, pixel);
        refract_path leaving = ray.path;
        leaving.dir = optics_refract(ray.path.dir, -ray.n, 1.0 / eta);
        if (is_first)
            path = leaving;
        is_first = false;
        bool is_trapped = ray.faces > space.march.bounces;
        bool is_last = i == EXITS || ray.faces >= space.march.bounces ||
                       exits_mean(ray.weight) * ray.reflectance < params.min_throughput;
        vec3 backdrop;
        vec3 light = refract_transmitted(leaving, !ray.is_reflected, backdrop);
        float transmitted = is_trapped ? 0.0 : 1.0 - ray.reflectance;
        if (EXITS == 1u)
            transmitted = 1.0;
        float rest = is_last ? 1.0 - transmitted : 0.0;
        backdrop *= transmitted;
        light = transmitted * light + rest * mean * exp(-refract_frame.absorb * ray.path.path);
#ifdef REFRACT_MATERIAL
        light *= ray.tint;
        backdrop *= ray.tint;
#endif
#ifdef REFRACT_MEDIUM
        light *= ray.transmittance;
        backdrop *= ray.transmittance;
#endif
        pixel.light += ray.weight * light;
        pixel.backdrop += ray.weight * backdrop;
        if (is_last && exits_mean(pixel.other.weight) <= 0.0)
            break;
        if (is_last) { /* the weaker branch gets one exit */
            ray = pixel.other;
            pixel.other.weight = vec3(0.0);
            i = EXITS - 1u;
            continue;
        }
        ray.weight *= ray.reflectance;
        exits_reflect(ray, ray.n);
    }
    refract_backdrop = pixel.backdrop;
    return pixel.light;
}

#endif
