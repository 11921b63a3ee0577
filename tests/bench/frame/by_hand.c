/* by_hand.c: a frame without the render graph: what is drawn, and in which order. */
#include "tests/bench/frame/by_hand.h"

#include <stdlib.h>
#include <string.h>

#include "tests/bench/frame/by_hand_private.h"

#include "shaders/embedded.h"
#include "shaders/globals.h"
#include "shaders/refract/refract_paper.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/tech/frame_resources.h"
#include "src/tech/output/tonemap.h"
#include "src/tech/refract/refract_paper.h"

#define GLOBALS \
    { \
        GLOBALS_BINDING, 0, VK_NULL_HANDLE \
    }

/* ---- once ---- */

#define AROUND_ROW(stem, compare_op, image) \
    { \
        .vert = &stem##_vert, .frag = &stem##_frag, .push_size = sizeof(struct surroundings_push), \
        .compare = (compare_op), .colors = { COLOR }, .bindings = { GLOBALS, image }, \
        .binding_count = 2, \
    }

static void fill_rows(const struct by_hand *h, struct pipeline_row rows[static PIPELINE_COUNT])
{
    const struct binding environment = { SURROUNDINGS_ENVIRONMENT, AROUND, h->imported[0] };
    const struct binding textures = { SURROUNDINGS_TEXTURES, TEXTURES, h->imported[1] };
    rows[SURROUNDINGS] =
        (struct pipeline_row)AROUND_ROW(surroundings, VK_COMPARE_OP_GREATER, textures);
    rows[SURROUNDINGS].mesh = true;
    rows[SKY] = (struct pipeline_row)AROUND_ROW(surroundings_sky, VK_COMPARE_OP_GREATER_OR_EQUAL,
                                                environment);
    rows[SKY].reads_depth = true;
    rows[BACK_NORMAL] = (struct pipeline_row){
        .vert = &ice_normal_vert,
        .frag = &ice_normal_frag,
        .mesh = true,
        .cull = VK_CULL_MODE_FRONT_BIT,
        .compare = VK_COMPARE_OP_GREATER,
        .colors = { NORMAL },
        .bindings = { GLOBALS },
        .binding_count = 1,
    };
    rows[PAPER] = (struct pipeline_row){
        .vert = &refract_vert,
        .frag = &refract_paper_frag,
        .mesh = true,
        .cull = VK_CULL_MODE_BACK_BIT,
        .push_size = sizeof(struct refract_paper_params),
        .compare = VK_COMPARE_OP_GREATER,
        .colors = { COLOR, HIGHLIGHT },
        .bindings = { GLOBALS,
                      { REFRACT_ENV_CUBE, LINEAR, h->views[CUBE] },
                      { REFRACT_NORMAL_BACK, LINEAR, h->views[NORMAL] } },
        .binding_count = 3,
    };
    rows[TONEMAP] = (struct pipeline_row){
        .vert = &fullscreen_vert,
        .frag = &tonemap_frag,
        .push_size = sizeof(struct tonemap_params),
        .colors = { SCREEN },
        .bindings = { { TONEMAP_COLOR, NEAREST, h->views[COLOR] } },
        .binding_count = 1,
    };
}

static void make_pipelines(struct by_hand *h)
{
    struct pipeline_row rows[PIPELINE_COUNT];
    const struct frame_constants constants =
        frame_view_constants(h->params.scene, h->params.settings, NULL);
    VkSpecializationMapEntry entries[CONSTANT_COUNT];
    for (uint32_t i = 0; i < CONSTANT_COUNT; i++)
        entries[i] = (VkSpecializationMapEntry){ i, i * sizeof(uint32_t), sizeof(uint32_t) };
    const VkSpecializationInfo info = { CONSTANT_COUNT, entries, sizeof(constants), &constants };
    fill_rows(h, rows);
    for (uint32_t i = 0; i < PIPELINE_COUNT; i++)
        by_hand_make_pipeline(h, &h->pipelines[i], &rows[i], &info);
}

