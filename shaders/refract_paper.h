/* refract_paper.h: what refract_paper.c and refract_paper*.{glsl,frag} agree on. */
#ifndef SHADERS_REFRACT_PAPER_H
#define SHADERS_REFRACT_PAPER_H
#include "refract.h"

struct refract_paper_params {
    float a; /* eq. 1: share of the back face's normal */
};

#endif
