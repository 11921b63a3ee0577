/*
 * cryptomatte.h: IDs and metadata of Cryptomatte 1.2 (Friedman, Jones 2015): ranked pairs of an ID
 * and its coverage of the pixel. An ID is the MurmurHash3 of a name, reinterpreted as a float.
 */
#ifndef FIRN_FILE_CRYPTOMATTE_H
#define FIRN_FILE_CRYPTOMATTE_H

#include <stdbool.h>
#include "src/file/image.h"

/* Returns the 32-bit MurmurHash3 of a string, with seed 0. */
uint32_t cryptomatte_hash(const char *text);

/* Returns the ID of a name: its hash, with an exponent that avoids denormals, infinity and NaN. */
float cryptomatte_id(const char *name);

enum {
    CRYPTOMATTE_TEXTS = 4 /* metadata texts of a matte */
};

/* Metadata of a matte. */
struct cryptomatte_texts {
    struct image_text all[CRYPTOMATTE_TEXTS];
    char keys[CRYPTOMATTE_TEXTS][32];
    char *manifest;
};

/* Sets the metadata of the matte `name`, whose channels begin with it. `names` has a line "NUMBER
 * NAME" for each ID. Returns false when out of memory; the caller finishes *texts even then. */
bool cryptomatte_describe(struct cryptomatte_texts *texts, const char *name, const char *names);

void cryptomatte_finish(struct cryptomatte_texts *texts); /* accepts {0} */

#endif
