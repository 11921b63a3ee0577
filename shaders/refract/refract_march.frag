/* refract_march.frag: refraction models that march the refracted ray through the object's depth
 * maps. Compiled without macros, it is the model `search`, which stops at the first exit. Compiled
 * with REFRACT_BOUNCE, REFRACT_EXITS, REFRACT_NEAREST and REFRACT_FULLSCREEN, it is the model
 * `bounce`, which follows total internal reflections and several exits. */
#version 460
#include "refract/refract_main.glsl"
#ifndef REFRACT_BOUNCE
#include "refract/refract_march_path.glsl"
#endif
