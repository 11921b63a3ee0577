/* water_color.glsl: main() of the picture of the water. */
#include "water.glsl"

layout(location = 0) out vec4 color;

void main()
{
    water_view view = water_look();
    color = vec4(optics_compose(view.reflection, view.refraction, view.fresnel), 1.0);
}
