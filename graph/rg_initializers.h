/*
 * rg_initializers.h: macros that initialise the tables of rg.h, in C17 and in C++20. Included by
 * rg.h.
 *
 *     static const struct rg_pass passes[] = {
 *         { .name = "show",
 *           .color = RG_TARGETS({ &shown, RG_LOAD_DISCARD }),
 *           .uses = RG_USES({ .image = &scene, .access = RG_SAMPLED }, ...), ... },
 *     };
 *     static const struct rg_technique technique = RG_TECHNIQUE("example", passes);
 *
 * In C the arrays are compound literals, which live as long as the enclosing scope. In C++ they are
 * static, refer only to static objects, and their initialisers are in the order of the fields.
 */
#ifndef RG_RG_INITIALIZERS_H
#define RG_RG_INITIALIZERS_H

/* Initialises a technique from its name and an array of passes. */
#define RG_TECHNIQUE(title, table) \
    { \
        .name = (title), .passes = (table), .pass_count = sizeof(table) / sizeof((table)[0]) \
    }

/* Initialisers of rg_pass: RG_TARGETS() for `color` and `color_count`, RG_USES() for `uses`. */
#ifndef __cplusplus

#define RG_TARGETS(...) \
    (const struct rg_target[]){ __VA_ARGS__ }, \
        .color_count = \
            sizeof((const struct rg_target[]){ __VA_ARGS__ }) / sizeof(struct rg_target)
#define RG_USES(...) ((const struct rg_use[]){ __VA_ARGS__, { 0 } })

#else

/* Tables omit fields that are zero, about which -Wextra warns in C++. */
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif

template <size_t count> constexpr uint32_t rg_target_count(const rg_target (&)[count])
{
    return count;
}

#define RG_STATIC_ARRAY(type, ...) \
    ([]() -> const type * { \
        static const type table[] = { __VA_ARGS__ }; \
        return table; \
    }())
#define RG_TARGETS(...) \
    RG_STATIC_ARRAY(rg_target, __VA_ARGS__), .color_count = rg_target_count({ __VA_ARGS__ })
#define RG_USES(...) RG_STATIC_ARRAY(rg_use, __VA_ARGS__, {})

#endif

#endif
