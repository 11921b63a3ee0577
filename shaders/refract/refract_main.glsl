/* refract_main.glsl: main() of the raster refraction models, which define refract_follow(). Shades
 * the ice by environment lookup, absorption, dispersion and reflection (Seipel and Nivfors 2006,
 * eq. 6). With REFRACT_LAYERS, writes AOVs instead of the image; with REFRACT_PACKED_LAYERS, both.
 */
#ifndef REFRACT_MAIN_GLSL
#define REFRACT_MAIN_GLSL
#include "lib/specialization_constants.glsl"
#include "refract/refract_environment.glsl"
#ifdef REFRACT_MATERIAL
#include "refract/refract_transmittance_fetch.glsl"
#endif
#include "refract/refract_result.glsl"
#ifdef REFRACT_MEDIUM
#include "refract/refract_medium.glsl"
#endif
#include "lighting/highlight.glsl"
#ifdef REFRACT_PACKED_LAYERS
#include "refract/refract_packed_layers.glsl"
#endif

#ifdef REFRACT_SSR /* reflections show the environment */
const bool refract_shows_backdrop = false;
#else
const bool refract_shows_backdrop = true;
#endif

/* Throughput of the paths through the ice that end at a background that is not drawn. */
vec3 refract_backdrop;

struct refract_result {
    refract_path path;
    vec3 refraction; /* refracted radiance, including the opaque base's */
    vec3 reflection; /* radiance along the reflected direction */
    vec3 backdrop;   /* refract_backdrop of all channels */
    float fresnel;   /* fraction of light that is reflected */
};

#ifdef REFRACT_PER_VERTEX
layout(location = REFRACT_REFLECTED) in vec3 reflected;
#endif

vec3 refract_reflected_dir(vec3 e, vec3 n_f)
{
#ifdef REFRACT_PER_VERTEX
    return reflected;
#else
    return optics_reflect(e, n_f);
#endif
}

/* Returns the radiance that leaves the ice along a path. `backdrop` is the throughput with which
 * the path shows a hidden background. */
vec3 refract_transmitted(refract_path path, bool is_refracted, out vec3 backdrop)
{
    float shown;
    vec3 light = refract_environment_seen(path.point, path.dir,
                                          refract_shows_backdrop && is_refracted, shown);
    vec3 transmittance = exp(-refract_frame.absorb * path.path);
    backdrop = shown * transmittance;
    return light * transmittance;
}

float refract_reflectance(vec3 e, vec3 n_f)
{
    if (constant_refract_fresnel == REFRACT_FRESNEL_EXACT)
        return optics_fresnel(e, n_f, refract_frame.eta);
    if (constant_refract_fresnel == REFRACT_FRESNEL_CROSSFADE)
        return 1.0 - frame.refract_crossfade;
    return clamp(fresnel_paper, 0.0, 1.0);
}

#ifndef REFRACT_EXITS
/* Returns the refracted radiance of a colour channel. Sets `path` to the path through the ice. */
vec3 refract_radiance(vec3 e, vec3 n_f, int channel, out refract_path path)
{
    path = refract_follow(e, n_f, channel);
    vec3 light = refract_transmitted(path, path.bounces + path.tir == 0.0, refract_backdrop);
#ifdef REFRACT_MATERIAL
    vec3 tint = refract_back_transmittance();
    light *= tint;
    refract_backdrop *= tint;
#endif
#ifdef REFRACT_MEDIUM
    float transmittance = 1.0;
    vec3 scattered =
        refract_in_scatter(frame.medium, path.point, normalize(path.dir), 1e30, transmittance);
    light = transmittance * light + scattered;
    refract_backdrop *= transmittance;
#endif
    return light;
}
#elif defined(REFRACT_NESTED)
#include "refract/refract_nested.glsl"
#else
#include "refract/refract_gather_exits.glsl"
#endif

/* Shades a visible point of the ice. The result's `path` is the path of green light. */
refract_result refract_shade(vec3 e, vec3 n_f)
{
    refract_result r;
    r.refraction = refract_radiance(e, n_f, 1, r.path);
    r.backdrop = refract_backdrop;
    if (constant_refract_colors > 1u) {
        refract_path other;
        for (int channel = 0; channel < 3; channel += 2) {
            r.refraction[channel] = refract_radiance(e, n_f, channel, other)[channel];
            r.backdrop[channel] = refract_backdrop[channel];
        }
    }
    r.reflection = refract_environment(refract_front_point(), refract_reflected_dir(e, n_f));
    r.fresnel = refract_reflectance(e, n_f);
#ifdef REFRACT_MATERIAL
    vec3 tint = refract_front_transmittance();
    r.refraction = r.refraction * tint + refract_base_radiance();
    r.backdrop *= tint;
#endif
    return r;
}

#ifdef REFRACT_SSR /* the including file defines main() */
#elif defined(REFRACT_LAYERS)
layout(location = REFRACT_OUT_EXIT) out vec4 out_exit;
layout(location = REFRACT_OUT_REFRACTION) out vec4 out_refraction;
layout(location = REFRACT_OUT_REFLECTION) out vec4 out_reflection;
layout(location = REFRACT_OUT_FRESNEL) out float out_fresnel;
layout(location = REFRACT_OUT_PATH) out vec4 out_path;

void main()
{
    refract_front_read();
    refract_result r = refract_shade(primary_ray_dir(eye_to_point), refract_front_normal());
    out_exit = vec4(normalize(r.path.dir), 0.0);
    out_refraction = vec4(r.refraction, 0.0);
    out_reflection = vec4(r.reflection, 0.0);
    out_fresnel = r.fresnel;
    out_path = vec4(r.path.path, r.path.bounces, r.path.tir, 0.0);
}
#else
layout(location = REFRACT_OUT_COLOR) out vec4 color;
layout(location = REFRACT_OUT_HIGHLIGHT) out float highlight;

void main()
{
    refract_front_read();
    vec3 e = primary_ray_dir(eye_to_point);
    vec3 n_f = refract_front_normal();
    refract_result r = refract_shade(e, n_f);
    float alpha = optics_alpha((1.0 - r.fresnel) * r.backdrop);
    color = vec4(optics_compose(r.reflection, r.refraction, r.fresnel), alpha);
    highlight = highlight_radiance(e, eye_to_point, n_f);
#ifdef REFRACT_PACKED_LAYERS
    refract_layers layers;
    layers.depth = front_depth;
    layers.exit = normalize(r.path.dir);
    layers.refraction = r.refraction;
    layers.reflection = r.reflection;
    layers.fresnel = r.fresnel;
    layers.path = r.path.path;
    layers.bounces = uint(r.path.bounces);
    layers.tir = uint(r.path.tir);
    layers.segments = 0u;
    layers.last = 0u;
    refract_write_layers(layers);
#endif
}
#endif

#endif
