/* gltf_image.c: loads the images of a glTF file's materials into texture layers. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf/gltf.h"

/* Image whose data must outlive model_texture_load(). */
struct source {
    char name[GLTF_LOCATION_SIZE];
    uint8_t *owned;
    uint32_t image;
};

/* Images of one texture array, which holds either sRGB colours or linear values. */
struct sources {
    struct source *list;
    struct model_texture *images;
    uint32_t count;
};

/* Resolves the URI of an image to a file in the model's folder. */
static enum status find_file(const struct gltf_object *image, const char *uri,
                             struct model_texture *encoded)
{
    const struct gltf *gltf = image->gltf;
    char *name = strdup(uri);
    if (!name)
        return gltf_out_of_memory(image->gltf);
    if (!model_file_clean(name, true))
        (void)gltf_fault(image, "texture %s: expected a file within the model's folder", uri);
    else if (!(encoded->file = model_file_join(gltf->path, name)))
        (void)gltf_out_of_memory(image->gltf);
    encoded->name = encoded->file;
    free(name);
    return gltf->status;
}

static enum status add(struct gltf *gltf, struct sources *sources, uint32_t index)
{
    const struct gltf_object image = gltf_element(gltf, "images", index);
    const char *uri = gltf_string(&image, "uri", NULL);
    const uint32_t view = gltf_index(&image, "bufferView", "bufferViews");
    struct source *source = &sources->list[sources->count];
    struct model_texture *encoded = &sources->images[sources->count];
    if (gltf->status != STATUS_OK)
        return gltf->status;
    sources->count++;
    source->image = index;
    memcpy(source->name, image.location, sizeof(source->name));
    encoded->name = source->name;
    if (uri && strncmp(uri, "data:", 5) != 0)
        return find_file(&image, uri, encoded);
    struct gltf_bytes bytes = { 0 };
    size_t stride;
    if (uri)
        (void)gltf_read_uri(&image, uri, &bytes);
    else if (view != gltf_none)
        bytes = gltf_view(gltf, view, &stride);
    else
        (void)gltf_fault(&image, "expected a uri or a bufferView");
    source->owned = bytes.owned;
    encoded->bytes = bytes.bytes;
    encoded->size = bytes.size;
    return gltf->status;
}

/* Removes the images from `count` on. */
static void drop(struct sources *sources, uint32_t count)
{
    for (; sources->count > count; sources->count--) {
        free(sources->list[sources->count - 1].owned);
        free(sources->images[sources->count - 1].file);
        sources->images[sources->count - 1] = (struct model_texture){ 0 };
    }
}

/* Adds an image unless it cannot be found or its format is not supported. */
static void try_add(struct gltf *gltf, struct sources *sources, uint32_t image)
{
    const uint32_t count = sources->count;
    gltf_attempt_begin(gltf, &gltf->import->textures);
    (void)add(gltf, sources, image);
    if (!gltf_attempt_end(gltf)) {
        drop(sources, count);
    } else if (model_texture_unsupported_format(&sources->images[count])) {
        gltf->undrawn |= 1u << GLTF_NO_IMAGE;
        drop(sources, count);
    }
}

/* Returns 1 + the layer of an image; 0 if the material is drawn without it. */
static uint32_t find_layer(struct gltf *gltf, struct sources *sources, uint32_t image)
{
    uint32_t layer = 0;
    while (layer < sources->count && sources->list[layer].image != image)
        layer++;
    if (layer == MODEL_TEXTURE_MAX) {
        const struct gltf_object top = gltf_top(gltf);
        (void)gltf_fault(&top, "expected at most %d textures", MODEL_TEXTURE_MAX);
        return 0;
    }
    if (layer == sources->count)
        try_add(gltf, sources, image);
    return layer < sources->count ? layer + 1 : 0;
}

/* Sets the layers of a material's linear textures if `are_numbers`, else of its sRGB textures. */
static void assign_layers(struct gltf *gltf, struct sources *sources, bool are_numbers,
                          struct gltf_material *material)
{
    for (uint32_t i = 0; i < MATERIAL_TEXTURE_COUNT && gltf->status == STATUS_OK; i++) {
        const uint32_t image = material->textures[i].image;
        struct material_texture *texture = &material->material.textures[i];
        if (image == gltf_none || texture->layer > 0 || material_texture_is_color(i) == are_numbers)
            continue;
        texture->layer = find_layer(gltf, sources, image);
        if (texture->layer == 0)
            material->textures[i].image = gltf_none;
        else
            sources->images[texture->layer - 1].is_normal_map |= i == MATERIAL_NORMAL;
    }
}

/* Loads the colour or linear textures of materials whose primitives have texture coordinates. */
static enum status read_images(struct gltf *gltf, bool are_numbers, struct texture_layers *layers)
{
    struct sources sources = {
        .list = calloc(MODEL_TEXTURE_MAX, sizeof(*sources.list)),
        .images = calloc(MODEL_TEXTURE_MAX, sizeof(*sources.images)),
    };
    if (!sources.list || !sources.images) {
        free(sources.list);
        free(sources.images);
        return gltf_out_of_memory(gltf);
    }
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count && gltf->status == STATUS_OK; k++) {
            const struct gltf_primitive *primitive = &gltf->meshes[i].primitives[k];
            struct gltf_material *material = &gltf->materials[primitive->material];
            if (primitive->uvs && primitive->index_count > 0)
                assign_layers(gltf, &sources, are_numbers, material);
        }
    }
    if (gltf->status == STATUS_OK)
        gltf->status =
            model_texture_load(gltf->import, sources.images, sources.count, are_numbers, layers);
    drop(&sources, 0);
    free(sources.list);
    free(sources.images);
    return gltf->status;
}

enum status gltf_images_read(struct gltf *gltf, struct model *model)
{
    const enum status status = read_images(gltf, false, &model->textures);
    return status == STATUS_OK ? read_images(gltf, true, &model->numbers) : status;
}
