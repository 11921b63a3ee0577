/* test_object_transform.c: transformed and hidden objects that share vertices. */
#include "src/scene/geometry/object_transform.h"

#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

enum {
    OBJECTS = 4
};

static const char names[] = "abaa"; /* of each object */

/* A model of triangles: object k has the vertices k, k + 1 and k + 2, which are at x = their index.
 * Its surroundings have a range of three vertices for each name. */
static struct model make_model(void)
{
    struct model model = { .object_count = OBJECTS, .surroundings_object_count = OBJECTS };
    assert_true(mesh_init(&model.object, OBJECTS + 2, 3 * OBJECTS));
    assert_true(mesh_init(&model.surroundings, 3 * OBJECTS, 3 * OBJECTS));
    model.objects = calloc(OBJECTS, sizeof(*model.objects));
    model.surroundings_starts = calloc(OBJECTS, sizeof(*model.surroundings_starts));
    model.surroundings_names = calloc(OBJECTS, sizeof(*model.surroundings_names));
    for (uint32_t v = 0; v < OBJECTS + 2; v++)
        model.object.vertices[v].position.x = (float)v;
    for (uint32_t i = 0; i < 3 * OBJECTS; i++) {
        model.object.indices[i] = i / 3 + i % 3;
        model.surroundings.indices[i] = i;
        model.surroundings.vertices[i].position.x = (float)i;
    }
    for (uint32_t k = 0; k < OBJECTS; k++) {
        model.objects[k] = (struct object){ .first_index = 3 * k, .index_count = 3 };
        model.objects[k].name[0] = names[k];
        model.surroundings_starts[k] = 3 * k;
        model.surroundings_names[k][0] = names[k];
    }
    return model;
}

static void finish(struct model *model)
{
    mesh_finish(&model->object);
    mesh_finish(&model->surroundings);
    free(model->objects);
    free(model->surroundings_starts);
    free(model->surroundings_names);
}

static void apply(struct model *model, const struct object_transform *transform)
{
    assert_int_equal(object_transform_apply(model, transform, 1, "a.gltf", true), STATUS_OK);
}

static void test_each_turns_about_its_own_centre(void **state)
{
    (void)state;
    struct model model = make_model();
    const struct object_transform half_turn = { .name = "a",
                                                .rotate_deg = { { 0, 180, 0 } },
                                                .scale = 2 };
    apply(&model, &half_turn);
    for (uint32_t i = 0; i < 3 * OBJECTS; i++) {
        const float k = (float)(i / 3), side = (float)(i % 3) - 1;
        const float factor = names[i / 3] == 'a' ? -2.0F : 1.0F;
        const struct mesh *object = &model.object, *other = &model.surroundings;
        CHECK_NEAR(object->vertices[object->indices[i]].position.x, k + 1 + factor * side, 1e-5);
        CHECK_NEAR(other->vertices[other->indices[i]].position.x, 3 * k + 1 + factor * side, 1e-5);
    }
    const struct box box = mesh_box(&model.object); /* no vertex is left behind */
    CHECK_NEAR(box.min.x, -1, 1e-5);
    CHECK_NEAR(box.max.x, 6, 1e-5);
    finish(&model);
}

static void test_hidden_objects(void **state)
{
    (void)state;
    struct model model = make_model();
    apply(&model, &(struct object_transform){ .name = "a", .is_hidden = true });
    assert_int_equal(model.object_count, 1);
    assert_int_equal(model.objects[0].name[0], 'b');
    assert_int_equal(model.objects[0].first_index, 0);
    assert_int_equal(model.object.index_count, 3);
    assert_int_equal(model.surroundings.index_count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(model.object.indices[i], i + 1);
        assert_int_equal(model.surroundings.indices[i], i + 3);
    }
    CHECK_NEAR(mesh_box(&model.object).min.x, 1, 0);
    CHECK_NEAR(mesh_box(&model.object).max.x, 3, 0);
    finish(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_turns_about_its_own_centre),
        cmocka_unit_test(test_hidden_objects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
