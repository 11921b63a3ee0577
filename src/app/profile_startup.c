/* profile_startup.c: measures the start-up of a first image by phases: firn profile --startup. */
#include "src/app/profile_startup.h"
#include <math.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/file/atomic_file.h"
#include "src/file/json_text.h"
#include "src/render/lavapipe_tuning.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer.h"
#include "src/tech/refract/refract.h"

enum phase {
    STARTUP_READER,
    STARTUP_SCENE,
    STARTUP_DEVICE,
    STARTUP_BVH,
    STARTUP_PIPELINES,
    STARTUP_FIRST,
    STARTUP_PHOTONS,
    STARTUP_NEXT,
    STARTUP_COUNT,
};

static const struct {
    const char *name, *help;
} phase_texts[STARTUP_COUNT] = {
    [STARTUP_READER] = { "reader", "processes that parse files" },
    [STARTUP_SCENE] = { "scene", "loading, generation, exposure metering" },
    [STARTUP_DEVICE] = { "device", "instance and device creation" },
    [STARTUP_BVH] = { "bvh", "BVH build" },
    [STARTUP_PIPELINES] = { "pipelines", "frame plan, uploads, pipeline creation" },
    [STARTUP_FIRST] = { "first_sample", "including the driver's deferred compilation" },
    [STARTUP_PHOTONS] = { "photons", "part of the first sample" },
    [STARTUP_NEXT] = { "next_sample", "the same sample again, for comparison" },
};

/* Milliseconds; negative if not measured. */
struct phase_time {
    double cpu, wall;
};

struct startup {
    struct app_options *o;
    struct gpu gpu;
    struct scene scene;
    struct camera camera;
    struct renderer *renderer;
    struct phase_time phases[STARTUP_COUNT];
    struct phase_time begin; /* of the current phase */
    double reader_begin;     /* CPU time of child processes */
};

static void begin_phase(struct startup *s)
{
    s->begin = (struct phase_time){ machine_cpu_ms(false), clock_ms() };
}

static void end_phase(struct startup *s, enum phase phase)
{
    s->phases[phase] =
        (struct phase_time){ machine_cpu_ms(false) - s->begin.cpu, clock_ms() - s->begin.wall };
}

static enum status load(struct startup *s)
{
    struct setup_image *image = &s->o->image;
    s->reader_begin = machine_cpu_ms(true);
    begin_phase(s);
    const enum status status = setup_load_exposed(&s->scene, &s->camera, image);
    if (status != STATUS_OK)
        return status;
    setup_choose_refraction(image, &s->scene, &s->camera);
    end_phase(s, STARTUP_SCENE);
    s->phases[STARTUP_READER] = (struct phase_time){ machine_cpu_ms(true) - s->reader_begin, -1.0 };
    return STATUS_OK;
}

static enum status open_renderer(struct startup *s)
{
    struct setup_image *image = &s->o->image;
    if ((uint64_t)image->width * image->height <= LAVAPIPE_TUNING_START_SAMPLES)
        lavapipe_tuning_prefer_start();
    begin_phase(s);
    enum status status = gpu_create(&s->gpu, &s->o->run.gpu);
    end_phase(s, STARTUP_DEVICE);
    if (status != STATUS_OK)
        return status;
    begin_phase(s);
    if (image->refraction->refraction.traces_bvh)
        status = scene_build_bvh(&s->scene, !s->gpu.no_cache);
    end_phase(s, STARTUP_BVH);
    setup_check_rays(&image->scene.settings, &s->gpu);
    struct renderer_params params = setup_renderer_params(image, &s->gpu, &s->scene);
    params.samples = 1;
    params.keep = true;
    params.measured = true;
    renderer_set_camera(&params, &s->camera);
    begin_phase(s);
    if (status == STATUS_OK)
        status = renderer_create(&s->renderer, &params);
    end_phase(s, STARTUP_PIPELINES);
    return status;
}

static enum status draw(struct startup *s, enum phase phase, enum rg_clock clock)
{
    const struct renderer_shot shot = { .camera = s->camera, .time = s->scene.time };
    renderer_measure(s->renderer, &(struct rg_measure){ clock, false });
    begin_phase(s);
    enum status status = renderer_draw(s->renderer, &shot);
    if (status == STATUS_OK)
        status = renderer_wait(s->renderer);
    end_phase(s, phase);
    return status;
}

