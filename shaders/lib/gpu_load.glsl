/* gpu_load.glsl: dependent arithmetic of adjustable length that compilers cannot remove, to load a
 * GPU. */

float busy(float x, uint rounds)
{
    for (uint i = 0u; i < rounds; i++)
        x = x * (1.75 - 0.5 * x); /* stays within (0, 1.54) if it begins there */
    return x;
}
