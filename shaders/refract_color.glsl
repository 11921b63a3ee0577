/* refract_color.glsl: main() of a rung's picture; shade() is the rung's. Eq. 6. */
layout(location = 0) out vec4 color;

void main()
{
    refract_result r = shade();
    color = vec4(optics_compose(r.reflection, r.refraction, r.fresnel), 1.0);
}
