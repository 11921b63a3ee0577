/* csv.h: writes all samples of a profile as comma-separated values. */
#ifndef FIRN_PROFILE_CSV_H
#define FIRN_PROFILE_CSV_H

#include <stdio.h>
#include "src/profile/profile.h"

/*
 * Writes a header and a record for every run and row, and, with kind "whole", for frame, plain and
 * wait: run,row,technique,repetition,kind,ms,begin_ms,record_ms. The format is RFC 4180 with CRLF;
 * numbers have a decimal point in every locale and full precision. Check ferror(out) afterwards.
 */
void profile_csv(const struct profile *profile, FILE *out);

#endif
