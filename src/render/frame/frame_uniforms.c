/* frame_uniforms.c: computes the uniform data of a frame from camera, time and scene. */
#include "src/render/frame/frame_uniforms.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "shaders/brdf.h"
#include "shaders/surroundings/procedural_sky.h"
#include "src/scene/gpu_material_table.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_media.h"
#include "src/tech/inclusions/medium_density_fields.h"
#include "src/tech/techniques.h"

/* Margins of frame_view_reach() for jittered samples, for bilinear lookups and for rays that begin
 * slightly outside the sphere. */
#define REACH_SCALE 1.05f

enum {
    REACH_MARGIN = 4 /* pixels */
};

static float radians(float degrees)
{
    return degrees * 0.01745329252f;
}

/* Returns the mip level of the environment map whose texels subtend an angle of `pixel` radians. */
static float environment_lod(const struct scene *scene, float pixel)
{
    float texel =
        6.2831853f /
        (float)(scene->background.environment.width ? scene->background.environment.width : 1);
    float lod = log2f(pixel / texel);
    return scene->background.environment.width && lod > 0.0f ? lod : 0.0f;
}

/* Texels of the blurred mip level across the angle env.blur: taps in surroundings_sky.frag. */
static const float blur_taps = 4.0f;

/* Returns the mip level of the environment map as background, which env.blur may blur. */
static float background_lod(const struct frame_view *view, float lod)
{
    const struct env_params *env = settings_of(view->settings, &env_settings);
    const float texel = radians(env->blur) / blur_taps;
    return texel > 0.0f ? fmaxf(lod, environment_lod(view->scene, texel)) : lod;
}

struct surroundings_push frame_view_push(const struct frame_view *view)
{
    const struct camera *camera = &view->camera;
    const struct camera_basis basis = camera_basis(camera);
    float width = (float)view->width;
    float height = (float)view->height;
    const bool is_orthographic = camera->height > 0.0f;
    float up = is_orthographic ? camera->height / 2.0f : tanf(radians(camera->fov_deg) / 2.0f);
    float right = up * width / height;
    if (camera->pixel_aspect > 0.0f)
        right *= camera->pixel_aspect;
    /* At distance 1, a pixel is 2 * right / width metres wide and 2 * up / height metres high. */
    const vec2s at =
        glms_vec2_add(view->jitter, camera_pixel_shift(camera, view->width, view->height));
    vec3s shift = glms_vec3_sub(glms_vec3_scale(basis.right, 2.0f * at.x * right / width),
                                glms_vec3_scale(basis.up, 2.0f * at.y * up / height));
    const float lod = is_orthographic ? 0.0f : environment_lod(view->scene, 2.0f * up / height);
    return (struct surroundings_push){
        .clip_from_world = camera_clip_from_world(camera, view->width, view->height,
                                                  scene_near_plane(view->scene), view->jitter),
        .eye = is_orthographic ? glms_vec3_add(camera->eye, shift) : camera->eye,
        .environment_lod = lod,
        .background_lod = background_lod(view, lod),
        .right = glms_vec3_scale(basis.right, right),
        .up = glms_vec3_scale(basis.up, up),
        .forward = is_orthographic ? basis.forward : glms_vec3_add(basis.forward, shift),
    };
}

mat4s frame_view_previous_clip_from_world(const struct frame_view *view,
                                          const struct camera *earlier)
{
    return camera_clip_from_world(earlier->fov_deg > 0.0f ? earlier : &view->camera, view->width,
                                  view->height, scene_near_plane(view->scene), view->jitter);
}

struct surroundings_push frame_view_face(const struct frame_view *view, uint32_t face)
{
    const struct camera_basis basis = camera_cube_basis(face);
    vec3s center = box_center(view->scene->box);
    const float lod = environment_lod(view->scene, 2.0f / (float)view->face_size);
    return (struct surroundings_push){
        .clip_from_world = camera_cube_clip_from_world(face, center, scene_near_plane(view->scene)),
        .eye = center,
        .environment_lod = lod,
        .background_lod = lod,
        .right = basis.right,
        .up = basis.up,
        .forward = basis.forward,
        .inverse = 1,
    };
}

