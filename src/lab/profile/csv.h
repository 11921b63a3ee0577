/* csv.h: writes a profile's samples as comma-separated values. */
#ifndef FIRN_LAB_PROFILE_CSV_H
#define FIRN_LAB_PROFILE_CSV_H

#include <stdio.h>
#include "src/lab/profile/profile_data.h"

/*
 * Writes a header line, then one record per row and run:
 * run,row,technique,repetition,kind,ms,begin_ms,record_ms. The totals `frame`, `plain` and `wait`
 * are rows of kind "whole". The format is RFC 4180 with CRLF. Numbers have full precision and a
 * decimal point in every locale. The caller must check ferror(out).
 */
void profile_csv(const struct profile *profile, FILE *out);

#endif
