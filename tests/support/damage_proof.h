/*
 * damage_proof.h: decides whether a plan needs one of its barriers or stores, and why.
 *
 * It examines only the accesses just before and just after to one mip, layer and aspect of an
 * image, or to a buffer. A barrier or store that it finds necessary is necessary in any plan with
 * these accesses, but it does not find all necessary ones.
 */
#ifndef TESTS_DAMAGE_PROOF_H
#define TESTS_DAMAGE_PROOF_H

#include <stdbool.h>
#include <stdint.h>

#include "graph/rg.h"

/* Barriers are named by index; initial ones only where that is said. */

/* What comes after a write sees it through it alone; `in_frame`: both are passes of one frame. */
bool damage_proof_depends(const struct rg_plan *plan, const struct rg_compile_params *params,
                          uint32_t barrier, bool in_frame);

/* A write after waits for a read before through it alone. */
bool damage_proof_orders(const struct rg_plan *plan, const struct rg_compile_params *params,
                         uint32_t barrier);

/* What comes after it needs the layout that it gives; `in_frame`: and that is a pass. */
bool damage_proof_layout(const struct rg_plan *plan, const struct rg_compile_params *params,
                         uint32_t barrier, bool in_frame);

/* What comes after it, in this frame, sees content or a layout through it alone. */
bool damage_proof_visible(const struct rg_plan *plan, const struct rg_compile_params *params,
                          uint32_t barrier);

/* Somebody needs the content that it keeps. */
bool damage_proof_content(const struct rg_plan *plan, const struct rg_compile_params *params,
                          uint32_t barrier);

/* The first frame needs this initial barrier. */
bool damage_proof_initial(const struct rg_plan *plan, const struct rg_compile_params *params,
                          uint32_t barrier);

/* Somebody needs what this pass stores in this target. */
bool damage_proof_store(const struct rg_plan *plan, const struct rg_compile_params *params,
                        uint32_t pass, const struct rg_plan_target *target);

/* Usages that its passes and output need. */
VkImageUsageFlags damage_proof_image_usage(const struct rg_plan *plan,
                                           const struct rg_compile_params *params, uint32_t image);
VkBufferUsageFlags damage_proof_buffer_usage(const struct rg_plan *plan,
                                             const struct rg_compile_params *params,
                                             uint32_t buffer);

#endif
