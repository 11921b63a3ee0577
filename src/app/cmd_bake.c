/* cmd_bake.c: command firn bake: writes the environment cube of a scene to a file for --env. */
#include <cglm/struct.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/file/exr.h"
#include "src/render/renderer.h"
#include "src/settings/scene_settings.h"
#include "src/setup/image_output.h"
#include "src/version.h"

struct job {
    struct app_options o;
    struct scene scene;
    struct gpu gpu;
    struct image strip;
    struct output output;
};

static enum status draw(struct job *job)
{
    struct setup_image *p = &job->o.image;
    const struct renderer_params params = setup_renderer_params(p, &job->gpu, &job->scene);
    enum status status = gpu_create(&job->gpu, &job->o.run.gpu);
    if (status == STATUS_OK)
        status = renderer_bake(&params, job->output.shot.time, &job->strip);
    p->width = job->strip.width;
    p->height = job->strip.height;
    return status;
}

static enum status encode(struct job *job, void **data, size_t *size)
{
    const vec3s center = job->output.shot.camera.eye;
    char where[64];
    snprintf(where, sizeof(where), "%.9g,%.9g,%.9g", (double)center.x, (double)center.y,
             (double)center.z);
    const enum status status = output_describe(&job->output);
    if (status != STATUS_OK)
        return status;
    const struct image_text texts[] = {
        { "firn/version", FIRN_VERSION },
        { "firn/settings", job->output.settings },
        { "firn/device", job->gpu.properties.deviceName },
        { "firn/center", where },
    };
    const struct exr_header header = {
        .texts = texts,
        .text_count = sizeof(texts) / sizeof(texts[0]),
    };
    return exr_encode(&job->strip, &header, data, size);
}

static enum status write_output(struct job *job)
{
    const char *path = job->o.run.outputs.paths[0];
    void *data = NULL;
    size_t size = 0;
    enum status status = encode(job, &data, &size);
    if (status == STATUS_OK)
        status = file_io_write(path, data, size);
    free(data);
    if (status == STATUS_OK && !job->o.run.quiet)
        fprintf(stderr, "%s: six faces of %ux%u\n", path[0] == '-' && !path[1] ? "stdout" : path,
                job->strip.width, job->strip.width);
    return status;
}

static enum status load(struct job *job)
{
    const struct motion_params *motion =
        settings_of(&job->o.image.scene.settings, &motion_settings);
    enum status status = setup_load_scene(&job->scene, &job->o.image.scene);
    if (status == STATUS_OK && job->scene.background.cube.texels) {
        log_error("--env %s: expected an equirectangular image, got a cube of firn bake",
                  job->o.image.scene.environment);
        status = STATUS_USAGE;
    }
    const vec3s center = box_center(job->scene.box);
    job->output = (struct output){
        .image = &job->o.image,
        .scene = &job->scene,
        .shot = {
            .camera = {
                .eye = center,
                .target = glms_vec3_add(center, (vec3s){ { 1.0f, 0.0f, 0.0f } }), /* face 0 */
                .fov_deg = 90.0f,
            },
            .time = motion->time,
        },
    };
    return status;
}

static enum status run(struct job *job)
{
    struct setup_outputs *outputs = &job->o.run.outputs;
    enum status status = setup_require_scene(&job->o.image.scene);
    if (status == STATUS_OK)
        status = file_io_check(outputs->paths[0]);
    if (status == STATUS_OK)
        status = load(job);
    if (status == STATUS_OK)
        status = draw(job);
    if (status == STATUS_OK)
        status = write_output(job);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    return status;
}

enum status app_bake(const struct app_options *options)
{
    struct job *job = calloc(1, sizeof(*job));
    if (!job) {
        return log_out_of_memory(NULL);
    }
    job->o = *options;
    enum status status = run(job);
    output_finish(&job->output);
    image_finish(&job->strip);
    gpu_destroy(&job->gpu);
    scene_finish(&job->scene);
    free(job);
    return status;
}
