/* gltf_draco.cpp: C wrapper of the Draco mesh decoder (KHR_draco_mesh_compression). */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop
#include <exception>
#include <memory>
#include <new>
extern "C" {
#include "src/scene/import/gltf/gltf_draco.h"
}

struct gltf_draco {
    std::unique_ptr<draco::Mesh> mesh;
};

struct gltf_draco *gltf_draco_new(const void *bytes, size_t size)
{
    try {
        draco::DecoderBuffer buffer;
        draco::Decoder decoder;
        buffer.Init(static_cast<const char *>(bytes), size);
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            return nullptr;
        return new gltf_draco{ std::move(decoded).value() };
    } catch (const std::exception &) {
        return nullptr;
    }
}

void gltf_draco_delete(struct gltf_draco *draco)
{
    delete draco;
}

uint32_t gltf_draco_vertex_count(const struct gltf_draco *draco)
{
    return draco->mesh->num_points();
}

uint32_t gltf_draco_index_count(const struct gltf_draco *draco)
{
    return 3 * draco->mesh->num_faces();
}

void gltf_draco_copy_indices(const struct gltf_draco *draco, uint32_t *indices)
{
    for (uint32_t i = 0; i < draco->mesh->num_faces(); i++) {
        const draco::Mesh::Face &face = draco->mesh->face(draco::FaceIndex(i));
        for (uint32_t k = 0; k < 3; k++)
            *indices++ = face[k].value();
    }
}

uint32_t gltf_draco_width(const struct gltf_draco *draco, uint32_t attribute)
{
    const draco::PointAttribute *found = draco->mesh->GetAttributeByUniqueId(attribute);
    return found ? static_cast<uint8_t>(found->num_components()) : 0;
}

bool gltf_draco_copy_values(const struct gltf_draco *draco, uint32_t attribute, float *values)
{
    const draco::PointAttribute *found = draco->mesh->GetAttributeByUniqueId(attribute);
    if (!found)
        return false;
    const int8_t width = static_cast<int8_t>(found->num_components());
    for (uint32_t i = 0; i < draco->mesh->num_points(); i++) {
        const draco::AttributeValueIndex index = found->mapped_index(draco::PointIndex(i));
        if (index.value() >= found->size() || !found->ConvertValue<float>(index, width, values))
            return false;
        values += width;
    }
    return true;
}
