/* draco_file.h: compresses a mesh by Draco, for tests in C. */
#ifndef TESTS_DRACO_FILE_H
#define TESTS_DRACO_FILE_H

#include <stddef.h>
#include <stdint.h>

/* Writes a mesh of positions, which keep all bits, as attribute 0. Returns its size, or 0 after a
 * failure. */
size_t draco_file_encode(const float *positions, uint32_t vertex_count, const uint16_t *indices,
                         uint32_t index_count, void *bytes, size_t size);

#endif
