/*
 * chrome_trace.h: exports a profile as a Chrome trace for Perfetto, Tracy (tracy-import-chrome)
 * etc.
 *
 * The object form of Google's "Trace Event Format", with events of phase X (complete), C (counter)
 * and M (metadata) in chronological order. Spans of a track are nested or consecutive. Runs are
 * consecutive; a run's GPU passes start when the CPU has submitted them.
 */
#ifndef FIRN_LAB_PROFILE_CHROME_TRACE_H
#define FIRN_LAB_PROFILE_CHROME_TRACE_H

#include <stddef.h>
#include "src/lab/profile/profile_data.h"

/* Writes the trace to *text. Ownership and errors are those of profile_write_json(). */
MUST_USE enum status profile_write_trace(const struct profile *profile, char **text, size_t *size);

#endif