mat4s frame_view_fit(const struct camera *camera, mat4s clip_from_world, vec3s center, float radius,
                     vec2s *fitted)
{
    vec3s forward = camera_basis(camera).forward;
    float middle = glms_vec3_dot(glms_vec3_sub(center, camera->eye), forward);
    float far = fmaxf(middle + radius, 2e-3f * radius);
    float near = fmaxf(middle - radius, 1e-3f * radius);
    if (camera->height > 0.0f) { /* z = (distance - near) / (far - near) */
        for (int column = 0; column < 3; column++)
            clip_from_world.raw[column][2] = forward.raw[column] / (far - near);
        clip_from_world.raw[3][2] = -(glms_vec3_dot(forward, camera->eye) + near) / (far - near);
        *fitted = (vec2s){ { near, far } };
        return clip_from_world;
    }
    /* Perspective: z = far / (far - near) * (w - near); w is the distance along the camera axis. */
    float scale = far / (far - near);
    for (int column = 0; column < 4; column++)
        clip_from_world.raw[column][2] = scale * clip_from_world.raw[column][3];
    clip_from_world.raw[3][2] -= scale * near;
    *fitted = (vec2s){ { near, far } };
    return clip_from_world;
}

/* Sets `ends` to the pixels that a sphere covers along an image axis, with a margin. The sphere's
 * centre is `ahead` metres along the camera axis and `aside` along the image axis. `half` is half
 * the image size in pixels. `edge` is the tangent of half the field of view. */
static void span(float aside, float ahead, float radius, float half, float edge, int32_t ends[2])
{
    const float bound = 4.0f * half;
    const float middle = atan2f(aside, ahead);
    const float around = asinf(fminf(radius / hypotf(aside, ahead), 1.0f));
    const float limit = 1.57f;
    const float low = tanf(fmaxf(middle - around, -limit)) / edge;
    const float high = tanf(fminf(middle + around, limit)) / edge;
    ends[0] = (int32_t)floorf(half + fminf(fmaxf(low * half, -bound), bound)) - REACH_MARGIN;
    ends[1] = (int32_t)ceilf(half + fminf(fmaxf(high * half, -bound), bound)) + REACH_MARGIN;
}

/* Does the same as span() for an orthographic camera. `scale` is in pixels per metre. */
static void span_orthographic(float aside, float radius, float half, float scale, int32_t ends[2])
{
    const float bound = 4.0f * half;
    const float low = (aside - radius) * scale;
    const float high = (aside + radius) * scale;
    ends[0] = (int32_t)floorf(half + fmaxf(fminf(low, bound), -bound)) - REACH_MARGIN;
    ends[1] = (int32_t)ceilf(half + fmaxf(fminf(high, bound), -bound)) + REACH_MARGIN;
}

/* Clips the pixel range `ends` to an image `side` pixels wide or high; keeps at least one pixel. */
static void clip(const int32_t ends[2], uint32_t side, int32_t *offset, uint32_t *extent)
{
    const int32_t last = (int32_t)side - 1;
    const int32_t low = ends[0] < 0 ? 0 : ends[0] > last ? last : ends[0] & ~1;
    const int32_t high = ends[1] > last ? last : ends[1] < low ? low : ends[1];
    *offset = low;
    *extent = (uint32_t)(high - low) + 1;
}

static void shift_pixels(int32_t ends[2], float pixels)
{
    ends[0] -= (int32_t)ceilf(pixels);
    ends[1] -= (int32_t)floorf(pixels);
}

