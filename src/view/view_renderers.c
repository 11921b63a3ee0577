/* view_renderers.c: viewport state: loads the scene, manages its renderers, applies changes. */
#include "src/view/view_renderers.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/output/present.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/render/frame/pass_list.h"
#include "src/render/make_frame_request.h"
#include "src/settings/scene_settings.h"
#include "src/tech/output/tonemap.h"
#include "src/view/shader_reload.h"

static char *copy(const char *text)
{
    return text ? strdup(text) : NULL;
}

enum status viewport_create(struct viewport **viewport, struct gpu *gpu,
                            const struct setup_image *state, struct shader_reload *reload,
                            bool quiet, bool refines)
{
    struct viewport *p = calloc(1, sizeof(*p));
    *viewport = NULL;
    if (!p)
        return log_out_of_memory(NULL);
    p->gpu = gpu;
    p->shader_reload = reload;
    p->divider = 0.5;
    p->quiet = quiet;
    p->is_progressive = refines;
    p->state = *state;
    p->state.scene.name = p->scene_name = copy(state->scene.name);
    p->state.scene.environment = p->environment_name = copy(state->scene.environment);
    p->state.scene.material = p->material_name = copy(state->scene.material);
    enum status status = STATUS_OK;
    if (!p->scene_name != !state->scene.name || !p->environment_name != !state->scene.environment ||
        !p->material_name != !state->scene.material)
        status = log_out_of_memory(NULL);
    if (status == STATUS_OK)
        status = setup_load_exposed(&p->scene, &p->camera, &p->state);
    if (status == STATUS_OK)
        setup_choose_refraction(&p->state, &p->scene, &p->camera);
    if (status == STATUS_OK)
        setup_check_rays(&p->state.scene.settings, p->gpu);
    p->state.scene.quiet = true; /* log the scene's notes only once */
    p->first_camera = p->camera;
    if (status == STATUS_OK)
        status = viewport_upload(p);
    if (status == STATUS_OK)
        *viewport = p;
    else
        viewport_destroy(p);
    return status;
}

static void forget_renderers(struct viewport *p)
{
    draft_renderer_finish(&p->draft);
    renderer_destroy(p->renderer);
    renderer_destroy(p->right_renderer);
    p->shows_draft = false;
    p->renderer = NULL;
    p->right_renderer = NULL;
}

static void forget_scene(struct viewport_scene *scene, struct gpu *gpu)
{
    if (!scene)
        return;
    uploaded_scene_finish(&scene->uploaded, gpu);
    scene_finish(&scene->scene);
    free(scene);
}

void viewport_leave_device(struct viewport *p)
{
    if (!p)
        return;
    forget_renderers(p);
    forget_scene(p->side_b_scene, p->gpu);
    p->side_b_scene = NULL;
    uploaded_scene_finish(&p->uploaded, p->gpu);
}

enum status viewport_upload(struct viewport *p)
{
    return uploaded_scene_init(&p->uploaded, p->gpu, &p->scene);
}

void viewport_destroy(struct viewport *p)
{
    if (!p)
        return;
    viewport_leave_device(p);
    scene_finish(&p->scene);
    free(p->scene_name);
    free(p->environment_name);
    free(p->material_name);
    free(p);
}

/* ---- the renderers ---- */

struct renderer_params viewport_params(struct viewport *p)
{
    struct renderer_params params = setup_renderer_params(&p->state, p->gpu, &p->scene);
    params.uploaded = &p->uploaded;
    renderer_set_camera(&params, &p->camera);
    params.replace = p->shader_reload ? shader_reload_replace : NULL;
    params.replace_user = p->shader_reload;
    return params;
}

struct renderer_params viewport_right_params(struct viewport *p)
{
    struct renderer_params params = viewport_params(p);
    params.refraction = p->state.split;
    if (p->has_right_settings)
        params.settings = &p->right_settings;
    if (p->side_b_scene) {
        params.scene = &p->side_b_scene->scene;
        params.uploaded = &p->side_b_scene->uploaded;
    }
    return params;
}

