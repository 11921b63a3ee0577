/* feature_acceleration_structure.c: feature graph of ray queries in an imported TLAS. */
#include "tests/support/feature_graphs.h"

static const struct rg_buffer upper = { .name = "upper", .size = 1 << 16 };
static const struct rg_buffer hits = { .name = "hits", .size_per_texel = sizeof(uint32_t) };
static const struct rg_buffer hits_out = FEATURE_NUMBERS("hits out");

static const struct rg_import import = { .buffer = &upper, .access = RG_TRACE };

static const struct rg_pass structure_rows[] = {
    {
        .name = "trace",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .buffer = &hits, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS },
                        { .buffer = &upper, .access = RG_TRACE, .binding = DATA_IMAGE }),
        .comp = &trace_comp,
        .record = feature_record_texels,
    },
    FEATURE_COPY("copy", hits, hits_out),
};

const struct feature feature_structure = {
    .name = "feature_structure",
    .params = {
        .technique = RG_TECHNIQUE("structure", structure_rows),
        .outputs = { &hits_out },
        .imports = &import,
        .import_count = 1,
    },
};
