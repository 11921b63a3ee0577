/* draco_file.cpp: Draco mesh compression behind a C interface. */
#include <cstring>
#include <draco/compression/encode.h>
extern "C" {
#include "tests/support/draco_file.h"
}

size_t draco_file_encode(const float *positions, uint32_t vertex_count, const uint16_t *indices,
                         uint32_t index_count, void *bytes, size_t size)
{
    draco::Mesh mesh;
    draco::GeometryAttribute kind;
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    mesh.set_num_points(vertex_count);
    kind.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
              3 * sizeof(float), 0);
    const int id = mesh.AddAttribute(kind, true, vertex_count);
    for (uint32_t i = 0; i < vertex_count; i++)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &positions[3 * i]);
    for (uint32_t i = 0; i < index_count; i += 3) {
        draco::Mesh::Face face;
        for (uint32_t k = 0; k < 3; k++)
            face[k] = draco::PointIndex(indices[i + k]);
        mesh.AddFace(face);
    }
    if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok() || buffer.size() > size)
        return 0;
    memcpy(bytes, buffer.data(), buffer.size());
    return buffer.size();
}
