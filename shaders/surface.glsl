/* surface.glsl: main() of the highlights on the ice's front; with REFRACT_BUMP on its bumps. */
#include "refract_front.glsl"
#include "surface.h"

layout(push_constant, scalar) uniform Push
{
    surface_params params;
};

layout(location = 0) out vec4 color; /* premultiplied: adds, and covers nothing */

void main()
{
    vec3 e = normalize(eye_to_point);
    vec3 n_f = refract_front_normal();
    vec3 point = frame.eye + eye_to_point;
    float highlight = 0.0;
    for (uint i = 0u; i < frame.light_count; i++) {
        vec3 light_dir = normalize(frame.lights[i].xyz - point);
        vec3 half_dir = normalize(light_dir - e);
        float c = dot(n_f, light_dir) > 0.0 ? max(dot(n_f, half_dir), 0.0) : 0.0;
        highlight += frame.lights[i].w * pow(c, params.shininess);
    }
    color = vec4(vec3(params.strength * highlight), 0.0);
}
