/* picture.c: builds small test scenes and renders them through the renderer. */
#include "tests/support/picture.h"

#include <cglm/struct.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/file/half_float.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/render/frame/pass_list.h"
#include "src/scene/generate/generate.h"
#include "src/tech/inclusions/frost.h"
#include "src/tech/lighting/bump.h"

static const double pi = 3.14159265358979323846;

static struct settings settings_for(const struct picture_request *request)
{
    return request->settings ? *request->settings : picture_settings("light.count=0");
}

/* Stores the request in the stage and returns its renderer parameters. */
static struct renderer_params params_for(struct picture_stage *stage,
                                         const struct picture_request *request)
{
    const struct renderer_params params = {
        .gpu = stage->gpu,
        .scene = request->scene,
        .settings = &stage->settings,
        .refraction = request->refraction ? techniques_find_refraction(request->refraction)
                                          : techniques_refraction(0),
        .width = request->width,
        .height = request->height,
        .samples = request->samples,
        .layers = request->layers,
        .linear = true,
        .display = request->display,
        .sharing = request->sharing,
    };
    assert_non_null(params.refraction);
    stage->request = *request;
    stage->settings = settings_for(request);
    return params;
}

void picture_begin(struct picture_stage *stage, struct gpu *gpu,
                   const struct picture_request *request)
{
    *stage = (struct picture_stage){ .gpu = gpu };
    const struct renderer_params params = params_for(stage, request);
    assert_int_equal(renderer_create(&stage->renderer, &params), STATUS_OK);
}

void picture_change(struct picture_stage *stage, const struct picture_request *request)
{
    const struct renderer_params params = params_for(stage, request);
    assert_int_equal(renderer_change(stage->renderer, &params), STATUS_OK);
}

/* Returns true if both settings give the same passes and shader variants. */
static bool is_same_stage(const struct scene *scene, const struct settings *a,
                          const struct settings *b)
{
    const struct frame_constants x = frame_view_constants(scene, a, NULL);
    const struct frame_constants y = frame_view_constants(scene, b, NULL);
    return !memcmp(&x, &y, sizeof(x)) && bump.is_on(a) == bump.is_on(b) &&
           frost.is_on(a) == frost.is_on(b) &&
           frame_draws_cube(a, scene) == frame_draws_cube(b, scene);
}

struct render_result picture_take(struct picture_stage *stage,
                                  const struct picture_request *request)
{
    const struct picture_request *first = &stage->request;
    const struct renderer_shot shot = { .camera = request->camera, .time = request->time };
    const struct settings settings = settings_for(request);
    struct render_result result;
    assert_true(request->scene == first->scene && request->refraction == first->refraction);
    assert_true(request->width == first->width && request->height == first->height);
    assert_true(request->samples == first->samples && request->layers == first->layers);
    assert_true(request->display == first->display && request->sharing == first->sharing);
    assert_true(is_same_stage(request->scene, &settings, &stage->settings));
    stage->settings = settings;
    assert_int_equal(renderer_render(stage->renderer, &shot, &result, NULL, NULL), STATUS_OK);
    assert_int_equal(stage->gpu->message_count, 0);
    return result;
}

void picture_end(struct picture_stage *stage)
{
    renderer_destroy(stage->renderer);
    assert_int_equal(stage->gpu->message_count, 0);
    *stage = (struct picture_stage){ 0 };
}

struct render_result picture_render(struct gpu *gpu, const struct picture_request *request)
{
    struct picture_stage stage;
    picture_begin(&stage, gpu, request);
    const struct render_result result = picture_take(&stage, request);
    picture_end(&stage);
    return result;
}

uint64_t picture_layer_bit(const char *name)
{
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (!strcmp(techniques_layer(i)->name, name))
            return UINT64_C(1) << i;
    }
    fail_msg("no layer %s", name);
    return 0;
}

struct settings picture_settings(const char *assignment)
{
    struct settings settings = settings_default();
    assert_int_equal(settings_assign(&settings, "bump.strength=0", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "light.count=0", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "env_cube.size=128", SETTING_USER, NULL),
                     STATUS_OK);
    assert_int_equal(settings_assign(&settings, "refract.fresnel=paper", SETTING_USER, NULL),
                     STATUS_OK);
    assert_int_equal(settings_assign(&settings, "refract.lookup=infinite", SETTING_USER, NULL),
                     STATUS_OK);
    assert_int_equal(settings_assign(&settings, assignment, SETTING_USER, NULL), STATUS_OK);
    return settings;
}

struct vec picture_ray(const struct picture_request *request, double x, double y)
{
    const struct camera *camera = &request->camera;
    const struct vec world_up = { 0, 1, 0 };
    const struct vec forward =
        vec_unit(vec_add(vec_from(camera->target), -1, vec_from(camera->eye)));
    const struct vec given = vec_from(camera->up);
    const struct vec right = vec_unit(vec_cross(forward, vec_norm(given) > 0 ? given : world_up));
    const struct vec up = vec_cross(right, forward);
    const double pixel = 2 * tan((double)camera->fov_deg * pi / 360) / request->height;
    struct vec ray = vec_add(forward, (x - request->width / 2.0) * pixel, right);
    return vec_unit(vec_add(ray, (request->height / 2.0 - y) * pixel, up));
}