/* Computes a sphere's unclipped pixel bounds; returns false if the camera is too near. */
static bool sphere_extent(const struct frame_view *view, vec3s center, float radius, int32_t x[2],
                          int32_t y[2])
{
    const struct camera_basis basis = camera_basis(&view->camera);
    const vec3s to = glms_vec3_sub(center, view->camera.eye);
    const float up = tanf(radians(view->camera.fov_deg) / 2.0f);
    const float ahead = glms_vec3_dot(to, basis.forward);
    const float width = (float)view->width, height = (float)view->height;
    const float pixel_aspect = view->camera.pixel_aspect > 0.0f ? view->camera.pixel_aspect : 1.0f;
    const vec2s shift = camera_pixel_shift(&view->camera, view->width, view->height);
    if (view->camera.height > 0.0f) {
        const float scale = height / view->camera.height;
        span_orthographic(glms_vec3_dot(to, basis.right), radius, width / 2.0f,
                          scale / pixel_aspect, x);
        span_orthographic(-glms_vec3_dot(to, basis.up), radius, height / 2.0f, scale, y);
    } else if (ahead > 1.01f * radius) {
        span(glms_vec3_dot(to, basis.right), ahead, radius, width / 2.0f,
             up * width / height * pixel_aspect, x);
        span(-glms_vec3_dot(to, basis.up), ahead, radius, height / 2.0f, up, y);
    } else {
        return false;
    }
    shift_pixels(x, shift.x);
    shift_pixels(y, shift.y);
    return true;
}

bool frame_view_exceeds_image(const struct frame_view *view)
{
    const struct box box = view->scene->box;
    int32_t x[2], y[2];
    if (!sphere_extent(view, box_center(box), box_diagonal(box) / 2.0f, x, y))
        return true;
    return x[0] < -REACH_MARGIN || x[1] > (int32_t)view->width + REACH_MARGIN ||
           y[0] < -REACH_MARGIN || y[1] > (int32_t)view->height + REACH_MARGIN;
}

VkRect2D frame_view_reach(const struct frame_view *view, const struct globals *globals, float radii)
{
    const float radius = REACH_SCALE * globals->radius * (radii > 0.0f ? radii : 1.0f);
    VkRect2D reach = { .extent = { view->width, view->height } };
    int32_t x[2], y[2];
    if (!sphere_extent(view, globals->center, radius, x, y))
        return reach;
    clip(x, view->width, &reach.offset.x, &reach.extent.width);
    clip(y, view->height, &reach.offset.y, &reach.extent.height);
    return reach;
}

VkRect2D frame_view_box_area(const struct frame_view *view, const struct globals *globals,
                             struct box box, VkExtent2D size, float room)
{
    const vec3s more = glms_vec3_fill(room * globals->radius);
    box = (struct box){ glms_vec3_sub(box.min, more), glms_vec3_add(box.max, more) };
    const mat4s clip_from_object =
        glms_mat4_mul(globals->clip_from_world, globals->world_from_object);
    const float near = scene_near_plane(view->scene);
    float low[2] = { 1.0f, 1.0f }, high[2] = { -1.0f, -1.0f };
    for (int corner = 0; corner < 8; corner++) {
        const vec4s point = glms_mat4_mulv(
            clip_from_object,
            (vec4s){ { corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 4 ? box.max.z : box.min.z, 1.0f } });
        const bool is_before = view->camera.height > 0.0f || point.w > near;
        for (int axis = 0; axis < 2; axis++) {
            const float at = point.raw[axis] / point.w;
            low[axis] = is_before ? fminf(low[axis], at) : -1.0f;
            high[axis] = is_before ? fmaxf(high[axis], at) : 1.0f;
        }
    }
    const uint32_t sides[2] = { size.width, size.height };
    VkRect2D area;
    for (int axis = 0; axis < 2; axis++) {
        const float half = (float)sides[axis] / 2.0f;
        const float first = half + half * fmaxf(low[axis], -1.0f);
        const float last = half + half * fminf(high[axis], 1.0f);
        const int32_t ends[2] = { (int32_t)floorf(first) - 1, (int32_t)ceilf(last) };
        clip(ends, sides[axis], axis ? &area.offset.y : &area.offset.x,
             axis ? &area.extent.height : &area.extent.width);
    }
    return area;
}

VkRect2D frame_view_reflection_area(const struct frame_view *view, const struct globals *globals,
                                    VkExtent2D size)
{
    struct box box = view->scene->box;
    const float height = box.max.y - box.min.y;
    box.max.y = box.min.y + 0.1f * height;
    box.min.y -= 1.3f * height;
    return frame_view_box_area(view, globals, box, size, 0.2f);
}

