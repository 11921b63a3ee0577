/* cmd_ladder.c: command firn ladder: compares refraction models with the reference. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/input_image.h"
#include "src/app/progress.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/base/shell_quote.h"
#include "src/file/atomic_file.h"
#include "src/lab/ladder/comparison_report.h"
#include "src/lab/ladder/white_furnace.h"
#include "src/lab/reference/reference.h"
#include "src/lab/reference/reference_aov_table.h"
#include "src/scene/gpu_material_table.h"
#include "src/settings/scene_settings.h"
#include "src/tech/inclusions/air.h"

static const char default_scene[] = "valley";

struct job {
    struct app_options o;
    struct scene scene;
    struct gpu gpu;
    struct image reference; /* image of --truth, or {0} */
    bool *reference_counted;
    struct ladder ladder;
    struct ladder_report report;
    char *command;
    struct progress progress;
};

/* ---- checks of the arguments ---- */

static enum status refuse_furnace(const struct app_options *o)
{
    const struct setup_scene *scene = &o->image.scene;

    const struct {
        const char *option;
        bool is_given;
    } options[] = {
        { "--env", scene->environment != NULL },
        { "--surroundings", scene->surroundings != NULL },
        { "--background", scene->background.is_given || scene->no_background },
        { "--ground", stage_has_floor(&scene->ground) },
        { "--whole", o->ladder.whole },
        { "--truth", o->ladder.reference_image != NULL },
        { "--output", o->run.outputs.count > 0 },
    };

    for (size_t i = 0; i < sizeof(options) / sizeof(options[0]); i++) {
        if (options[i].is_given) {
            log_error("%s: not available with --furnace, which has a constant environment and "
                      "prints only numbers",
                      options[i].option);
            return STATUS_USAGE;
        }
    }
    return STATUS_OK;
}

static enum status check(struct job *job)
{
    struct app_options *o = &job->o;
    struct setup_scene *scene = &o->image.scene;
    enum status status = o->ladder.furnace ? refuse_furnace(o) : STATUS_OK;
    if (status == STATUS_OK && !reference_is_built()) {
        log_error("firn ladder: this build has no Embree; rebuild with meson setup --reconfigure "
                  "-Dreference=enabled");
        return STATUS_NO_DEVICE;
    }
    if (status == STATUS_OK && o->mask.file && !o->ladder.reference_image) {
        log_error("--mask %s: selects pixels of the image of --truth, which is missing",
                  o->mask.file);
        return STATUS_USAGE;
    }
    for (uint32_t i = 0; i < o->run.outputs.count && status == STATUS_OK; i++)
        status = file_io_check(o->run.outputs.paths[i]);
    if (!scene->name)
        scene->name = default_scene;
    if (o->ladder.furnace) {
        scene->background = (struct setup_vector){ true, { { 1.0f, 1.0f, 1.0f } } };
        o->ladder.run_count = 0;
        settings_set_value(&scene->settings, settings_find("motion.count"), 0.0);
    }
    return status;
}

/* Reads the image of --truth, and the mask of pixels to compare. */
static enum status read_reference(struct job *job)
{
    const struct app_options *o = &job->o;
    const char *path = o->ladder.reference_image;
    struct image mask = { 0 };
    enum status status = input_image_read(path, &o->image.scene.reader, &job->reference);
    if (status != STATUS_OK)
        return status;
    if (job->reference.width != o->image.width || job->reference.height != o->image.height) {
        log_error("%s has %u x %u pixels: use --size %ux%u", path, job->reference.width,
                  job->reference.height, job->reference.width, job->reference.height);
        return STATUS_DATA;
    }
    if (!image_find(&job->reference, "R") || !image_find(&job->reference, "G") ||
        !image_find(&job->reference, "B")) {
        log_error("%s: expected the channels R, G and B", path);
        return STATUS_DATA;
    }
    if (!o->mask.file)
        return STATUS_OK;
    status = input_image_read(o->mask.file, &o->image.scene.reader, &mask);
    if (status == STATUS_OK)
        status = input_image_check_size(&job->reference, path, &mask, o->mask.file);
    if (status == STATUS_OK)
        status = input_image_make_mask(&mask, o->mask.file, o->mask.channel ? o->mask.channel : "A",
                                       &job->reference_counted);
    image_finish(&mask);
    return status;
}

/* ---- images and numbers ---- */

static bool show_progress(void *user, uint32_t stage, uint32_t done, uint32_t all)
{
    struct job *job = user;
    job->progress.frame = stage;
    progress_show(&job->progress, done, all);
    return true;
}

