/* ice_front.glsl: main() of the front faces; with REFRACT_BUMP, with bumps in the shading
 * normal. */
#include "refract_front.glsl"

layout(location = 0) out vec4 front; /* xyz: outward unit normal, world; w: 1 */
layout(location = 1) out float depth;
layout(location = 2) out vec4 shading; /* xyz: outward unit normal, world; w: eq. 4 */

void main()
{
    front = vec4(normalize(normal), 1.0);
    depth = gl_FragCoord.z;
    shading = vec4(refract_front_normal(), fresnel_paper);
}
