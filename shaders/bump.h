/* bump.h: the maps of the ice's uneven surface, for those who read them (bump*.glsl). */
#ifndef SHADERS_BUMP_H
#define SHADERS_BUMP_H

#define BUMP_MAP  14 /* rg: slopes along u and v */
#define BUMP_MASK 15 /* r: how smooth it is; g: how thick its crystals stand */

#endif
