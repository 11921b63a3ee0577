/* layer.vert: covers the target's layer whose number is that of the instance. */
#version 460
#extension GL_ARB_shader_viewport_layer_array : require

layout(location = 0) out float number;

void main()
{
    const vec2 corners[] = { vec2(-1, -1), vec2(-1, 3), vec2(3, -1) };
    gl_Position = vec4(corners[gl_VertexIndex % 3], 0, 1);
    gl_Layer = gl_InstanceIndex;
    number = float(gl_InstanceIndex + 1);
}