static void make_pools(struct by_hand *h)
{
    const VkDescriptorPoolSize sizes[2] = {
        { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, PIPELINE_COUNT },
        { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, PIPELINE_COUNT * BINDING_COUNT },
    };
    VK(vkCreateDescriptorPool(h->device,
                              &(VkDescriptorPoolCreateInfo){
                                  .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                  .maxSets = PIPELINE_COUNT,
                                  .poolSizeCount = 2,
                                  .pPoolSizes = sizes,
                              },
                              NULL, &h->descriptors));
    VK(vkCreateCommandPool(h->device,
                           &(VkCommandPoolCreateInfo){
                               .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                               .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                               .queueFamilyIndex = h->params.gpu->queue_family,
                           },
                           NULL, &h->pool));
    VK(vkAllocateCommandBuffers(h->device,
                                &(VkCommandBufferAllocateInfo){
                                    .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                    .commandPool = h->pool,
                                    .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                    .commandBufferCount = 1,
                                },
                                &h->commands));
    VK(vkCreateFence(h->device,
                     &(VkFenceCreateInfo){ .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO }, NULL,
                     &h->fence));
}

struct by_hand *by_hand_create(const struct by_hand_params *params)
{
    const struct uploaded_scene *scene = params->uploaded;
    struct by_hand *h = calloc(1, sizeof(*h));
    assert_non_null(h);
    h->params = *params;
    h->device = params->gpu->device;
    by_hand_make_objects(h, sizeof(struct globals));
    h->imported[0] = by_hand_view(h, uploaded_scene_image(scene, &frame_environment),
                                  frame_environment.format, VK_IMAGE_VIEW_TYPE_2D, 0);
    h->imported[1] = by_hand_view(h, uploaded_scene_image(scene, &frame_textures),
                                  frame_textures.format, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0);
    make_pools(h);
    make_pipelines(h);
    return h;
}

void by_hand_destroy(struct by_hand *h)
{
    for (uint32_t i = 0; i < PIPELINE_COUNT; i++)
        by_hand_free_pipeline(h, &h->pipelines[i]);
    vkDestroyFence(h->device, h->fence, NULL);
    vkDestroyCommandPool(h->device, h->pool, NULL);
    vkDestroyDescriptorPool(h->device, h->descriptors, NULL);
    vkDestroyImageView(h->device, h->imported[0], NULL);
    vkDestroyImageView(h->device, h->imported[1], NULL);
    by_hand_free_objects(h);
    free(h);
}

/* ---- barriers ---- */

#define DRAWN_STAGES \
    (VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | \
     VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT)
#define DRAWN_ACCESS \
    (VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT)
#define DRAW_ACCESS \
    (DRAWN_ACCESS | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | \
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT)

/* What is drawn next comes after all that was drawn; images that it reads change their layouts. */
static void after_drawing(struct by_hand *h, const uint32_t *read, uint32_t read_count)
{
    VkImageMemoryBarrier2 images[IMAGE_COUNT];
    for (uint32_t i = 0; i < read_count; i++)
        images[i] = (VkImageMemoryBarrier2){
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
            .srcAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
            .dstStageMask = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
            .dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
            .oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            .image = h->images[read[i]],
            .subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS },
        };
    const VkMemoryBarrier2 drawn = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = DRAWN_STAGES,
        .srcAccessMask = DRAWN_ACCESS,
        .dstStageMask = DRAWN_STAGES,
        .dstAccessMask = DRAW_ACCESS,
    };
    vkCmdPipelineBarrier2(h->commands, &(VkDependencyInfo){
                                           .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                           .memoryBarrierCount = 1,
                                           .pMemoryBarriers = &drawn,
                                           .imageMemoryBarrierCount = read_count,
                                           .pImageMemoryBarriers = images,
                                       });
}

/* Nothing is left of the frame before, which was waited for. */
static void before_drawing(struct by_hand *h)
{
    VkImageMemoryBarrier2 images[IMAGE_COUNT];
    for (uint32_t i = 0; i < IMAGE_COUNT; i++) {
        const bool depth = by_hand_images[i].format == VK_FORMAT_D32_SFLOAT;
        images[i] = (VkImageMemoryBarrier2){
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .dstStageMask = DRAWN_STAGES,
            .dstAccessMask = depth ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
                                   : VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
            .newLayout = depth ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL
                               : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .image = h->images[i],
            .subresourceRange = { depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT, 0,
                                  1, 0, VK_REMAINING_ARRAY_LAYERS },
        };
    }
    vkCmdPipelineBarrier2(h->commands, &(VkDependencyInfo){
                                           .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                           .imageMemoryBarrierCount = IMAGE_COUNT,
                                           .pImageMemoryBarriers = images,
                                       });
}

