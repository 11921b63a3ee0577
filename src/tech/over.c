/*
 * over.c: premultiplied colours over each other, those that lie further out last: air, bubbles,
 * cracks; the highlights of the surface are added.
 *
 * One row for every set of layers, since a row names the images that it reads. The shader's
 * bindings are the same in all; what is not there is bound to the highlights, and not looked at.
 */
#include "src/tech/over.h"
#include "shaders/embedded.h"
#include "src/frame.h"
#include "src/tech/air.h"
#include "src/tech/background.h"
#include "src/tech/bubbles.h"
#include "src/tech/cracks.h"
#include "src/tech/surface.h"

static rg_record_fn record_area;

#define LAYER(image_, binding_) \
    { \
        .image = &(image_), .access = RG_SAMPLED, .binding = (binding_), .same_texel = true \
    }

#define USES(air, bubbles, cracks) \
    { \
        FRAME_USE_GLOBALS, AIR_USE_ENVIRONMENT, LAYER(surface_highlight, OVER_HIGHLIGHT), \
            LAYER(air, OVER_AIR), LAYER(bubbles, OVER_BUBBLES), LAYER(cracks, OVER_CRACKS), \
        { \
            0 \
        } \
    }
#define NONE surface_highlight

enum {
    AIR = 1 << 0,
    BUBBLES = 1 << 1,
    CRACKS = 1 << 2,
    SET_COUNT = 1 << 3,
};

static const struct rg_use uses[SET_COUNT][7] = {
    [0] = USES(NONE, NONE, NONE),
    [AIR] = USES(air_cover, NONE, NONE),
    [BUBBLES] = USES(NONE, bubbles_color, NONE),
    [AIR | BUBBLES] = USES(air_cover, bubbles_color, NONE),
    [CRACKS] = USES(NONE, NONE, cracks_color),
    [AIR | CRACKS] = USES(air_cover, NONE, cracks_color),
    [BUBBLES | CRACKS] = USES(NONE, bubbles_color, cracks_color),
    [AIR | BUBBLES | CRACKS] = USES(air_cover, bubbles_color, cracks_color),
};

#define ROW(set) \
    { \
        { \
            .name = "over.ice", \
            .color = RG_TARGETS({ &background_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }), \
            .uses = uses[set], .vert = &over_vert, .frag = &over_frag, .record = record_area, \
        } \
    }

static const struct rg_pass rows[SET_COUNT][1] = {
    ROW(0), ROW(1), ROW(2), ROW(3), ROW(4), ROW(5), ROW(6), ROW(7),
};

static void record_area(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, frame->object_area);
    rg_cmd_draw(cmd, 3);
}

#define TECHNIQUE(set) \
    { \
        .graph = RG_TECHNIQUE("over", rows[set]), \
        .help = "air, bubbles, cracks and highlights over the picture of the ice" \
    }

static const struct technique techniques[SET_COUNT] = {
    TECHNIQUE(0), TECHNIQUE(1), TECHNIQUE(2), TECHNIQUE(3),
    TECHNIQUE(4), TECHNIQUE(5), TECHNIQUE(6), TECHNIQUE(7),
};

const struct technique *over_find(uint32_t layers)
{
    const uint32_t set = (layers & OVER_HAS_AIR ? AIR : 0u) |
                         (layers & OVER_HAS_BUBBLES ? BUBBLES : 0u) |
                         (layers & OVER_HAS_CRACKS ? CRACKS : 0u);
    return layers ? &techniques[set] : NULL;
}
