/* stage_textures.h: procedural textures of a stage's floor: slate and wooden boards. */
#ifndef FIRN_SCENE_STAGE_STAGE_TEXTURES_H
#define FIRN_SCENE_STAGE_STAGE_TEXTURES_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    STAGE_TEXTURE_SIZE = 512, /* texels along each side */
};

/* Textures of a floor, which repeat without seams. */
struct stage_textures {
    uint8_t *colors;  /* sRGB base colour; RGBA8 texels, rows from the top; freed by the caller */
    uint8_t *normals; /* tangent space normals, in the same layout; freed by the caller */
    vec3s mean;       /* mean of the colours, linear */
};

/* Generates the textures of cleft slate or, for `is_wood`, of oiled boards along v. Returns false
 * when out of memory; *textures is then zeroed. */
bool stage_textures_generate(struct stage_textures *textures, bool is_wood);

#endif
