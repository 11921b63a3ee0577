/* refract_paper.h: push constants of the paper's refraction model (refract_paper.c). */
#ifndef SHADERS_REFRACT_REFRACT_PAPER_H
#define SHADERS_REFRACT_REFRACT_PAPER_H
#include "refract/refract.h"

struct refract_paper_params {
    float a; /* weight of the back face's normal */
};

#endif
