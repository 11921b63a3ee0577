/*
 * test_bvh_cache.c: cached BVH topologies: round trip through a file, and rejection of invalid
 * files.
 */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "src/base/disk_cache.h"
#include "src/scene/bvh/bvh_topology_cache.h"
#include "src/scene/bvh/bvh_two_level.h"
#include "tests/support/assertions.h"

enum {
    TRIANGLES = 300,
    GROUPS = 3,
    WORDS = 3 * TRIANGLES,
};

/* A part of three groups of triangles. */
struct sample {
    struct model model;
    struct bvh_part part;
    uint32_t triangles[WORDS], firsts[GROUPS + 1];
};

static void begin(struct sample *sample, uint32_t group_count)
{
    *sample = (struct sample){ .model = { .materials = NULL } };
    assert_true(generate_teapot(&sample->model.object, TRIANGLES));
    assert_true(sample->model.object.index_count / 3 >= TRIANGLES);
    for (uint32_t i = 0; i < TRIANGLES; i++)
        sample->triangles[i] = i;
    for (uint32_t i = 0; i <= group_count; i++)
        sample->firsts[i] = i == group_count ? TRIANGLES : 70 * i * i;
    sample->part = (struct bvh_part){ .model = &sample->model,
                                      .mesh = &sample->model.object,
                                      .triangles = sample->triangles,
                                      .count = TRIANGLES,
                                      .firsts = sample->firsts,
                                      .group_count = group_count,
                                      .is_object = true };
}

static struct bvh_two_level make(const struct sample *sample)
{
    struct bvh_two_level shape;
    struct bvh_build_stats work = { .threads = 1 };
    assert_true(bvh_two_level_build(&shape, &sample->part, &work));
    shape.builder.boxes = malloc(TRIANGLES * sizeof(*shape.builder.boxes));
    assert_non_null(shape.builder.boxes);
    for (uint32_t i = 0; i < TRIANGLES; i++)
        shape.builder.boxes[i] = bvh_triangle_box(&sample->part, i);
    return shape;
}

/* Makes a shape forget its trees. */
static void forget(struct bvh_two_level *shape)
{
    for (uint32_t i = 0; i < TRIANGLES; i++)
        shape->builder.order[i] = i;
    memset(shape->builder.nodes, 0x5a, shape->node_count * sizeof(*shape->builder.nodes));
}

static void check_same(const struct bvh_builder *a, uint32_t at, const struct bvh_builder *b,
                       uint32_t other)
{
    const struct bvh_node *node = &a->nodes[at], *same = &b->nodes[other];
    for (int k = 0; k < 3; k++) { /* 0 may be -0 */
        assert_true(node->box.low[k] == same->box.low[k]);
        assert_true(node->box.high[k] == same->box.high[k]);
    }
    assert_int_equal(node->first, same->first);
    assert_int_equal(node->count, same->count);
    assert_int_equal(!node->children[0], !same->children[0]);
    for (int i = 0; i < 2 && node->children[0]; i++)
        check_same(a, node->children[i], b, same->children[i]);
}

static void check_all_same(const struct bvh_two_level *a, const struct bvh_two_level *b)
{
    assert_memory_equal(a->builder.order, b->builder.order, TRIANGLES * sizeof(*a->builder.order));
    for (uint32_t i = 0; i < a->group_count; i++)
        check_same(&a->builder, a->groups[i].root, &b->builder, b->groups[i].root);
}

/* Gives a test a cache of its own; its name is in *state. */
static int set_up(void **state)
{
    static char folder[32];
    snprintf(folder, sizeof(folder), "/tmp/firn-test-XXXXXX");
    *state = folder;
    return mkdtemp(folder) && !setenv("XDG_CACHE_HOME", folder, 1) ? 0 : -1;
}

static const char *path_of(const char *folder, uint64_t key)
{
    static char path[96];
    snprintf(path, sizeof(path), "%s/firn/tree-%016llx", folder, (unsigned long long)key);
    return path;
}

static int tear_down(void **state)
{
    char inner[64];
    snprintf(inner, sizeof(inner), "%s/firn", (const char *)*state);
    unsetenv("XDG_CACHE_HOME");
    return rmdir(inner) || rmdir(*state); /* nothing else was left */
}