vec3s frame_sun_light(const struct scene *scene, const struct settings *settings)
{
    const struct sky_params *sky = settings_of(settings, &sky_settings);
    const struct env_params *env = settings_of(settings, &env_settings);
    const vec3s own =
        env->sun == ENV_SUN_CUSTOM ? glms_vec3_one() : scene->background.environment.sun.light;
    if (scene->background.kind == SCENE_SKY || scene->has_pool)
        return glms_vec3_scale(SKY_SUN_COLOR, sky->strength * sky->sun_strength);
    if (scene->background.kind != SCENE_ENVIRONMENT || env->sun == ENV_SUN_NONE)
        return glms_vec3_zero();
    return glms_vec3_scale(own, env->sun_strength);
}

/* Sets the panorama's sun as a light whose disc has the angular radius `radius`. */
static void set_environment_sun(const struct frame_view *view, float radius, struct globals *g)
{
    const struct env_params *params = settings_of(view->settings, &env_settings);
    const struct environment *environment = &view->scene->background.environment;
    const bool is_own = params->sun == ENV_SUN_CUSTOM;
    g->sun_spread = 0.5f * radius;
    if (params->sun == ENV_SUN_NONE || !(is_own || glms_vec3_max(environment->sun.light) > 0.0f))
        return;
    g->sun_radius = radius;
    g->sun_dir = is_own ? environment_direction(params->sun_azimuth, params->sun_elevation)
                        : glms_vec3_rotate(environment->sun.dir, environment->turn * 6.28318531f,
                                           (vec3s){ { 0.0f, 1.0f, 0.0f } });
}

/* Sets the sun of the built-in sky or the panorama as a light. g->sun_radius must be set. */
static void set_sun(const struct frame_view *view, struct globals *g)
{
    const float radius = g->sun_radius;
    g->sun_radius = 0.0f;
    g->sun_spread = LIT_SUN_SPREAD;
    g->sun_light = frame_sun_light(view->scene, view->settings);
    if (view->scene->background.kind == SCENE_ENVIRONMENT && !view->scene->has_pool)
        set_environment_sun(view, radius, g);
}

/* Spaces the light sources evenly on a circle around the object; the circle rotates with time. */
static void set_lights(const struct frame_view *view, struct globals *g)
{
    const struct light_params *light = settings_of(view->settings, &light_settings);
    const struct motion_params *motion = settings_of(view->settings, &motion_settings);
    for (uint32_t i = 0; i < light->count; i++) {
        float turn = (float)i / (float)light->count * 360.0f;
        float azimuth = light->azimuth + turn + motion->lights * view->time;
        vec3s dir = environment_direction(azimuth, light->elevation);
        vec3s at = glms_vec3_add(g->center, glms_vec3_scale(dir, light->distance * g->radius));
        g->lights[i] = (vec4s){ { at.x, at.y, at.z, light->strength } };
    }
}

/* Sets the medium of an object whose material overrides the settings. */
static void set_medium(const struct frame_view *view, uint32_t object, struct globals *g)
{
    const struct scene *scene = view->scene;
    if (frame_media_are_from_settings(scene))
        return;
    const struct frame_medium medium = frame_medium_at(scene, view->settings, object);
    const struct frame_medium outside =
        frame_medium_at(scene, view->settings, frame_media_count(scene) - 1);
    for (int c = 0; c < 3; c++)
        g->etas.raw[c] = outside.ior[c] / medium.ior[c];
    g->eta = g->etas.y;
    g->outside_in_air = outside.ior[1] / frame_media_air(scene);
    g->absorb = medium.absorption;
}

/* Fits the depth range of an object's G-buffer to its bounding sphere. */
static void fit_depth(const struct frame_view *view, struct globals *g)
{
    g->fitted_clip_from_world = frame_view_fit(&view->camera, g->clip_from_world, g->center,
                                               fmaxf(g->radius, 1e-6f), &g->fitted);
}

struct globals frame_view_object_globals(const struct frame_view *view, const struct globals *all,
                                         uint32_t object)
{
    const struct box box = view->scene->model.objects[object].box;
    struct globals g = *all;
    g.center = glms_mat4_mulv3(g.world_from_object, box_center(box), 1.0f);
    g.radius = box_diagonal(box) / 2.0f;
    fit_depth(view, &g);
    set_medium(view, object, &g);
    g.medium = medium_field_of(view->scene, view->settings, object);
    return g;
}

