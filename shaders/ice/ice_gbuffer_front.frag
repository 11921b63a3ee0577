/* ice_gbuffer_front.frag: G-buffer of the ice's front faces; REFRACT_BUMP adds bump mapping. */
#version 460
#include "refract/refract_front_face_input.glsl"

layout(location = 0) out vec4 front; /* outward unit normal, world; w: 1 */
layout(location = 1) out float depth;
layout(location = 2) out vec4 shading; /* shading normal, world; w: Fresnel reflectance */

void main()
{
    front = vec4(normalize(normal), 1.0);
    depth = gl_FragCoord.z;
    shading = vec4(refract_front_normal(), fresnel_paper);
}
