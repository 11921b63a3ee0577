/*
 * test_trace.c: BVH traversal on a device (shaders/trace/trace_bvh.glsl) finds the hits that the
 * host finds.
 */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "shaders/embedded.h"
#include "shaders/specialization_constants.h"
#include "shaders/trace/refract_trace.h"
#include "src/gpu/gpu_acceleration.h"
#include "src/render/blas_groups.h"
#include "src/scene/bvh/bvh.h"
#include "tests/gpu/shaders/trace_rays.h"
#include "tests/gpu/test_shaders.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"
#include "tests/support/run_graph.h"

enum {
    RAYS = TRACE_RAYS_SIDE * TRACE_RAYS_SIDE,
};

/* ---- a pass ---- */

#define WORDS(title, kind) \
    { \
        .name = (title), .size = 16, .format = (kind) \
    }
static const struct rg_buffer rays = WORDS("rays", VK_FORMAT_R32G32B32A32_SFLOAT);
static const struct rg_buffer nodes = WORDS("nodes", VK_FORMAT_R32G32B32A32_UINT);
static const struct rg_buffer triangles = WORDS("triangles", VK_FORMAT_R32G32B32A32_UINT);
static const struct rg_buffer corners = WORDS("corners", VK_FORMAT_R32G32B32A32_UINT);
static const struct rg_buffer stored_nodes = { "stored nodes", .size = 16,
                                               .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer stored_triangles = { "stored triangles", .size = 16,
                                                   .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer stored_corners = { "stored corners", .size = 16,
                                                 .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer structure = { "structure", .size = 16 };
static const struct rg_buffer trace = {
    .name = "trace",
    .size = sizeof(struct trace_frame),
    .memory = RG_MEMORY_UPLOAD,
};
static const struct rg_image found = {
    .name = "found",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};
static const struct rg_buffer found_out = {
    .name = "found out",
    .size_per_texel = sizeof(vec4s),
    .memory = RG_MEMORY_READBACK,
};

static void record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

#define TREE_USES \
    { .buffer = &trace, .access = RG_UNIFORM, .binding = TRACE_FRAME }, \
        { .buffer = &rays, .access = RG_SAMPLED, .binding = TRACE_RAYS_BINDING }, \
        { .buffer = &nodes, .access = RG_SAMPLED, .binding = TRACE_NODES }, \
        { .buffer = &triangles, .access = RG_SAMPLED, .binding = TRACE_TRIANGLES }, \
        { .buffer = &corners, .access = RG_SAMPLED, .binding = TRACE_CORNERS }, \
        { .buffer = &stored_nodes, .access = RG_STORAGE_READ, .binding = TRACE_STORED_NODES }, \
        { .buffer = &stored_corners, .access = RG_STORAGE_READ, .binding = TRACE_STORED_CORNERS }, \
    { \
        .buffer = &stored_triangles, .access = RG_STORAGE_READ, .binding = TRACE_STORED_TRIANGLES \
    }

static const struct rg_pass bvh_rows[] = {
    {
        .name = "meet",
        .color = RG_TARGETS({ &found, RG_LOAD_DISCARD }),
        .uses = RG_USES(TREE_USES),
        .vert = &fullscreen_vert,
        .frag = &trace_rays_frag,
        .record = record,
    },
    RUN_READ("read", found, found_out),
};

static const struct rg_pass query_rows[] = {
    {
        .name = "meet",
        .color = RG_TARGETS({ &found, RG_LOAD_DISCARD }),
        .uses = RG_USES(TREE_USES,
                        { .buffer = &structure, .access = RG_TRACE, .binding = TRACE_STRUCTURE }),
        .vert = &fullscreen_vert,
        .frag = &trace_rays_query_frag,
        .record = record,
    },
    RUN_READ("read", found, found_out),
};

/* ---- rays ---- */

static float pick(uint32_t *seed)
{
    *seed = *seed * 747796405u + 2891336453u;
    return (float)(*seed >> 8) * 0x1p-23f - 1.0f;
}

static vec3s pick_point(uint32_t *seed, float size)
{
    const float x = pick(seed), y = pick(seed), z = pick(seed);
    return (vec3s){ { size * x, size * y, size * z } };
}

struct ray {
    vec3s origin;
    float part;
    vec3s dir;
    float side; /* as of trace_ray in trace_bvh.glsl */
};

/* Cosine and sine of a turn about the vertical axis, and what x and z are shifted by. */
static const vec4s turn = { { 0.6f, 0.8f, 0.25f, -0.5f } };

static vec3s turned(vec3s v)
{
    return (vec3s){ { turn.x * v.x + turn.y * v.z, v.y, turn.x * v.z - turn.y * v.x } };
}

/* Rays from all around and from inside of an object, some along an axis. `is_sided`: they meet only
 * faces that they can see, as of a closed object. */
static void pick_rays(struct ray *to, const struct bvh *bvh, bool is_sided)
{
    uint32_t seed = 1;
    for (int i = 0; i < RAYS; i++) {
        to[i] = (struct ray){ .origin = pick_point(&seed, i % 3 ? 3.0f : 0.7f) };
        to[i].dir = glms_vec3_normalize(glms_vec3_sub(pick_point(&seed, 1.0f), to[i].origin));
        if (i % 7 == 0)
            to[i].dir = (vec3s){ { 0.0f, i % 2 ? 1.0f : -1.0f, 0.0f } };
        if (is_sided)
            to[i].side = bvh_interior_list_at(bvh, to[i].origin).words[0] ? 1.0f : -1.0f;
    }
}

/* ---- a device ---- */

enum {
    WORDS_AND_RAYS = 4,
    IMPORTS = WORDS_AND_RAYS + 1,
};

static struct gpu_acceleration *build(struct gpu *gpu, const struct bvh *bvh)
{
    struct gpu_blas_groups groups;
    struct gpu_acceleration *built;
    assert_int_equal(blas_groups_init(&groups, bvh, false), STATUS_OK);
    assert_int_equal(gpu_acceleration_create(gpu, &built, &groups), STATUS_OK);
    assert_int_equal(gpu_acceleration_build(gpu, built, &groups), STATUS_OK);
    return built;
}

/* Asks the device what rays meet, by the tree or, if there are any, acceleration structures. */
static void ask(struct gpu *gpu, const struct bvh *bvh, const struct gpu_acceleration *structures,
                const struct ray *asked, uint32_t constant, vec4s *answers)
{
    const VkSpecializationMapEntry entry = { CONSTANT_TRACE, 0, sizeof(constant) };
    const VkSpecializationInfo constants = { 1, &entry, sizeof(constant), &constant };
    const struct bvh_words *words[] = { &bvh->nodes, &bvh->triangles, &bvh->corners };
    const struct rg_buffer *const declared[] = { &nodes, &triangles, &corners, &rays };
    struct rg_import imports[IMPORTS];
    struct rg_exec_import objects[IMPORTS];
    struct gpu_buffer buffers[WORDS_AND_RAYS];
    struct run run;
    for (int i = 0; i < WORDS_AND_RAYS; i++) {
        const void *bytes = i < 3 ? (const void *)words[i]->all : asked;
        const size_t size =
            i < 3 ? words[i]->count * sizeof(*words[i]->all) : RAYS * sizeof(*asked);
        assert_int_equal(gpu_buffer_create(gpu, &buffers[i],
                                           VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, bytes, size,
                                           declared[i]->name),
                         STATUS_OK);
        imports[i] =
            (struct rg_import){ .buffer = declared[i], .access = RG_SAMPLED, .size = size };
        objects[i] = (struct rg_exec_import){ .buffer = buffers[i].buffer };
    }
    if (structures) {
        imports[WORDS_AND_RAYS] =
            (struct rg_import){ .buffer = &structure, .access = RG_TRACE, .size = 16 };
        objects[WORDS_AND_RAYS] = (struct rg_exec_import){ .buffer = structures->tlas_memory.buffer,
                                                           .acceleration = structures->tlas };
    }
    run_open(&run, gpu,
             &(struct run_params){ .technique = { "trace", structures ? query_rows : bvh_rows, 2 },
                                   .view = { TRACE_RAYS_SIDE, TRACE_RAYS_SIDE },
                                   .outputs = { &found_out },
                                   .imports = imports,
                                   .objects = objects,
                                   .import_count = WORDS_AND_RAYS + (structures ? 1 : 0),
                                   .constants = &constants });
    struct trace_frame frame = { .one = 1, .epsilon = 1e-4f, .objects_rotation = turn };
    memcpy(frame.roots, bvh->roots, sizeof(bvh->roots));
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    memcpy(run_data(&run, &trace), &frame, sizeof(frame));
    assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
    memcpy(answers, run_data(&run, &found_out), RAYS * sizeof(*answers));
    run_close(&run);
    for (int i = 0; i < WORDS_AND_RAYS; i++)
        gpu_buffer_destroy(gpu, &buffers[i]);
}

/* A ray along a side of two triangles may meet either, so the places count. `constant`: with
 * TRACE_HAS_CULLING rays are sided, with TRACE_HAS_MOTION the object is turned. */
static void compare(struct gpu *gpu, const struct bvh *bvh,
                    const struct gpu_acceleration *structures, uint32_t constant)
{
    static struct ray asked[RAYS], sent[RAYS];
    static vec4s answers[RAYS];
    int met = 0, same = 0;
    pick_rays(asked, bvh, constant & TRACE_HAS_CULLING);
    memcpy(sent, asked, sizeof(sent));
    for (int i = 0; i < RAYS && constant & TRACE_HAS_MOTION; i++) {
        sent[i].origin = glms_vec3_add(turned(asked[i].origin), (vec3s){ { turn.z, 0, turn.w } });
        sent[i].dir = turned(asked[i].dir);
    }
    ask(gpu, bvh, structures, sent, constant, answers);
    for (int i = 0; i < RAYS; i++) {
        struct bvh_hit hit;
        const struct bvh_ray ray = { asked[i].origin, asked[i].dir, 0.0, BVH_NONE };
        const bool meets = bvh_intersect(bvh, BVH_OBJECTS, &ray, &hit);
        assert_int_equal(answers[i].w >= 0.0f, meets);
        if (!meets)
            continue;
        met++;
        same += (uint32_t)answers[i].w == hit.triangle;
        CHECK_NEAR(answers[i].x, hit.t, 1e-5 * fmax(hit.t, 1.0)); /* some are 5 m long */
    }
    assert_in_range(met, RAYS / 4, RAYS);
    assert_in_range(same, met - met / 500, met);
}

static void rays_meet_the_same(struct gpu *gpu, bool by_query)
{
    bool (*const generators[])(struct mesh *, uint32_t) = { generate_sphere, generate_ice_cube,
                                                            generate_teapot };
    for (size_t g = 0; g < 3; g++) {
        struct model model = { 0 };
        struct bvh bvh;
        assert_true(generators[g](&model.object, 3000));
        assert_int_equal(bvh_init(&bvh, &(struct bvh_params){ .model = &model, .threads = 2 }),
                         STATUS_OK);
        struct gpu_acceleration *structures = by_query ? build(gpu, &bvh) : NULL;
        compare(gpu, &bvh, structures, TRACE_HAS_MOTION);
        if (bvh.is_closed)
            compare(gpu, &bvh, structures, TRACE_HAS_CULLING);
        gpu_acceleration_destroy(gpu, structures);
        bvh_finish(&bvh);
        mesh_finish(&model.object);
    }
}

static void trees_meet_the_same(void **state)
{
    rays_meet_the_same(*state, false);
}

static void queries_meet_the_same(void **state)
{
    struct gpu *gpu = *state;
    if (!gpu->has_rays) {
        print_message("skipped: the device has no ray queries\n");
        skip();
    }
    rays_meet_the_same(gpu, true);
}

/* A device whose buffers of texels are too small has the words in storage buffers. */
static void stored_trees_show_the_same(void **state)
{
    const struct gpu *real = *state;
    struct gpu small = *real;
    struct gpu *const gpus[2] = { *state, &small };
    struct scene scene = picture_sphere_scene(glms_vec3_zero(), 400);
    struct render_result results[2];
    small.properties.limits.maxTexelBufferElements = 1000; /* of the triangles alone 1200 are */
    picture_add_directions(&scene, glms_vec3_zero(), 9.0F);
    for (int i = 0; i < 2; i++) {
        const struct settings settings = picture_settings("trace.surroundings=rays");
        const struct picture_request request = {
            .scene = &scene,
            .settings = &settings,
            .refraction = "trace",
            .camera = camera_orbit(28, 9, 4.5F, glms_vec3_zero(), 45),
            .width = 64,
            .height = 48,
            .layers = picture_layer_bit("object.last"),
        };
        results[i] = picture_render(gpus[i], &request);
    }
    for (uint32_t p = 0; p < results[0].image.plane_count; p++)
        assert_memory_equal(results[0].image.planes[p].texels, results[1].image.planes[p].texels,
                            sizeof(float) * 64 * 48);
    render_result_finish(&results[0]);
    render_result_finish(&results[1]);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_meet_the_same),
        cmocka_unit_test(queries_meet_the_same),
        cmocka_unit_test(stored_trees_show_the_same),
    };
    return RUN_ON_DEVICE(tests);
}
