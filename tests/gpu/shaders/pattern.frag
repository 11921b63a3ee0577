/* pattern.frag: another value in each texel. */
#version 460

layout(location = 0) out vec4 color;

void main()
{
    vec2 texel = floor(gl_FragCoord.xy);
    color = vec4(texel.x, texel.y, texel.x * texel.y, 1);
}
