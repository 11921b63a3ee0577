/* ui_overlay.vert: vertex shader of the user interface drawn over the image. */
#version 460
#include "output/ui_overlay.h"

layout(location = OVERLAY_POSITION) in vec2 position;
layout(location = OVERLAY_UV) in vec2 vertex_uv;
layout(location = OVERLAY_COLOR) in vec4 vertex_color;

layout(push_constant, scalar) uniform Push
{
    overlay_push push;
};

layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 color;

void main()
{
    uv = vertex_uv;
    color = vertex_color;
    gl_Position = vec4(position * push.clip_from_pixel - 1.0, 0.0, 1.0);
}
