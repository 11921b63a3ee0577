/* deferred_light.frag: lighting pass: sun with shadow map, sky, and emission. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 lit;

layout(binding = 0) uniform sampler2D colors;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D positions;
layout(binding = 3) uniform sampler2D shadow;

layout(push_constant) uniform Push
{
    mat4 shadow_from_world;
}

push;

void main()
{
    const vec3 sun_dir = normalize(vec3(5.0, 8.0, 3.0));
    vec4 color = texture(colors, uv);
    vec3 normal = texture(normals, uv).xyz;
    vec4 position = texture(positions, uv);
    if (position.w == 0.0) { /* the sky */
        lit = vec4(0.15, 0.2, 0.3, 1.0);
        return;
    }
    vec4 from_sun = push.shadow_from_world * vec4(position.xyz + 0.02 * normal, 1.0);
    bool in_shadow_map = all(lessThan(abs(from_sun.xyz), vec3(1.0))); /* by the shadow map */
    float depth = in_shadow_map ? texture(shadow, 0.5 * from_sun.xy + 0.5).r : 1.0;
    float sun_visibility = float(!in_shadow_map || from_sun.z < depth + 0.001);
    float sun = sun_visibility * max(0.0, dot(normal, sun_dir));
    lit = vec4(color.rgb * (vec3(0.1, 0.13, 0.18) + 0.8 * sun + color.a), 1.0);
}
