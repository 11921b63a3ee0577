/* profile_sample.c: a synthetic profile in which every field is set. */
#include "tests/support/profile_sample.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "tests/support/assertions.h"

static const struct {
    const char *name, *technique;
    enum profile_kind kind;
    uint32_t repetition, repetition_count, width, height;
    double ms;
} rows[] = {
    { "env_cube.objects", "env_cube", PROFILE_RASTER, 0, 2, 512, 512, 1 },
    { "env_cube.objects", "env_cube", PROFILE_RASTER, 1, 2, 512, 512, 1 },
    { "refract_paper.color", "refract_paper", PROFILE_RASTER, 0, 1, 1024, 768, 8 },
    { "wave.simulate", "wave", PROFILE_COMPUTE, 0, 1, 0, 0, 2 },
    { "copy \"quoted\" <b>", "readback", PROFILE_TRANSFER, 0, 1, 0, 0, 0.5 },
    { "record", "", PROFILE_HOST, 0, 1, 0, 0, 0.3 },
    { "submit", "", PROFILE_HOST, 0, 1, 0, 0, 0.1 },
    { "unattributed", "", PROFILE_UNATTRIBUTED, 0, 1, 0, 0, 0.1 },
};

/* Returns deterministic noise from 0.97 to 1.03 for a row of the profile and a run. */
static double spread(uint32_t row, uint32_t run)
{
    return 0.97 + 0.06 * ((row * 7 + run * 13) % 23) / 22.0;
}

static void fill_row(struct profile *p, uint32_t index, double scale)
{
    struct profile_row *row = &p->rows[index];
    assert_true(index < p->pass_count || !strcmp(row->name, rows[index].name));
    snprintf(row->name, sizeof(row->name), "%s", rows[index].name);
    snprintf(row->technique, sizeof(row->technique), "%s", rows[index].technique);
    row->kind = rows[index].kind;
    row->repetition = rows[index].repetition;
    row->repetition_count = rows[index].repetition_count;
    row->width = rows[index].width;
    row->height = rows[index].height;
    row->target_bytes = (uint64_t)row->width * row->height * 12;
    if (row->kind == PROFILE_RASTER) {
        row->vertices = 2880;
        row->triangles = 960;
        row->fragments = row->width * row->height / 2;
        row->covered = row->fragments;
    }
    for (uint32_t run = 0; run < p->run_count; run++) {
        row->ms[run] = rows[index].ms * scale * spread(index, run);
        if (run == 7 && index == 2)
            row->ms[run] *= 3;
        row->begin_ms[run] = index && index < p->pass_count
                                 ? p->rows[index - 1].begin_ms[run] + p->rows[index - 1].ms[run]
                                 : 0;
        row->record_ms[run] = index < p->pass_count ? 0.05 * scale : 0;
        p->frame[run] += row->ms[run];
        p->plain[run] = p->frame[run] * 0.98;
        p->wait[run] = p->frame[run] * 0.9;
    }
}

void profile_sample(struct profile *p, double scale)
{
    *p = (struct profile){
        .command = strdup("firn profile valley --set ice.name='a & b' --json"),
        .scene = strdup("valley"),
        .refraction = "paper",
        .material = "ice",
        .width = 1024,
        .height = 768,
        .settings = calloc(2, sizeof(struct profile_setting)),
        .setting_count = 2,
        .device = "llvmpipe (LLVM 15.0.6, 256 bits)",
        .driver = "CPU, 1.3.230, Mesa 22.3.6",
        .host = "A processor, 2 threads",
        .clock = "timestamps",
        .has_statistics = true,
        .warmup = 3,
        .run_count = SAMPLE_RUN_COUNT,
        .bvh_ms = 31,
        .bvh_triangles = 14400,
        .bvh_size = 3145728,
        .rays = 4.25,
        .rays_size = 2097152,
        .upload = 12,
        .compile = 0.05,
        .realise = 40,
        .first_frame = 90,
        .memory_used = 66060288,
        .memory_without_aliasing = 91226112,
        .memory_bound = 66060288,
        .residents = calloc(2, sizeof(struct profile_resource)),
        .resident_count = 2,
        .pass_count = SAMPLE_PASS_COUNT,
    };
    assert_true(p->command && p->scene && p->settings && p->residents);
    p->settings[0] = (struct profile_setting){ "refract.ior", "1.3091" };
    p->settings[1] = (struct profile_setting){ "tonemap.curve", "neutral" };
    p->residents[0] = (struct profile_resource){ "env_cube.color", 0, 2, 0, 0, 12582912 };
    p->residents[1] = (struct profile_resource){ "wave.height", 3, 4, 0, 0, 1048576 };
    assert_int_equal(profile_make_rows(p), STATUS_OK);
    for (uint32_t i = 0; i < p->row_count; i++)
        fill_row(p, i, scale);
}
