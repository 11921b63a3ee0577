/* env_cube_updates.c: finds the environment-cube faces and caustic maps that a frame redraws. */
#include "src/render/frame/env_cube_updates.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/mesh_layout.h"
#include "src/base/log.h"
#include "src/settings/scene_settings.h"
#include "src/tech/techniques.h"

enum {
    MOVER_TRIANGLES = 64, /* consecutive moving triangles per bounding sphere */
};

static vec3s corner(const struct mesh *mesh, uint32_t triangle, uint32_t i)
{
    return mesh->vertices[mesh->indices[3 * triangle + i]].position;
}

/* Returns a bounding sphere of `count` triangles; `count` must not be 0. */
static struct frame_cube_moving_sphere sphere_around(const struct mesh *mesh,
                                                     const uint32_t *triangles, uint32_t count)
{
    struct frame_cube_moving_sphere sphere = { 0 };
    for (uint32_t i = 0; i < 3 * count; i++)
        sphere.center = glms_vec3_add(sphere.center, corner(mesh, triangles[i / 3], i % 3));
    sphere.center = glms_vec3_scale(sphere.center, 1.0f / (float)(3 * count));
    for (uint32_t i = 0; i < 3 * count; i++) {
        const vec3s at = corner(mesh, triangles[i / 3], i % 3);
        sphere.radius = fmaxf(sphere.radius, glms_vec3_distance(sphere.center, at));
    }
    return sphere;
}

static bool moves(const struct mesh *mesh, uint32_t triangle)
{
    return mesh->vertices[mesh->indices[(size_t)3 * triangle]].material & MESH_ORBITS;
}

enum status frame_cube_init(struct frame_cube *cube, const struct scene *scene)
{
    const struct mesh *mesh = &scene->model.surroundings;
    uint32_t triangles[MOVER_TRIANGLES], count = 0, all = 0;
    *cube = (struct frame_cube){ 0 };
    for (uint32_t i = 0; i < mesh->index_count / 3; i++)
        all += moves(mesh, i);
    if (all == 0)
        return STATUS_OK;
    cube->movers = calloc(all / MOVER_TRIANGLES + 1, sizeof(*cube->movers));
    if (!cube->movers)
        return log_out_of_memory(NULL);
    for (uint32_t i = 0; i < mesh->index_count / 3; i++) {
        if (moves(mesh, i))
            triangles[count++] = i;
        if (count == MOVER_TRIANGLES || (count > 0 && i + 1 == mesh->index_count / 3)) {
            cube->movers[cube->orbiting_ball_count++] = sphere_around(mesh, triangles, count);
            count = 0;
        }
    }
    return STATUS_OK;
}

void frame_cube_finish(struct frame_cube *cube)
{
    free(cube->movers);
    *cube = (struct frame_cube){ 0 };
}

static struct frame_cube_state face_inputs(const struct globals *globals)
{
    return (struct frame_cube_state){
        .background_color = globals->background_color,
        .sun_dir = globals->sun_dir,
        .sun_light = globals->sun_light,
        .center = globals->center,
        .sky_strength = globals->sky_strength,
        .sun_strength = globals->sun_strength,
        .world_from_movers = globals->world_from_movers,
    };
}

/* Returns true if a cube face may show a sphere. A point is in the face's frustum if its
 * coordinates |right| and |up| are at most `forward`. */
static bool may_be_visible(uint32_t face, const struct frame_cube_state *state,
                           const struct frame_cube_moving_sphere *sphere)
{
    const struct camera_basis basis = camera_cube_basis(face);
    const vec3s at = glms_vec3_sub(glms_mat4_mulv3(state->world_from_movers, sphere->center, 1.0f),
                                   state->center);
    const float max = glms_vec3_dot(at, basis.forward) + sqrtf(2.0f) * sphere->radius;
    return fabsf(glms_vec3_dot(at, basis.right)) <= max &&
           fabsf(glms_vec3_dot(at, basis.up)) <= max;
}

