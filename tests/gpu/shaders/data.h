/* data.h: bindings of the test shaders that compute. */
#ifndef DATA_H
#define DATA_H
#include "shaders/abi.h"

#define DATA_SEED    0 /* uniform buffer */
#define DATA_NUMBERS 1 /* storage buffer, one number a texel */
#define DATA_TEXELS  2 /* storage image, or the same sampled */
#define DATA_IMAGE   3 /* cube or array, sampled */
#define DATA_COLORS  4 /* storage buffer of what was sampled */

#define DATA_SAMPLERS 5 /* and on */
#define DATA_COMMANDS 6 /* storage buffer of a struct data_commands */

#define DATA_GROUP 4 /* a workgroup's width and height */

struct data_seed {
    uint32_t value;
};

/* Vulkan's commands, word by word, not at the beginning of the buffer. */
struct data_commands {
    uint32_t unused;
    uint32_t groups[3];
    uint32_t vertices[4];
    uint32_t indices[5];
};

#endif
