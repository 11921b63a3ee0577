/* fault_case.c: compiles small graphs with one fault each, and compares the faults reported. */
#include "tests/support/fault_case.h"

#include <stdio.h>
#include <string.h>

#include "tests/support/assertions.h"

const struct rg_image fault_case_picture = {
    .name = "picture",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};
const struct rg_image fault_case_other = { .name = "other", .format = VK_FORMAT_R8G8B8A8_UNORM };

static const struct rg_image pixel = {
    .name = "pixel",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
    .width = 1,
    .height = 1,
};

/* Valid passes run first, so that the compiler's fast path for repeated accesses is tested. */
static const struct rg_pass good_rows[] = {
    DRAW("fill", .color = RG_TARGETS({ CLEARED(fault_case_picture) })),
    COMPUTE("meet", { .image = &fault_case_picture, .access = RG_SAMPLED },
            { .image = &pixel, .access = RG_STORAGE_WRITE, .binding = 1 }),
    COMPUTE("read", { .image = &pixel, .access = RG_STORAGE_READ_WRITE }),
};

struct rg_plan *fault_case_compile(const struct fault_case *fc)
{
    const struct rg_technique good = RG_TECHNIQUE("good", good_rows);
    const struct rg_technique bad = {
        .name = fc->nameless_technique ? NULL : "bad",
        .passes = fc->rows,
        .pass_count = fc->row_count,
    };
    const struct rg_technique *const techniques[] = { &good, &bad };
    const struct rg_output wanted = { .image = &fault_case_picture, .access = RG_SAMPLED };
    bool own = fc->outputs[0].image || fc->outputs[0].buffer || fc->outputs[0].access;
    bool second_output = fc->outputs[1].image;
    bool import = fc->imports[0].image || fc->imports[0].buffer || fc->imports[0].access;
    bool second_import = fc->imports[1].image;
    struct rg_compile_params params = {
        .techniques = techniques,
        .technique_count = 2,
        .view = { FAULT_CASE_VIEW, fc->no_view ? 0 : FAULT_CASE_VIEW },
        .outputs = own ? fc->outputs : &wanted,
        .output_count = fc->no_output   ? 0
                        : second_output ? 2
                                        : 1,
        .imports = fc->imports,
        .import_count = second_import ? 2
                        : import      ? 1
                                      : 0,
        .device = fc->device,
    };
    if (fc->edit)
        fc->edit(&params);
    return rg_compile(&params);
}

bool fault_case_same_text(const char *a, const char *b)
{
    return a && b ? !strcmp(a, b) : a == b;
}

static void check_text(const struct rg_fault *fault)
{
    char text[512];
    const char *const names[] = { fault->technique, fault->pass, fault->resource, fault->hint };
    int length = rg_fault_text(fault, text, sizeof(text));
    assert_int_equal(length, strlen(text));
    assert_null(strchr(text, '\n'));
    assert_non_null(fault->hint);
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        assert_true(!names[i] || strstr(text, names[i]));
    char row[32];
    snprintf(row, sizeof(row), "row %u", fault->row);
    assert_true((strstr(text, row) != NULL) == (fault->row != RG_NONE));
}

static bool is_expected(const struct fault_case *fc, const struct rg_fault *fault)
{
    const char *technique = fc->row ? "bad" : NULL;
    const char *pass = fc->row ? fc->rows[fc->row_count - 1].name : NULL;
    uint32_t row = fc->row ? fc->row_count - 1 : RG_NONE;
    char text[512];
    rg_fault_text(fault, text, sizeof(text));
    if (fc->text)
        return fault->error == fc->error && !strcmp(text, fc->text);
    return fault->error == fc->error && fault_case_same_text(fault->technique, technique) &&
           fault_case_same_text(fault->pass, pass) &&
           fault_case_same_text(fault->resource, fc->resource) && fault->row == row;
}

static void check_case(const struct fault_case *fc)
{
    struct rg_plan *plan = fault_case_compile(fc);
    assert_non_null(plan);
    bool good = plan->fault_count == 1 && is_expected(fc, &plan->faults[0]);
    if (!good) {
        print_error("error %d of %s expected, found:\n", (int)fc->error,
                    fc->text       ? fc->text
                    : fc->resource ? fc->resource
                                   : "nothing");
        rg_dump(plan, stderr);
    }
    assert_true(good);
    check_text(&plan->faults[0]);
    assert_int_equal(plan->pass_count, 0);
    rg_plan_destroy(plan);
}

void fault_case_check(const struct fault_cases *tables, size_t table_count,
                      bool provoked[RG_ERROR_COUNT])
{
    for (size_t t = 0; t < table_count; t++) {
        for (size_t i = 0; i < tables[t].count; i++) {
            check_case(&tables[t].cases[i]);
            provoked[tables[t].cases[i].error] = true;
        }
    }
}
