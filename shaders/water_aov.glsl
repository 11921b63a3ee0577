/* water_aov.glsl: main() of the AOV layer `caustics`: sunlight on the ground below the water. */
#define WATER_WITH_CAUSTICS
#include "water_surface.glsl"

layout(location = 0) out float out_caustics;

void main()
{
    out_caustics = water_look().caustics;
}
