/*
 * sample_mean_upload.c: uploads the mean of all samples to the colour image frame_color.
 *
 * The CPU accumulates samples as floats. The mean is taken before tone mapping, because tone
 * mapping is not linear.
 */
#include "src/tech/frame_resources.h"
#include "src/tech/technique.h"

static rg_record_fn record_upload;

static const struct rg_pass passes[] = {
    {
        .name = "resolve.upload",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &frame_samples, .access = RG_COPY_SRC },
                        { .image = &frame_color, .access = RG_COPY_DST }),
        .record = record_upload,
    },
};

static void record_upload(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &frame_samples, 0, &frame_color);
}

const struct technique sample_mean_upload = {
    .name = "resolve",
    .help = "mean of all samples, uploaded to the device",
    .pass_groups = { { PHASE_ENVIRONMENT, SCENE_OF_ANY, .purposes = 1u << TECHNIQUE_RESOLVE,
                       .graph = RG_TECHNIQUE("resolve", passes) } },
};
