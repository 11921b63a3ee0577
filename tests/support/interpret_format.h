/* interpret_format.h: texels of the formats that random tables have, as interpret.c keeps them. */
#ifndef TESTS_INTERPRET_FORMAT_H
#define TESTS_INTERPRET_FORMAT_H

#include "graph/rg.h"

/* Bits of a channel, and bytes of a texel, of depth without its stencil. */
uint32_t interpret_format_mask(VkFormat format);
uint32_t interpret_format_size(VkFormat format);

/* Stores what shaders read; what a format lacks reads as 0, 0, 1. The second value of a format with
 * a stencil is that. */
void interpret_format_store(uint32_t *texel, VkFormat format, const uint32_t value[4]);

/* From and to bytes, the lowest first. */
void interpret_format_decode(uint32_t *texel, VkFormat format, const unsigned char *bytes);
void interpret_format_encode(unsigned char *bytes, VkFormat format, const uint32_t *texel);

#endif
