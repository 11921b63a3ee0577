/* globals.glsl: declares the uniform buffer of globals.h as `frame`. */
#ifndef LIB_GLOBALS_GLSL
#define LIB_GLOBALS_GLSL
#include "globals.h"

layout(set = 0, binding = GLOBALS_BINDING, scalar) uniform Globals
{
    globals frame;
};
#endif
