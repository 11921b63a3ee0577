/*
 * print_plan.c: program that prints a plan, for tests that read dumps.
 *
 * print-plan FORMAT PLAN
 * FORMAT: text, json or html
 * PLAN: everything, awkward, faults, or the seed of a random graph
 */
#include <stdlib.h>
#include <string.h>
#include "tests/support/dump_plan.h"
#include "tests/support/random_graph.h"

typedef void dump_fn(const struct rg_plan *plan, FILE *out);

static dump_fn *find_format(const char *name)
{
    static const struct {
        const char *name;
        dump_fn *dump;
    } formats[] = {
        { "text", rg_dump },
        { "json", rg_dump_json },
        { "html", rg_dump_html },
    };

    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
        if (!strcmp(formats[i].name, name))
            return formats[i].dump;
    }
    return NULL;
}

static int print_random(dump_fn *dump, const char *seed)
{
    struct random_graph graph;
    if (!random_graph_init(&graph, strtoull(seed, NULL, 10), 0))
        return EXIT_FAILURE;
    struct rg_plan *plan = rg_compile(&graph.params);
    if (plan)
        dump(plan, stdout);
    int status = plan ? EXIT_SUCCESS : EXIT_FAILURE;
    rg_plan_destroy(plan);
    random_graph_finish(&graph);
    return status;
}

int main(int argc, char **argv)
{
    struct dump_plan plan;
    dump_fn *dump = argc == 3 ? find_format(argv[1]) : NULL;
    if (!dump) {
        fprintf(stderr, "usage: %s text|json|html everything|awkward|faults|SEED\n", argv[0]);
        return 2;
    }
    if (!strcmp(argv[2], "faults")) {
        dump(&dump_plan_faults, stdout);
        return EXIT_SUCCESS;
    }
    bool awkward = !strcmp(argv[2], "awkward");
    if (!awkward && strcmp(argv[2], "everything") != 0)
        return print_random(dump, argv[2]);
    dump_plan_init(&plan, awkward ? dump_plan_awkward_names : dump_plan_names);
    dump(&plan.plan, stdout);
    return EXIT_SUCCESS;
}
