/* render.c: firn render: a picture, to EXR and PNG. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/app/app.h"
#include "src/frame_view.h"
#include "src/image/exr.h"
#include "src/image/file.h"
#include "src/image/png.h"
#include "src/log.h"
#include "src/renderer.h"
#include "src/scene_settings.h"
#include "src/version.h"

static bool is_png(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && !strcmp(dot, ".png");
}

static void print_vector(FILE *out, const char *name, vec3s v)
{
    fprintf(out, " %s=%.9g,%.9g,%.9g", name, (double)v.x, (double)v.y, (double)v.z);
}

/* What was drawn, so that it can be drawn again: options, then every setting. */
static char *describe(const struct app_options *o, const struct camera *camera)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(out, "scene=%s refraction=%s size=%ux%u samples=%u", o->positional, o->rung->name,
            o->width, o->height, o->samples);
    if (o->environment)
        fprintf(out, " env=%s", o->environment);
    if (o->surroundings)
        fprintf(out, " surroundings=%s", o->surroundings);
    if (o->has_background)
        print_vector(out, "background", o->background);
    print_vector(out, "eye", camera->eye);
    print_vector(out, "target", camera->target);
    fprintf(out, " fov=%.9g", (double)camera->fov_deg);
    for (size_t g = 0; setting_groups[g]; g++) {
        for (size_t r = 0; r < setting_groups[g]->row_count; r++) {
            const struct setting *row = &setting_groups[g]->rows[r];
            fprintf(out, " %s=", row->name);
            settings_print(&o->settings, row, out);
        }
    }
    if (fclose(out)) {
        free(text);
        return NULL;
    }
    return text;
}

struct job {
    struct app_options o;
    struct scene scene;
    struct camera camera;
    struct gpu gpu;
    struct renderer *renderer;
    struct render_result result;
};

static enum status encode_exr(const struct job *job, void **data, size_t *size)
{
    const struct app_options *o = &job->o;
    char *settings = describe(o, &job->camera);
    if (!settings) {
        log_error("out of memory");
        return STATUS_TRY_AGAIN;
    }
    const mat4s view = camera_view_from_world(&job->camera);
    const mat4s ndc =
        camera_clip_from_world(&job->camera, o->width, o->height,
                               frame_view_near_plane(&job->scene), (vec2s){ { 0.0f, 0.0f } });
    const struct exr_text texts[] = {
        { "firn/version", FIRN_VERSION },
        { "firn/device", job->gpu.properties.deviceName },
        { "firn/settings", settings },
    };
    /* column-major matrices for column vectors are row-major ones for row vectors */
    const struct exr_header header = {
        .texts = texts,
        .text_count = sizeof(texts) / sizeof(texts[0]),
        .world_to_camera = &view.raw[0][0],
        .world_to_ndc = &ndc.raw[0][0],
    };
    enum status status = exr_encode(&job->result.image, &header, data, size);
    free(settings);
    return status;
}

static enum status write_output(const struct job *job, const char *path)
{
    void *data = NULL;
    size_t size = 0;
    enum status status =
        is_png(path) ? png_encode(job->result.rgba, job->o.width, job->o.height, &data, &size)
                     : encode_exr(job, &data, &size);
    if (status == STATUS_OK)
        status = file_write(path, data, size);
    free(data);
    if (status == STATUS_OK && !job->o.quiet)
        fprintf(stderr, "%s: %ux%u, %u sample%s\n", strcmp(path, "-") ? path : "stdout",
                job->o.width, job->o.height, job->o.samples, job->o.samples > 1 ? "s" : "");
    return status;
}

/* A bar that is drawn over itself, for terminals only. */
static bool show_progress(void *user, uint32_t done, uint32_t all)
{
    const struct job *job = user;

    enum {
        BAR = 40
    };

    uint32_t filled = (uint32_t)((uint64_t)done * BAR / all);
    if (job->o.quiet || all == 1 || !isatty(STDERR_FILENO))
        return true;
    fprintf(stderr, "\r[%.*s%.*s] %u/%u samples", (int)filled,
            "########################################", (int)(BAR - filled),
            "                                        ", done, all);
    if (done == all)
        fprintf(stderr, "\r%*s\r", BAR + 30, "");
    fflush(stderr);
    return true;
}

static enum status check_outputs(struct app_options *o)
{
    enum status status = STATUS_OK;
    bool stdout_taken = false;
    if (!o->output_count)
        o->outputs[o->output_count++] = "firn.exr";
    for (uint32_t i = 0; i < o->output_count && status == STATUS_OK; i++) {
        bool is_stdout = !strcmp(o->outputs[i], "-");
        if (is_stdout && stdout_taken) {
            log_error("-o - twice: stdout takes one picture");
            return STATUS_USAGE;
        }
        stdout_taken = stdout_taken || is_stdout;
        if (!is_stdout)
            status = file_check(o->outputs[i]);
    }
    return status;
}

static enum status draw(struct job *job)
{
    const struct app_options *o = &job->o;
    struct renderer_params params = {
        .gpu = &job->gpu,
        .scene = &job->scene,
        .settings = &o->settings,
        .rung = o->rung,
        .width = o->width,
        .height = o->height,
        .samples = o->samples,
        .sharing = o->sharing,
    };
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (is_png(o->outputs[i]))
            params.display = true;
        else
            params.linear = true;
    }
    if (params.linear)
        params.layers = o->layers;
    else if (o->layers)
        log_warning("--aov: PNG files have no layers; name an .exr file too");
    const struct motion_params *motion = settings_of(&o->settings, &motion_settings);
    const struct renderer_shot shot = { .camera = job->camera, .time = motion->time };
    enum status status = renderer_create(&job->renderer, &params);
    if (status == STATUS_OK)
        status = renderer_render(job->renderer, &shot, &job->result, show_progress, job);
    return status;
}

/* Everything that can be wrong with the words and files is found before the device is opened. */
static enum status run(struct job *job)
{
    enum status status = check_outputs(&job->o);
    if (status == STATUS_OK)
        status = app_load_scene(&job->scene, &job->o);
    if (status == STATUS_OK)
        status = app_camera(&job->camera, &job->scene, &job->o);
    if (status == STATUS_OK)
        status = gpu_create(&job->gpu, &(struct gpu_params){
                                           .device = job->o.device,
                                           .validate = job->o.validate,
                                       });
    if (status == STATUS_OK)
        status = draw(job);
    for (uint32_t i = 0; i < job->o.output_count && status == STATUS_OK; i++)
        status = write_output(job, job->o.outputs[i]);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has said why */
    return status;
}

enum status app_render(const struct app_options *options)
{
    struct job *job = calloc(1, sizeof(*job));
    if (!job) {
        log_error("out of memory");
        return STATUS_TRY_AGAIN;
    }
    job->o = *options;
    if (!job->o.samples)
        job->o.samples = 1;
    enum status status = run(job);
    render_result_finish(&job->result);
    renderer_destroy(job->renderer);
    gpu_destroy(&job->gpu);
    scene_finish(&job->scene);
    free(job);
    return status;
}
