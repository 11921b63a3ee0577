/* bump.h: the map of the ice's uneven surface, for those who read it (bump*.glsl). */
#ifndef SHADERS_BUMP_H
#define SHADERS_BUMP_H

/* rg: slopes along u and v; b: how smooth it is; a: how thick its crystals stand */
#define BUMP_MAP 14

#endif
