/* gltf_file.h: writes small glTF files, m.gltf and m.bin in the current folder, and loads them. */
#ifndef TESTS_GLTF_FILE_H
#define TESTS_GLTF_FILE_H

#include <stddef.h>

#include "src/scene/import/model.h"

enum {
    GLTF_FILE_SAID = 1024, /* bytes of a loader's messages */
};

enum gltf_file_component {
    GLTF_FILE_BYTE = 5120,
    GLTF_FILE_UNSIGNED_BYTE,
    GLTF_FILE_SHORT,
    GLTF_FILE_UNSIGNED_SHORT,
    GLTF_FILE_UNSIGNED_INT = 5125,
    GLTF_FILE_FLOAT,
};

/* Forgets all data. Each test begins so. */
void gltf_file_begin(void);

/* Adds bytes as a buffer view; `extra` continues its JSON, with ' for ": ",'byteStride':12".
 * Returns its index. */
uint32_t gltf_file_view(const void *bytes, size_t size, const char *extra);

/* Adds an accessor of a view, or of none (UINT32_MAX). Returns its index. */
uint32_t gltf_file_accessor(uint32_t view, enum gltf_file_component component, uint32_t count,
                            const char *type, const char *extra);

/* Both: an accessor of a view of its own. */
uint32_t gltf_file_add(const void *bytes, size_t size, enum gltf_file_component component,
                       uint32_t count, const char *type);
uint32_t gltf_file_floats(const float *numbers, uint32_t count, const char *type);

/* Writes the files: members of the top, as "'meshes':[...]" with ' for ", after those of the data.
 */
void gltf_file_write(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Loads m.gltf; what is logged is in `said`. */
enum status gltf_file_load(struct model *model, char said[static GLTF_FILE_SAID]);

/* Writes and loads a triangle (0 0 0) (1 0 0) (0 1 0) whose material 0, and further members of the
 * top, are given; what is logged is in `said`. */
enum status gltf_file_material(struct model *model, const char *material, const char *more,
                               char said[static GLTF_FILE_SAID]);

#endif
