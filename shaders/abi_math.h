/*
 * abi_math.h: compatibility macros for functions that C and GLSL share.
 *
 * Shared functions begin with ABI_FUNCTION. They are written in C, with functions of <math.h> and
 * cglm's value types. This header defines their names for GLSL.
 */
#ifndef SHADERS_ABI_MATH_H
#define SHADERS_ABI_MATH_H
#include "abi.h"

#ifdef GL_core_profile
#define ABI_FUNCTION
#define ABI_VEC2(x, y)    vec2(x, y)
#define ABI_VEC3(x, y, z) vec3(x, y, z)
#define ABI_FLOAT(x)      float(x)
#define ABI_INT(x)        int(x)
#define ABI_UINT(x)       uint(x)

#define acosf          acos
#define atan2f         atan
#define cosf           cos
#define exp2f          exp2
#define expf           exp
#define fabsf          abs
#define floorf         floor
#define fmaxf          max
#define fminf          min
#define hypotf(x, y)   length(vec2(x, y))
#define log2f          log2
#define powf           pow
#define sinf           sin
#define sqrtf          sqrt
#define glm_clamp      clamp
#define glm_lerp       mix
#define glm_smoothstep smoothstep

#define glms_vec3(v)            ((v).xyz)
#define glms_vec3_add(a, b)     ((a) + (b))
#define glms_vec3_cross(a, b)   cross(a, b)
#define glms_vec3_div(a, b)     ((a) / (b))
#define glms_vec3_divs(a, s)    ((a) / (s))
#define glms_vec3_dot(a, b)     dot(a, b)
#define glms_vec3_lerp(a, b, t) mix(a, b, t)
#define glms_vec3_max(a)        max(max((a).x, (a).y), (a).z)
#define glms_vec3_minv(a, b)    min(a, b)
#define glms_vec3_mul(a, b)     ((a) * (b))
#define glms_vec3_negate(a)     (-(a))
#define glms_vec3_norm(a)       length(a)
#define glms_vec3_normalize(a)  normalize(a)
#define glms_vec3_scale(a, s)   ((a) * (s))
#define glms_vec3_sub(a, b)     ((a) - (b))
#else
#include <cglm/struct/vec3.h>

#define ABI_FUNCTION      static inline
#define ABI_VEC2(x, y)    ((vec2s){ { (x), (y) } })
#define ABI_VEC3(x, y, z) ((vec3s){ { (x), (y), (z) } })
#define ABI_FLOAT(x)      ((float)(x))
#define ABI_INT(x)        ((int32_t)(x))
#define ABI_UINT(x)       ((uint32_t)(x))
#endif

#endif
