/* caustics_blur.frag: fragment shader that blurs pool caustics by the sun's disc. */
#version 460
#include "water/caustics.glsl"

layout(set = 0, binding = CAUSTICS_RAW) uniform sampler2D raw;

layout(location = 0) out float light;

/* Returns where light from the point `at` of the sun's disc lands, relative to light from the
 * disc's centre, in light map texels. The light passes through level water to ground at `depth`. */
vec2 image_of(vec2 at, float depth)
{
    vec3 sun_center = sun_inside();
    vec3 inside = refract(-sun_disc(at), up, 1.0 / push.water.ior);
    vec2 shift = sun_center.xy / sun_center.z - inside.xy / inside.z;
    return shift * depth / map_texel_size();
}

/* Blurs light from the sun's centre over an ellipse, which is the image of the sun's disc through
 * level water. If the ellipse is large, samples are `pace` texels apart. */
void main()
{
    ivec2 center = ivec2(gl_FragCoord.xy);
    vec2 facing;
    float height = caustics_map_height(push.pool, sun_inside(), map_point(center), facing);
    float depth = push.pool.depth - height;
    mat2 texels_from_disc = mat2(image_of(vec2(1.0, 0.0), depth), image_of(vec2(0.0, 1.0), depth));
    float radius = max(length(texels_from_disc[0]), length(texels_from_disc[1]));
    if (radius < 0.3) {
        light = texelFetch(raw, center, 0).r;
        return;
    }
    mat2 disc_from_texels = inverse(texels_from_disc);
    int reach = int(ceil(radius + 0.5));
    int pace = 1 + reach / 9;
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -reach / pace * pace; y <= reach; y += pace) {
        for (int x = -reach / pace * pace; x <= reach; x += pace) {
            float inside = (1.0 - length(disc_from_texels * vec2(x, y))) * radius;
            float weight = clamp(inside + 0.5, 0.0, 1.0);
            ivec2 texel = clamp(center + ivec2(x, y), ivec2(0), ivec2(CAUSTICS_SIZE - 1));
            sum += weight * texelFetch(raw, texel, 0).r;
            weights += weight;
        }
    }
    light = sum / weights;
}