static size_t read_file(const char *path, uint8_t *data, size_t size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t got = fread(data, 1, size, file);
    fclose(file);
    return got;
}

static void write_file(const char *path, const uint8_t *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void test_round_trip(void **state)
{
    for (uint32_t group_count = 1; group_count <= GROUPS; group_count += GROUPS - 1) {
        struct sample sample;
        begin(&sample, group_count);
        struct bvh_two_level shape = make(&sample), other = make(&sample);
        const uint64_t key = bvh_cache_key(&sample.part);
        assert_false(bvh_cache_load(&shape, key)); /* there is none yet */
        bvh_cache_save(&shape, key);
        forget(&other);
        assert_true(bvh_cache_load(&other, key));
        check_all_same(&shape, &other);
        assert_false(bvh_cache_load(&other, key ^ 1));
        assert_int_equal(remove(path_of(*state, key)), 0);
        bvh_two_level_finish(&shape);
        bvh_two_level_finish(&other);
        model_finish(&sample.model);
    }
}

static void test_damage(void **state)
{
    uint8_t data[sizeof(uint64_t) + WORDS * sizeof(uint32_t) + DISK_CACHE_HASH_SIZE + 1] = { 0 };
    struct sample sample;
    begin(&sample, GROUPS);
    struct bvh_two_level shape = make(&sample), other = make(&sample);
    const uint64_t key = bvh_cache_key(&sample.part);
    char path[96];
    snprintf(path, sizeof(path), "%s", path_of(*state, key));
    bvh_cache_save(&shape, key);
    const size_t size = read_file(path, data, sizeof(data) - 1);
    forget(&other);
    for (size_t i = 0; i < size; i += i < 16 || i + 16 > size ? 1 : 37) {
        data[i] ^= 0x10;
        write_file(path, data, size);
        assert_false(bvh_cache_load(&other, key));
        data[i] ^= 0x10;
    }
    for (size_t cut = 0; cut < size; cut += cut < 20 ? 1 : 68) {
        write_file(path, data, cut);
        assert_false(bvh_cache_load(&other, key));
    }
    write_file(path, data, size + 1);
    assert_false(bvh_cache_load(&other, key));
    for (uint32_t i = 0; i < TRIANGLES; i++)
        assert_int_equal(other.builder.order[i], i);
    write_file(path, data, size);
    assert_true(bvh_cache_load(&other, key));
    check_all_same(&shape, &other);
    assert_int_equal(rename(path, path_of(*state, key ^ 1)), 0); /* the file of another mesh */
    assert_false(bvh_cache_load(&other, key ^ 1));
    assert_int_equal(remove(path_of(*state, key ^ 1)), 0);
    bvh_two_level_finish(&shape);
    bvh_two_level_finish(&other);
    model_finish(&sample.model);
}

/* Words that no hash protects: of the trees of two groups, with 5 and 1 triangles. */
static void test_lies(void **state)
{
    (void)state;

    static const struct {
        uint32_t words[12], count;
        bool is_sound;
    } cases[] = {
        { { 4, 0, 1, 2, 3, 5, 2, 0, 0, 0 }, 10, true },  /* 2 and 3, 1 */
        { { 4, 0, 1, 2, 3, 5, 2, 0, 0, 0 }, 9, false },  /* ends early */
        { { 4, 0, 1, 2, 3, 5, 0, 0 }, 8, false },        /* a leaf of 5 */
        { { 4, 0, 1, 2, 3, 5, 5, 0, 0, 0 }, 10, false }, /* a child of all, one of none */
        { { 4, 0, 1, 2, 3, 5, 5, 2, 0, 0, 0, 0 }, 12, false },
        { { 4, 0, 1, 2, 3, 5, 9, 0, 0, 0 }, 10, false },
        { { 4, 0, 1, 2, 3, 5, 2, 0, 0, 0, 0 }, 11, false }, /* ends late */
        { { 4, 0, 1, 2, 3, 5, UINT32_MAX, 0, 0, 0 }, 10, false },
        { { 4, 0, 1, 2, 3, 5, 1, 0, 0, 0 }, 10, true },
        { { 4, 0, 1, 2, 3, 5, 1, 0, 0, 1 }, 10, false }, /* half of a triangle */
        { { 4, 0, 1, 2, 3, 5, 1, 0, 0, 0 }, 6, false },  /* no nodes */
        { { 4, 0, 1, 2, 3 }, 5, false },                 /* not even an order */
        { { 4, 0, 1, 2, 0, 5, 2, 0, 0, 0 }, 10, false }, /* twice */
        { { 4, 0, 1, 2, 5, 3, 2, 0, 0, 0 }, 10, false }, /* of the other group */
        { { 4, 0, 1, 2, 6, 5, 2, 0, 0, 0 }, 10, false }, /* of no group */
        { { 4, 0, 1, 2, UINT32_MAX, 5, 2, 0, 0, 0 }, 10, false },
    };
    struct bvh_box boxes[6] = { { { 0.0f }, { 1.0f } } };
    struct bvh_range groups[2] = { { 0, 5, 1 }, { 5, 1, 11 } };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        uint32_t order[6] = { 0, 1, 2, 3, 4, 5 };
        struct bvh_node nodes[13] = { 0 };
        struct bvh_two_level shape = {
            { boxes, order, nodes, BVH_LEAF_MAX }, groups, 6, 2, 13, 0, 3
        };
        if (bvh_cache_decode(&shape, cases[i].words, cases[i].count) != cases[i].is_sound)
            fail_msg("case %zu", i);
        for (uint32_t k = 0; k < 6; k++)
            assert_int_equal(order[k], cases[i].is_sound ? cases[i].words[k] : k);
        shape.depth = 1; /* ways of one node */
        assert_false(bvh_cache_decode(&shape, cases[i].words, cases[i].count));
    }
}

