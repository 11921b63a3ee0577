/* water_color.frag: fragment shader of the water surface for a camera above it. */
#version 460
#include "water/water_surface_radiance.glsl"

layout(location = 0) out vec4 color;

void main()
{
    water_view view = water_shade();
    vec3 radiance = optics_compose(view.reflection, view.refraction, view.fresnel);
    color = vec4(min(radiance, vec3(65504.0)), 1.0); /* largest half float */
}
