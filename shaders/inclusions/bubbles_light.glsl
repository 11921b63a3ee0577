/* bubbles_light.glsl: light that bubbles reflect and transmit, from the environment cube map. */
#ifndef BUBBLES_LIGHT_GLSL
#define BUBBLES_LIGHT_GLSL

layout(set = 0, binding = BUBBLES_ENV_CUBE) uniform samplerCube env_cube;

/* Returns the reflected and transmitted light of a bubble, weighted by reflectance and coverage. */
vec3 bubble_light(vec3 reflected, float fresnel, vec3 transmitted, float cover)
{
    return fresnel * textureLod(env_cube, reflected, 0.0).rgb +
           cover * textureLod(env_cube, transmitted, 0.0).rgb;
}
#endif
