/* environment.h: environment variables. Changes are for single-threaded use, except for
 * environment_fill(). */
#ifndef FIRN_BASE_ENVIRONMENT_H
#define FIRN_BASE_ENVIRONMENT_H

#include <stdbool.h>
#include <stddef.h>

/* Sets a variable unless it is set. Returns false if out of memory. */
bool environment_set_default(const char *name, const char *value);

/* Returns the value of a variable, or NULL if it is unset or if the program runs with privileges
 * that its user lacks. */
const char *environment_get_secure(const char *name);

/* Sets a variable to "", with space for values of fewer than `size` characters. Returns false if
 * out of memory, or if the system has no such variables. */
bool environment_reserve(const char *name, size_t size);

/* Writes a value into the reserved space. Other threads may read the environment meanwhile. */
void environment_fill(const char *name, const char *value);

#endif