/* Sums the time of the passes that trace and splat photons. */
static void add_photons(struct startup *s)
{
    const struct rg_times times = renderer_times(s->renderer);
    const struct rg_plan *plan = renderer_frame(s->renderer);
    s->phases[STARTUP_PHOTONS] = (struct phase_time){ -1.0, 0.0 };
    for (uint32_t i = 0; times.passes && i < times.pass_count; i++) {
        const char *name = plan->passes[i].technique->name;
        if (!strcmp(name, "ice_caustics") || !strcmp(name, "caustics"))
            s->phases[STARTUP_PHOTONS].wall +=
                (double)(times.passes[i].end - times.passes[i].begin) * 1e-6;
    }
}

static void print_time(double ms)
{
    if (ms < 0.0)
        printf(" %9s", "-");
    else
        printf(" %9.1f", ms);
}

static void print_table(const struct startup *s)
{
    const struct setup_image *image = &s->o->image;
    struct phase_time sum = { 0 };
    printf("%s, %s, %ux%u\n\n%-14s %9s %9s\n", image->scene.name,
           image->refraction->refraction.name, image->width, image->height, "phase", "CPU ms",
           "ms");
    for (int i = 0; i < STARTUP_COUNT; i++) {
        const struct phase_time *time = &s->phases[i];
        if (i <= STARTUP_FIRST) {
            sum.cpu += fmax(time->cpu, 0.0);
            sum.wall += fmax(time->wall, 0.0);
        }
        printf("%-14s", phase_texts[i].name);
        print_time(time->cpu);
        print_time(time->wall);
        printf("  %s\n", phase_texts[i].help);
    }
    printf("%-14s", "start");
    print_time(sum.cpu);
    print_time(sum.wall);
    printf("  reader to first sample\n");
}

static json_t *make_time(double ms)
{
    return ms < 0.0 ? json_null() : json_real(ms);
}

static enum status write_json(const struct startup *s)
{
    const struct setup_image *image = &s->o->image;
    json_t *phases = json_array();
    for (int i = 0; i < STARTUP_COUNT; i++)
        phases = json_text_append(phases, json_pack("{s:s, s:o, s:o}", "name", phase_texts[i].name,
                                                    "cpu", make_time(s->phases[i].cpu), "wall",
                                                    make_time(s->phases[i].wall)));
    json_t *root =
        json_pack("{s:i, s:s, s:o, s:s, s:i, s:i, s:o}", "format", 1, "type", "startup", "scene",
                  json_text_string(image->scene.name), "rung", image->refraction->refraction.name,
                  "width", (int)image->width, "height", (int)image->height, "phases", phases);
    char *text = root ? json_dumps(root, JSON_COMPACT) : NULL;
    json_decref(root);
    if (!text)
        return log_out_of_memory(NULL);
    const size_t length = strlen(text);
    text[length] = '\n'; /* replaces the terminating 0 */
    const enum status status = file_io_write(s->o->profile.json, text, length + 1);
    free(text);
    return status;
}

enum status profile_startup(struct app_options *o)
{
    struct startup s = { .o = o };
    enum status status = o->profile.json ? file_io_check(o->profile.json) : STATUS_OK;
    if (status == STATUS_OK)
        status = load(&s);
    if (status == STATUS_OK)
        status = open_renderer(&s);
    if (status == STATUS_OK)
        status = draw(&s, STARTUP_FIRST, RG_CLOCK_SUBMITS);
    if (status == STATUS_OK) {
        add_photons(&s);
        status = draw(&s, STARTUP_NEXT, RG_CLOCK_NONE);
    }
    if (status == STATUS_OK && o->profile.json)
        status = write_json(&s);
    if (status == STATUS_OK && !(o->profile.json && !strcmp(o->profile.json, "-")))
        print_table(&s);
    if (status == STATUS_OK && s.gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    renderer_destroy(s.renderer);
    gpu_destroy(&s.gpu);
    scene_finish(&s.scene);
    return status;
}
