/* refract_march.frag: refraction models that march the refracted ray through depth maps. Without
 * macros, it is the model `search`, which stops at the first exit. With REFRACT_BOUNCE,
 * REFRACT_EXITS, REFRACT_NEAREST and REFRACT_FULLSCREEN, it is the model `bounce`. `bounce` follows
 * total internal reflections and several exits. */
#version 460
#include "refract/refract_main.glsl"
#ifndef REFRACT_BOUNCE
#include "refract/refract_march_path.glsl"
#endif
