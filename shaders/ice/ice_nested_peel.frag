/* ice_nested_peel.frag: fragment shader that peels the depth layers of nested objects.
 * ICE_NESTED_INNER is defined for all levels except the outermost one. */
#version 460
#include "ice/ice_nested.h"

#ifdef ICE_NESTED_INNER
layout(set = 0, binding = ICE_NESTED_BEFORE) uniform sampler2DArray outer;
#endif

layout(push_constant, scalar) uniform Push
{
    ice_nested_push push;
};

layout(location = 0) in vec3 normal;

/* xyz: unit outward normal of the nesting level; w: index of the medium inside the level, plus 1 */
layout(location = 0) out vec4 face;
layout(location = 1) out float depth;

/* Writes a face of one nesting level. If the face is outside the surrounding level, discards it.
 * The depth test keeps the nearest or farthest face. */
void main()
{
    depth = gl_FragCoord.z;
#ifdef ICE_NESTED_INNER
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float near = texelFetch(outer, ivec3(pixel, 0), 0).r;
    float far = texelFetch(outer, ivec3(pixel, 1), 0).r;
    if (depth >= near || depth <= far)
        discard;
#endif
    bool is_entered = gl_FrontFacing != (push.is_far == 1u); /* enters the object */
    face.xyz = is_entered ? normalize(normal) : -normalize(normal);
    face.w = 1.0 + float(is_entered ? push.medium : push.cavity_medium);
}
