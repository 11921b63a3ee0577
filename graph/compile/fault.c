/* fault.c: collects faults and formats a fault as one line of text. */
#include <stdarg.h>
#include <string.h>
#include "graph/compile/compiler.h"

static const char *const messages[RG_ERROR_COUNT] = {
    [RG_ERROR_NONE] = "no fault",
    [RG_ERROR_NO_OUTPUT] = "no output is requested",
    [RG_ERROR_NO_NAME] = "has no name",
    [RG_ERROR_DUPLICATE_NAME] = "name is used twice",
    [RG_ERROR_NO_SIZE] = "has no size",
    [RG_ERROR_TOO_LARGE] = "is too large",
    [RG_ERROR_FORMAT] = "format does not support this use",
    [RG_ERROR_CUBE] = "is not a valid cube",
    [RG_ERROR_RANGE] = "has no such mip, layer or aspect",
    [RG_ERROR_NOT_ONE_RESOURCE] = "entry without exactly one resource and an access",
    [RG_ERROR_ACCESS] = "access does not fit",
    [RG_ERROR_DUPLICATE_BINDING] = "binding is used twice",
    [RG_ERROR_TARGET_SIZE] = "target differs in size",
    [RG_ERROR_NO_TARGET] = "raster pass without a target",
    [RG_ERROR_NO_SHADER] = "shader is missing",
    [RG_ERROR_NO_RECORD] = "record function is missing",
    [RG_ERROR_PUSH_SIZE] = "push constants have an invalid size",
    [RG_ERROR_CONFLICT] = "has conflicting uses in one pass",
    [RG_ERROR_READ_BEFORE_WRITE] = "is read before anything writes it",
    [RG_ERROR_OUTPUT_NOT_WRITTEN] = "is an output that nothing writes",
    [RG_ERROR_WRITES_NOTHING] = "writes nothing",
    [RG_ERROR_REPEAT] = "has no image that defines its repetitions",
    [RG_ERROR_LISTED_TWICE] = "is listed twice",
    [RG_ERROR_SAMPLES] = "has an unsupported sample count or resolve",
    [RG_ERROR_PERSISTENT] = "cannot be persistent or imported",
    [RG_ERROR_VALUE] = "has an invalid value",
    [RG_ERROR_TABLE] = "has a table that is NULL or too long",
    [RG_ERROR_SHADER] = "is not a valid shader",
    [RG_ERROR_SHADER_PUSH] = "push constants differ from those of the shader",
    [RG_ERROR_SHADER_BINDING] = "binding differs from that of the shader",
    [RG_ERROR_SHADER_ACCESS] = "access differs from that of the shader",
    [RG_ERROR_SHADER_VERTEX] = "vertex attribute differs from that of the shader",
    [RG_ERROR_SHADER_INPUT] = "is not an output of the vertex shader",
    [RG_ERROR_SHADER_OUTPUT] = "target differs from the output of the shader",
    [RG_ERROR_CONSTANT] = "specialization constant differs from those of the shaders",
    [RG_ERROR_DEVICE] = "has impossible properties on this device",
};

static const char *or_else(const char *text, const char *instead)
{
    return text ? text : instead;
}

int rg_fault_text(const struct rg_fault *fault, char *text, size_t size)
{
    char row[24] = "";
    bool in_row = fault->row != RG_NONE;
    const char *end = fault->technique ? ": " : "";
    if (in_row) {
        snprintf(row, sizeof(row), " row %u (", fault->row);
        end = "): ";
    }
    return snprintf(text, size, "%s%s%s%s%s%s%s; %s", or_else(fault->technique, in_row ? "?" : ""),
                    row, in_row ? or_else(fault->pass, "?") : "", end, or_else(fault->resource, ""),
                    fault->resource ? " " : "", messages[fault->error], fault->hint);
}

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
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    size_t size = length < (int)sizeof(text) ? (size_t)length + 1 : sizeof(text);
    char *hint = ARENA_ARRAY(c->arena, char, size);
    if (!hint)
        return;
    memcpy(hint, text, size);
    hint[size - 1] = '\0';
    rg_fault(c, error, resource, hint);
}

void rg_fault_of(struct compiler *c, enum rg_error error, const char *resource, const char *hint)
{
    add(c, (struct rg_fault){ error, .resource = resource, .row = RG_NONE, .hint = hint });
}
