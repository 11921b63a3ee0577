/*
 * mutation_proof.h: proves that a plan needs one of its barriers or stores, for mutation testing.
 *
 * It examines only the accesses just before and just after to one mip, layer and aspect of an
 * image, or to a buffer. A barrier or store that it finds necessary is necessary in any plan with
 * these accesses, but it does not find all necessary ones.
 */
#ifndef TESTS_SUPPORT_MUTATION_PROOF_H
#define TESTS_SUPPORT_MUTATION_PROOF_H

#include <stdbool.h>
#include <stdint.h>

#include "graph/rg.h"

/* Barriers are indices in plan->barriers; initial ones are allowed only where documented. */

/* Returns true if the barrier is the only memory dependency between a write and the next access.
 * With `in_frame`, both accesses must be by passes of one frame. */
bool mutation_proof_depends(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier, bool in_frame);

/* Returns true if the barrier alone orders a write after an earlier read (WAR). */
bool mutation_proof_orders(const struct rg_plan *plan, const struct rg_compile_params *params,
                           uint32_t barrier);

/* Returns true if the next access needs the layout that the barrier transitions to. With
 * `in_frame`, that access must be by a pass of the same frame. */
bool mutation_proof_layout(const struct rg_plan *plan, const struct rg_compile_params *params,
                           uint32_t barrier, bool in_frame);

/* Returns true if the next access in this frame needs the barrier for visibility or layout. */
bool mutation_proof_visible(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier);

/* Returns true if a later access needs the image content that the barrier preserves. */
bool mutation_proof_content(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier);

/* Returns true if the first frame needs this initial barrier. */
bool mutation_proof_initial(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier);

/* Returns true if a later access needs what this pass stores to `target`. */
bool mutation_proof_store(const struct rg_plan *plan, const struct rg_compile_params *params,
                          uint32_t pass, const struct rg_plan_target *target);

/* Returns the usage flags that the passes and outputs of an image or buffer require. */
VkImageUsageFlags mutation_proof_image_usage(const struct rg_plan *plan,
                                             const struct rg_compile_params *params,
                                             uint32_t image);
VkBufferUsageFlags mutation_proof_buffer_usage(const struct rg_plan *plan,
                                               const struct rg_compile_params *params,
                                               uint32_t buffer);

#endif
