/* gpu_busy_loop.glsl: loads a GPU with dependent arithmetic that compilers cannot remove. */

float busy(float x, uint rounds)
{
    for (uint i = 0u; i < rounds; i++)
        x = x * (1.75 - 0.5 * x); /* stays within (0, 1.54) */
    return x;
}
