/* dump_internal.h: formatted output of a plan, common to all dump formats. Private to graph/dump/.
 */
#ifndef RG_DUMP_DUMP_INTERNAL_H
#define RG_DUMP_DUMP_INTERNAL_H

#include "graph/rg.h"

/* Writes a resource or pass name, escaped for the output format. */
typedef void rg_dump_name_fn(FILE *out, const char *name);

/* Destination and format of a dump. */
struct rg_dump {
    const struct rg_plan *plan;
    FILE *out;
    rg_dump_name_fn *name;
};

/* Formats and writes text. %u takes a uint32_t, %z a VkDeviceSize, %s an unchanged string, and %n a
 * name to escape. */
void rg_dump_print(const struct rg_dump *d, const char *text, ...);

/* plan_page.html before and after the JSON dump */
extern const char rg_dump_page_begin[], rg_dump_page_end[];

/* ---- flag_names.c ---- */

/* Name of a flag or enum value in dumps. In tables, a NULL name marks the end. */
struct rg_dump_flag_name {
    const char *word;
    uint64_t value;
};

extern const struct rg_dump_flag_name rg_dump_aspects[], rg_dump_stages[], rg_dump_accesses[];
extern const struct rg_dump_flag_name rg_dump_layouts[], rg_dump_loads[], rg_dump_stores[];
extern const struct rg_dump_flag_name rg_dump_kinds[], rg_dump_memories[], rg_dump_queues[];

/* Returns the name of a value; "?" if it has none. */
const char *rg_dump_flag_name(const struct rg_dump_flag_name *words, uint64_t value);

/* Writes the names of flags, separated by `separator`; nothing if no flag is set. */
void rg_dump_flags(FILE *out, const struct rg_dump_flag_name *words, uint64_t flags,
                   const char *separator);

const char *rg_dump_depth(const struct rg_pass *pass); /* its access name */

/* Returns the binding of a use, or RG_NONE if it has no descriptor. */
uint32_t rg_dump_binding(const struct rg_plan_use *use);

/* Properties that images and buffers have in common. */
struct rg_dump_resource {
    const char *name;
    bool imported, persistent;
    bool host; /* in host memory */
    uint32_t first, last, block;
    VkDeviceSize offset, size; /* bytes; `offset` is within the block */
};

/* Returns an image or buffer of the plan. Indices count all images first, then all buffers. */
struct rg_dump_resource rg_dump_resource(const struct rg_plan *plan, uint32_t index);

#endif
