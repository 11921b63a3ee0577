/* refract_march_path.glsl: refraction models that march a ray in depth maps to its exit point and,
 * with REFRACT_BOUNCE, beyond total internal reflections. */
#ifndef REFRACT_MARCH_PATH_GLSL
#define REFRACT_MARCH_PATH_GLSL
#include "refract/refract_march_ray.glsl"
#include "refract/refract_result.glsl"

#ifdef MARCH_GROUND
/* Returns true if a point is in the ground, where no air is below the ice. */
bool march_is_in_ground(vec3 point);

vec3 march_reflected; /* direction of internal reflection where the last path has left */
#endif

#ifdef REFRACT_MEDIUM
#include "refract/refract_medium.glsl"

vec3 march_scattered;            /* radiance scattered into the last path */
float march_transmittance_media; /* medium transmittance; initialised by callers */
#endif

/* Traces a path to its exit. Sets `leaving` to the exit face's transmittance; 0 without a face. */
void march_continue(march_space space, float eta, inout refract_path path, out float leaving)
{
    leaving = 0.0;
    for (uint i = 0u;; i++) {
        bool near_front;
        float t = march_length(space, path.point, path.dir, near_front);
#ifdef REFRACT_MEDIUM
        march_scattered +=
            exp(-refract_frame.absorb * path.path) *
            refract_in_scatter(frame.medium, path.point, path.dir, t, march_transmittance_media);
#endif
        path.point += t * path.dir;
        path.path += t;
        vec3 n = march_normal(space, path.point, path.dir, near_front);
        if (dot(n, path.dir) <= 0.0) /* no face: the ray goes straight */
            break;
#ifdef MARCH_GROUND
        if (march_is_in_ground(path.point)) {
            leaving = 1.0;
            break;
        }
#endif
#ifdef MARCH_GROUND
        march_reflected = reflect(path.dir, n);
#endif
        bool total = optics_refract_k(path.dir, n, 1.0 / eta) < 0.0;
        leaving = 1.0 - optics_fresnel(path.dir, n, 1.0 / eta);
        path.dir = optics_refract(path.dir, -n, 1.0 / eta);
        path.tir = total && i == 0u ? 1.0 : path.tir;
        path.bounces += total ? 1.0 : 0.0;
        if (!total || i == space.march.bounces)
            break;
    }
}

/* Traces the path of a ray that enters through the front face. */
refract_path march_path(vec3 e, vec3 n_f, int channel, out float leaving)
{
    float eta = refract_frame.etas[channel];
    refract_path path = refract_leave_at_front(optics_refract(e, n_f, eta));
    march_continue(march_space_of_frame(), eta, path, leaving);
    return path;
}

refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    float leaving;
    return march_path(e, n_f, channel, leaving);
}

#endif
