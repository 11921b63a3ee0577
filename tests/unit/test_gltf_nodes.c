/*
 * test_gltf_nodes.c: nodes of glTF files: cameras, lights, their animations, and names that make
 * meshes refractive.
 */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "src/scene/model_transform.h"
#include "tests/support/assertions.h"
#include "tests/support/gltf_file.h"
#include "tests/support/temporary_folder.h"

static const float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

/* Writes a triangle in node 0, and further nodes of the scene and members of the top. */
static void write_nodes(const char *nodes, const char *more)
{
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_write("'nodes':[{'mesh':0},%s],'meshes':[{'primitives':[{'attributes':{"
                    "'POSITION':0}}]}]%s",
                    nodes, more);
}

/* ---- cameras ---- */

#define PERSPECTIVE "{'name':'lens','type':'perspective','perspective':{'yfov':1,'znear':1}}"
#define ORTHOGRAPHIC(ymag) \
    "{'type':'orthographic','orthographic':{'xmag':1,'ymag':" ymag ",'znear':0,'zfar':9}}"

static void cameras_are_listed(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    write_nodes("{'name':'plan','camera':1,'translation':[0,0,5]},{'camera':0},"
                "{'name':'front','children':[4],'translation':[7,0,0]},"
                "{'name':'eye','camera':0,'translation':[0,1,0],'rotation':[0,1,0,0]}",
                ",'cameras':[" PERSPECTIVE "," ORTHOGRAPHIC("-3") "]");
    assert_int_equal(gltf_file_load(&model, said), STATUS_OK);
    assert_null(strstr(said, "not drawn"));
    assert_int_equal(model.camera_count, 3);
    assert_string_equal(model.cameras[0].name, "plan");
    assert_int_equal(model.cameras[0].kind, MODEL_ORTHOGRAPHIC);
    CHECK_NEAR(model.cameras[0].height, 6, 1e-6);
    CHECK_NEAR(model.cameras[0].camera.eye.z, 5, 1e-6);
    assert_string_equal(model.cameras[1].name, "lens"); /* its node has no name */
    assert_string_equal(model.cameras[2].name, "eye");
    CHECK_NEAR(model.cameras[2].camera.fov_deg, 180 / 3.14159265, 1e-4);
    assert_true(glms_vec3_distance(model.cameras[2].camera.eye, (vec3s){ { 7, 1, 0 } }) < 1e-5F);
    assert_true(model.cameras[2].camera.target.z > 0.1F); /* turned by half a turn about +Y */
    assert_true(model.has_camera);
    assert_memory_equal(&model.camera, &model.cameras[1].camera, sizeof(model.camera));
    const struct model_transform model_transform = { .is_z_up = true, .scale = 2 };
    assert_int_equal(model_transform_apply(&model, &model_transform, "m.gltf"), STATUS_OK);
    assert_true(glms_vec3_distance(model.cameras[2].camera.eye, (vec3s){ { 14, 0, -2 } }) < 1e-5F);
    CHECK_NEAR(model.cameras[0].height, 12, 1e-5);
    model_finish(&model);
}

static void cameras_are_checked(void **state)
{
    (void)state;
    static const char *const bad[] = { "0", "1e30", "1e6" };
    char said[GLTF_FILE_SAID], more[256];
    struct model model;
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
        (void)snprintf(more, sizeof(more), ",'cameras':[" ORTHOGRAPHIC("%s") "]", bad[i]);
        write_nodes("{'camera':0}", more);
        assert_int_equal(gltf_file_load(&model, said), STATUS_DATA);
        assert_non_null(strstr(said, "cameras[0]"));
    }
}

/* ---- animations ---- */

static void animations_are_listed(void **state)
{
    (void)state;
    const float times[2] = { 0, 2.5F };
    const float places[6] = { 1, 0, 0, 5, 0, 0 };
    struct model model;
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_accessor(gltf_file_view(times, sizeof(times), ""), GLTF_FILE_FLOAT, 2, "SCALAR",
                       ",'max':[2.5]");
    gltf_file_floats(places, 2, "VEC3");
    gltf_file_write(
        "'nodes':[{'mesh':0},{'camera':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}"
        "],'cameras':[" PERSPECTIVE "],'animations':[{'name':'drive','samplers':[{'input':1,"
        "'output':2}],'channels':[{'sampler':0,'target':{'node':1,'path':'translation'}}]},"
        "{'samplers':[],'channels':[]}]");
    static const struct model_pose poses[] = { { .is_first = true, .time = 1.25F },
                                               { .animation = "drive", .time = 1.25F },
                                               { .animation = "1" },
                                               { .animation = NULL } };
    static const uint32_t wanted[] = { 1, 1, 2, 0 };
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(model_load_posed(&model, "m.gltf", MODEL_OBJECT, &poses[i]), STATUS_OK);
        assert_int_equal(model.animation_count, 2);
        assert_int_equal(model.animation, wanted[i]);
        assert_string_equal(model.animations[0].name, "drive");
        assert_string_equal(model.animations[1].name, "");
        CHECK_NEAR(model.animations[0].seconds, 2.5, 1e-6);
        CHECK_NEAR(model.animations[1].seconds, 0, 0);
        CHECK_NEAR(model.camera.eye.x, i < 2 ? 3 : 0, 1e-6); /* half way from 1 to 5 */
        model_finish(&model);
    }
}

/* ---- lights ---- */

