/* test_env_cube.c: every texel of the environment cube shows the surroundings in its direction. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "graph/rg_cmd.h"
#include "graph/rg_exec.h"
#include "shaders/globals.h"
#include "shaders/specialization_constants.h"
#include "src/file/half_float.h"
#include "src/render/frame/pass_list.h"
#include "src/render/uploaded_scene.h"
#include "src/tech/frame_resources.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIDE = 512, /* texels; Seipel and Nivfors 2006, section 3.2 */
    FACE_TEXELS = SIDE * SIDE,
};

static const float near = 1e-3F;

/*
 * Vulkan 1.3, 16.5.4, table "Cube map face and coordinate selection", solved for the direction:
 * the major axis, and where s_c and t_c of each face grow.
 */
static const struct face {
    struct vec major, s, t;
} faces[6] = {
    { { 1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } }, { { -1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
    { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },   { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
    { { 0, 0, 1 }, { 1, 0, 0 }, { 0, -1, 0 } },  { { 0, 0, -1 }, { -1, 0, 0 }, { 0, -1, 0 } },
};

/* Through a point of a face, its texels' centres at .5; 1 long along the major axis. */
static struct vec face_ray(uint32_t face, double x, double y)
{
    const struct vec along_s = vec_add(faces[face].major, 2 * x / SIDE - 1, faces[face].s);
    return vec_add(along_s, 2 * y / SIDE - 1, faces[face].t);
}

static struct vec texel_at(const uint16_t *cube, uint32_t face, uint32_t x, uint32_t y)
{
    const uint16_t *texel = cube + 4 * ((size_t)face * FACE_TEXELS + (size_t)y * SIDE + x);
    return (struct vec){ (double)half_to_float(texel[0]), (double)half_to_float(texel[1]),
                         (double)half_to_float(texel[2]) };
}

/* ---- a graph of the cube alone ---- */

static rg_record_fn record_copy;

static const struct rg_buffer copied = {
    .name = "test.cube",
    .size = (VkDeviceSize)6 * FACE_TEXELS * 8,
    .memory = RG_MEMORY_READBACK,
};

static const struct rg_pass copy_passes[] = {
    {
        .name = "test.copy",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &frame_env_cube, .access = RG_COPY_SRC },
                        { .buffer = &copied, .access = RG_COPY_DST }),
        .record = record_copy,
    },
};

static const struct rg_technique copy = RG_TECHNIQUE("test", copy_passes);

static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, &frame_env_cube, &copied, 0);
}

/* The plan reads the list, which the caller frees after it. */
static struct rg_plan *compile(const struct rg_device *device, const struct scene *scene,
                               struct frame_list *list)
{
    const struct settings settings = settings_default();
    const struct technique_config config = { .settings = &settings,
                                             .scene = scene,
                                             .purpose = TECHNIQUE_CAPTURE };
    const struct rg_technique *pass_groups[] = { NULL, &copy };
    const struct environment *environment = &scene->background.environment;
    const uint32_t side =
        environment->width > environment->height ? environment->width : environment->height;
    assert_int_equal(frame_list_init(list, &config), STATUS_OK);
    assert_int_equal(list->count, 1);
    pass_groups[0] = &list->pass_groups[0];
    const struct rg_import imports[] = {
        { .image = &frame_environment,
          .access = RG_SAMPLED,
          .extent = { environment->width, environment->height },
          .mips = environment->texels ? (uint32_t)log2(side) + 1 : 0 },
        { .image = &frame_textures, .access = RG_SAMPLED },
    };
    const struct rg_output output = { .buffer = &copied, .access = RG_HOST_READ };
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .techniques = pass_groups,
        .technique_count = 2,
        .view = { 64, 64 },
        .outputs = &output,
        .output_count = 1,
        .imports = imports,
        .import_count = 2,
        .device = device,
    });
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    return plan;
}

static struct rg_frame make_frame(const struct uploaded_scene *on_gpu, vec3s center)
{
    struct rg_frame frame = {
        .surroundings = uploaded_scene_mesh(&on_gpu->surroundings, false),
        .due = { .cube = true },
    };
    for (uint32_t i = 0; i < 6; i++) {
        const struct camera_basis basis = camera_cube_basis(i);
        frame.faces[i] = (struct surroundings_push){
            .clip_from_world = camera_cube_clip_from_world(i, center, near),
            .eye = center,
            .right = basis.right,
            .up = basis.up,
            .forward = basis.forward,
        };
    }
    return frame;
}

