/* srgb.glsl: decodes sRGB colours to linear ones (IEC 61966-2-1). */
vec3 srgb_decode(vec3 c)
{
    vec3 low = c / 12.92;
    vec3 high = pow((c + 0.055) / 1.055, vec3(2.4));
    return mix(high, low, lessThanEqual(c, vec3(0.04045)));
}
