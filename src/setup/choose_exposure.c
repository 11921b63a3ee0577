/* choose_exposure.c: automatic exposure, metered on a small image of the path tracer. The image has
 * a fixed number of pixels and samples and is traced on the CPU. The exposure depends on the scene
 * at time 0, the camera and the aspect ratio, but not on the device, the image size, tiles or the
 * frame of a sequence. */
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/lab/reference/reference.h"
#include "src/settings/scene_settings.h"
#include "src/setup/aov_to_png.h"
#include "src/setup/setup.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/output/tonemap.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/tech/techniques.h"

enum {
    PIXEL_COUNT = 64 * 48,
    SAMPLE_COUNT = 4,
    STEPS_PER_STOP = 10, /* exposures are multiples of a tenth of a stop */
    LIMIT = 6 * STEPS_PER_STOP,
};

static const float darkest = 0.27f; /* range of the median luminance, sRGB-encoded */
static const float brightest = 0.42f;
static const float clipped = 254.0f / 255;   /* luminance at which highlights have lost detail */
static const float clipped_fraction = 0.01f; /* fraction of pixels that may be clipped */

/* Radiance of the pixels that are metered. */
struct meter {
    vec3s *radiance;
    float *luminance; /* after tone mapping and encoding, sorted */
    size_t count;
    uint32_t curve;
};

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Computes and sorts the luminance of the displayed pixels. */
static void expose(struct meter *meter, int step)
{
    const struct tonemap_params params = { exp2f((float)step / STEPS_PER_STOP), meter->curve };
    for (size_t i = 0; i < meter->count; i++) {
        const vec3s c = tonemap_encode(meter->radiance[i], params);
        meter->luminance[i] = 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
    }
    qsort(meter->luminance, meter->count, sizeof(*meter->luminance), compare);
}

static float median(struct meter *meter, int step)
{
    expose(meter, step);
    return meter->luminance[meter->count / 2];
}

static bool clips(struct meter *meter, int step)
{
    expose(meter, step);
    const float share = clipped_fraction * (float)meter->count;
    return meter->luminance[meter->count - 1 - (size_t)share] >= clipped;
}

/* Returns the exposure nearest to 0 that brings the median into range. Raises it only as far as
 * highlights keep their detail. */
static float choose(struct meter *meter)
{
    const float middle = median(meter, 0);
    int step = 0;
    while (middle > brightest && step > -LIMIT && median(meter, step) > brightest)
        step--;
    while (middle < darkest && step < LIMIT && median(meter, step) < darkest &&
           !clips(meter, step + 1))
        step++;
    if (step == LIMIT) /* nothing is lit */
        return 0.0f;
    return (float)step / STEPS_PER_STOP;
}

/* Copies the radiance of the pixels. With a stated background, only those of objects count. */
static bool meter_init(struct meter *meter, const struct image *image, bool is_masked)
{
    const size_t count = (size_t)image->width * image->height;
    const float *depth = image_find(image, layer_image_find("Z")->planes[0]);
    const float *planes[3];
    for (int c = 0; c < 3; c++)
        planes[c] = image_find(image, frame_beauty.planes[c]);
    meter->radiance = calloc(count, sizeof(*meter->radiance));
    meter->luminance = calloc(count, sizeof(*meter->luminance));
    if (!meter->radiance || !meter->luminance)
        return false;
    for (size_t i = 0; i < count; i++) {
        if (!is_masked || depth[i] < 1e9f)
            meter->radiance[meter->count++] =
                (vec3s){ { planes[0][i], planes[1][i], planes[2][i] } };
    }
    return true;
}

/* Makes a copy of the scene without inclusions and bumps, whose textures may not be generated yet,
 * but with the density of scattering media, and with the background, which clear objects show. The
 * result borrows the scene's memory, except
 * inclusions.media. Returns false when out of memory. */
