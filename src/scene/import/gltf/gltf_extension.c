/* gltf_extension.c: supported glTF extensions; warnings about features that are not drawn. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf/gltf.h"
#include "src/scene/import/model_avif.h"

/* Supported extensions. All others are ignored, or rejected if the file requires them. */
static const struct model_extension supported[] = {
    { "EXT_mesh_gpu_instancing", MODEL_DRAWN },
    { "EXT_meshopt_compression", MODEL_DRAWN },
    { "EXT_texture_avif", MODEL_DRAWN }, /* with libavif */
    { "EXT_texture_webp", MODEL_DRAWN },
    { "KHR_draco_mesh_compression", MODEL_DRAWN },
    /* without shadows; lights opaque surfaces only */
    { "KHR_lights_punctual", MODEL_APPROXIMATED },
    /* on opaque materials only, without clearcoatNormalTexture */
    { "KHR_materials_clearcoat", MODEL_APPROXIMATED },
    { "KHR_materials_dispersion", MODEL_DRAWN },
    { "KHR_materials_emissive_strength", MODEL_DRAWN },
    { "KHR_materials_ior", MODEL_DRAWN },
    { "KHR_materials_specular", MODEL_APPROXIMATED }, /* on opaque materials only */
    { "KHR_materials_transmission", MODEL_DRAWN },
    { "KHR_materials_unlit", MODEL_DRAWN },
    { "KHR_materials_volume", MODEL_APPROXIMATED }, /* without thicknessTexture */
    { "KHR_mesh_quantization", MODEL_DRAWN },
    { "KHR_meshopt_compression", MODEL_DRAWN },
    { "KHR_texture_transform", MODEL_DRAWN },
};

static const char *const undrawn[GLTF_UNDRAWN_COUNT] = {
    [GLTF_TRANSMISSIVE_ALPHA] = "alpha of transmissive materials",
    [GLTF_TRANSMISSIVE_EMISSION] = "emission of transmissive materials",
    [GLTF_TRANSMISSIVE_METALLIC] = "metallic factor of transmissive materials",
    [GLTF_TRANSMISSIVE_OCCLUSION] = "occlusion of transmissive materials",
    [GLTF_TRANSMISSIVE_COAT] = "clear coat of transmissive materials",
    [GLTF_TRANSMISSIVE_SPECULAR] = "specular of transmissive materials",
    [GLTF_TRANSMISSIVE_THICKNESS] = "thickness textures",
    [GLTF_COAT_NORMAL] = "normal textures of clear coats",
    [GLTF_ATTENUATION_DISTANCE] = "attenuation with a distance of 0",
    [GLTF_THIRD_UV_SET] = "textures with a third texture coordinate set",
    [GLTF_NO_IMAGE] = "textures without an image in a supported format",
    [GLTF_NEAREST_FILTER] = "nearest filtering (magFilter NEAREST)",
    [GLTF_COLORS_WITHOUT_MATERIAL] = "vertex colours of a file without materials",
    [GLTF_ANIMATION] = "animations (the model is shown in its rest pose)",
    [GLTF_MORE_COLORS] = "vertex colours beyond COLOR_0",
    [GLTF_MORE_JOINTS] = "more than four joints per vertex",
    [GLTF_MORPHED_COLORS] = "colours and texture coordinates of morph targets",
    [GLTF_POINTS] = "points and lines",
    [GLTF_OTHER_SCENES] = "scenes other than the one shown",
};

const char *model_undrawn_name(uint32_t index)
{
    return index < GLTF_UNDRAWN_COUNT ? undrawn[index] : NULL;
}

/* Returns the description of a supported extension; NULL for others. */
static const struct model_extension *find_extension(const char *name)
{
    if (!model_avif_is_built() && strcmp(name, "EXT_texture_avif") == 0)
        return NULL;
    for (size_t i = 0; i < sizeof(supported) / sizeof(supported[0]); i++) {
        if (strcmp(supported[i].name, name) == 0)
            return &supported[i];
    }
    return NULL;
}

/* Returns true if a file can be drawn without an extension, because it concerns only textures,
 * animations or materials. Prefixes of vendors are ignored. */
static bool is_optional(const char *name)
{
    static const char *const subjects[] = { "_texture_", "_image_", "_animation_", "_materials_" };
    const char *subject = strchr(name, '_');
    for (size_t i = 0; subject && i < sizeof(subjects) / sizeof(subjects[0]); i++) {
        if (strncmp(subject, subjects[i], strlen(subjects[i])) == 0)
            return true;
    }
    return false;
}

