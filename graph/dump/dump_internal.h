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

/* ---- formatted_output.c ---- */

/* Formats and writes text. %u takes a uint32_t, %z a VkDeviceSize, %b a VkDeviceSize to write with
 * a unit (12.5 MiB), %s an unchanged string, and %n a name to escape. */
void rg_dump_print(const struct rg_dump *d, const char *text, ...);

/* Returns the nonzero UTF-8 character at *text, or U+FFFD if invalid, and advances *text. */
uint32_t rg_dump_decode_utf8(const char **text);

/* Returns the character, or U+FFFD for control characters and those that XML forbids. */
uint32_t rg_dump_printable(uint32_t character);

void rg_dump_utf8(FILE *out, uint32_t character);

/* ---- flag_names.c ---- */

/* Name of a flag or enum value in dumps. In tables, a NULL name marks the end. */
struct rg_dump_flag_name {
    const char *word;
    uint64_t value;
};

extern const struct rg_dump_flag_name rg_dump_aspects[], rg_dump_stages[], rg_dump_accesses[];
extern const struct rg_dump_flag_name rg_dump_layouts[], rg_dump_loads[], rg_dump_stores[];
extern const struct rg_dump_flag_name rg_dump_kinds[], rg_dump_memories[];

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

/* ---- text_dump.c ---- */

void rg_dump_pass_name(const struct rg_dump *d, const struct rg_pass *pass, uint32_t repetition);
void rg_dump_image(const struct rg_dump *d, uint32_t index);
void rg_dump_buffer(const struct rg_dump *d, uint32_t index);
void rg_dump_barriers(const struct rg_dump *d, const char *what, uint32_t first, uint32_t count);
void rg_dump_pass(const struct rg_dump *d, uint32_t index); /* without its barriers */
void rg_dump_text(const struct rg_dump *d);

/* html_chart.c: prints the SVG chart of passes, memory blocks and other resources */
void rg_dump_chart(const struct rg_dump *d);

#endif
