/* scene.c: loads scenes with the options of firn render, and applies changed options. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/set_option.h"
#include "src/base/text_stream.h"
#include "src/lib/scene_source.h"
#include "src/settings/settings.h"

/* ---- strings ---- */

const char *lib_keep_text(firn_scene *scene, const char *text)
{
    for (const struct lib_text *t = scene->texts; t; t = t->next) {
        if (!strcmp(t->text, text))
            return t->text;
    }
    struct lib_text *kept = malloc(sizeof(*kept) + strlen(text) + 1);
    if (!kept)
        return NULL;
    kept->next = scene->texts;
    memcpy(kept->text, text, strlen(text) + 1);
    scene->texts = kept;
    return kept->text;
}

/* ---- options ---- */

/* Removes an earlier override for the node of the last material or transform override. */
static void drop_replaced(struct setup_scene *given)
{
    const uint32_t materials = given->material_override_count;
    const uint32_t transforms = given->object_transform_count;
    for (uint32_t i = 0; i + 1 < materials; i++) {
        if (!strcmp(given->material_overrides[i].name,
                    given->material_overrides[materials - 1].name)) {
            given->material_overrides[i] = given->material_overrides[materials - 1];
            given->material_override_count--;
            break;
        }
    }
    for (uint32_t i = 0; i + 1 < transforms; i++) {
        if (!strcmp(given->object_transforms[i].name,
                    given->object_transforms[transforms - 1].name)) {
            given->object_transforms[i] = given->object_transforms[transforms - 1];
            given->object_transform_count--;
            break;
        }
    }
}

/* Sets an option in `image`, a copy of the scene's options. */
static enum status set_option(firn_scene *scene, struct setup_image *image, const char *name,
                              const char *value)
{
    if (lib_require(name, "name") != STATUS_OK || lib_require(value, name) != STATUS_OK)
        return STATUS_USAGE;
    const char *kept = lib_keep_text(scene, value);
    if (!kept)
        return log_out_of_memory(name);
    const enum status status = option_set_render(image, name, kept);
    if (status == STATUS_OK)
        drop_replaced(&image->scene);
    return status;
}

static enum status set_options(firn_scene *scene, const char *const *options)
{
    enum status status = STATUS_OK;
    for (size_t i = 0; options && options[i] && status == STATUS_OK; i += 2) {
        status = set_option(scene, &scene->given, options[i], options[i + 1]);
        if (!options[i + 1])
            break; /* no pair follows */
    }
    return status;
}

/* ---- loading ---- */

/* Sets the reader program and the scene's arrays. */
static void adapt(firn_scene *scene, struct setup_image *image)
{
    image->scene.reader.program = scene->device->reader;
    image->scene.reader.stays_dumpable = true;
    image->scene.source = scene->source.user ? &scene->source : NULL;
}

/* Copies the scene's options to *image and derives the dependent ones. A nonzero `samples`
 * overrides their sample count. */
static enum status complete(firn_scene *scene, uint32_t samples, struct setup_image *image)
{
    *image = scene->given;
    adapt(scene, image);
    if (samples) {
        image->samples = samples;
        image->is_adaptive = false;
    }
    return option_complete_render(image);
}

void lib_scene_close_sessions(firn_scene *scene)
{
    for (firn_renderer *r = scene->renderers; r; r = r->next)
        image_session_close(&r->session);
}

/* Loads the scene. On failure, keeps the previous one. */
static enum status load(firn_scene *scene)
{
    struct setup_image image;
    struct session_scene session = { .pose = scene->session.pose + 1 };
    lib_set_source(scene);
    enum status status = complete(scene, 0, &image);
    if (status == STATUS_OK)
        status = setup_begin_scene(&session.scene, &image.scene);
    if (status != STATUS_OK)
        return status;
    lib_scene_close_sessions(scene);
    scene_finish(&scene->session.scene);
    scene->session = session;
    scene->image = image;
    scene->is_loaded = true;
    scene->needs_load = scene->needs_settings = false;
    scene->version++;
    return STATUS_OK;
}

enum status lib_scene_image(firn_scene *scene, uint32_t samples, struct setup_image *image)
{
    const enum status status = complete(scene, samples, image);
    const struct settings settings = image->scene.settings;
    const struct setup_exposure exposure = image->scene.exposure;
    if (status != STATUS_OK)
        return status;
    image->scene = scene->image.scene;
    image->scene.settings = settings;
    image->scene.exposure = exposure;
    setup_apply_scene_settings(&image->scene, &scene->session.scene);
    return STATUS_OK;
}

/* Applies changed settings without reloading the scene. */
static enum status apply_settings(firn_scene *scene)
{
    struct setup_image image;
    const enum status status = lib_scene_image(scene, 0, &image);
    if (status != STATUS_OK)
        return status;
    scene->image = image;
    scene->needs_settings = false;
    scene->version++;
    return STATUS_OK;
}