/* Loads a separate scene for side B if its settings require one. The pose is copied from side A. If
 * none is required, sets p->side_b_scene to NULL. The caller frees the previous scene. */
static enum status make_right_scene(struct viewport *p)
{
    struct setup_scene given = p->state.scene;
    p->side_b_scene = NULL;
    if (!p->has_right_settings ||
        settings_changed(&given.settings, &p->right_settings) < SETTING_AFFECTS_SCENE)
        return STATUS_OK;
    struct viewport_scene *made = calloc(1, sizeof(*made));
    if (!made)
        return log_out_of_memory(NULL);
    given.settings = p->right_settings;
    given.quiet = true;
    settings_set_sources(&given.settings, SETTING_USER); /* all settings come from B */
    if (p->scene.is_animated)
        settings_set_value(&given.settings, settings_find("motion.time"), (double)p->scene.time);
    enum status status = setup_load_scene(&made->scene, &given);
    if (status == STATUS_OK)
        status = uploaded_scene_init(&made->uploaded, p->gpu, &made->scene);
    if (status == STATUS_OK)
        p->side_b_scene = made;
    else
        forget_scene(made, p->gpu);
    return status;
}

/* Updates *renderer to new parameters. If there is none, creates a renderer. If memory is too small
 * for the old and the new plan together, frees the old renderer first and creates a new one. */
