/* ocio_view.c: 3D lookup table of an OpenColorIO view: sends it to the parent, and interpolates. */
#include "src/file/ocio_view.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/file/ocio_bake.h"

enum {
    SIDE = 65, /* nodes per axis */
    NODE_OF_1 = 40,
    NODE_COUNT = SIDE * SIDE * SIDE,
    MAGIC_OCIO = 0x4f49434f,
    FAULT_SIZE = 512,
};

/* Nodes are evenly spaced in log2(1 + x / TOE). One of them is at x = 1, because many views clip
 * there; the last is at 147. */
#define TOE (1.0f / 4096.0f)

static float nodes_per_octave(void)
{
    return NODE_OF_1 / log2f(1.0f + 1.0f / TOE);
}

/* Returns the position of a linear value on an axis, 0 to SIDE - 1. NaN becomes 0. */
static float position_of(float linear)
{
    const float position = log2f(1.0f + fmaxf(linear, 0.0f) / TOE) * nodes_per_octave();
    return fminf(position, SIDE - 1);
}

static float value_at(size_t node)
{
    return TOE * (exp2f((float)node / nodes_per_octave()) - 1.0f);
}

enum status ocio_view_send(const char *config, const char *name, const struct pipe_sink *sink)
{
    static const uint32_t magic = MAGIC_OCIO;
    char fault[FAULT_SIZE] = "";
    float *lattice = malloc((size_t)NODE_COUNT * 3 * sizeof(*lattice));
    if (!lattice)
        return log_out_of_memory(config);
    for (size_t i = 0; i < NODE_COUNT; i++) {
        lattice[3 * i] = value_at(i % SIDE);
        lattice[3 * i + 1] = value_at(i / SIDE % SIDE);
        lattice[3 * i + 2] = value_at(i / SIDE / SIDE);
    }
    enum status status = STATUS_OK;
    if (!ocio_bake(config, name, lattice, NODE_COUNT, fault, sizeof(fault))) {
        fault[strcspn(fault, "\r\n")] = '\0';
        log_error("%s: %s", config, fault);
        status = STATUS_DATA;
    } else if (!pipe_write(sink, &magic, sizeof(magic)) ||
               !pipe_write(sink, lattice, (size_t)NODE_COUNT * 3 * sizeof(*lattice)) ||
               !pipe_write_end(sink)) {
        status = STATUS_WRITE;
    }
    free(lattice);
    return status;
}

static enum pipe_fault receive(const struct pipe_source *source, float *lattice)
{
    uint32_t magic = 0;
    enum pipe_fault fault = pipe_read(source, &magic, sizeof(magic));
    if (fault == PIPE_OK && magic != MAGIC_OCIO)
        return PIPE_HEAD;
    if (fault == PIPE_OK)
        fault = pipe_read(source, lattice, (size_t)NODE_COUNT * 3 * sizeof(*lattice));
    for (size_t i = 0; i < (size_t)NODE_COUNT * 3 && fault == PIPE_OK; i++) {
        if (!isfinite(lattice[i]))
            return PIPE_NUMBER;
    }
    return fault == PIPE_OK ? pipe_read_end(source) : fault;
}

enum status ocio_view_load(struct ocio_view *view, const char *config, const char *name,
                           const struct reader_params *params)
{
    struct reader *reader;
    struct reader_params named = *params;
    named.details = name;
    *view = (struct ocio_view){ 0 };
    if (!ocio_bake_is_built()) {
        log_error("--ocio: this build has no OpenColorIO");
        return STATUS_NO_DEVICE;
    }
    if (!file_is_readable(config)) {
        log_error("%s: %s", config, strerror(errno));
        return STATUS_NO_INPUT;
    }
    view->lattice = malloc((size_t)NODE_COUNT * 3 * sizeof(*view->lattice));
    if (!view->lattice)
        return log_out_of_memory(config);
    enum status status = reader_start(&reader, &named, READER_OCIO, config);
    if (status == STATUS_OK) {
        const struct pipe_source source = reader_source(reader);
        status = reader_end(reader, receive(&source, view->lattice));
    }
    if (status != STATUS_OK)
        ocio_view_finish(view);
    return status;
}

void ocio_view_finish(struct ocio_view *view)
{
    free(view->lattice);
    *view = (struct ocio_view){ 0 };
}

void ocio_view_apply(const struct ocio_view *view, const float linear[static 3],
                     float shown[static 3])
{
    static const size_t strides[3] = { 3, (size_t)3 * SIDE, (size_t)3 * SIDE * SIDE };
    size_t at = 0;
    float weights[3];
    for (size_t c = 0; c < 3; c++) {
        const float position = position_of(linear[c]);
        const float first = fminf(floorf(position), (float)(SIDE - 2));
        at += (size_t)first * strides[c];
        weights[c] = position - first;
    }
    shown[0] = shown[1] = shown[2] = 0.0f;
    for (size_t corner = 0; corner < 8; corner++) {
        size_t node = at;
        float weight = 1.0f;
        for (size_t c = 0; c < 3; c++) {
            const bool is_second = corner >> c & 1;
            node += is_second ? strides[c] : 0;
            weight *= is_second ? weights[c] : 1.0f - weights[c];
        }
        for (size_t c = 0; c < 3; c++)
            shown[c] += weight * view->lattice[node + c];
    }
}
