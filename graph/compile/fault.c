/* fault.c: collects faults. */
#include <stdarg.h>
#include <string.h>
#include "graph/compile/compiler.h"

/* Returns true if an equal fault is listed, which a repetition of the same pass may have caused. */
static bool is_known(const struct compiler *c, const struct rg_fault *fault)
{
    for (uint32_t i = c->row_first_fault; i < c->fault_count; i++) {
        const struct rg_fault *f = &c->faults[i];
        if (f->error == fault->error && f->technique == fault->technique && f->row == fault->row &&
            f->resource == fault->resource &&
            (f->hint == fault->hint || !strcmp(f->hint, fault->hint)))
            return true;
    }
    return false;
}

static void add(struct compiler *c, struct rg_fault fault)
{
    if (!is_known(c, &fault) && ARENA_ROOM(c->arena, c->faults, c->fault_count, c->fault_room, 8))
        c->faults[c->fault_count++] = fault;
}

void rg_fault(struct compiler *c, enum rg_error error, const char *resource, const char *hint)
{
    bool in_row = c->technique && c->row != RG_NONE;
    add(c, (struct rg_fault){
               .error = error,
               .technique = c->technique ? c->technique->name : NULL,
               .pass = in_row ? c->technique->passes[c->row].name : NULL,
               .resource = resource,
               .row = c->row,
               .hint = hint,
           });
}

void rg_fault_with(struct compiler *c, enum rg_error error, const char *resource,
                   const char *format, ...)
{
    const size_t size = 256;
    char *hint = ARENA_ARRAY(c->arena, char, size);
    va_list arguments;
    if (!hint)
        return;
    va_start(arguments, format);
    vsnprintf(hint, size, format, arguments);
    va_end(arguments);
    rg_fault(c, error, resource, hint);
}

void rg_fault_of(struct compiler *c, enum rg_error error, const char *resource, const char *hint)
{
    add(c, (struct rg_fault){ error, .resource = resource, .row = RG_NONE, .hint = hint });
}