#define LIGHTS(list) ",'extensions':{'KHR_lights_punctual':{'lights':[" list "]}}"
#define LIT(number)  "'extensions':{'KHR_lights_punctual':{'light':" number "}}"

static void lights_are_listed(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    write_nodes("{'name':'sun'," LIT("0") ",'rotation':[0,1,0,0],'scale':[3,3,3]},"
                                          "{'translation':[1,2,3]," LIT(
                                              "2") "},{'name':'bulb'," LIT("1") "}",
                ",'extensionsUsed':['KHR_lights_punctual']" LIGHTS(
                    "{'type':'directional','intensity':10.5,'color':[1,0.5,0]},{'type':'point'},"
                    "{'name':'beam','type':'spot','range':9,'spot':{'innerConeAngle':0.25}}"));
    assert_int_equal(gltf_file_load(&model, said), STATUS_OK);
    assert_string_equal(said, "");
    assert_int_equal(model.light_count, 3);
    const struct light *sun = &model.lights[0], *beam = &model.lights[1], *bulb = &model.lights[2];
    assert_string_equal(sun->name, "sun");
    assert_int_equal(sun->kind, LIGHT_DIRECTIONAL);
    CHECK_NEAR(sun->intensity, 10.5, 0);
    CHECK_NEAR(sun->color.y, 0.5, 0);
    assert_true(glms_vec3_distance(sun->direction, (vec3s){ { 0, 0, 1 } }) < 1e-5F);
    assert_string_equal(beam->name, "beam");
    assert_int_equal(beam->kind, LIGHT_SPOT);
    assert_true(glms_vec3_distance(beam->position, (vec3s){ { 1, 2, 3 } }) < 1e-6F);
    CHECK_NEAR(beam->range, 9, 0);
    CHECK_NEAR(beam->inner_cone, 0.25, 0);
    CHECK_NEAR(beam->outer_cone, 3.14159265 / 4, 1e-6);
    CHECK_NEAR(beam->direction.z, -1, 1e-6);
    assert_string_equal(bulb->name, "bulb");
    assert_int_equal(bulb->kind, LIGHT_POINT);
    CHECK_NEAR(bulb->intensity, 1, 0);
    CHECK_NEAR(bulb->color.z, 1, 0);
    const struct model_transform model_transform = { .is_z_up = true, .scale = 2 };
    assert_int_equal(model_transform_apply(&model, &model_transform, "m.gltf"), STATUS_OK);
    assert_true(glms_vec3_distance(beam->position, (vec3s){ { 2, 6, -4 } }) < 1e-5F);
    assert_true(glms_vec3_distance(beam->direction, (vec3s){ { 0, -1, 0 } }) < 1e-5F);
    CHECK_NEAR(beam->range, 18, 1e-5);
    CHECK_NEAR(beam->intensity, 1, 0);
    model_finish(&model);
}

static void lights_are_checked(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "{'type':'area'}",
        "{}",
        "{'type':'point','intensity':-1}",
        "{'type':'point','color':[1,1]}",
        "{'type':'spot','spot':{'innerConeAngle':0.8}}",
        "{'type':'spot','spot':{'outerConeAngle':2}}",
    };
    char said[GLTF_FILE_SAID], more[256];
    struct model model;
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
        (void)snprintf(more, sizeof(more), LIGHTS("%s"), bad[i]);
        write_nodes("{" LIT("0") "}", more);
        assert_int_equal(gltf_file_load(&model, said), STATUS_DATA);
        assert_non_null(strstr(said, "lights[0]"));
    }
}

/* ---- objects by name ---- */

static void check_objects(const char *names, uint32_t object_triangles, uint32_t surroundings)
{
    const struct model_pose pose = { .objects = names };
    struct model model;
    assert_int_equal(model_load_posed(&model, "m.gltf", MODEL_OBJECT, &pose), STATUS_OK);
    if (model.object.index_count != 3 * object_triangles ||
        model.surroundings.index_count != 3 * surroundings)
        fail_msg("'%s': %u, %u", names ? names : "", model.object.index_count / 3,
                 model.surroundings.index_count / 3);
    model_finish(&model);
}

static void named_nodes_are_objects(void **state)
{
    (void)state;
    gltf_file_begin();
    gltf_file_floats(positions, 3, "VEC3");
    gltf_file_write("'nodes':[{'name':'cup','mesh':0},{'name':'lid','mesh':1},{'name':'wood',"
                    "'mesh':0},{'name':'tin'}],'materials':[{'name':'tin'},{'name':'wood'}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]},"
                    "{'primitives':[{'attributes':{'POSITION':0},'material':1}]}]");
    check_objects(NULL, 3, 0);
    check_objects("", 3, 0);
    check_objects("lid\n", 1, 2);
    check_objects("lid\ncup\n", 2, 1);
    check_objects("wood\n", 1, 2); /* the node, not the material */
    check_objects("tin\n", 2, 1);  /* its node has no mesh */
    static const char *const bad[] = { "cap\n", "lid\nli\n" };
    for (size_t i = 0; i < 2; i++) {
        const struct model_pose pose = { .objects = bad[i] };
        struct model model;
        assert_int_equal(model_load_posed(&model, "m.gltf", MODEL_OBJECT, &pose), STATUS_DATA);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cameras_are_listed, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(cameras_are_checked, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(animations_are_listed, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(lights_are_listed, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(lights_are_checked, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(named_nodes_are_objects, temporary_folder_enter,
                                        temporary_folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