/* All that decides a tree decides the key. */
static void test_key(void **state)
{
    (void)state;
    struct sample sample;
    begin(&sample, GROUPS);
    const uint64_t key = bvh_cache_key(&sample.part);
    assert_int_equal(key, bvh_cache_key(&sample.part));
    struct mesh *mesh = &sample.model.object;
    const uint32_t spare = mesh->vertex_count;
    mesh->vertices = realloc(mesh->vertices, (spare + 1) * sizeof(*mesh->vertices));
    assert_non_null(mesh->vertices);
    for (uint32_t k = 0; k < 9; k++) { /* each coordinate of each corner of one triangle alone */
        uint32_t *corner = &mesh->indices[3 * (TRIANGLES / 2) + k / 3];
        const uint32_t vertex = *corner;
        mesh->vertices[spare] = mesh->vertices[vertex];
        mesh->vertices[spare].position.raw[k % 3] += 1e-3f;
        *corner = spare;
        assert_true(key != bvh_cache_key(&sample.part));
        *corner = vertex;
    }
    sample.firsts[1]++;
    assert_true(key != bvh_cache_key(&sample.part));
    sample.firsts[1]--;
    sample.triangles[0] = 1;
    sample.triangles[1] = 0;
    assert_true(key != bvh_cache_key(&sample.part));
    sample.triangles[0] = 0;
    sample.triangles[1] = 1;
    assert_true(key == bvh_cache_key(&sample.part));
    model_finish(&sample.model);
}

/* The files that were used longest ago go first; others stay. */
static void test_trim(void **state)
{
    const char *folder = *state;
    static const char *const names[] = { "tree-a", "tree-b", "tree-c", "other" };
    char path[4][64];
    for (int i = 0; i < 4; i++) {
        uint8_t data[100 + DISK_CACHE_HASH_SIZE] = { 0 };
        disk_cache_write(names[i], data, 100);
        snprintf(path[i], sizeof(path[i]), "%s/firn/%s", folder, names[i]);
        const struct timespec times[2] = { { 1000 - i, 0 }, { 1000 - i, 0 } };
        assert_int_equal(utimensat(AT_FDCWD, path[i], times, 0), 0);
    }
    disk_cache_evict("tree-", (uint64_t)2 * (100 + DISK_CACHE_HASH_SIZE));
    assert_int_equal(remove(path[0]), 0);
    assert_int_equal(remove(path[1]), 0);
    assert_int_not_equal(remove(path[2]), 0);
    assert_int_equal(remove(path[3]), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_round_trip, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_damage, set_up, tear_down),
        cmocka_unit_test(test_lies),
        cmocka_unit_test(test_key),
        cmocka_unit_test_setup_teardown(test_trim, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
