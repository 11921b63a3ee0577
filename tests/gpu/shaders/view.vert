/* view.vert: covers the layer of each view, with the number of the view. The triangles stay within
 * the viewport: llvmpipe 22.3 draws larger ones of all views to the first layer. */
#version 460
#extension GL_EXT_multiview : require

layout(location = 0) out float number;

void main()
{
    const vec2 corner = vec2(gl_VertexIndex % 2, gl_VertexIndex / 2 % 2);
    gl_Position = vec4(corner * 2 - 1, 0, 1);
    number = float(gl_ViewIndex + 1);
}
