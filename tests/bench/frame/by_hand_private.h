/* by_hand_private.h: what the files of by_hand share. */
#ifndef BENCH_BY_HAND_PRIVATE_H
#define BENCH_BY_HAND_PRIVATE_H

#include "tests/bench/frame/by_hand.h"
#include "tests/support/assertions.h"

enum {
    CUBE, /* images, and views of all of them */
    CUBE_DEPTH,
    COLOR,
    DEPTH,
    NORMAL,
    NORMAL_DEPTH,
    HIGHLIGHT,
    SCREEN,
    IMAGE_COUNT,
    SURROUNDINGS = 0, /* pipelines */
    SKY,
    BACK_NORMAL,
    PAPER,
    TONEMAP,
    PIPELINE_COUNT,
    BINDING_COUNT = 3,
    FACE_COUNT = 6,
};

enum {
    NEAREST,
    LINEAR,
    AROUND,   /* wraps around horizontally, mips */
    TEXTURES, /* repeats, mips, anisotropic */
    SAMPLER_COUNT,
};

#define VK(call) assert_int_equal((call), VK_SUCCESS)

struct pipeline {
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorSet set;
};

struct by_hand {
    struct by_hand_params params;
    VkDevice device;
    VkImage images[IMAGE_COUNT];
    VkDeviceMemory memory[IMAGE_COUNT];
    VkImageView views[IMAGE_COUNT];
    VkImageView faces[2][FACE_COUNT]; /* of CUBE and CUBE_DEPTH, to draw to */
    VkImageView imported[2];          /* environment, textures */
    VkSampler samplers[SAMPLER_COUNT];
    VkBuffer buffers[2]; /* globals; the picture brought back */
    VkDeviceMemory buffer_memory[2];
    void *mapped[2];
    VkDescriptorPool descriptors;
    struct pipeline pipelines[PIPELINE_COUNT];
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    uint32_t object_count, surroundings_count; /* indices */
};

struct image_row {
    VkFormat format;
    uint32_t layers;
    VkImageUsageFlags usage;
};

extern const struct image_row by_hand_images[IMAGE_COUNT];

struct binding {
    uint32_t number;
    uint32_t sampler;  /* with an image; the globals otherwise */
    VkImageView image; /* VK_NULL_HANDLE: the globals */
};

struct pipeline_row {
    const struct rg_shader *vert, *frag;
    bool mesh;
    VkCullModeFlags cull;
    uint32_t push_size;
    VkCompareOp compare; /* NEVER (0): no depth */
    bool reads_depth;
    uint32_t colors[2]; /* images; the second may be 0, which is none's */
    struct binding bindings[BINDING_COUNT];
    uint32_t binding_count;
};

VkExtent2D by_hand_size(const struct by_hand *h, uint32_t image);
VkImageView by_hand_view(const struct by_hand *h, VkImage image, VkFormat format,
                         VkImageViewType type, uint32_t layer);

/* by_hand_objects.c: images and views, buffers of `globals_size` and of the picture, samplers */
void by_hand_make_objects(struct by_hand *h, VkDeviceSize globals_size);
void by_hand_free_objects(struct by_hand *h);

/* by_hand_pipeline.c: h->descriptors is there */
void by_hand_make_pipeline(struct by_hand *h, struct pipeline *p, const struct pipeline_row *row,
                           const VkSpecializationInfo *constants);
void by_hand_free_pipeline(const struct by_hand *h, const struct pipeline *p);

#endif
