/* draco_file.h: compresses a triangle mesh with the Draco library, for tests in C. */
#ifndef TESTS_DRACO_FILE_H
#define TESTS_DRACO_FILE_H

#include <stddef.h>
#include <stdint.h>

/* Writes a Draco mesh with unquantised positions as attribute 0. Returns its size, or 0 on failure.
 */
size_t draco_file_encode(const float *positions, uint32_t vertex_count, const uint16_t *indices,
                         uint32_t index_count, void *bytes, size_t size);

#endif
