/* gltf_skin_morph.c: deforms glTF meshes by morph targets and linear blend skinning, on the CPU
 * (glTF 2.0, 3.7.2.2 and 3.7.3). */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

static float *copy_vectors(struct gltf *gltf, const float *numbers, uint32_t vertex_count)
{
    const size_t size = sizeof(*numbers) * 3 * vertex_count;
    float *copied = numbers ? malloc(size) : NULL;
    if (copied)
        memcpy(copied, numbers, size);
    else if (numbers)
        (void)gltf_out_of_memory(gltf);
    return copied;
}

static void add_deltas(float *to, const float *deltas, float weight, uint32_t vertex_count)
{
    for (size_t i = 0; to && deltas && i < 3 * (size_t)vertex_count; i++)
        to[i] += weight * deltas[i];
}

/* Returns the skinning matrices (joint times inverse bind matrix, relative to gltf->origin), which
 * the caller frees. */
static mat4s *read_joints(struct gltf *gltf, uint32_t skin, uint32_t *count)
{
    const struct gltf_object object = gltf_element(gltf, "skins", skin);
    const uint32_t inverse = gltf_index(&object, "inverseBindMatrices", "accessors");
    struct gltf_array matrices = { 0 };
    *count = gltf_length(&object, "joints");
    mat4s *joints = malloc((*count + (size_t)1) * sizeof(*joints));
    if (!joints) {
        (void)gltf_out_of_memory(gltf);
        return NULL;
    }
    if (inverse != gltf_none && gltf_read_floats(gltf, inverse, &matrices) &&
        (matrices.width != 16 || matrices.count < *count))
        (void)gltf_fault(&object, "inverseBindMatrices: expected %u 4x4 matrices", *count);
    for (uint32_t i = 0; i < *count && gltf->status == STATUS_OK; i++) {
        const uint32_t node = gltf_index_at(&object, "joints", i, "nodes");
        mat4s joint_from_mesh = glms_mat4_identity();
        if (matrices.values)
            memcpy(&joint_from_mesh, &matrices.values[(size_t)16 * i], sizeof(joint_from_mesh));
        if (!gltf->nodes[node].is_listed)
            (void)gltf_fault(&object, "joints: nodes[%u] is not in the scene", node);
        const struct affine bind = affine_from_mat4(joint_from_mesh);
        const struct affine joint = affine_multiply(&gltf->nodes[node].model_from_node, &bind);
        joints[i] = affine_to_mat4(&joint, gltf->origin);
    }
    free(matrices.values);
    return joints;
}

/* Scales the weights of a vertex so that their sum is 1. If that is impossible, only the first
 * joint counts. Returns true if the sum was within 0.001 of 1. */
static bool normalize_weights(const float *weights, float *normalized)
{
    const float sum = weights[0] + weights[1] + weights[2] + weights[3];
    for (int k = 0; k < 4; k++)
        normalized[k] = sum > 0 && isfinite(sum) ? weights[k] / sum : (float)(k == 0);
    return fabsf(sum - 1) <= 1e-3F;
}

/* Returns the skinning matrix of a vertex: the weighted sum of its joints' matrices. */
static mat4s blend(const mat4s *joints, const float *indices, const float *weights)
{
    mat4s sum = glms_mat4_zero();
    for (int k = 0; k < 4; k++) {
        const mat4s *joint = &joints[(size_t)indices[k]];
        for (int i = 0; weights[k] != 0 && i < 16; i++)
            sum.raw[i / 4][i % 4] += weights[k] * joint->raw[i / 4][i % 4];
    }
    return sum;
}

static void apply_skin(struct gltf *gltf, const struct gltf_object *mesh_object, uint32_t skin,
                       const struct gltf_primitive *primitive, struct gltf_primitive *posed)
{
    uint32_t joint_count;
    mat4s *joints = read_joints(gltf, skin, &joint_count);
    for (size_t i = 0; i < 4 * (size_t)primitive->vertex_count; i++) {
        if (!(primitive->joints[i] >= 0 && primitive->joints[i] < (float)joint_count))
            (void)gltf_fault(mesh_object, "JOINTS_0: the skin has only %u joints", joint_count);
    }
    for (size_t i = 0; i < primitive->vertex_count && gltf->status == STATUS_OK; i++) {
        float weights[4];
        gltf->has_weight_sums |= !normalize_weights(&primitive->weights[4 * i], weights);
        const mat4s m = blend(joints, &primitive->joints[4 * i], weights);
        vec3s v;
        memcpy(&v, &posed->positions[3 * i], sizeof(v));
        v = glms_mat4_mulv3(m, v, 1);
        memcpy(&posed->positions[3 * i], &v, sizeof(v));
        if (!posed->normals)
            continue;
        memcpy(&v, &posed->normals[3 * i], sizeof(v));
        v = glms_mat3_mulv(glms_mat4_pick3(m), v);
        memcpy(&posed->normals[3 * i], &v, sizeof(v));
    }
    free(joints);
}

bool gltf_is_deformed(const struct gltf_node *node, const struct gltf_primitive *primitive)
{
    return primitive->target_count > 0 || (node->skin != gltf_none && primitive->joints);
}

enum status gltf_skin_morph(struct gltf *gltf, const struct gltf_node *node,
                            const struct gltf_primitive *primitive, struct gltf_primitive *posed)
{
    const struct gltf_object mesh_object = gltf_element(gltf, "meshes", node->mesh);
    *posed = (struct gltf_primitive){
        .positions = copy_vectors(gltf, primitive->positions, primitive->vertex_count),
        .normals = copy_vectors(gltf, primitive->normals, primitive->vertex_count),
    };
    for (uint32_t i = 0; i < primitive->target_count && gltf->status == STATUS_OK; i++) {
        const float weight = i < node->weight_count ? node->weights[i] : 0;
        const struct gltf_target *target = &primitive->targets[i];
        add_deltas(posed->positions, target->positions, weight, primitive->vertex_count);
        add_deltas(posed->normals, target->normals, weight, primitive->vertex_count);
    }
    if (node->skin != gltf_none && primitive->joints && gltf->status == STATUS_OK)
        apply_skin(gltf, &mesh_object, node->skin, primitive, posed);
    return gltf->status;
}