static bool copy_without_inclusions(struct scene *bare, const struct scene *scene)
{
    *bare = *scene;
    bare->inclusions = (struct scene_inclusions){ .media = scene->inclusions.media };
    bare->bump = (struct bump_maps){ 0 };
    bare->background.is_hidden = false;
    return scattering_media_fill(&bare->inclusions.media, &scene->model);
}

/* Returns the settings of the metered image. They do not depend on the quality level. */
static struct settings metering_settings(const struct settings *given)
{
    struct settings settings = *given;
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_ice_only)
            techniques_switch_off(&settings, *t);
    }
    settings_set_value(&settings, settings_find("ground.light"), GROUND_TRACED);
    settings_set_value(&settings, settings_find("ice_caustics.light"), ICE_CAUSTICS_NONE);
    settings_set_value(&settings, settings_find("reference.photons"), 0);
    return settings;
}

/* Renders the metered image. */
static enum status render(const struct setup_image *p, const struct scene *scene,
                          const struct camera *camera, struct render_result *result)
{
    const float aspect = (float)p->width / (float)p->height;
    const float width = fminf(fmaxf(sqrtf(PIXEL_COUNT * aspect), 1.0f), PIXEL_COUNT);
    const struct settings settings = metering_settings(&p->scene.settings);
    struct scene bare;
    const bool is_copied = copy_without_inclusions(&bare, scene);
    const struct reference_request request = {
        .scene = &bare,
        .settings = &settings,
        .width = (uint32_t)lrintf(width),
        .height = (uint32_t)lrintf(PIXEL_COUNT / width),
        .samples = SAMPLE_COUNT,
        .layers = layer_image_bit(layer_image_find("Z")),
        .linear = true,
    };
    const struct renderer_shot shot = { .camera = *camera }; /* at time 0 */
    struct reference *reference = NULL;
    enum status status =
        is_copied ? reference_create(&reference, &request) : log_out_of_memory("scattering media");
    if (status == STATUS_OK)
        status = reference_render(reference, &shot, result, NULL, NULL);
    reference_destroy(reference);
    scattering_media_finish(&bare.inclusions.media);
    return status;
}

/* Returns true if the exposure is to be metered: for --exposure auto, and for a model file unless
 * an exposure or the background's colour is stated. */
static bool is_metered(const struct setup_scene *options, const struct scene *scene)
{
    const struct setup_exposure *exposure = &options->exposure;
    if (exposure->is_auto)
        return true;
    return reference_is_built() && !options->plain && !options->background.is_given &&
           scene->framing.count &&
           settings_source(&options->settings, settings_find("tonemap.exposure")) <= SETTING_SCENE;
}

void setup_put_exposure(struct setup_scene *options)
{
    const struct setting *row = settings_find("tonemap.exposure");
    const enum setting_source source = settings_source(&options->settings, row);
    if (options->exposure.is_chosen && source != SETTING_USER)
        settings_put(&options->settings, row, (double)options->exposure.stops,
                     source > SETTING_SCENE && options->exposure.is_auto ? source : SETTING_SCENE);
}

enum status setup_choose_exposure(struct setup_image *p, const struct scene *scene,
                                  const struct camera *camera)
{
    const struct tonemap_values *values = settings_of(&p->scene.settings, &tonemap_settings);
    struct render_result result = { 0 };
    struct meter meter = { .curve = values->curve };
    enum status status = STATUS_OK;
    if (!p->scene.exposure.is_chosen && is_metered(&p->scene, scene)) {
        status = render(p, scene, camera, &result);
        if (status == STATUS_OK &&
            !meter_init(&meter, &result.image,
                        p->scene.background.is_given || p->scene.no_background))
            status = log_out_of_memory("exposure");
        if (status == STATUS_OK) {
            p->scene.exposure.is_chosen = true;
            p->scene.exposure.stops = meter.count ? choose(&meter) : 0.0f;
        }
        free(meter.radiance);
        free(meter.luminance);
        render_result_finish(&result);
    }
    setup_put_exposure(&p->scene);
    return status;
}
