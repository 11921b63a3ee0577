/* bump.h: binding of the ice's bump map, shared by C and bump*.glsl. */
#ifndef SHADERS_LIGHTING_BUMP_H
#define SHADERS_LIGHTING_BUMP_H

/* Binding of the bump map. rg: slopes along u and v; b: smoothness; a: thickness of the frost */
#define BUMP_MAP 14

#endif
