/* specialization_constants.glsl: declarations of the specialisation constants, with defaults. */
#ifndef SPECIALIZATION_CONSTANTS_GLSL
#define SPECIALIZATION_CONSTANTS_GLSL
#include "specialization_constants.h"

layout(constant_id = CONSTANT_BACKGROUND) const uint constant_background = 0u;
layout(constant_id = CONSTANT_TEXTURED) const uint constant_textured = 0xffffffffu;
layout(constant_id = CONSTANT_LIT) const uint constant_lit = 1u;
layout(constant_id = CONSTANT_LIGHTS) const uint constant_lights = 0u;
layout(constant_id = CONSTANT_BUMP_UV) const uint constant_bump_uv = 0u;
layout(constant_id = CONSTANT_REFRACT_COLORS) const uint constant_refract_colors = 1u;
layout(constant_id = CONSTANT_REFRACT_FRESNEL) const uint constant_refract_fresnel = 0u;
layout(constant_id = CONSTANT_REFRACT_LOOKUP) const uint constant_refract_lookup = 0u;
layout(constant_id = CONSTANT_REFRACT_STEPS) const uint constant_refract_steps = 0u;
layout(constant_id = CONSTANT_REFRACT_EXITS) const uint constant_refract_exits = 1u;
layout(constant_id = CONSTANT_TONEMAP_CURVE) const uint constant_tonemap_curve = 0u;
layout(constant_id = CONSTANT_TILED) const uint constant_tiled = 0u;
layout(constant_id = CONSTANT_ICE_SHADOW) const uint constant_ice_shadow = 1u;
layout(constant_id = CONSTANT_OBJECTS) const uint constant_objects = 0u;
layout(constant_id = CONSTANT_COMPOSITE) const uint constant_composite = 0u;
layout(constant_id = CONSTANT_ENVIRONMENT) const float constant_environment_turn = 0.0;
layout(constant_id = CONSTANT_BACKDROP) const uint constant_backdrop = 0u;
layout(constant_id = CONSTANT_SCENE_LIGHTS) const uint constant_scene_lights = 0u;
layout(constant_id = CONSTANT_ORTHOGRAPHIC) const uint constant_orthographic = 0u;
layout(constant_id = CONSTANT_AO) const uint constant_ao = 0u;
layout(constant_id = CONSTANT_CRACKS_TRACED) const uint constant_cracks_traced = 0u;
layout(constant_id = CONSTANT_BUBBLES_TRACED) const uint constant_bubbles_traced = 0u;
layout(constant_id = CONSTANT_TRACE) const uint constant_trace = 0u;

#endif