static enum status fit_renderer(const struct viewport *p, struct renderer_params params,
                                struct renderer **renderer)
{
    params.keep = true;
    params.refines = p->is_progressive;
    params.measured = true;
    enum status status = *renderer ? renderer_change(*renderer, &params) : STATUS_TRY_AGAIN;
    if (status != STATUS_TRY_AGAIN)
        return status;
    renderer_destroy(*renderer);
    status = renderer_create(renderer, &params);
    if (status == STATUS_OK)
        renderer_measure(*renderer, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
    return status;
}

static bool are_wide(struct viewport *p)
{
    const struct renderer_params left = viewport_params(p);
    const struct renderer_params right = viewport_right_params(p);
    return renderer_draws_beyond_image(&left) || renderer_draws_beyond_image(&right);
}

bool viewport_is_outgrown(struct viewport *p)
{
    return p->renderer && are_wide(p) != p->draws_beyond_image;
}

static void forget_right(struct viewport *p)
{
    renderer_destroy(p->right_renderer);
    renderer_destroy(p->draft.right);
    p->right_renderer = p->draft.right = NULL;
}

/* Updates the renderers of both sides. On failure there are no renderers. */
static enum status fit_renderers(struct viewport *p)
{
    struct viewport_scene *before = p->side_b_scene;
    enum status status = make_right_scene(p);
    if (before || p->side_b_scene || !p->state.split)
        forget_right(p); /* renderers cannot change their scene */
    forget_scene(before, p->gpu);
    if (status == STATUS_OK)
        status = fit_renderer(p, viewport_params(p), &p->renderer);
    if (status == STATUS_OK && p->state.split)
        status = fit_renderer(p, viewport_right_params(p), &p->right_renderer);
    if (status != STATUS_OK) {
        forget_renderers(p);
        return status;
    }
    p->draws_beyond_image = are_wide(p);
    p->version++;
    p->shows_mean = p->shows_draft = p->is_left_refined = false;
    p->extent = (VkExtent2D){ p->state.width, p->state.height };
    return STATUS_OK;
}

enum status viewport_rebuild(struct viewport *p)
{
    return p->renderer ? fit_renderers(p) : STATUS_OK;
}

/* Recreates the renderers of the restored state. If this fails, viewport_resize() retries. */
static enum status restore(struct viewport *p, enum status status)
{
    (void)fit_renderers(p);
    return status;
}

enum status viewport_resize(struct viewport *p, VkExtent2D size)
{
    if (p->renderer && p->state.width == size.width && p->state.height == size.height)
        return STATUS_OK;
    p->state.width = size.width;
    p->state.height = size.height;
    return fit_renderers(p);
}

enum status viewport_split(struct viewport *p, const struct technique *refraction,
                           const struct settings *settings)
{
    const struct technique *before = p->state.split;
    const struct settings settings_before = p->right_settings;
    const bool had_settings = p->has_right_settings;
    if (refraction == before && !settings && !had_settings)
        return STATUS_OK;
    p->state.split = refraction;
    p->has_right_settings = refraction && settings;
    if (p->has_right_settings)
        p->right_settings = *settings;
    const enum status status = viewport_rebuild(p);
    if (status != STATUS_OK) {
        p->state.split = before;
        p->right_settings = settings_before;
        p->has_right_settings = had_settings;
        return restore(p, status);
    }
    return STATUS_OK;
}

bool viewport_is_split(const struct viewport *p)
{
    return p->state.split || p->shows_comparison_image;
}

enum status viewport_rotate_panorama(struct viewport *p, float degrees)
{
    const float before = p->state.scene.env_rotate;
    const float rotation = p->scene.background.environment.turn;
    p->state.scene.env_rotate = degrees;
    p->scene.background.environment.turn = degrees / 360.0f - floorf(degrees / 360.0f);
    const enum status status = viewport_rebuild(p);
    if (status != STATUS_OK) {
        p->state.scene.env_rotate = before;
        p->scene.background.environment.turn = rotation;
        return restore(p, status);
    }
    return STATUS_OK;
}

/* ---- frames ---- */

enum status viewport_draw(struct viewport *p, const struct renderer_shot *shot)
{
    enum status status = renderer_draw(p->renderer, shot);
    if (status == STATUS_OK && p->right_renderer)
        status = renderer_draw(p->right_renderer, shot);
    return status;
}

enum status viewport_warm_up(struct viewport *p, const struct renderer_shot *shot)
{
    const VkExtent2D small = { p->state.width < 32 ? p->state.width : 32,
                               p->state.height < 24 ? p->state.height : 24 };
    enum status status = STATUS_OK;
    if (p->is_progressive)
        status = renderer_set_view(p->renderer, small);
    if (status == STATUS_OK && p->is_progressive && p->right_renderer)
        status = renderer_set_view(p->right_renderer, small);
    return status == STATUS_OK ? viewport_draw(p, shot) : status;
}

static struct draft_renderer_params draft_renderer_params(struct viewport *p)
{
    return (struct draft_renderer_params){
        .left = viewport_params(p),
        .right = viewport_right_params(p),
        .is_split = p->state.split != NULL,
        .version = p->version,
    };
}

bool viewport_wants_draft(const struct viewport *p)
{
    const struct draft_renderer *q = &p->draft;
    return !q->left && !q->is_off && !q->failed && p->is_progressive && !p->scene.is_animated;
}

enum status viewport_create_draft(struct viewport *p, const struct renderer_shot *shot)
{
    const struct draft_renderer_params params = draft_renderer_params(p);
    enum status status = uploaded_scene_add_simplified(&p->uploaded, p->gpu, &p->scene);
    if (status == STATUS_OK && p->side_b_scene)
        status = uploaded_scene_add_simplified(&p->side_b_scene->uploaded, p->gpu,
                                               &p->side_b_scene->scene);
    if (status != STATUS_OK && status != STATUS_TRY_AGAIN)
        return status;
    return draft_renderer_create(&p->draft, &params, shot);
}

enum status viewport_draw_interactive(struct viewport *p, const struct renderer_shot *shot,
                                      VkExtent2D view)
{
    const struct draft_renderer_params params = draft_renderer_params(p);
    enum status status = viewport_abandon(p);
    if (status == STATUS_OK && !p->draft.is_off)
        status = draft_renderer_update(&p->draft, &params);
    p->extent = view;
    p->shows_mean = false;
    p->shows_draft = p->draft.left && !p->draft.is_off;
    if (status == STATUS_OK && p->shows_draft)
        return draft_renderer_draw(&p->draft, shot, view);
    if (status == STATUS_OK)
        status = renderer_set_view(p->renderer, view);
    if (status == STATUS_OK && p->right_renderer)
        status = renderer_set_view(p->right_renderer, view);
    return status == STATUS_OK ? viewport_draw(p, shot) : status;
}

enum status viewport_refine(struct viewport *p, const struct renderer_shot *shot, uint32_t sample,
                            double seconds, bool *is_done)
{
    enum status status = STATUS_OK;
    *is_done = p->is_left_refined;
    if (!p->is_left_refined)
        status = renderer_refine(p->renderer, shot, sample, seconds, is_done);
    if (status != STATUS_OK || !*is_done || !p->right_renderer)
        return status;
    if (!p->is_left_refined) {
        p->is_left_refined = true;
        *is_done = false;
        return STATUS_OK;
    }
    status = renderer_refine(p->right_renderer, shot, sample, seconds, is_done);
    p->is_left_refined = !*is_done;
    return status;
}

enum status viewport_abandon(struct viewport *p)
{
    enum status status = p->renderer ? renderer_abandon(p->renderer) : STATUS_OK;
    if (status == STATUS_OK && p->right_renderer)
        status = renderer_abandon(p->right_renderer);
    p->is_left_refined = false;
    return status;
}

enum status viewport_resolve(struct viewport *p, uint32_t sample_count, uint32_t step)
{
    enum status status = renderer_resolve(p->renderer, sample_count, step);
    if (status == STATUS_OK && p->right_renderer)
        status = renderer_resolve(p->right_renderer, sample_count, step);
    if (status != STATUS_OK || step + 1 < RENDERER_RESOLVE_STEPS)
        return status;
    p->shows_mean = true;
    p->shows_draft = false;
    p->extent = (VkExtent2D){ p->state.width, p->state.height };
    return status;
}

enum status viewport_wait(struct viewport *p)
{
    enum status status = renderer_wait(p->renderer);
    if (status == STATUS_OK && p->right_renderer)
        status = renderer_wait(p->right_renderer);
    return status;
}

static double passes_of(const struct renderer *renderer)
{
    const struct rg_times times = renderer ? renderer_times(renderer) : (struct rg_times){ 0 };
    uint64_t end = 0;
    for (uint32_t i = 0; i < times.pass_count && times.passes; i++)
        end = times.passes[i].end > end ? times.passes[i].end : end;
    return (double)end * 1e-9;
}

const struct renderer *viewport_renderer(const struct viewport *p, bool right)
{
    if (p->shows_draft)
        return right ? p->draft.right : p->draft.left;
    return right ? p->right_renderer : p->renderer;
}

double viewport_pass_seconds(const struct viewport *p)
{
    return passes_of(viewport_renderer(p, false)) + passes_of(viewport_renderer(p, true));
}

static VkImage image_of(const struct viewport *p, const struct renderer *renderer)
{
    return p->shows_mean ? renderer_mean(renderer) : renderer_display_image(renderer);
}

VkImage viewport_right(const struct viewport *p)
{
    if (p->replacement)
        return p->replacement;
    const bool right = viewport_renderer(p, true);
    return p->shows_comparison_image && p->comparison_image
               ? p->comparison_image
               : image_of(p, viewport_renderer(p, right));
}

VkImage viewport_left(const struct viewport *p)
{
    if (p->flipped)
        return viewport_right(p);
    return p->replacement ? p->replacement : image_of(p, viewport_renderer(p, false));
}

VkExtent2D viewport_right_extent(const struct viewport *p)
{
    if (p->replacement)
        return (VkExtent2D){ p->state.width, p->state.height };
    return p->shows_comparison_image && p->comparison_image ? p->comparison_extent : p->extent;
}

VkExtent2D viewport_extent(const struct viewport *p)
{
    if (p->flipped)
        return viewport_right_extent(p);
    return p->replacement ? (VkExtent2D){ p->state.width, p->state.height } : p->extent;
}

uint32_t viewport_divider_column(const struct viewport *p)
{
    return p->state.split ? (uint32_t)(p->divider * p->state.width + 0.5) : PRESENT_NO_LINE;
}

/* ---- poses ---- */

/* Limits the time to the end of a model's animation, after which the pose no longer changes. */
static float pose_time(const struct viewport *p, float time)
{
    const struct model *model = &p->scene.model;
    const struct motion_params *motion = settings_of(&p->state.scene.settings, &motion_settings);
    if (model->animation && !(motion->melt > 0.0f))
        return fminf(time, model->animations[model->animation - 1].seconds);
    return p->scene.is_animated ? time : p->scene.time;
}

bool viewport_is_posed(const struct viewport *p, float time)
{
    const float requested = pose_time(p, time);
    return !(requested < p->scene.time || requested > p->scene.time);
}

/* Applies the file's camera for the current pose, unless the user has moved the camera. */
static enum status follow_camera(struct viewport *p)
{
    struct camera camera;
    const enum status status = setup_camera(&camera, &p->scene, &p->state);
    if (status != STATUS_OK)
        return status;
    if (glms_vec3_eqv(p->camera.eye, p->first_camera.eye) &&
        glms_vec3_eqv(p->camera.target, p->first_camera.target))
        p->camera = camera;
    p->first_camera = camera;
    return STATUS_OK;
}

enum status viewport_pose(struct viewport *p, float time)
{
    bool is_changed;
    enum status status = p->renderer ? viewport_wait(p) : STATUS_OK;
    if (status == STATUS_OK)
        status = setup_pose_scene(&p->scene, &p->state.scene, pose_time(p, time), &is_changed);
    if (status != STATUS_OK)
        return status;
    viewport_leave_device(p);
    status = follow_camera(p);
    return status == STATUS_OK ? viewport_upload(p) : status;
}

/* ---- changes ---- */

/* Replaces *viewport by a new one with renderers of the same size. Destroys the old viewport. */
static enum status replace(struct viewport **viewport, const struct setup_image *state,
                           bool keep_camera)
{
    struct viewport *next;
    const bool drawn = (*viewport)->renderer != NULL;
    enum status status = viewport_create(&next, (*viewport)->gpu, state, (*viewport)->shader_reload,
                                         (*viewport)->quiet, (*viewport)->is_progressive);
    if (status == STATUS_OK) {
        next->has_right_settings = (*viewport)->has_right_settings;
        next->right_settings = (*viewport)->right_settings;
        next->shows_comparison_image = (*viewport)->shows_comparison_image;
        next->draft.is_off = (*viewport)->draft.is_off;
        next->flipped = (*viewport)->flipped;
    }
    if (status == STATUS_OK && keep_camera) {
        next->camera = (*viewport)->camera;
        next->first_camera = (*viewport)->first_camera;
    }
    if (status == STATUS_OK && drawn)
        status = fit_renderers(next);
    if (status == STATUS_OK && drawn && viewport_wants_draft(next))
        status = viewport_create_draft(
            next, &(struct renderer_shot){ .camera = next->camera, .time = next->scene.time });
    if (status != STATUS_OK) {
        viewport_destroy(next);
        return status;
    }
    next->divider = (*viewport)->divider;
    next->version = (*viewport)->version + 1;
    viewport_destroy(*viewport);
    *viewport = next;
    return STATUS_OK;
}

enum status viewport_apply_state(struct viewport **viewport, const struct setup_image *state)
{
    return replace(viewport, state, false);
}

struct settings viewport_with_exposure(const struct settings *settings, const struct settings *of)
{
    const struct setting *row =
        settings_row(&tonemap_settings, offsetof(struct tonemap_values, exposure));
    struct settings other = *settings;
    settings_set_value(&other, row, settings_get(of, row));
    return other;
}

/* Returns true if renderers of state `a` can also draw state `b`. */
static bool same_frame(const struct viewport *p, const struct setup_image *a,
                       const struct setup_image *b)
{
    if (settings_changed(&a->scene.settings, &b->scene.settings) >= SETTING_AFFECTS_PLAN ||
        a->refraction != b->refraction)
        return false;
    const struct settings other = viewport_with_exposure(&a->scene.settings, &b->scene.settings);
    if (settings_equal(&other, &b->scene.settings))
        return true;
    /* an environment cube that is not redrawn has the old lighting */
    return frame_draws_cube(&a->scene.settings, &p->scene) &&
           frame_draws_cube(&b->scene.settings, &p->scene);
}

enum status viewport_change(struct viewport **viewport, const struct setup_scene *scene,
                            const struct technique *refraction, bool *remade)
{
    struct viewport *p = *viewport;
    const struct setup_image before = p->state;
    struct setup_image requested = p->state;
    *remade = false;
    requested.scene = *scene;
    requested.is_refraction_named =
        p->state.is_refraction_named || refraction != p->state.refraction;
    requested.refraction = refraction;
    if (settings_changed(&before.scene.settings, &scene->settings) == SETTING_AFFECTS_SCENE) {
        *remade = true;
        return replace(viewport, &requested, true);
    }
    p->state = requested;
    if (!p->renderer || same_frame(p, &before, &requested))
        return STATUS_OK;
    const enum status status = viewport_rebuild(p);
    *remade = true; /* renderers may have been replaced even on failure */
    if (status == STATUS_OK)
        return status;
    p->state = before;
    return restore(p, status);
}

static bool is_environment(const char *path)
{
    return path_ends_in(path, ".exr") || path_ends_in(path, ".hdr") || scene_is_environment(path);
}

static void leave_environment(struct setup_scene *scene)
{
    scene->environment = NULL;
    scene->has_default_environment = false;
    scene->env_rotate = scene->env_exposure = 0.0f;
}

enum status viewport_load(struct viewport **viewport, const char *path, bool *remade)
{
    const bool environment = is_environment(path);
    struct setup_image state = (*viewport)->state;
    state.scene.settings = state.scene.user_settings;
    state.scene.exposure.is_chosen = false;
    if (environment) {
        state.scene.environment = path;
        state.scene.has_default_environment = setup_is_stage_environment(state.scene.name, path);
        state.scene.background.is_given = false;
    } else {
        state.scene.name = path;
        state.scene.quiet = (*viewport)->quiet;
        /* these belonged to the previous object */
        state.scene.material = NULL;
        state.camera = NULL;
        state.scene.animation = NULL;
        state.scene.material_override_count = state.scene.object_transform_count = 0;
        if (scene_find_builtin(path))
            state.scene.ground = (struct stage_params){ 0 };
        state.eye.is_given = state.target.is_given = state.orbit.is_given = false;
        if (state.scene.has_default_environment)
            leave_environment(&state.scene);
    }
    const enum status status = replace(viewport, &state, environment);
    *remade = status == STATUS_OK;
    return status;
}

enum status viewport_reload(struct viewport **viewport, const struct setup_scene *scene)
{
    struct setup_image state = (*viewport)->state;
    state.scene = *scene;
    state.scene.settings = state.scene.user_settings;
    state.scene.quiet = (*viewport)->quiet;
    return replace(viewport, &state, true);
}

void viewport_camera_range(const struct viewport *p, float *nearest, float *farthest)
{
    const float size = box_diagonal(p->scene.box);
    *nearest = 0.05f * size;
    *farthest = 50.0f * size;
}
