/* interpret_texel_format.h: texel formats of the interpreter, as four 32-bit values per texel. */
#ifndef TESTS_SUPPORT_INTERPRET_TEXEL_FORMAT_H
#define TESTS_SUPPORT_INTERPRET_TEXEL_FORMAT_H

#include "graph/rg.h"

/* Return the bit mask of a channel; the size of a texel in bytes, without stencil. */
uint32_t interpret_format_mask(VkFormat format);
uint32_t interpret_format_size(VkFormat format);

/* Stores a value as shaders would read it: missing channels become 0, 0, 1. In stencil formats,
 * value[1] is the stencil. */
void interpret_format_store(uint32_t *texel, VkFormat format, const uint32_t value[4]);

/* Convert a texel from and to its little-endian bytes. */
void interpret_format_decode(uint32_t *texel, VkFormat format, const unsigned char *bytes);
void interpret_format_encode(unsigned char *bytes, VkFormat format, const uint32_t *texel);

#endif
