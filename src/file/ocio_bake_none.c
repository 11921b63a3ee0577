/* ocio_bake_none.c: stubs for builds without OpenColorIO. */
#include <stdio.h>
#include "src/file/ocio_bake.h"

bool ocio_bake_is_built(void)
{
    return false;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the other implementation writes to them */
bool ocio_bake(const char *config, const char *view, float *colors, size_t count, char *fault,
               size_t fault_size)
{
    (void)config, (void)view, (void)colors, (void)count;
    snprintf(fault, fault_size, "this build has no OpenColorIO");
    return false;
}
