/*
 * Bytes become the code of one shader of a row: the first byte chooses the stage. Whatever the code
 * says, rg_compile() finds faults or makes a plan, and reads nothing beyond it.
 */
#include "graph/rg.h"
#include "tests/fuzz/fuzz.h"

static void record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

static const struct rg_image target = { "target", VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image source = { "source", VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image depth = { "depth", VK_FORMAT_D32_SFLOAT };
static const struct rg_image stored = { "stored", VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_shader any = { .name = "any" };
static const VkVertexInputAttributeDescription attribute = { 0, 0, VK_FORMAT_R32G32_SFLOAT, 0 };
static const struct rg_vertex_layout vertices = { 8, 1, &attribute };
static const struct rg_use uses[] = {
    { .image = &source, .access = RG_SAMPLED, .binding = 0 },
    { .image = &stored, .access = RG_STORAGE_WRITE, .binding = 1 },
    { 0 },
};
static const struct rg_target targets[] = { { &target, RG_LOAD_CLEAR } };

/* Both stages of a raster pass have the code, which may have an entry point for each. */
static struct rg_pass row(uint8_t stage, const struct rg_shader *shader)
{
    struct rg_pass pass = { .name = "pass", .record = record, .push_size = 8, .uses = uses };
    if (stage % 3 == 2) {
        pass.kind = RG_COMPUTE;
        pass.comp = shader;
        return pass;
    }
    pass.vert = shader;
    pass.vertices = &vertices;
    if (stage % 3) {
        pass.frag = shader;
        pass.color = targets;
        pass.color_count = 1;
    } else {
        pass.depth = (struct rg_target){ &depth, RG_LOAD_CLEAR };
    }
    return pass;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const size_t count = size ? (size - 1) / sizeof(uint32_t) : 0;
    uint32_t *words = malloc(count * sizeof(*words) + 1);
    FUZZ_CHECK(words != NULL);
    if (count)
        memcpy(words, data + 1, count * sizeof(*words));
    const struct rg_shader shader = { "fuzzed", words, count };
    const struct rg_pass pass = row(size ? data[0] : 0, count ? &shader : &any);
    const struct rg_technique technique = { "fuzzed", &pass, 1 };
    const struct rg_technique *const techniques[] = { &technique };
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .techniques = techniques,
        .technique_count = 1,
        .view = { 16, 16 },
        .imports = &(struct rg_import){ .image = &source, .access = RG_SAMPLED },
        .import_count = 1,
        .outputs = &(struct rg_output){ .image = &stored, .access = RG_SAMPLED },
        .output_count = 1,
    });
    FUZZ_CHECK(plan != NULL);
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        FUZZ_CHECK(rg_fault_text(&plan->faults[i], text, sizeof(text)) > 0);
    }
    rg_plan_destroy(plan);
    free(words);
    return 0;
}