struct globals frame_view_globals(const struct frame_view *view,
                                  const struct surroundings_push *push)
{
    const struct sky_params *sky = settings_of(view->settings, &sky_settings);
    const struct scene *scene = view->scene;
    const struct box box =
        scene->has_pool && scene->model.object.index_count ? scene->floating_ice : scene->box;
    vec3s center = box_center(box);
    struct globals g = {
        .clip_from_world = push->clip_from_world,
        .eye = view->camera.eye,
        .forward = camera_basis(&view->camera).forward,
        .background_color = view->scene->background.color,
        .sky_strength = sky->strength,
        .sun_dir = environment_direction(sky->sun_azimuth, sky->sun_elevation),
        .sun_strength = sky->sun_strength,
        .center = center,
        .cube_center = center,
        .radius = box_diagonal(box) / 2.0f,
        .time = view->time,
        .lod_bias = view->lod_bias,
        .sample_random = view->light_jitter.x + 0.5f,
    };
    frame_rotations(view, center, view->time, &g.world_from_object, &g.world_from_movers);
    fit_depth(view, &g);
    set_lights(view, &g);
    for (const struct technique *const *technique = techniques; *technique; technique++) {
        if ((*technique)->write_globals)
            (*technique)->write_globals(view, &g);
    }
    set_sun(view, &g);
    set_medium(view, 0, &g);
    g.medium = medium_field_of(scene, view->settings, 0);
    return g;
}

/* Returns flags for the kinds of textures in use. Shaders must leave out unused kinds, because CPU
 * drivers fetch textures even in branches that are not taken. */
static uint32_t textured(const struct model *model)
{
    const bool any = model->textures.count + model->numbers.count > 0;
    const uint32_t holes = material_table_has_holes(model) ? CONSTANT_TEXTURED_HOLES : 0;
    const uint32_t coat = material_table_has_coat(model) ? CONSTANT_TEXTURED_COAT : 0;
    const uint32_t catcher =
        material_table_has_shadow_catcher(model) ? CONSTANT_TEXTURED_CATCHER : 0;
    const uint32_t uses = any ? CONSTANT_TEXTURED_ANY | material_table_uses(model) : 0;
    return uses | holes | coat | catcher;
}

struct frame_constants frame_view_constants(const struct scene *scene,
                                            const struct settings *settings,
                                            const struct technique *refraction)
{
    static const uint32_t backgrounds[] = {
        [SCENE_SKY] = GLOBALS_SKY,
        [SCENE_COLOR] = GLOBALS_COLOR,
        [SCENE_ENVIRONMENT] = GLOBALS_ENVIRONMENT,
    };
    const struct light_params *light = settings_of(settings, &light_settings);
    const struct technique_config config = { .scene = scene,
                                             .settings = settings,
                                             .refraction = refraction };
    struct frame_constants constants = { {
        [CONSTANT_BACKGROUND] = backgrounds[scene->background.kind],
        [CONSTANT_TEXTURED] = textured(&scene->model),
        [CONSTANT_LIT] =
            material_table_has_lit(&scene->model.surroundings) || scene_has_lit_object(scene),
        [CONSTANT_LIGHTS] = light->count,
        [CONSTANT_OBJECTS] = scene->model.object_count > 1,
        [CONSTANT_REFRACT_COLORS] = frame_media_disperse(scene, settings) ? 3 : 1,
        [CONSTANT_BACKDROP] = scene->background.is_hidden     ? GLOBALS_BACKDROP_NONE
                              : scene->background.is_backdrop ? GLOBALS_BACKDROP_COLOR
                                                              : GLOBALS_BACKDROP_ENVIRONMENT,
        [CONSTANT_SCENE_LIGHTS] = scene->tables.punctual_lights ? scene->model.light_count : 0,
    } };
    memcpy(&constants.values[CONSTANT_ENVIRONMENT], &scene->background.environment.turn,
           sizeof(scene->background.environment.turn));
    for (const struct technique *const *technique = techniques; *technique; technique++) {
        if ((*technique)->write_constants)
            (*technique)->write_constants(&config, constants.values);
    }
    return constants;
}