/* Returns a name from a list such as "extensionsUsed"; NULL after a fault. */
static const char *name_at(const struct gltf_object *top, const char *list, uint32_t index)
{
    const json_t *name = json_array_get(json_object_get(top->json, list), index);
    if (!json_is_string(name))
        (void)gltf_fault(top, "%s: expected extension names", list);
    return json_string_value(name);
}

enum status gltf_extensions_check(struct gltf *gltf)
{
    const struct gltf_object top = gltf_top(gltf);
    const uint32_t required_count = gltf_length(&top, "extensionsRequired");
    const uint32_t used_count = gltf_length(&top, "extensionsUsed");
    for (uint32_t i = 0; i < required_count && gltf->status == STATUS_OK; i++) {
        const char *name = name_at(&top, "extensionsRequired", i);
        if (name && !find_extension(name) && !is_optional(name))
            (void)gltf_fault(&top,
                             "requires the extension %.64s, which is not supported; export "
                             "the file without it",
                             name);
    }
    for (uint32_t i = 0; i < used_count && gltf->status == STATUS_OK; i++)
        (void)name_at(&top, "extensionsUsed", i);
    return gltf->status;
}

/* Adds an extension to the model's list unless it is listed already. */
static void add_extension(struct gltf *gltf, struct model *model, const char *name)
{
    const struct gltf_object top = gltf_top(gltf);
    const struct model_extension *known = find_extension(name);
    struct model_extension added = { .support = known ? known->support : MODEL_IGNORED };
    (void)snprintf(added.name, sizeof(added.name), "%s", name);
    for (uint32_t i = 0; i < model->extension_count; i++) {
        if (strcmp(model->extensions[i].name, added.name) == 0)
            return;
    }
    if (model->extension_count < MODEL_EXTENSION_MAX)
        model->extensions[model->extension_count++] = added;
    else
        (void)gltf_fault(&top, "expected at most %d extensions", MODEL_EXTENSION_MAX);
}

/* Adds every extension that a JSON value uses, even if the file does not declare it. The parser
 * limits the nesting depth, and thus the depth of this recursion. */
static void add_extensions_within(struct gltf *gltf, struct model *model, json_t *json)
{
    const char *key;
    json_t *value;
    size_t i;
    json_array_foreach(json, i, value) add_extensions_within(gltf, model, value);
    json_object_foreach(json, key, value)
    {
        const char *name;
        json_t *extension;
        if (strcmp(key, "extras") == 0)
            continue;
        if (strcmp(key, "extensions") == 0) {
            json_object_foreach(value, name, extension) add_extension(gltf, model, name);
        }
        add_extensions_within(gltf, model, value);
    }
}

enum status gltf_extensions_read(struct gltf *gltf, struct model *model)
{
    const struct gltf_object top = gltf_top(gltf);
    static const char *const lists[] = { "extensionsUsed", "extensionsRequired" };
    model->undrawn = gltf->undrawn;
    model->extensions = calloc(MODEL_EXTENSION_MAX, sizeof(*model->extensions));
    if (!model->extensions)
        return gltf_out_of_memory(gltf);
    for (size_t k = 0; k < sizeof(lists) / sizeof(lists[0]); k++) {
        const uint32_t count = gltf_length(&top, lists[k]);
        for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++) {
            const char *name = name_at(&top, lists[k], i);
            if (name)
                add_extension(gltf, model, name);
        }
    }
    add_extensions_within(gltf, model, gltf->root);
    return gltf->status;
}

void gltf_warn(const struct gltf *gltf, const struct model *model)
{
    for (uint32_t i = 0; i < model->extension_count; i++) {
        if (model->extensions[i].support == MODEL_IGNORED)
            log_warning("%s: the extension %s is not supported and is ignored", gltf->path,
                        model->extensions[i].name);
    }
    if (gltf->clamped_count > 0)
        log_warning("%s: factors outside their ranges were clamped in %u materials", gltf->path,
                    gltf->clamped_count);
    if (gltf->has_unordered_keys)
        log_warning("%s: keyframes have repeated or decreasing times; the later keyframe counts",
                    gltf->path);
    if (gltf->has_weight_sums && !(gltf->undrawn & 1u << GLTF_MORE_JOINTS))
        log_warning("%s: skin weights whose sum is not 1 were normalised", gltf->path);
    char names[1024] = "";
    size_t length = 0;
    for (uint32_t i = 0; i < GLTF_UNDRAWN_COUNT; i++) {
        if (!(gltf->undrawn & 1u << i) || length >= sizeof(names))
            continue;
        const int more = snprintf(&names[length], sizeof(names) - length, "%s%s",
                                  length > 0 ? ", " : "", undrawn[i]);
        length += more > 0 ? (size_t)more : 0;
    }
    if (length > 0)
        log_warning("%s: not drawn: %s", gltf->path, names);
}
