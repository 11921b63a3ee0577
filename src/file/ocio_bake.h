/* ocio_bake.h: C interface to OpenColorIO. */
#ifndef FIRN_FILE_OCIO_BAKE_H
#define FIRN_FILE_OCIO_BAKE_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns true if this build has OpenColorIO. */
bool ocio_bake_is_built(void);

/* Converts `count` linear Rec. 709 colours in place to display colours of a view. On failure,
 * writes the reason to `fault` and returns false. */
bool ocio_bake(const char *config, const char *view, float *colors, size_t count, char *fault,
               size_t fault_size);

#ifdef __cplusplus
}
#endif

#endif
