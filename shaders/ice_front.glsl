/* ice_front.glsl: the front faces; with REFRACT_BUMP, bumps bend the normal that shades them. */
#include "refract_front.glsl"

layout(location = 0) out vec4 front; /* xyz: outward world normal, unit; w: 1 where there is one */
layout(location = 1) out float depth;
layout(location = 2) out vec4 shading; /* xyz: outward world normal, unit; w: eq. 4 */

void main()
{
    front = vec4(normalize(normal), 1.0);
    depth = gl_FragCoord.z;
    shading = vec4(refract_front_normal(), fresnel_paper);
}
