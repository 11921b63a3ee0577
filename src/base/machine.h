/* machine.h: memory and processor of the machine. */
#ifndef FIRN_BASE_MACHINE_H
#define FIRN_BASE_MACHINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Returns the size of the machine's memory, bytes; 0 if it is unknown. */
uint64_t machine_memory(void);

/* Returns the limit of this process's address space in bytes, or 0 if there is none. */
uint64_t machine_memory_limit(void);

/* Returns the number of processor cores, at least 1. */
uint32_t machine_core_count(void);

/* Chooses huge pages, or small ones, for pages of this process. Failure only costs time. */
void machine_advise_pages(void *begin, size_t size, bool is_huge);

/* Chooses huge pages for an allocation of several MiB: filling it takes fewer page faults. Does
 * nothing to smaller ones and to NULL. */
void machine_advise_allocation(void *bytes, size_t size);

/* Returns the user and system CPU time in milliseconds of this process or, with `of_children`, of
 * the child processes that were waited for. The time of child processes is 0 on Windows. */
double machine_cpu_ms(bool of_children);

/* Writes the processor's name, truncated to `size` bytes, or "a processor". */
void machine_processor(char *text, size_t size);

#endif
