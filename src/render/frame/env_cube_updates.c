/* env_cube_updates.c: finds out whether a frame redraws the environment cube and caustic maps. */
#include "src/render/frame/env_cube_updates.h"
#include <cglm/struct.h>
#include <string.h>
#include "src/settings/scene_settings.h"
#include "src/tech/techniques.h"

static struct frame_cube_state cube_inputs(const struct frame_view *view,
                                           const struct globals *globals)
{
    const struct motion_params *motion = settings_of(view->settings, &motion_settings);
    return (struct frame_cube_state){
        .background_color = globals->background_color,
        .sun_dir = globals->sun_dir,
        .sun_light = globals->sun_light,
        .center = globals->center,
        .sky_strength = globals->sky_strength,
        .sun_strength = globals->sun_strength,
        .world_from_movers = motion->count ? globals->world_from_movers : GLMS_MAT4_ZERO,
    };
}

/* Returns true if the object's bounding sphere overlaps the view frustum of unlimited depth. */
static bool is_in_image(const struct globals *globals)
{
    const mat4s rows = glms_mat4_transpose(globals->clip_from_world);
    const vec4s center = glms_vec4(globals->center, 1.0f);
    for (int edge = 0; edge < 4; edge++) {
        const vec4s axis = glms_vec4_scale(rows.col[edge / 2], edge % 2 ? -1.0f : 1.0f);
        const vec4s plane = glms_vec4_add(rows.col[3], axis);
        const float reach = glms_vec3_norm(glms_vec3(plane)) * globals->radius;
        if (glms_vec4_dot(plane, center) < -reach)
            return false;
    }
    return true;
}

/* Returns true if an enabled technique makes the objects transmit or block light. */
static bool has_caustics(const struct frame_view *view)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->affects_light && (*t)->is_on(view->settings) && (*t)->affects_light(view->scene))
            return true;
    }
    return false;
}

static struct frame_cube_light light_inputs(const struct frame_view *view,
                                            const struct globals *globals)
{
    struct frame_cube_light light = { *view->settings, *globals, view->light_jitter };
    light.globals.clip_from_world = light.globals.fitted_clip_from_world = GLMS_MAT4_ZERO;
    light.globals.eye = light.globals.forward = GLMS_VEC3_ZERO;
    light.globals.fitted = light.globals.wide_scale = GLMS_VEC2_ZERO;
    light.globals.sample_random = light.globals.lod_bias = 0.0f;
    return light;
}

/* Returns true if all bytes are equal. Unequal padding bytes only cause one redundant redraw. */
static bool are_equal(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static bool same_light_inputs(const struct frame_cube_light *a, const struct frame_cube_light *b)
{
    return are_equal(&a->settings, &b->settings, sizeof(a->settings)) &&
           are_equal(&a->globals, &b->globals, sizeof(a->globals));
}

static bool same_sun_sample(const struct frame_cube_light *a, const struct frame_cube_light *b)
{
    return glms_vec2_eqv(a->jitter, b->jitter);
}

static bool same_cube_inputs(const struct frame_cube_state *a, const struct frame_cube_state *b)
{
    return glms_vec3_eqv(a->background_color, b->background_color) &&
           glms_vec3_eqv(a->sun_dir, b->sun_dir) && glms_vec3_eqv(a->sun_light, b->sun_light) &&
           glms_vec3_eqv(a->center, b->center) && a->sky_strength == b->sky_strength &&
           a->sun_strength == b->sun_strength &&
           are_equal(&a->world_from_movers, &b->world_from_movers, sizeof(mat4s));
}

static bool cube_is_due(const struct frame_cube *cube, const struct frame_view *view,
                        const struct globals *globals)
{
    const struct env_cube_params *params = settings_of(view->settings, &env_cube_settings);
    const struct frame_cube_state now = cube_inputs(view, globals);
    return params->always ||
           (is_in_image(globals) && !(cube->is_drawn && same_cube_inputs(&cube->state, &now)));
}

struct frame_updates frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                                    const struct globals *globals)
{
    const bool is_due = cube_is_due(cube, view, globals);
    if (!has_caustics(view))
        return (struct frame_updates){ .cube = is_due };
    const struct frame_cube_light now = light_inputs(view, globals);
    return (struct frame_updates){
        .cube = is_due || !cube->is_drawn || !same_light_inputs(&cube->cube_light, &now) ||
                (view->sample == 0 && !same_sun_sample(&cube->cube_light, &now)),
        .light = !cube->has_light || !same_light_inputs(&cube->light, &now) ||
                 !same_sun_sample(&cube->light, &now),
    };
}

void frame_cube_mark_drawn(struct frame_cube *cube, const struct frame_view *view,
                           const struct globals *globals, struct frame_updates due)
{
    if (due.light) {
        cube->light = light_inputs(view, globals);
        cube->has_light = true;
    }
    if (due.cube) {
        cube->state = cube_inputs(view, globals);
        cube->cube_light = light_inputs(view, globals);
        cube->is_drawn = true;
    }
}
