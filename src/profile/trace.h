/*
 * trace.h: writes a profile as a Chrome trace, for Perfetto, Tracy (tracy-import-chrome),
 * speedscope.
 *
 * The object form of Google's "Trace Event Format", events of phase X (complete), C (counter) and M
 * (names) only, in the order of time; spans of a track nest or follow each other. Runs follow each
 * other without gaps; a run's passes begin on the device when the host has submitted them.
 */
#ifndef FIRN_PROFILE_TRACE_H
#define FIRN_PROFILE_TRACE_H

#include <stddef.h>
#include "src/profile/profile.h"

/* Writes the trace. Ownership and errors are those of profile_write_json(). */
MUST_USE enum status profile_write_trace(const struct profile *profile, char **text, size_t *size);

#endif
