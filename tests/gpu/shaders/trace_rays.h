/* trace_rays.h: shared by trace_rays.frag and test_trace.c. */
#ifndef TESTS_TRACE_RAYS_H
#define TESTS_TRACE_RAYS_H

#define TRACE_RAYS_BINDING 1
#define TRACE_RAYS_SIDE    100 /* rays in a row, and rows */

/* Two texels of a buffer for each ray: origin and part, direction and side as of trace_ray. */
#define TRACE_RAYS_TEXELS 2

#endif