static bool same_light(const struct frame_cube_state *a, const struct frame_cube_state *b)
{
    return glms_vec3_eqv(a->background_color, b->background_color) &&
           glms_vec3_eqv(a->sun_dir, b->sun_dir) && glms_vec3_eqv(a->sun_light, b->sun_light) &&
           glms_vec3_eqv(a->center, b->center) && a->sky_strength == b->sky_strength &&
           a->sun_strength == b->sun_strength;
}

static bool same_pose(const struct frame_cube_state *a, const struct frame_cube_state *b)
{
    for (int i = 0; i < 4; i++) {
        if (!glms_vec4_eqv(a->world_from_movers.col[i], b->world_from_movers.col[i]))
            return false;
    }
    return true;
}

static bool has_changed(const struct frame_cube *cube, uint32_t face,
                        const struct frame_cube_state *now)
{
    const struct frame_cube_state *before = &cube->states[face];
    if (!(cube->drawn & 1u << face) || !same_light(before, now))
        return true;
    if (same_pose(before, now))
        return false;
    for (uint32_t i = 0; i < cube->orbiting_ball_count; i++) {
        if (may_be_visible(face, before, &cube->movers[i]) ||
            may_be_visible(face, now, &cube->movers[i]))
            return true;
    }
    return false;
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

/* Returns true if the caustics have changed since they were drawn into the cube faces. */
static bool light_differs(const struct frame_cube *cube, const struct frame_cube_light *now,
                          bool is_first)
{
    return !cube->has_faces_light || !same_light_inputs(&cube->faces_light, now) ||
           (is_first && !same_sun_sample(&cube->faces_light, now));
}

static uint32_t faces_due(const struct frame_cube *cube, const struct frame_view *view,
                          const struct globals *globals)
{
    const struct env_cube_params *params = settings_of(view->settings, &env_cube_settings);
    const struct frame_cube_state now = face_inputs(globals);
    const bool round_robin = cube->round_robin && cube->drawn == FRAME_CUBE_ALL;
    const uint32_t max = round_robin ? params->faces : FRAME_CUBE_FACES;
    uint32_t due = 0;
    if (params->always)
        return FRAME_CUBE_ALL;
    if (!is_in_image(globals))
        return 0;
    for (uint32_t i = 0, count = 0; i < FRAME_CUBE_FACES && count < max; i++) {
        const uint32_t face = (cube->next + i) % FRAME_CUBE_FACES;
        if (has_changed(cube, face, &now)) {
            due |= 1u << face;
            count++;
        }
    }
    return due;
}

struct frame_updates frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                                    const struct globals *globals)
{
    if (!has_caustics(view))
        return (struct frame_updates){ .faces = faces_due(cube, view, globals) };
    const struct frame_cube_light now = light_inputs(view, globals);
    return (struct frame_updates){
        .faces = light_differs(cube, &now, view->sample == 0) ? FRAME_CUBE_ALL
                                                              : faces_due(cube, view, globals),
        .light = !cube->has_light || !same_light_inputs(&cube->light, &now) ||
                 !same_sun_sample(&cube->light, &now),
    };
}

void frame_cube_mark_drawn(struct frame_cube *cube, const struct frame_view *view,
                           const struct globals *globals, struct frame_updates due)
{
    const uint32_t first = cube->next;
    const uint32_t faces = due.faces;
    if (due.light) {
        cube->light = light_inputs(view, globals);
        cube->has_light = true;
    }
    if (faces == FRAME_CUBE_ALL) {
        cube->faces_light = light_inputs(view, globals);
        cube->has_faces_light = true;
    }
    for (uint32_t i = 0; i < FRAME_CUBE_FACES; i++) {
        const uint32_t face = (first + i) % FRAME_CUBE_FACES;
        if (!(faces & 1u << face))
            continue;
        cube->states[face] = face_inputs(globals);
        cube->next = (face + 1) % FRAME_CUBE_FACES;
    }
    cube->drawn |= faces;
}
