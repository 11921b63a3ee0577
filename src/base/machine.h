/* machine.h: memory and processor of the machine. */
#ifndef FIRN_BASE_MACHINE_H
#define FIRN_BASE_MACHINE_H

#include <stddef.h>
#include <stdint.h>

/* Returns the size of the machine's memory, bytes; 0 if it is unknown. */
uint64_t machine_memory(void);

/* Returns the limit of this process's address space in bytes, or 0 if there is none. */
uint64_t machine_memory_limit(void);

/* Writes the processor's name, truncated to `size` bytes, or "a processor". */
void machine_processor(char *text, size_t size);

#endif
