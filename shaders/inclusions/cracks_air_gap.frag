/* cracks_air_gap.frag: draws air-filled cracks, which reflect the environment cube map. */
#version 460
#include "inclusions/cracks_clip.glsl"
#include "inclusions/cracks_shading.glsl"
#include "lib/optics.glsl"

layout(set = 0, binding = CRACKS_ENV_CUBE) uniform samplerCube env_cube;

layout(location = 0) out vec4 color; /* premultiplied alpha */

void main()
{
    if (!crack_is_inside())
        discard;
    if (shading.surface != 0u) {
        color = crack_red;
        return;
    }
    crack_point c = crack_here();
    float highlight = crack_highlight(c);
    float alpha = min(highlight, 1.0);
    vec3 reflectance = constant_cracks_traced != 0u ? vec3(0.0) : crack_reflectance(c);
    vec3 reflected =
        reflectance * texture(env_cube, pose_object_normal(optics_reflect(c.e, c.n))).rgb;
    float mean = dot(reflectance, vec3(1.0 / 3.0));
    color = vec4(vec3(highlight) + (1.0 - alpha) * reflected, alpha + (1.0 - alpha) * mean);
}