/* ---- passes ---- */

struct pass {
    uint32_t pipeline;
    VkExtent2D size;
    VkImageView colors[2], depth; /* null: none */
    VkAttachmentLoadOp color_load, depth_load;
    const void *push;
    uint32_t push_size;
    const struct gpu_buffer *vertices, *indices; /* NULL: a triangle over everything */
};

static void begin_pass(struct by_hand *h, const struct pass *pass)
{
    VkRenderingAttachmentInfo colors[2];
    for (uint32_t i = 0; i < 2; i++)
        colors[i] = (VkRenderingAttachmentInfo){
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = pass->colors[i],
            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = i ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : pass->color_load,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        };
    const VkRenderingAttachmentInfo depth = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = pass->depth,
        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
        .loadOp = pass->depth_load,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
    };
    const VkRect2D all = { .extent = pass->size };
    vkCmdBeginRendering(h->commands, &(VkRenderingInfo){
                                         .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                         .renderArea = all,
                                         .layerCount = 1,
                                         .colorAttachmentCount = pass->colors[1] ? 2 : 1,
                                         .pColorAttachments = colors,
                                         .pDepthAttachment = pass->depth ? &depth : NULL,
                                     });
    vkCmdSetViewport(
        h->commands, 0, 1,
        &(VkViewport){ 0, 0, (float)all.extent.width, (float)all.extent.height, 0, 1 });
    vkCmdSetScissor(h->commands, 0, 1, &all);
}

static void draw_pass(struct by_hand *h, const struct pass *pass)
{
    const struct pipeline *p = &h->pipelines[pass->pipeline];
    const VkDeviceSize start = 0;
    begin_pass(h, pass);
    vkCmdBindPipeline(h->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, p->pipeline);
    vkCmdBindDescriptorSets(h->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, p->layout, 0, 1, &p->set,
                            0, NULL);
    if (pass->push_size)
        vkCmdPushConstants(h->commands, p->layout,
                           VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                           pass->push_size, pass->push);
    if (!pass->vertices) {
        vkCmdDraw(h->commands, 3, 1, 0, 0);
    } else if (pass->indices->size) {
        vkCmdBindVertexBuffers(h->commands, 0, 1, &pass->vertices->buffer, &start);
        vkCmdBindIndexBuffer(h->commands, pass->indices->buffer, 0, VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(h->commands, (uint32_t)(pass->indices->size / sizeof(uint32_t)), 1, 0, 0,
                         0);
    }
    vkCmdEndRendering(h->commands);
}

/* The surroundings, and after a barrier the sky behind them: of all faces, or of the view. Onto
 * what is there, or onto nothing. */
static void draw_around(struct by_hand *h, struct pass pass, bool sky, bool onto)
{
    pass.pipeline = sky ? SKY : SURROUNDINGS;
    pass.color_load = onto ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    pass.depth_load = onto ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    pass.push_size = sizeof(struct surroundings_push);
    pass.vertices = sky ? NULL : &h->params.uploaded->surroundings.vertices;
    pass.indices = &h->params.uploaded->surroundings.indices;
    draw_pass(h, &pass);
}

static void draw_cube(struct by_hand *h, const struct frame_view *view)
{
    for (uint32_t i = 0; i < 2 * FACE_COUNT; i++) {
        const uint32_t face = i % FACE_COUNT;
        const struct surroundings_push push = frame_view_face(view, face);
        if (i == FACE_COUNT)
            after_drawing(h, NULL, 0);
        draw_around(h,
                    (struct pass){ .size = by_hand_size(h, CUBE),
                                   .colors = { h->faces[CUBE][face] },
                                   .depth = h->faces[CUBE_DEPTH][face],
                                   .push = &push },
                    i >= FACE_COUNT, i >= FACE_COUNT);
    }
}

static void draw_view(struct by_hand *h, const struct surroundings_push *push)
{
    const struct pass pass = { .size = by_hand_size(h, COLOR),
                               .colors = { h->views[COLOR] },
                               .depth = h->views[DEPTH],
                               .push = push };
    draw_around(h, pass, false, true);
    after_drawing(h, NULL, 0);
    draw_around(h, pass, true, true);
}

static void draw_ice(struct by_hand *h)
{
    static const uint32_t read[] = { CUBE, NORMAL };
    const VkExtent2D size = by_hand_size(h, COLOR);
    const struct uploaded_scene *scene = h->params.uploaded;
    draw_pass(h, &(struct pass){ .pipeline = BACK_NORMAL,
                                 .size = size,
                                 .colors = { h->views[NORMAL] },
                                 .depth = h->views[NORMAL_DEPTH],
                                 .color_load = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                 .depth_load = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                 .vertices = &scene->object.vertices,
                                 .indices = &scene->object.indices });
    after_drawing(h, read, 2);
    draw_pass(h, &(struct pass){ .pipeline = PAPER,
                                 .size = size,
                                 .colors = { h->views[COLOR], h->views[HIGHLIGHT] },
                                 .depth = h->views[DEPTH],
                                 .color_load = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                 .depth_load = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                 .push = settings_of(h->params.settings, &refract_paper_settings),
                                 .push_size = sizeof(struct refract_paper_params),
                                 .vertices = &scene->object.vertices,
                                 .indices = &scene->object.indices });
}

static void draw_screen(struct by_hand *h)
{
    const struct tonemap_params push = tonemap_params_of(h->params.settings);
    draw_pass(h, &(struct pass){ .pipeline = TONEMAP,
                                 .size = by_hand_size(h, SCREEN),
                                 .colors = { h->views[SCREEN] },
                                 .color_load = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                 .push = &push,
                                 .push_size = sizeof(push) });
}

/* ---- frames ---- */

static void begin(struct by_hand *h)
{
    VK(vkBeginCommandBuffer(
        h->commands,
        &(VkCommandBufferBeginInfo){ .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO }));
}

static void finish(struct by_hand *h)
{
    VK(vkEndCommandBuffer(h->commands));
    const VkCommandBufferSubmitInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = h->commands,
    };
    const VkSubmitInfo2 info = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &commands,
    };
    VK(vkQueueSubmit2(h->params.gpu->queue, 1, &info, h->fence));
    VK(vkWaitForFences(h->device, 1, &h->fence, VK_TRUE, UINT64_MAX));
    VK(vkResetFences(h->device, 1, &h->fence));
}

