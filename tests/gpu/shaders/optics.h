/* optics.h: what optics.comp is asked, and what it answers: one of each a case. */
#ifndef OPTICS_H
#define OPTICS_H
#include "shaders/water/water.h"

#define OPTICS_QUESTIONS 0
#define OPTICS_ANSWERS   1

struct optics_question {
    vec3s e;
    vec3s front, back; /* normals */
    float a;           /* share of the back one in the normal that refracts; 0: front alone */
    float eta;
    float b; /* impact parameter */
    /* of a ray along e that looks up a cube in a box */
    vec3s point, low, high, captured;
    vec2s at; /* on the water */
    float time;
    ABI_STRUCT(water_params) water;
};

struct optics_answer {
    vec3s blended;
    vec3s refracted; /* at the blended normal */
    vec3s reflected; /* at the front normal, as are: */
    vec3s composed;
    float k; /* at the blended normal */
    float fresnel_paper;
    float fresnel;
    vec2s bubble_transmitted, bubble_reflected; /* turns */
    float gap;
    vec3s local; /* where it looks up the cube */
    vec3s wave;  /* slopes and height, as are: */
    vec3s wave_normal;
    vec3s up_ray; /* direction in which light leaves that comes straight from below */
};

#endif