/* Six faces, half RGBA; the caller frees them. */
static uint16_t *capture(struct gpu *gpu, const struct scene *scene, vec3s center)
{
    const struct rg_vulkan vulkan = {
        gpu->instance,
        vkGetInstanceProcAddr,
        gpu->physical,
        gpu->device,
    };
    const struct rg_device device = rg_exec_device(&vulkan);
    struct frame_list list;
    struct rg_plan *plan = compile(&device, scene, &list);
    struct uploaded_scene on_gpu;
    assert_int_equal(uploaded_scene_init(&on_gpu, gpu, scene), STATUS_OK);
    const struct rg_exec_import imports[] = {
        { .image = uploaded_scene_image(&on_gpu, &frame_environment) },
        { .image = uploaded_scene_image(&on_gpu, &frame_textures) },
    };
    const uint32_t background =
        scene->background.kind == SCENE_COLOR ? GLOBALS_COLOR : GLOBALS_ENVIRONMENT;
    const VkSpecializationMapEntry entry = { CONSTANT_BACKGROUND, 0, sizeof(background) };
    struct rg_exec *exec = rg_exec_create(
        &(struct rg_exec_params){
            .plan = plan,
            GPU_EXEC_PARAMS(gpu),
            .imports = imports,
            .import_count = 2,
            .constants = &(VkSpecializationInfo){ 1, &entry, sizeof(background), &background },
        },
        NULL);
    const struct globals globals = {
        .background_color = scene->background.color,
    };
    const struct rg_frame frame = make_frame(&on_gpu, center);
    uint32_t slot;
    uint16_t *cube = malloc(copied.size);
    assert_true(exec && cube);
    assert_int_equal(rg_exec_begin(exec, &slot), VK_SUCCESS);
    memcpy(rg_exec_mapped(exec, &frame_globals, slot), &globals, sizeof(globals));
    assert_int_equal(rg_exec_submit(exec, &frame), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(exec, slot), VK_SUCCESS);
    memcpy(cube, rg_exec_mapped(exec, &copied, slot), copied.size);
    rg_exec_destroy(exec);
    rg_plan_destroy(plan);
    frame_list_finish(&list);
    uploaded_scene_finish(&on_gpu, gpu);
    assert_int_equal(gpu->message_count, 0);
    return cube;
}

/* ---- directions ---- */

static void check_directions(const uint16_t *cube, double tolerance, double at_poles)
{
    for (uint32_t face = 0; face < 6; face++) {
        for (uint32_t i = 0; i < FACE_TEXELS; i++) {
            const uint32_t x = i % SIDE;
            const uint32_t y = i / SIDE;
            const struct vec dir = vec_unit(face_ray(face, x + 0.5, y + 0.5));
            const struct vec color = texel_at(cube, face, x, y);
            const double most = fabs(dir.y) > 0.998 ? at_poles : tolerance;
            if (!(vec_difference(color, picture_direction_color(dir)) <= most))
                fail_msg("face %u, texel %u %u: %g %g %g", face, x, y, color.x, color.y, color.z);
        }
    }
}

static void faces_are_vulkans(void **state)
{
    (void)state;
    assert_int_equal(frame_env_cube.width, SIDE);
    assert_int_equal(frame_env_cube.height, SIDE);
}

static void surroundings_are_where_they_are(void **state)
{
    static const vec3s centers[] = { { { 0, 0, 0 } }, { { 3, -2, 50 } } };
    for (size_t i = 0; i < 2; i++) {
        struct scene scene = { .background.kind = SCENE_COLOR };
        picture_add_directions(&scene, centers[i], 7);
        uint16_t *cube = capture(*state, &scene, centers[i]);
        check_directions(cube, 1e-3, 1e-3);
        free(cube);
        scene_finish(&scene);
    }
}

/* Large texels, so that a seam would be seen; at the poles the picture lacks half of one. */
static void environment_is_where_it_is(void **state)
{
    struct scene scene = { 0 };
    picture_use_directions(&scene, 64);
    uint16_t *cube = capture(*state, &scene, (vec3s){ { 1, 2, 3 } });
    check_directions(cube, 4e-3, 0.03);
    free(cube);
    scene_finish(&scene);
}

/* ---- triangles that cross faces, edges, near planes and the space behind ---- */

enum {
    TRIANGLE_COUNT = 24,
    NOTHING = TRIANGLE_COUNT,
};

static vec3s triangle_color(uint32_t i)
{
    const uint32_t row = i / 5;
    return (vec3s){ { (float)(i % 5) / 4, (float)row / 4, 0.5F } };
}

static float random_within(uint32_t *state, float size)
{
    *state = *state * 1664525U + 1013904223U;
    return ((float)(*state >> 8) / 8388608.0F - 1) * size;
}

