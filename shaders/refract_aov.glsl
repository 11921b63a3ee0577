/* refract_aov.glsl: main() of a rung's layers; shade() is the rung's. */
layout(location = REFRACT_OUT_EXIT) out vec4 out_exit;
layout(location = REFRACT_OUT_REFRACTION) out vec4 out_refraction;
layout(location = REFRACT_OUT_REFLECTION) out vec4 out_reflection;
layout(location = REFRACT_OUT_FRESNEL) out float out_fresnel;

void main()
{
    refract_result r = shade();
    out_exit = vec4(normalize(r.exit), 0.0);
    out_refraction = vec4(r.refraction, 0.0);
    out_reflection = vec4(r.reflection, 0.0);
    out_fresnel = r.fresnel;
}
