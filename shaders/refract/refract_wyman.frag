/* refract_wyman.frag: fragment shader of the refraction model of Wyman 2005. */
#version 460
#include "refract/refract_depth_maps.glsl"
#include "refract/refract_main.glsl"

/* Estimates the ice's width in metres as the side of the bounding sphere's inscribed cube. */
float bounding_cube_side()
{
    return 2.0 * refract_frame.radius * inversesqrt(3.0);
}

/* Returns the ice's thickness along the unrefracted ray, in metres. Without a back face, returns 0.
 * Distance is 1 / depth times a constant in perspective views, but linear in orthographic views. */
float thickness_along_ray()
{
    float back = texelFetch(depth_back, ivec2(gl_FragCoord.xy), 0).r;
    if (constant_orthographic != 0u)
        return back > 0.0 ? max(view_depth(refract_frame.clip_from_world, back) -
                                    view_depth(refract_frame.clip_from_world, gl_FragCoord.z),
                                0.0)
                          : 0.0;
    return back > 0.0 ? length(eye_to_point) * max(gl_FragCoord.z / back - 1.0, 0.0) : 0.0;
}

/* Returns the ice's thickness along the front normal. First looks for the back face at a distance
 * of bounding_cube_side(). While there is no back face, halves the distance. */
float thickness_along_normal(vec3 point, vec3 n_f)
{
    float guess = bounding_cube_side();
    for (int i = 0; i < 4; i++) {
        vec3 end = point - guess * n_f;
        vec4 clip = refract_clip(end);
        float back = texelFetch(depth_back, refract_texel(clip), 0).r;
        if (back > 0.0 && clip.w > 0.0) {
            if (constant_orthographic != 0u)
                end += frame.forward * (view_depth(frame.clip_from_world, back) -
                                        view_depth(frame.clip_from_world, clip.z));
            else
                end = frame.eye + (end - frame.eye) * (clip.z / clip.w / back);
            return max(dot(point - end, n_f), 0.0);
        }
        guess *= 0.5;
    }
    return guess;
}

/* Refracts as in Wyman 2005, eq. 2: interpolates between two thicknesses by the ratio of angles. */
refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    float eta = frame.etas[channel];
    vec3 point = refract_front_point();
    vec3 inside = optics_refract(e, n_f, eta);
    float ci = clamp(-dot(n_f, e), 0.0, 1.0);
    float si = sqrt(1.0 - ci * ci);
    /* eta is over 1 if the ice's index is the lower one */
    float ratio = si > 1e-3 ? asin(min(eta * si, 1.0)) / asin(si) : eta;
    float ray_thickness = thickness_along_ray();
    float path_length = mix(thickness_along_normal(point, n_f), ray_thickness, ratio);
    point += path_length * inside;
    vec3 n_b = refract_normal_at(normal_back, refract_uv(refract_clip(point)));
    if (n_b == vec3(0.0)) /* the path ends outside the silhouette */
        n_b = texelFetch(normal_back, ivec2(gl_FragCoord.xy), 0).xyz;
    if (dot(n_b, inside) <= 0.0)
        return refract_path(inside, point, path_length, 0.0, 0.0);
    float tir = optics_refract_k(inside, n_b, 1.0 / eta) < 0.0 ? 1.0 : 0.0;
    return refract_path(optics_refract(inside, -n_b, 1.0 / eta), point, path_length, 0.0, tir);
}
