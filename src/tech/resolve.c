/*
 * resolve.c: fills the picture with the mean of its samples.
 *
 * Samples are added up in float on the CPU; tonemapping a mean is not the mean of the tonemapped,
 * so the mean goes back into background_color before tonemap reads it.
 */
#include "src/tech/resolve.h"
#include "src/tech/background.h"
#include "src/tech/frame.h"

static rg_record_fn record_upload;

const struct rg_buffer resolve_samples = {
    .name = "resolve.samples",
    .size_per_texel = 8,
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_pass passes[] = {
    {
        .name = "resolve.upload",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &resolve_samples, .access = RG_COPY_SRC },
                        { .image = &background_color, .access = RG_COPY_DST }),
        .record = record_upload,
    },
};

static void record_upload(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &resolve_samples, 0, &background_color);
}

const struct technique resolve = {
    .graph = RG_TECHNIQUE("resolve", passes),
    .help = "the mean of many samples, back on the device",
};
