/*
 * refract_march.frag: refraction models that march the refracted ray through the object's depth
 * maps.
 *
 * Without a macro it is the model `search`, which ends at the first exit. REFRACT_BOUNCE,
 * REFRACT_EXITS, REFRACT_NEAREST and REFRACT_FULLSCREEN together make it the model `bounce`, which
 * follows total internal reflections and several exits.
 */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "refract/refract_main.glsl"
#ifndef REFRACT_BOUNCE
#include "refract/refract_march_path.glsl"
#endif
