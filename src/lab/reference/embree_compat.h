/*
 * embree_compat.h: common interface to Embree 3 and 4; if both are installed, meson.build selects
 * 4.
 */
#ifndef FIRN_LAB_REFERENCE_EMBREE_COMPAT_H
#define FIRN_LAB_REFERENCE_EMBREE_COMPAT_H

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>

struct embree_context {
    struct RTCRayQueryContext of_embree;
};

#else
#include <embree3/rtcore.h>

struct embree_context {
    struct RTCIntersectContext of_embree;
};

#endif

/* Finds the closest hit of a ray. Passes `context` to intersection filters and user geometry. */
static inline void embree_intersect(RTCScene scene, struct embree_context *context,
                                    struct RTCRayHit *rayhit)
{
#if RTC_VERSION_MAJOR >= 4
    struct RTCIntersectArguments arguments;
    rtcInitRayQueryContext(&context->of_embree);
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context->of_embree;
    rtcIntersect1(scene, rayhit, &arguments);
#else
    rtcInitIntersectContext(&context->of_embree);
    rtcIntersect1(scene, &context->of_embree, rayhit);
#endif
}

#endif
