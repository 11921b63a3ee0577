/*
 * Bytes become what a reader of files sends back: as they are, or put into a sound stream here and
 * there. Whatever they are, a model that is taken is one that every pass may draw.
 */
#include <math.h>
#include <string.h>

#include "src/scene/import/mesh_pipe.h"
#include "tests/fuzz/fuzz.h"

enum {
    STREAM_SIZE = 4096,
    SIZE_MAX_OF_ALL = 1 << 20,
    EDIT_SIZE = 6, /* where (2), what (4) */
    MOST_EDITS = 4,
};

struct stream {
    uint8_t bytes[STREAM_SIZE];
    size_t size, at;
};

static bool read_stream(void *user, void *bytes, size_t size)
{
    struct stream *stream = user;
    if (size > stream->size - stream->at)
        return false;
    memcpy(bytes, stream->bytes + stream->at, size);
    stream->at += size;
    return true;
}

static bool write_stream(void *user, const void *bytes, size_t size)
{
    struct stream *stream = user;
    FUZZ_CHECK(size <= STREAM_SIZE - stream->size);
    memcpy(stream->bytes + stream->size, bytes, size);
    stream->size += size;
    return true;
}

static void check_mesh(const struct mesh *mesh, const struct texture_layers *textures)
{
    FUZZ_CHECK(mesh->index_count % 3 == 0);
    for (uint32_t i = 0; i < mesh->index_count; i++)
        FUZZ_CHECK(mesh->indices[i] < mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const struct mesh_vertex *vertex = &mesh->vertices[i];
        for (int k = 0; k < 3; k++)
            FUZZ_CHECK(isfinite(vertex->position.raw[k]) && isfinite(vertex->normal.raw[k]) &&
                       isfinite(vertex->color.raw[k]));
        FUZZ_CHECK((vertex->material & MESH_TEXTURE_MASK) <= textures->count);
    }
}

static void read_model(struct stream *stream)
{
    const struct pipe_source source = { read_stream, stream, SIZE_MAX_OF_ALL };
    struct model model;
    if (mesh_pipe_read_model(&source, &model) != PIPE_OK) {
        FUZZ_CHECK(!model.object.vertices && !model.object.indices && !model.textures.texels &&
                   !model.surroundings.vertices && !model.surroundings.indices);
        return;
    }
    FUZZ_CHECK(model.object.index_count + model.surroundings.index_count > 0);
    check_mesh(&model.object, &model.textures);
    check_mesh(&model.surroundings, &model.textures);
    model_finish(&model);
}

static void read_environment(struct stream *stream)
{
    const struct pipe_source source = { read_stream, stream, SIZE_MAX_OF_ALL };
    struct environment environment;
    if (mesh_pipe_read_environment(&source, &environment) != PIPE_OK) {
        FUZZ_CHECK(!environment.texels && environment.width == 0 && environment.height == 0);
        return;
    }
    FUZZ_CHECK(environment.width > 0 && environment.height > 0);
    for (size_t i = 0; i < (size_t)environment.width * environment.height * 4; i++)
        FUZZ_CHECK(environment.texels[i] <= 0x7bff);
    environment_finish(&environment);
}

/* A sound one: two triangles, a camera, two textures; or a panorama of 2 x 1. */
static void make(struct stream *stream, bool is_model)
{
    struct mesh_vertex vertices[4] = { 0 };
    uint32_t indices[6] = { 0, 1, 2, 2, 3, 0 };
    uint8_t texels[32] = { 0 };
    uint16_t halfs[8] = { 0, 1, 2, 0x3c00, 0x7bff, 0, 0, 0x3c00 };
    const struct model model = {
        .object = { vertices, indices, 4, 6 },
        .surroundings = { vertices, indices, 4, 6 },
        .textures = { texels, 2, 2 },
        .camera = { .eye = { { 0, 0, 2 } }, .fov_deg = 45 },
        .ior = 1.3F,
        .has_camera = true,
        .has_ior = true,
    };
    const struct environment environment = { halfs, 2, 1 };
    const struct pipe_sink sink = { write_stream, stream };
    FUZZ_CHECK(is_model ? mesh_pipe_write_model(&sink, &model)
                        : mesh_pipe_write_environment(&sink, &environment));
}

static void edit(struct stream *stream, const uint8_t *data, size_t size)
{
    for (size_t i = 0; i < MOST_EDITS && size >= (i + 1) * EDIT_SIZE; i++) {
        const uint8_t *what = data + i * EDIT_SIZE;
        const size_t at = (what[0] | (size_t)what[1] << 8) % (stream->size - 3);
        memcpy(stream->bytes + at, what + 2, 4);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct stream stream = { .size = 0 };
    if (size == 0)
        return 0;
    const bool is_model = data[0] & 1;
    if (data[0] & 2) {
        stream.size = size - 1 < STREAM_SIZE ? size - 1 : STREAM_SIZE;
        memcpy(stream.bytes, data + 1, stream.size);
    } else {
        make(&stream, is_model);
        edit(&stream, data + 1, size - 1);
    }
    if (is_model)
        read_model(&stream);
    else
        read_environment(&stream);
    return 0;
}
