/* cracks_shading.glsl: shading of cracks: view ray, bump-mapped normal, reflectance and highlights.
 */
#ifndef CRACKS_SHADING_GLSL
#define CRACKS_SHADING_GLSL
#include "inclusions/cracks.h"
#include "inclusions/cracks_noise.h"
#include "inclusions/cracks_reflectance.h"
#include "lib/object_pose.glsl"
#include "lib/optics.glsl"
#include "lib/specialization_constants.glsl"

layout(location = CRACKS_POSITION) in vec3 position;
layout(location = CRACKS_NORMAL) in vec3 normal;
layout(location = CRACKS_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = CRACKS_OPEN) in float open;
layout(location = CRACKS_LIGHTS) flat in vec4 lights[GLOBALS_LIGHT_COUNT];
layout(location = CRACKS_SHADING) flat in cracks_shading shading;
layout(location = CRACKS_ETA) flat in float eta;

const vec4 crack_red = vec4(1.0, 0.0, 0.0, 1.0); /* colour with cracks_shading.surface */

/* Primary ray direction and normal at a point of a crack, in object space. */
struct crack_point {
    vec3 e; /* direction of the primary ray */
    vec3 n; /* unit normal towards the camera */
};

crack_point crack_here()
{
    vec3 n = normalize(normal);
    crack_point c;
    c.e = constant_orthographic != 0u ? transpose(mat3(frame.world_from_object)) * frame.forward
                                      : normalize(eye_to_point);
    c.n = shading.bump > 0.0 ? crack_perturbed(n, position, shading.bump) : n;
    if (dot(n, c.e) > 0.0) /* cracks are double-sided */
        c.n = -c.n;
    return c;
}

/* Returns the local width of the air gap in micrometres. */
float crack_width()
{
    return shading.gap * sqrt(max(open, 0.0));
}

/* Returns the reflectance of the air gap towards the camera. */
vec3 crack_reflectance(crack_point c)
{
    return cracks_reflectance(-dot(c.n, c.e), frame.outside_in_air / frame.eta, crack_width());
}

/* Returns the sum of the Blinn-Phong highlights of all lights on the camera's side of a crack. */
float crack_highlight(crack_point c)
{
    float sum = 0.0;
    for (uint i = 0u; i < constant_lights; i++) {
        vec3 l = normalize(lights[i].xyz - eye_to_point);
        vec3 half_dir = normalize(l - c.e);
        float lobe = pow(max(dot(c.n, half_dir), 0.0), shading.shininess);
        float reflectance = eta > 0.0 ? optics_gap(c.e, half_dir, eta) : 1.0;
        sum += dot(c.n, l) > 0.0 ? reflectance * (lights[i].w * lobe) : 0.0;
    }
    return shading.strength * sum;
}
#endif
