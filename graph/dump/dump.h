/*
 * dump.h: functions that the forms of a plan share: words, and lines of text in which names
 * are escaped as the form needs it. Private to graph/dump/.
 */
#ifndef RG_DUMP_DUMP_H
#define RG_DUMP_DUMP_H

#include "graph/rg.h"

/* Writes a name, escaped as the form needs it. */
typedef void rg_dump_name_fn(FILE *out, const char *name);

/* Where a plan is written to, and how. */
struct rg_dump {
    const struct rg_plan *plan;
    FILE *out;
    rg_dump_name_fn *name;
};

/* ---- put.c ---- */

/* Writes a text, in which %u stands for a uint32_t, %z for a VkDeviceSize, %b for one as a number
 * of bytes with a unit (12.5 MiB), %s for a string as it is, and %n for a name. */
void rg_put(const struct rg_dump *d, const char *text, ...);

/* Returns the next character of a text that is not at its end, and moves behind it. A byte that is
 * no part of valid UTF-8 gives U+FFFD. */
uint32_t rg_dump_character(const char **text);

/* Returns the character, or U+FFFD for controls and characters that XML forbids. */
uint32_t rg_dump_visible(uint32_t character);

void rg_dump_utf8(FILE *out, uint32_t character);

/* ---- words.c ---- */

/* The word for a flag or a value of an enum; a list of them ends with a NULL. */
struct rg_dump_word {
    const char *word;
    uint64_t value;
};

extern const struct rg_dump_word rg_dump_aspects[], rg_dump_stages[], rg_dump_accesses[];
extern const struct rg_dump_word rg_dump_layouts[], rg_dump_loads[], rg_dump_stores[];
extern const struct rg_dump_word rg_dump_kinds[], rg_dump_memories[];

/* Returns the word for a value; "?" if there is none. */
const char *rg_dump_word(const struct rg_dump_word *words, uint64_t value);

/* Writes the words for flags with a separator between them; nothing if there are none. */
void rg_dump_flags(FILE *out, const struct rg_dump_word *words, uint64_t flags,
                   const char *separator);

const char *rg_dump_depth(const struct rg_pass *pass); /* what it does to its depth target */

/* Returns the binding of a use that has a descriptor, else RG_NONE. */
uint32_t rg_dump_binding(const struct rg_plan_use *use);

/* What images and buffers have in common. */
struct rg_dump_resource {
    const char *name;
    bool imported, persistent;
    bool host; /* a buffer that the CPU writes or reads */
    uint32_t first, last, block;
    VkDeviceSize offset, size; /* bytes, in the block */
};

/* Returns the resource of an index: images come first, then buffers. */
struct rg_dump_resource rg_dump_resource(const struct rg_plan *plan, uint32_t index);

/* ---- text.c: lines of text, each with its newline ---- */

void rg_dump_pass_name(const struct rg_dump *d, const struct rg_pass *pass, uint32_t repetition);
void rg_dump_image(const struct rg_dump *d, uint32_t index);
void rg_dump_buffer(const struct rg_dump *d, uint32_t index);
void rg_dump_barriers(const struct rg_dump *d, const char *what, uint32_t first, uint32_t count);
void rg_dump_pass(const struct rg_dump *d, uint32_t index); /* without its barriers */
void rg_dump_text(const struct rg_dump *d);

/* chart.c: the drawing of an HTML page: passes, blocks of memory, other resources */
void rg_dump_chart(const struct rg_dump *d);

#endif
