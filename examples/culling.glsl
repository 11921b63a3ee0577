/* culling.glsl: positions of the cubes of culling.c, a grid of 16 x 16 x 16. */
const float cube_size = 0.15;

vec3 cube_center(uint i)
{
    return vec3(i % 16, i / 16 % 16, i / 256) - 7.5;
}
