/* materials_blend.frag: temporal antialiasing: averages a frame with the history, at the place where
 * the surface was in the previous frame. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 blended;
layout(binding = 0) uniform sampler2D lit;
layout(binding = 1) uniform sampler2D positions;
layout(binding = 2) uniform sampler2D history;

layout(push_constant) uniform Push
{
    mat4 previous_clip_from_world;
    float weight; /* of this frame */
}

push;

void main()
{
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 now = texelFetch(lit, texel, 0);
    vec4 low = now, high = now;
    for (int i = 0; i < 9; i++) {
        ivec2 at = clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), textureSize(lit, 0) - 1);
        low = min(low, texelFetch(lit, at, 0));
        high = max(high, texelFetch(lit, at, 0));
    }
    vec4 position = texelFetch(positions, texel, 0);
    vec4 clip = push.previous_clip_from_world * vec4(position.xyz, 1.0);
    vec2 before = position.w == 0.0 ? uv : 0.5 * clip.xy / clip.w + 0.5;
    bool is_inside = all(greaterThan(before, vec2(0.0))) && all(lessThan(before, vec2(1.0)));
    /* history that no texel nearby has, such as of what was hidden, is limited to what they have */
    vec4 old = clamp(texture(history, before), low, high);
    blended = mix(old, now, is_inside ? push.weight : 1.0);
}