void by_hand_draw(struct by_hand *h)
{
    static const uint32_t read[] = { COLOR };
    const struct frame_view view = {
        .scene = h->params.scene,
        .settings = h->params.settings,
        .camera = h->params.camera,
        .width = h->params.width,
        .height = h->params.height,
        .face_size = frame_env_cube.width,
    };
    const struct surroundings_push push = frame_view_push(&view);
    const struct globals globals = frame_view_globals(&view, &push);
    memcpy(h->mapped[0], &globals, sizeof(globals));
    begin(h);
    before_drawing(h);
    draw_cube(h, &view);
    draw_ice(h);
    after_drawing(h, NULL, 0);
    draw_view(h, &push);
    after_drawing(h, read, 1);
    draw_screen(h);
    finish(h);
}

void by_hand_fetch(struct by_hand *h, uint32_t count)
{
    begin(h);
    for (uint32_t i = 0; i < count; i++) {
        if (i)
            after_drawing(h, NULL, 0);
        draw_screen(h);
    }
    finish(h);
}

const uint8_t *by_hand_picture(struct by_hand *h)
{
    begin(h);
    vkCmdPipelineBarrier2(h->commands,
                          &(VkDependencyInfo){
                              .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                              .imageMemoryBarrierCount = 1,
                              .pImageMemoryBarriers =
                                  &(VkImageMemoryBarrier2){
                                      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                      .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                      .dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT,
                                      .oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                      .newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                      .image = h->images[SCREEN],
                                      .subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 },
                                  },
                          });
    vkCmdCopyImageToBuffer(h->commands, h->images[SCREEN], VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           h->buffers[1], 1,
                           &(VkBufferImageCopy){
                               .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 },
                               .imageExtent = { h->params.width, h->params.height, 1 },
                           });
    finish(h);
    return h->mapped[1];
}
