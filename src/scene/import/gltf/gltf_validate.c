/* gltf_validate.c: validates all indices of a glTF file, even those that the scene does not use. */
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

/* Checks that all members of an attributes object are indices of existing accessors. */
static void check_attributes(const struct gltf_object *attributes)
{
    const char *key;
    json_t *value;
    /* Casts const away, since jansson iterates over mutable objects only; nothing is modified. */
    json_t *json = json_incref((json_t *)(uintptr_t)attributes->json);
    json_object_foreach(json, key, value)(void) gltf_index(attributes, key, "accessors");
    json_decref(json);
}

static void check_mesh(const struct gltf_object *mesh)
{
    const uint32_t count = gltf_length(mesh, "primitives");
    for (uint32_t i = 0; i < count && mesh->gltf->status == STATUS_OK; i++) {
        const struct gltf_object primitive = gltf_item(mesh, "primitives", i);
        const struct gltf_object attributes = gltf_member(&primitive, "attributes");
        check_attributes(&attributes);
        for (uint32_t k = 0; k < gltf_length(&primitive, "targets"); k++) {
            const struct gltf_object target = gltf_item(&primitive, "targets", k);
            check_attributes(&target);
        }
    }
}

static void check_skin(const struct gltf_object *skin)
{
    const uint32_t count = gltf_length(skin, "joints");
    for (uint32_t i = 0; i < count && skin->gltf->status == STATUS_OK; i++)
        (void)gltf_index_at(skin, "joints", i, "nodes");
    if (count == 0)
        (void)gltf_fault(skin, "expected joints");
    (void)gltf_index(skin, "inverseBindMatrices", "accessors");
    (void)gltf_index(skin, "skeleton", "nodes");
}

/* Records faults of an animation, which do not reject the file. */
static void check_animation(const struct gltf_object *animation)
{
    struct gltf *gltf = animation->gltf;
    gltf_attempt_begin(gltf, &gltf->import->channels);
    const uint32_t sampler_count = gltf_length(animation, "samplers");
    const uint32_t channel_count = gltf_length(animation, "channels");
    for (uint32_t i = 0; i < sampler_count && gltf->status == STATUS_OK; i++) {
        const struct gltf_object sampler = gltf_item(animation, "samplers", i);
        if (gltf_index(&sampler, "input", "accessors") == gltf_none ||
            gltf_index(&sampler, "output", "accessors") == gltf_none)
            (void)gltf_fault(&sampler, "expected an input and an output");
    }
    for (uint32_t i = 0; i < channel_count && gltf->status == STATUS_OK; i++) {
        const struct gltf_object channel = gltf_item(animation, "channels", i);
        const struct gltf_object target = gltf_member(&channel, "target");
        (void)gltf_index(&target, "node", "nodes");
        if (gltf_count(&channel, "sampler", sampler_count) >= sampler_count)
            (void)gltf_fault(&channel, "sampler: expected an index below %u", sampler_count);
    }
    (void)gltf_attempt_end(gltf);
}

static void check_camera(const struct gltf_object *camera)
{
    const char *type = gltf_string(camera, "type", "");
    if (strcmp(type, "perspective") != 0 && strcmp(type, "orthographic") != 0)
        (void)gltf_fault(camera, "type: expected perspective or orthographic, got \"%.16s\"", type);
    else if (!gltf_member(camera, type).json)
        (void)gltf_fault(camera, "expected %s", type);
}

static void check_light(const struct gltf_object *node)
{
    const struct gltf_object top = gltf_top(node->gltf);
    const struct gltf_object all = gltf_extension(&top, "KHR_lights_punctual");
    const struct gltf_object light = gltf_extension(node, "KHR_lights_punctual");
    const uint32_t count = gltf_length(&all, "lights");
    if (light.json && gltf_count(&light, "light", count) >= count)
        (void)gltf_fault(&light, "light: expected an index below %u", count);
}

enum status gltf_validate(struct gltf *gltf)
{
    static const struct {
        const char *list;
        void (*check)(const struct gltf_object *object);
    } lists[] = {
        { "meshes", check_mesh },    { "skins", check_skin },  { "animations", check_animation },
        { "cameras", check_camera }, { "nodes", check_light },
    };

    for (size_t i = 0; i < sizeof(lists) / sizeof(lists[0]); i++) {
        const uint32_t count = gltf_list_length(gltf, lists[i].list);
        for (uint32_t k = 0; k < count && gltf->status == STATUS_OK; k++) {
            const struct gltf_object object = gltf_element(gltf, lists[i].list, k);
            lists[i].check(&object);
        }
    }
    return gltf->status;
}
