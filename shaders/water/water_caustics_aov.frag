/* water_caustics_aov.frag: fragment shader of the AOV `caustics`: sunlight on the ground below the
 * water. */
#version 460
#define WATER_WITH_CAUSTICS
#include "water/water_surface_radiance.glsl"

layout(location = 0) out float out_caustics;

void main()
{
    out_caustics = water_shade().caustics;
}
