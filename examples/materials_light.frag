/* materials_light.frag: a sky, and a sun with cascaded shadow maps, filtered by comparison. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 lit;
layout(binding = 0) uniform sampler2D colors;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D positions;
layout(binding = 3) uniform sampler2DArrayShadow cascades;

layout(push_constant) uniform Push
{
    mat4 shadow_from_world; /* of cascade 0; the next ones are each three times as wide */
}

push;

float sun_visibility(vec3 position)
{
    vec4 from_sun = push.shadow_from_world * vec4(position, 1.0);
    float cascade = 0.0;
    while (cascade < 2.0 && any(greaterThan(abs(from_sun.xy), vec2(0.97)))) {
        from_sun.xy /= 3.0;
        cascade++;
    }
    const vec2 texel = 1.0 / vec2(textureSize(cascades, 0).xy);
    float sum = 0.0;
    for (int i = 0; i < 4; i++) {
        vec2 offset = (vec2(i & 1, i >> 1) - 0.5) * texel;
        sum += texture(cascades,
                       vec4(0.5 * from_sun.xy + 0.5 + offset, cascade, min(from_sun.z, 1.0)));
    }
    return sum / 4.0;
}

void main()
{
    const vec3 sun_dir = normalize(vec3(5.0, 8.0, 3.0));
    vec4 position = texture(positions, uv);
    vec3 normal = texture(normals, uv).xyz;
    float sun = max(0.0, dot(normal, sun_dir)) * sun_visibility(position.xyz + 0.02 * normal);
    vec3 shaded = texture(colors, uv).rgb * (vec3(0.15, 0.18, 0.25) + sun);
    lit = vec4(position.w == 0.0 ? vec3(0.3, 0.4, 0.6) : shaded, 1.0);
}
