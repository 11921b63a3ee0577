/*
 * abi.h: compatibility macros for headers that C and GLSL share.
 *
 * Shared structs use cglm's value types (vec3s, mat4s), which this header maps to GLSL's types.
 * GLSL uses scalar block layout; tests/unit/test_shaders.c compares each member's offset with the
 * SPIR-V. Members of type vec4s and mat4s come first, because C aligns them to 16 bytes.
 */
#ifndef SHADERS_ABI_H
#define SHADERS_ABI_H

#ifdef GL_core_profile
#extension GL_EXT_scalar_block_layout : require
#define vec2s            vec2
#define vec3s            vec3
#define vec4s            vec4
#define mat4s            mat4
#define uint32_t         uint
#define ABI_STRUCT(name) name /* GLSL: without the keyword `struct` */
#else
#include <stdint.h>

#include <cglm/types-struct.h>
#define ABI_STRUCT(name) struct name
#endif

#endif
