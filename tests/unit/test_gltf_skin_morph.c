/*
 * test_gltf_skin_morph.c: animations, skins and morph targets of glTF, against values computed by
 * hand.
 */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "tests/support/assertions.h"
#include "tests/support/gltf_file.h"
#include "tests/support/temporary_folder.h"

static const float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

/* Loads m.gltf at a time of animation `name`. */
static struct model load(const char *name, float time)
{
    const struct model_pose pose = { .animation = name, .time = time };
    struct model model;
    assert_int_equal(model_load_posed(&model, "m.gltf", MODEL_SURROUNDINGS, &pose), STATUS_OK);
    return model;
}

/* The position of a corner of the triangle at a time. */
static void check_corner(const char *name, float time, int corner, float x, float y, float z)
{
    struct model model = load(name, time);
    const struct mesh *mesh = &model.surroundings;
    const vec3s p = mesh->vertices[mesh->indices[corner]].position;
    if (!(glms_vec3_distance(p, (vec3s){ { x, y, z } }) < 1e-5F))
        fail_msg("%s at %g: corner %d at %g %g %g", name ? name : "rest", (double)time, corner,
                 (double)p.x, (double)p.y, (double)p.z);
    model_finish(&model);
}

/* A triangle whose node has two animations. Accessors: 0 positions, 1 times, 2 values; 3 turns. */
static void write_moving(const char *interpolation, const float *values, uint32_t count)
{
    const float times[2] = { 1, 3 };
    const float turns[8] = { 0, 0, 0, 1, 0, 0, sqrtf(0.5F), sqrtf(0.5F) };
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_floats(times, 2, "SCALAR");
    gltf_file_floats(values, count, "VEC3");
    gltf_file_floats(turns, 2, "VEC4");
    gltf_file_write("'nodes':[{'mesh':0,'translation':[0,0,7]}],'meshes':[{'primitives':[{"
                    "'attributes':{'POSITION':0}}]}],'animations':[{'name':'slide','samplers':[{"
                    "'input':1,'output':2,'interpolation':'%s'}],'channels':[{'sampler':0,'target':"
                    "{'node':0,'path':'translation'}}]},{'samplers':[{'input':1,'output':3}],"
                    "'channels':[{'sampler':0,'target':{'node':0,'path':'rotation'}}]},{'samplers':"
                    "[{'input':1,'output':2,'interpolation':'%s'}],'channels':[{'sampler':0,"
                    "'target':{'node':0,'path':'scale'}}]}]",
                    interpolation, interpolation);
}

static void nodes_move(void **state)
{
    (void)state;
    const float ends[6] = { 2, 0, 0, 4, 8, 0 };
    write_moving("LINEAR", ends, 2);
    check_corner(NULL, 2, 0, 0, 0, 7);
    check_corner("slide", 0, 0, 2, 0, 0);
    check_corner("slide", 1.5F, 0, 2.5F, 2, 0);
    check_corner("0", 9, 0, 4, 8, 0);
    /* half of a quarter turn about +Z */
    check_corner("1", 2, 1, sqrtf(0.5F), sqrtf(0.5F), 7);
    /* a quarter of it: an angle, not a straight line between the quaternions */
    check_corner("1", 1.5F, 1, cosf(GLM_PIf / 8), sinf(GLM_PIf / 8), 7);
    check_corner("2", 2, 1, 3, 0, 7); /* scaled by 3 and 4 */
    check_corner("2", 2, 2, 0, 4, 7);
    write_moving("STEP", ends, 2);
    check_corner("slide", 2.9F, 0, 2, 0, 0);
    check_corner("slide", 3, 0, 4, 8, 0);
    /* tangents of 1 and -3; half way: (2 + 4) / 2 + 2 s (1 + 3) / 8 */
    const float cubic[18] = { 0, 0, 0, 2, 0, 0, 1, 0, 0, -3, 0, 0, 4, 8, 0, 0, 0, 0 };
    write_moving("CUBICSPLINE", cubic, 6);
    check_corner("slide", 2, 0, 4, 4, 0);
    check_corner("slide", 3, 0, 4, 8, 0);
}

/* As KHR_animation_pointer has them: they move what is no node. */
static void channels_without_nodes_are_skipped(void **state)
{
    (void)state;
    const float times[2] = { 0, 1 };
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_floats(times, 2, "SCALAR");
    gltf_file_write("'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]"
                    "}],'animations':[{'samplers':[{'input':1,'output':1}],'channels':[{'sampler':"
                    "0,'target':{'path':'pointer','extensions':{'KHR_animation_pointer':{'pointer':"
                    "'/materials/0/alphaCutoff'}}}}]}]");
    check_corner("0", 0.5F, 1, 1, 0, 0);
}

static void animations_are_checked(void **state)
{
    (void)state;
    const float ends[6] = { 2, 0, 0, 4, 8, 0 };
    struct model model;
    write_moving("LINEAR", ends, 2);
    static const char *const names[] = { "slip", "3", "-1", "" };
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        const struct model_pose pose = { .animation = names[i] };
        assert_int_equal(model_load_posed(&model, "m.gltf", MODEL_OBJECT, &pose), STATUS_DATA);
    }
    write_moving("LINEAR", ends, 1); /* one value of two: the channel is left out */
    check_corner("slide", 2, 0, 0, 0, 7);
    write_moving("ROUND", ends, 2);
    check_corner("slide", 2, 0, 0, 0, 7);
}