enum status lib_scene_update(firn_scene *scene)
{
    enum status status = STATUS_OK;
    if (scene->needs_load || !scene->is_loaded)
        status = load(scene);
    else if (scene->needs_settings)
        status = apply_settings(scene);
    return status;
}

void lib_scene_reload(firn_scene *scene)
{
    scene->needs_load = true;
}

/* Creates a scene with options, but does not load it. */
static enum status create(firn *device, const char *path, const char *const *options,
                          firn_scene **created)
{
    firn_scene *scene = calloc(1, sizeof(*scene));
    if (!scene)
        return log_out_of_memory(NULL);
    scene->device = device;
    scene->refs = 1;
    device->refs++;
    option_init_render(&scene->given);
    scene->given.scene.name = lib_keep_text(scene, path);
    enum status status =
        scene->given.scene.name ? set_options(scene, options) : log_out_of_memory(path);
    if (status == STATUS_OK)
        *created = scene;
    else
        lib_release_scene(scene);
    return status;
}

firn_status firn_scene_load(firn *device, const char *path, const char *const *options,
                            firn_scene **scene)
{
    struct lib_call call;
    firn_scene *created = NULL;
    if (scene)
        *scene = NULL;
    if (!lib_enter(&call, device, true))
        return device ? FIRN_FAILED : FIRN_USAGE;
    enum status status = lib_require(path, "path");
    if (status == STATUS_OK)
        status = lib_require(scene, "scene");
    if (status == STATUS_OK)
        status = create(device, path, options, &created);
    if (status == STATUS_OK)
        status = lib_scene_update(created);
    if (status == STATUS_OK)
        *scene = created;
    else if (created)
        lib_release_scene(created);
    return lib_leave(&call, status);
}

firn_status firn_scene_create(firn *device, const char *const *options, firn_scene **scene)
{
    struct lib_call call;
    if (scene)
        *scene = NULL;
    if (!lib_enter(&call, device, true))
        return device ? FIRN_FAILED : FIRN_USAGE;
    enum status status = lib_require(scene, "scene");
    if (status == STATUS_OK)
        status = create(device, "arrays", options, scene);
    if (status == STATUS_OK)
        (*scene)->is_arrays = true;
    return lib_leave(&call, status);
}

void lib_release_scene(firn_scene *scene)
{
    firn *device = scene->device;
    if (--scene->refs)
        return;
    scene_finish(&scene->session.scene);
    lib_free_arrays(scene->arrays);
    free(scene->changes);
    while (scene->texts) {
        struct lib_text *next = scene->texts->next;
        free(scene->texts);
        scene->texts = next;
    }
    free(scene);
    lib_release_device(device);
}

void firn_scene_close(firn_scene *scene)
{
    struct lib_call call;
    if (!scene || !lib_enter(&call, scene->device, true))
        return;
    lib_release_scene(scene);
    (void)lib_leave(&call, STATUS_OK);
}

/* ---- changes ---- */

firn_status firn_scene_set(firn_scene *scene, const char *name, const char *value)
{
    struct lib_call call;
    struct setup_image changed;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    changed = scene->given;
    enum status status = set_option(scene, &changed, name, value);
    if (status == STATUS_OK) {
        const struct settings *before = &scene->given.scene.settings;
        const bool loads =
            settings_changed(before, &changed.scene.settings) == SETTING_AFFECTS_SCENE ||
            option_is_of_scene(name) || !strcmp(name, "set");
        scene->given = changed;
        scene->needs_load = scene->needs_load || loads;
        scene->needs_settings = true;
    }
    return lib_leave(&call, status);
}

/* Writes a setting's value, truncated to `size` bytes. */
static enum status print_setting(const struct settings *settings, const struct setting *row,
                                 char *text, size_t size)
{
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);
    if (out)
        settings_print(settings, row, out);
    char *value = text_stream_close(&stream, NULL);
    if (!value)
        return log_out_of_memory(NULL);
    snprintf(text, size, "%s", value);
    free(value);
    return STATUS_OK;
}

firn_status firn_scene_get(firn_scene *scene, const char *name, char *text, size_t size)
{
    struct lib_call call;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    enum status status = lib_require(name, "name");
    if (status == STATUS_OK)
        status = lib_require(text, "text");
    const struct setting *row = status == STATUS_OK ? settings_find(name) : NULL;
    if (status == STATUS_OK && (!row || !size)) {
        log_error(row ? "size: expected at least 1"
                      : "unknown setting '%.64s' (firn list settings)",
                  name);
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = lib_scene_update(scene);
    if (status == STATUS_OK)
        status = print_setting(&scene->image.scene.settings, row, text, size);
    return lib_leave(&call, status);
}
