/* cracks_gap.glsl: main() of cracks filled with air; the clipping method defines crack_is_inside().
 */
#include "cracks.glsl"
#include "lib/optics.glsl"

layout(set = 0, binding = CRACKS_ENV_CUBE) uniform samplerCube env_cube;

layout(location = 0) out vec4 color; /* premultiplied */

void main()
{
    if (!crack_is_inside())
        discard;
    if (look.surface != 0u) {
        color = crack_red;
        return;
    }
    crack_point c = crack_here();
    float share = optics_gap(c.e, c.n, frame.outside_in_air / frame.eta);
    float shine = crack_highlight(c);
    float over = min(shine, 1.0);
    vec3 mirrored = share * texture(env_cube, pose_object_normal(optics_reflect(c.e, c.n))).rgb;
    color = vec4(vec3(shine) + (1.0 - over) * mirrored, over + (1.0 - over) * share);
}