/* Writes a node that moves along X, and has the keyframes (time, x). */
static void write_keys(const char *interpolation, const float (*keys)[2], uint32_t count)
{
    float times[4], xs[36] = { 0 };
    const bool is_cubic = strcmp(interpolation, "CUBICSPLINE") == 0;
    for (uint32_t i = 0; i < count; i++) {
        times[i] = keys[i][0];
        xs[is_cubic ? 9 * i + 3 : 3 * i] = keys[i][1];
    }
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_floats(times, count, "SCALAR");
    gltf_file_floats(xs, is_cubic ? 3 * count : count, "VEC3");
    gltf_file_write("'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]"
                    "}],'animations':[{'samplers':[{'input':1,'output':2,'interpolation':'%s'}],"
                    "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]}]",
                    interpolation);
}

/* A repeated time is a step; a decreasing one replaces the keyframes at later times. */
static void later_keys_count(void **state)
{
    (void)state;
    static const float repeated[4][2] = { { 0, 0 }, { 1, 10 }, { 1, 20 }, { 2, 30 } };
    static const float decreasing[4][2] = { { 0, 0 }, { 1.5F, 10 }, { 1, 20 }, { 2, 30 } };
    write_keys("LINEAR", repeated, 4);
    check_corner("0", 0.5F, 0, 5, 0, 0);
    check_corner("0", 1, 0, 20, 0, 0);
    check_corner("0", 1.5F, 0, 25, 0, 0);
    write_keys("CUBICSPLINE", repeated, 4);
    check_corner("0", 0.5F, 0, 5, 0, 0);
    check_corner("0", 1, 0, 20, 0, 0);
    write_keys("LINEAR", decreasing, 4);
    check_corner("0", 0.5F, 0, 10, 0, 0);
    check_corner("0", 1.5F, 0, 25, 0, 0);
    write_keys("STEP", repeated, 1);
    check_corner("0", 0.5F, 0, 0, 0, 0);
}

static void morph_targets(void **state)
{
    (void)state;
    const float lift[9] = { 0, 0, 1, 0, 0, 2, 0, 0, 3 };
    const float times[2] = { 0, 1 };
    const float weights[4] = { 0, 0, 1, 10 };
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_floats(lift, 3, "VEC3");
    gltf_file_floats(times, 2, "SCALAR");
    gltf_file_floats(weights, 4, "SCALAR");
    gltf_file_write("'nodes':[{'mesh':0}],'meshes':[{'weights':[0.5,0],'primitives':[{'attributes':"
                    "{'POSITION':0},'targets':[{'POSITION':1},{'POSITION':0}]}]}],"
                    "'animations':[{'samplers':[{'input':2,'output':3}],'channels':[{'sampler':0,"
                    "'target':{'node':0,'path':'weights'}}]}]");
    check_corner(NULL, 0, 1, 1, 0, 1);
    check_corner("0", 0.5F, 1, 6, 0, 1); /* 1 + 5 in x, and half of the lift */
    check_corner("0", 1, 2, 0, 11, 3);
}

/* Joints: node 1 at (10 0 0) within node 2 at (0 0 5); the mesh's node is far away, which does not
 * count. Corners 0 and 1 belong to joint 0, and corner 2 to both. */
static void write_skin(const char *matrices, uint8_t joint)
{
    const uint8_t joints[12] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, joint, 0, 0 };
    const float weights[12] = { 1, 0, 0, 0, 1, 0, 0, 0, 3, 3, 0, 0 }; /* to be normalised */
    float inverse[32] = { 0 };
    for (int i = 0; i < 32; i += i % 16 == 15 ? 1 : 5)
        inverse[i] = 1;
    inverse[12] = -10; /* of joint 0: back from (10 0 0) */
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_add(joints, sizeof(joints), GLTF_FILE_UNSIGNED_BYTE, 3, "VEC4");
    gltf_file_floats(weights, 3, "VEC4");
    gltf_file_floats(inverse, 2, "MAT4");
    gltf_file_write("'scenes':[{'nodes':[0,2]}],'nodes':[{'mesh':0,'skin':0,'translation':[99,0,0]}"
                    ",{'translation':[10,0,0]},{'translation':[0,0,5],'children':[1]}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':1,"
                    "'WEIGHTS_0':2}}]}],'skins':[{'joints':[1,2]%s}]",
                    matrices);
}

static void skins(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    write_skin("", 1);
    check_corner(NULL, 0, 1, 11, 0, 5);
    check_corner(NULL, 0, 2, 5, 1, 5);
    assert_int_equal(gltf_file_load(&model, said), STATUS_OK);
    assert_non_null(strstr(said, "skin weights whose sum is not 1"));
    model_finish(&model);
    write_skin(",'inverseBindMatrices':3", 1);
    check_corner(NULL, 0, 1, 1, 0, 5);
    check_corner(NULL, 0, 2, 0, 1, 5);
    write_skin("", 2);
    assert_int_equal(gltf_file_load(&model, said), STATUS_DATA);
    assert_non_null(strstr(said, "the skin has only 2 joints"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nodes_move, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(channels_without_nodes_are_skipped, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(animations_are_checked, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(later_keys_count, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(morph_targets, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(skins, temporary_folder_enter, temporary_folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
