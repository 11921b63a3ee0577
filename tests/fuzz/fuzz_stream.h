/* fuzz_stream.h: valid streams of a reader process, and edits of their bytes. */
#ifndef TESTS_FUZZ_STREAM_H
#define TESTS_FUZZ_STREAM_H

#include <string.h>

#include "src/file/image_receive.h"
#include "src/scene/import/model_pipe.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/memory_pipe.h"

enum {
    EDIT_SIZE = 6, /* bytes of an edit: position (2), value (4) */
    MOST_EDITS = 4,
};

/* Header of an image with two planes, a position and a string. */
static inline void fuzz_stream_make_head(struct memory_pipe *stream)
{
    struct image_header head = { .has_window = true, .window = { 1, 2, 8, 8 } };
    image_init(&head.image, 4, 4);
    FUZZ_CHECK(image_header_add_plane(&head, "R", true) &&
               image_header_add_plane(&head, "Z", false) &&
               image_header_add_text(&head, "firn/tile", "1 of 2x2", 8));
    FUZZ_CHECK(image_pipe_write_header(&(struct pipe_sink){ memory_pipe_write, stream }, &head));
    image_header_finish(&head);
}

/* Valid data: a model of two objects, a camera and two textures, or a panorama of 2 x 1. */
static inline void fuzz_stream_make(struct memory_pipe *stream, bool is_model)
{
    struct mesh_vertex vertices[4] = { 0 };
    uint32_t indices[6] = { 0, 1, 2, 2, 3, 0 };
    uint8_t texels[32] = { 0 };
    uint16_t halfs[8] = { 0, 1, 2, 0x3c00, 0x7bff, 0, 0, 0x3c00 };
    struct object objects[2] = { { .index_count = 3 }, { .first_index = 3, .index_count = 3 } };
    struct material material = material_make("glass");
    struct model_camera camera = { .camera = { .eye = { { 0, 0, 2 } }, .fov_deg = 45 } };
    struct model_animation animation = { "walk", 1 };
    struct light light = { .kind = LIGHT_SPOT, .direction = { { 1, 0, 0 } }, .outer_cone = 1 };
    struct model_extension extension = { "EXT_any", MODEL_DRAWN };
    const struct model model = {
        .object = { .vertices = vertices, .indices = indices, .vertex_count = 4, .index_count = 6 },
        .objects = objects,
        .object_count = 2,
        .materials = &material,
        .material_count = 1,
        .cameras = &camera,
        .camera_count = 1,
        .lights = &light,
        .light_count = 1,
        .extensions = &extension,
        .extension_count = 1,
        .undrawn = 1,
        .animations = &animation,
        .animation_count = 1,
        .animation = 1,
        .surroundings = { .vertices = vertices,
                          .indices = indices,
                          .vertex_count = 4,
                          .index_count = 6 },
        .textures = { texels, 2, 2 },
        .camera = { .eye = { { 0, 0, 2 } }, .fov_deg = 45 },
        .ior = 1.3F,
        .has_camera = true,
        .has_ior = true,
    };
    const struct environment environment = { .texels = halfs, .width = 2, .height = 1 };
    const struct pipe_sink sink = { memory_pipe_write, stream };
    FUZZ_CHECK(is_model ? model_pipe_write_model(&sink, &model)
                        : model_pipe_write_environment(&sink, &environment));
}

static inline void fuzz_stream_edit(struct memory_pipe *stream, const uint8_t *data, size_t size)
{
    for (size_t i = 0; i < MOST_EDITS && size >= (i + 1) * EDIT_SIZE; i++) {
        const uint8_t *what = data + i * EDIT_SIZE;
        const size_t at = (what[0] | (size_t)what[1] << 8) % (stream->size - 3);
        memcpy(stream->bytes + at, what + 2, 4);
    }
}

#endif