static enum status measure(struct job *job)
{
    const struct app_options *o = &job->o;
    const struct setup_image *p = &o->image;
    const struct motion_params *motion = settings_of(&p->scene.settings, &motion_settings);
    struct ladder_params params = {
        .gpu = &job->gpu,
        .scene = &job->scene,
        .settings = &p->scene.settings,
        .shot = { .time = motion->time },
        .width = p->width,
        .height = p->height,
        .samples = p->samples,
        .filter = p->filter,
        .refraction_models = (uint32_t)o->ladder.refraction_models,
        .is_whole = o->ladder.whole,
        .run_count = o->ladder.run_count,
        .truth = job->reference.plane_count ? &job->reference : NULL,
        .truth_counted = job->reference_counted,
    };
    char names[REFERENCE_NAMES_SIZE];
    enum status status = setup_camera(&params.shot.camera, &job->scene, p);
    if (status == STATUS_OK)
        status = gpu_create(&job->gpu, &o->run.gpu);
    if (status != STATUS_OK)
        return status;
    setup_check_rays(&p->scene.settings, &job->gpu);
    if (!o->run.quiet && reference_unsupported(&p->scene.settings, names, sizeof(names)))
        log_warning("firn ladder: the reference draws the scene without %s", names);
    if (!o->run.quiet && o->ladder.furnace &&
        material_table_has_lit(&job->scene.model.surroundings))
        log_warning("%s: pixels that show opaque surfaces are darker than the furnace's radiance "
                    "of 1, because these surfaces absorb light",
                    p->scene.name);
    if (!o->run.quiet && air_is_medium(&p->scene.settings))
        log_warning("air.model=medium: only bounce, one-sided, trace and the reference draw a "
                    "medium; other refraction models draw the air as planes");
    progress_begin(&job->progress, ladder_stages(&params), "steps", o->run.quiet);
    status = ladder_run(&job->ladder, &params, show_progress, job);
    progress_clear(&job->progress);
    job->report = (struct ladder_report){
        .ladder = &job->ladder,
        .scene = p->scene.name,
        .command = job->command,
        .device = job->gpu.properties.deviceName,
        .samples = p->samples,
    };
    return status;
}

/* ---- results ---- */

static enum status write_output(const struct job *job, const char *path)
{
    void *data = NULL;
    size_t size = 0;
    enum status status = path_ends_in(path, ".png") ? ladder_sheet(&job->report, &data, &size)
                                                    : ladder_exr(&job->report, &data, &size);
    if (status == STATUS_OK)
        status = file_io_write(path, data, size);
    free(data);
    if (status == STATUS_OK && !job->o.run.quiet)
        fprintf(stderr, "%s\n", path);
    return status;
}

static enum status print(const struct job *job)
{
    char *text = NULL;
    size_t size;
    enum status status = STATUS_OK;
    if (job->o.run.format != APP_FORMAT_JSON)
        ladder_table(&job->report, stdout);
    else
        status = ladder_json(&job->report, &text, &size);
    if (text)
        puts(text);
    free(text);
    return status;
}

static enum status report(const struct job *job)
{
    struct furnace furnace;
    enum status status = STATUS_OK;
    if (job->o.ladder.furnace) {
        furnace = furnace_measure(&job->ladder);
        furnace_print(&furnace, stdout);
        status = furnace_passes(&furnace) ? STATUS_OK : STATUS_FAILED;
    } else {
        for (uint32_t i = 0; i < job->o.run.outputs.count && status == STATUS_OK; i++)
            status = write_output(job, job->o.run.outputs.paths[i]);
        if (status == STATUS_OK)
            status = print(job);
    }
    return status;
}

static enum status run(struct job *job)
{
    enum status status = check(job);
    if (status == STATUS_OK && job->o.ladder.reference_image)
        status = read_reference(job);
    if (status == STATUS_OK)
        status = setup_load_scene(&job->scene, &job->o.image.scene);
    if (status == STATUS_OK && job->scene.has_pool) {
        log_error("firn ladder: expected a scene with a refracting object, got '%s'",
                  job->o.image.scene.name);
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = measure(job);
    if (status == STATUS_OK)
        status = report(job);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    return status;
}

static void job_finish(struct job *job)
{
    ladder_finish(&job->ladder);
    image_finish(&job->reference);
    free(job->reference_counted);
    gpu_destroy(&job->gpu);
    scene_finish(&job->scene);
    free(job->command);
    free(job);
}

enum status app_ladder(const struct app_options *options)
{
    struct job *job = calloc(1, sizeof(*job));
    if (!job)
        return log_out_of_memory(NULL);
    job->o = *options;
    job->command = shell_quote_join(options->run.args);
    const enum status status = job->command ? run(job) : log_out_of_memory(NULL);
    job_finish(job);
    return status;
}