struct vec picture_pixel_ray(const struct picture_request *request, size_t i)
{
    const size_t column = i % request->width;
    const size_t row = i / request->width;
    return picture_ray(request, (double)column + 0.5, (double)row + 0.5);
}

struct picture_layer picture_layer(const struct image *image, const char *name)
{
    static const char *const sets[] = { "XYZ", "RGB" };
    struct picture_layer layer = { { 0 } };
    for (size_t s = 0; s < 2 && !layer.planes[0]; s++) {
        for (size_t p = 0; p < 3; p++) {
            char plane[IMAGE_NAME_SIZE];
            snprintf(plane, sizeof(plane), "%s%s%c", name, *name ? "." : "", sets[s][p]);
            layer.planes[p] = image_find(image, plane);
        }
    }
    assert_true(layer.planes[0] && layer.planes[1] && layer.planes[2]);
    return layer;
}

struct vec picture_at(struct picture_layer layer, size_t i)
{
    return (struct vec){ (double)layer.planes[0][i], (double)layer.planes[1][i],
                         (double)layer.planes[2][i] };
}

bool picture_is_object(struct picture_layer exit, size_t i)
{
    return !(vec_norm(picture_at(exit, i)) < 0.5); /* NaN counts as covered by the object */
}

/* ---- scenes ---- */

struct vec picture_direction_color(struct vec dir)
{
    return (struct vec){ (dir.x + 1) / 2, (dir.y + 1) / 2, (dir.z + 1) / 2 };
}

struct scene picture_sphere_scene(vec3s center, uint32_t triangles)
{
    struct scene scene = { 0 };
    struct mesh *mesh = &scene.model.object;
    assert_true(generate_sphere(mesh, triangles));
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].position = glms_vec3_add(mesh->vertices[i].position, center);
    scene.box = mesh_box(mesh);
    return scene;
}

void picture_add_directions(struct scene *scene, vec3s center, float radius)
{
    struct mesh ball;
    assert_true(generate_sphere(&ball, 40000));
    for (uint32_t i = 0; i < ball.vertex_count; i++) {
        struct mesh_vertex *v = &ball.vertices[i];
        v->color = glms_vec3_scale(glms_vec3_adds(v->position, 1), 0.5F);
        v->position = glms_vec3_add(glms_vec3_scale(v->position, radius), center);
        v->material = MESH_UNLIT;
    }
    assert_true(mesh_append(&scene->model.surroundings, &ball));
    mesh_finish(&ball);
}

void picture_use_directions(struct scene *scene, uint32_t width)
{
    struct environment *e = &scene->background.environment;
    scene->background.kind = SCENE_ENVIRONMENT;
    *e = (struct environment){ .width = width, .height = width / 2 };
    e->texels = malloc((size_t)e->width * e->height * 4 * sizeof(*e->texels));
    assert_non_null(e->texels);
    for (size_t i = 0; i < (size_t)e->width * e->height; i++) {
        /* equirectangular: -Z in the centre, +X a quarter of the width to its right */
        const size_t column = i % width;
        const size_t row = i / width;
        const double longitude = ((double)column + 0.5) / width * 2 * pi - pi;
        const double from_top = ((double)row + 0.5) / e->height * pi;
        const struct vec color = picture_direction_color((struct vec){
            sin(from_top) * sin(longitude), cos(from_top), -sin(from_top) * cos(longitude) });
        e->texels[4 * i + 0] = half_from_float((float)color.x);
        e->texels[4 * i + 1] = half_from_float((float)color.y);
        e->texels[4 * i + 2] = half_from_float((float)color.z);
        e->texels[4 * i + 3] = half_from_float(1);
    }
}

void picture_add_quad(struct scene *scene, const struct picture_quad *quad)
{
    static const uint32_t corners[6] = { 0, 2, 3, 0, 3, 1 }; /* top left, bottom left, ... */
    struct mesh mesh;
    assert_true(mesh_init(&mesh, 4, 6));
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t row = i / 2;
        const vec2s uv = { { (float)(i % 2), (float)row } };
        mesh.vertices[i] = (struct mesh_vertex){
            .position = glms_vec3_muladds(quad->down, uv.y,
                                          glms_vec3_muladds(quad->right, uv.x, quad->top_left)),
            .normal = glms_vec3_normalize(glms_vec3_cross(quad->down, quad->right)),
            .color = quad->color,
            .uv = uv,
            .material = quad->material,
        };
    }
    memcpy(mesh.indices, corners, sizeof(corners));
    assert_true(mesh_append(&scene->model.surroundings, &mesh));
    mesh_finish(&mesh);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double picture_quantile(double *values, size_t count, double q)
{
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++)
        values[i] = isnan(values[i]) ? HUGE_VAL : values[i];
    qsort(values, count, sizeof(*values), compare);
    return values[(size_t)(q * (double)(count - 1) + 0.5)];
}
