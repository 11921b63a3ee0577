/* gltf_file.h: writes and loads small glTF files, m.gltf and m.bin in the working directory. */
#ifndef TESTS_GLTF_FILE_H
#define TESTS_GLTF_FILE_H

#include <stddef.h>

#include "src/scene/import/model.h"

enum {
    GLTF_FILE_SAID = 1024, /* size of the buffer for a loader's log messages */
};

enum gltf_file_component {
    GLTF_FILE_BYTE = 5120,
    GLTF_FILE_UNSIGNED_BYTE,
    GLTF_FILE_SHORT,
    GLTF_FILE_UNSIGNED_SHORT,
    GLTF_FILE_UNSIGNED_INT = 5125,
    GLTF_FILE_FLOAT,
};

/* Discards all data. Every test must call it first. */
void gltf_file_begin(void);

/* Adds data as a buffer view and returns its index. `extra` is JSON to append, such as
 * ",'byteStride':12", in which ' stands for ". */
uint32_t gltf_file_view(const void *bytes, size_t size, const char *extra);

/* Adds an accessor of a buffer view, or without one (UINT32_MAX). Returns the accessor's index. */
uint32_t gltf_file_accessor(uint32_t view, enum gltf_file_component component, uint32_t count,
                            const char *type, const char *extra);

/* Adds a buffer view and an accessor of it. Returns the accessor's index. */
uint32_t gltf_file_add(const void *bytes, size_t size, enum gltf_file_component component,
                       uint32_t count, const char *type);
uint32_t gltf_file_floats(const float *numbers, uint32_t count, const char *type);

/* Writes m.gltf and m.bin. `format` is JSON of further top-level members, such as "'meshes':[...]",
 * in which ' stands for ". */
void gltf_file_write(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Loads m.gltf; `said` receives the log messages. */
enum status gltf_file_load(struct model *model, char said[static GLTF_FILE_SAID]);

/* Writes and loads a triangle (0 0 0) (1 0 0) (0 1 0). `material` and `more` are JSON of its
 * material and of further top-level members; `said` receives the log messages. */
enum status gltf_file_material(struct model *model, const char *material, const char *more,
                               char said[static GLTF_FILE_SAID]);

#endif
