/* frame_resources.c: images, samplers and record functions shared by all techniques. */
#include "src/tech/frame_resources.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/geometry/mesh.h"
#include "src/settings/scene_settings.h"
#include "src/tech/techniques.h"

static const VkVertexInputAttributeDescription mesh_attributes[] = {
    {
        .location = MESH_POSITION,
        .format = VK_FORMAT_R32G32B32_SFLOAT,
        .offset = offsetof(struct mesh_vertex, position),
    },
    {
        .location = MESH_NORMAL,
        .format = VK_FORMAT_R32G32B32_SFLOAT,
        .offset = offsetof(struct mesh_vertex, normal),
    },
    {
        .location = MESH_COLOR,
        .format = VK_FORMAT_R32G32B32_SFLOAT,
        .offset = offsetof(struct mesh_vertex, color),
    },
    {
        .location = MESH_UV,
        .format = VK_FORMAT_R32G32_SFLOAT,
        .offset = offsetof(struct mesh_vertex, uv),
    },
    {
        .location = MESH_MATERIAL,
        .format = VK_FORMAT_R32_UINT,
        .offset = offsetof(struct mesh_vertex, material),
    },
};

const struct rg_vertex_layout frame_mesh_layout = {
    .stride = sizeof(struct mesh_vertex),
    .attribute_count = sizeof(mesh_attributes) / sizeof(mesh_attributes[0]),
    .attributes = mesh_attributes,
};

const struct rg_buffer frame_globals = {
    .name = "frame.globals",
    .size = sizeof(struct globals),
    .memory = RG_MEMORY_UPLOAD,
};

const struct rg_image frame_color = {
    .name = "surroundings.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image frame_depth = {
    .name = "surroundings.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_image frame_display = {
    .name = "tonemap.color",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};

/* Environment cube images. frame_plan_init() replaces the width and height by the actual size. */
const struct rg_image frame_env_cube = {
    .name = "env_cube.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .width = 512,
    .height = 512,
    .cube = true,
    .persistent = true, /* keeps its content in frames that do not redraw it */
};

const struct rg_image frame_env_cube_depth = {
    .name = "env_cube.depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .width = 512,
    .height = 512,
    .layers = 6,
};

const struct rg_buffer frame_samples = {
    .name = "resolve.samples",
    .size_per_texel = 8,
    .memory = RG_MEMORY_UPLOAD,
};

/* Images imported from the scene. The declared size is that of the 1x1 fallback images. */
const struct rg_image frame_environment =
    FRAME_IMPORTED("frame.environment", VK_FORMAT_R16G16B16A16_SFLOAT, false);

const struct rg_image frame_textures =
    FRAME_IMPORTED("frame.textures", VK_FORMAT_R8G8B8A8_SRGB, true);

const struct rg_image frame_data_textures =
    FRAME_IMPORTED("frame.numbers", VK_FORMAT_R8G8B8A8_UNORM, true);

const struct rg_image frame_materials =
    FRAME_IMPORTED("frame.materials", VK_FORMAT_R32G32B32A32_SFLOAT, false);

const struct rg_image frame_extras =
    FRAME_IMPORTED("frame.extras", VK_FORMAT_R32G32B32A32_SFLOAT, false);

const struct rg_image frame_lights =
    FRAME_IMPORTED("frame.lights", VK_FORMAT_R32G32B32A32_SFLOAT, false);

const struct rg_image frame_surface_light =
    FRAME_IMPORTED("frame.surface_light", VK_FORMAT_R16G16B16A16_SFLOAT, true);

const struct rg_image frame_surface_split =
    FRAME_IMPORTED("frame.surface_split", VK_FORMAT_R16G16_SFLOAT, false);

const struct rg_sampler frame_linear = { .linear = true };
const struct rg_sampler frame_same_texel = { 0 };

const struct rg_sampler frame_environment_sampler = {
    .linear = true,
    .mips = true,
    .repeat_u = true,
};

const struct rg_sampler frame_texture_sampler = {
    .linear = true,
    .mips = true,
    .repeat_u = true,
    .repeat_v = true,
    .anisotropy = FRAME_ANISOTROPY,
};

/* Returns the object that a pass draws; NULL if the pass draws all objects. */
static const struct frame_object *owner(const struct rg_pass *pass, const struct rg_frame *frame)
{
    for (size_t i = 0; i < frame->object_count; i++) {
        const struct frame_object *object = &frame->objects[i];
        if (pass >= object->passes && pass < object->passes + object->pass_count)
            return object;
    }
    return NULL;
}

static const struct frame_object *object_of(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    return owner(rg_cmd_pass(cmd), frame);
}

const struct object *frame_object_of(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct model *model = &frame->scene->model;
    const struct frame_object *object = object_of(cmd, frame);
    return object_of_index(model->objects, model->object_count, object ? object->first_index : 0);
}

VkRect2D frame_object_area(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct frame_object *object = object_of(cmd, frame);
    return object ? object->area : frame->object_area;
}

VkRect2D frame_object_drawn(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    return object_of(cmd, frame)->drawn;
}

const struct rg_pass *frame_object_next_pass(const struct rg_pass *pass,
                                             const struct rg_frame *frame)
{
    const struct frame_object *object =
        pass->area == frame_object_drawn ? owner(pass, frame) : NULL;
    return object && object->next ? &object->next->passes[pass - object->passes] : NULL;
}

void frame_draw_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct frame_object *object = object_of(cmd, frame);
    if (object)
        rg_cmd_draw_mesh_part(cmd, &frame->object, object->first_index, object->index_count);
    else
        rg_cmd_draw_mesh(cmd, &frame->object);
}

void frame_draw_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

void frame_draw_lookup_area(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct frame_object *object = object_of(cmd, frame);
    rg_cmd_scissor(cmd, object ? object->lookup_area : frame->lookup_area);
    rg_cmd_draw(cmd, 3);
}

void frame_draw_mesh(struct rg_cmd *cmd, const struct rg_frame *frame,
                     const struct technique *technique)
{
    rg_cmd_draw_mesh(cmd, &frame->meshes[techniques_index(technique)]);
}

float frame_time_before(const struct settings *settings, float time)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    return fmaxf(time - 1.0f / motion->fps, 0.0f);
}

/* Returns a rotation about the vertical axis through `center` by `angle` radians. */
static mat4s rotation_about(vec3s center, float angle)
{
    mat4s there = glms_translate(glms_mat4_identity(), center);
    mat4s rotation_about = glms_rotate(there, angle, (vec3s){ { 0.0f, 1.0f, 0.0f } });
    return glms_translate(rotation_about, glms_vec3_negate(center));
}

void frame_rotations(const struct frame_view *view, vec3s center, float time,
                     mat4s *world_from_object, mat4s *world_from_movers)
{
    const struct motion_params *motion = settings_of(view->settings, &motion_settings);
    const float radians = 0.01745329252f;
    *world_from_object = rotation_about(center, motion->ice * time * radians);
    *world_from_movers = rotation_about(center, motion->objects * time * radians);
}
