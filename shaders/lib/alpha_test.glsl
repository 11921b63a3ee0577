/* alpha_test.glsl: alpha test and stochastic transparency of surfaces with materials. */
#ifndef ALPHA_TEST_GLSL
#define ALPHA_TEST_GLSL
#include "lib/globals.glsl"
#include "lib/material_textures.glsl"

/* Returns true if the current sample skips a blended surface. Of each pixel's samples, a fraction
 * `alpha` keeps the surface (Enderton et al. 2010, "Stochastic transparency"). Layers of distance
 * have different multiples of the random number, so that they skip independent samples. */
bool is_alpha_skipped(float alpha, uint row)
{
    const float layers = 128.0; /* per factor of 2 of the distance */
    float layer = floor(layers * -log2(gl_FragCoord.z));
    float of_pixel = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float multiple = 2.0 * mod(layer, 7.0) + 1.0;
    float of_surface = 0.7548777 * float(row) + 0.618034 * layer;
    return alpha <= fract(multiple * (of_pixel + frame.sample_random) + of_surface);
}

/* Returns true if a surface is skipped. `alpha` is the base colour texture's. */
bool is_hole(float alpha, uint row)
{
    float kind = material_texel(row, MATERIAL_ROW_F0).w;
    alpha *= material_texel(row, MATERIAL_ROW_FACTORS).w;
    if ((constant_textured & CONSTANT_TEXTURED_HOLES) == 0u)
        return false;
    if (kind == float(MATERIAL_KIND_CUTOUT))
        return alpha < material_texel(row, MATERIAL_ROW_EMISSION).w;
    return kind == float(MATERIAL_KIND_BLENDED) && is_alpha_skipped(alpha, row);
}
#endif
