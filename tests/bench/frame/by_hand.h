/*
 * by_hand.h: the plain frame of a scene (no air, cracks, bubbles, bumps nor lights; rung `paper`)
 * as one would write it without a render graph: the same shaders, targets and draws, with barriers
 * where they were thought to be needed.
 */
#ifndef BENCH_BY_HAND_H
#define BENCH_BY_HAND_H

#include "src/render/renderer.h"
#include "src/render/uploaded_scene.h"

struct by_hand_params {
    struct gpu *gpu;
    const struct scene *scene;
    const struct uploaded_scene *uploaded;
    const struct settings *settings;
    struct camera camera;
    uint32_t width, height; /* pixels */
};

struct by_hand;

/* Any failure fails the test. */
struct by_hand *by_hand_create(const struct by_hand_params *params);
void by_hand_destroy(struct by_hand *h);

/* Records a frame, submits it and waits for it. */
void by_hand_draw(struct by_hand *h);

/* The yardstick: `count` times the last pass alone, which fetches each texel and writes it. */
void by_hand_fetch(struct by_hand *h, uint32_t count);

/* The picture, sRGB-encoded, width * height * 4 bytes, until the next call of any of these. */
const uint8_t *by_hand_picture(struct by_hand *h);

#endif