/* Large ones around the origin; every third passes it closely, with corners on all sides. */
static void add_triangles(struct mesh *mesh, uint32_t seed)
{
    assert_true(mesh_init(mesh, 3 * TRIANGLE_COUNT, 3 * TRIANGLE_COUNT));
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float size = i / 3 % 3 ? 20 : 3;
        struct mesh_vertex *v = &mesh->vertices[i];
        v->position.x = random_within(&seed, size);
        v->position.y = random_within(&seed, size);
        v->position.z = random_within(&seed, size);
        v->normal = (vec3s){ { 0, 1, 0 } };
        v->color = triangle_color(i / 3);
        v->material = MESH_UNLIT;
        mesh->indices[i] = i;
    }
}

/* Moeller and Trumbore 1997, from the origin: how often the ray's length, or infinity. */
static double cast(const struct mesh *mesh, size_t i, struct vec ray)
{
    const struct mesh_vertex *corners = mesh->vertices + 3 * i;
    const struct vec a = vec_from(corners[0].position);
    const struct vec b = vec_add(vec_from(corners[1].position), -1, a);
    const struct vec c = vec_add(vec_from(corners[2].position), -1, a);
    const struct vec p = vec_cross(ray, c);
    const double inverse = 1 / vec_dot(b, p);
    const double u = -vec_dot(a, p) * inverse;
    const struct vec q = vec_cross(vec_scale(a, -1), b);
    const double v = vec_dot(ray, q) * inverse;
    const bool hit = u >= 0 && v >= 0 && u + v <= 1;
    return hit ? vec_dot(c, q) * inverse : HUGE_VAL;
}

/* The nearest triangle beyond the near plane. */
static uint32_t seen(const struct mesh *mesh, struct vec ray)
{
    uint32_t nearest = NOTHING;
    double depth = HUGE_VAL;
    for (uint32_t i = 0; i < TRIANGLE_COUNT; i++) {
        const double t = cast(mesh, i, ray);
        if (t < depth && t > (double)near) {
            depth = t;
            nearest = i;
        }
    }
    return nearest;
}

/* Also a texel further in every direction, so that no edge passes by. */
static bool seen_clearly(const struct mesh *mesh, uint32_t face, uint32_t x, uint32_t y,
                         uint32_t *triangle)
{
    *triangle = seen(mesh, face_ray(face, x + 0.5, y + 0.5));
    for (int down = -1; down <= 1; down++) {
        for (int right = -1; right <= 1; right++) {
            if (seen(mesh, face_ray(face, x + 0.5 + right, y + 0.5 + down)) != *triangle)
                return false;
        }
    }
    return true;
}

/* How often each triangle, and nothing, is seen; returns how often it is hard to say. */
static uint32_t check_face(const uint16_t *cube, uint32_t face, const struct mesh *mesh, vec3s sky,
                           uint32_t *counts)
{
    enum {
        STEP = 7 /* 511 = 7 * 73: first and last texels of rows and columns too */
    };

    uint32_t unclear_count = 0;
    for (uint32_t y = 0; y < SIDE; y += STEP) {
        for (uint32_t x = 0; x < SIDE; x += STEP) {
            uint32_t triangle;
            if (!seen_clearly(mesh, face, x, y, &triangle)) {
                unclear_count++;
                continue;
            }
            const vec3s color = triangle == NOTHING ? sky : triangle_color(triangle);
            if (!(vec_difference(texel_at(cube, face, x, y), vec_from(color)) < 1e-3))
                fail_msg("face %u, texel %u %u is not triangle %u", face, x, y, triangle);
            counts[triangle]++;
        }
    }
    return unclear_count;
}

static void check_triangles(const uint16_t *cube, const struct mesh *mesh, vec3s sky)
{
    uint32_t counts[TRIANGLE_COUNT + 1] = { 0 };
    uint32_t distinct_count = 0;
    uint32_t clear_count = 0;
    uint32_t unclear_count = 0;
    for (uint32_t face = 0; face < 6; face++)
        unclear_count += check_face(cube, face, mesh, sky, counts);
    for (uint32_t i = 0; i <= TRIANGLE_COUNT; i++) {
        distinct_count += counts[i] > 0;
        clear_count += counts[i];
    }
    assert_true(distinct_count >= 10 && clear_count > 9 * unclear_count);
}

static void no_face_shows_what_belongs_to_another(void **state)
{
    for (uint32_t seed = 1; seed <= 3; seed++) {
        struct scene scene = { .background.kind = SCENE_COLOR,
                               .background.color = { { 0, 0, 1 } } };
        add_triangles(&scene.model.surroundings, seed);
        uint16_t *cube = capture(*state, &scene, (vec3s){ { 0, 0, 0 } });
        check_triangles(cube, &scene.model.surroundings, scene.background.color);
        free(cube);
        scene_finish(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_vulkans),
        cmocka_unit_test(surroundings_are_where_they_are),
        cmocka_unit_test(environment_is_where_it_is),
        cmocka_unit_test(no_face_shows_what_belongs_to_another),
    };
    return RUN_ON_DEVICE(tests);
}
