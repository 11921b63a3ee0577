/*
 * abi.h: compatibility macros for headers that C and GLSL share.
 *
 * Shared structs use cglm's value types (vec3s, mat4s), which are macros for GLSL's types here.
 * GLSL uses scalar block layout; tests/unit/test_shaders.c compares every member's offset with the
 * SPIR-V. C aligns vec4s and mat4s to 16 bytes, so members of these types come first.
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
