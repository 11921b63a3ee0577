/* gpu_volk.c: the only file that defines volk's functions. */
#define VOLK_IMPLEMENTATION
#include <volk.h>
