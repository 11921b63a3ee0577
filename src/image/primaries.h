/* primaries.h: colours of other primaries to those of Rec.709. */
#ifndef FIRN_IMAGE_PRIMARIES_H
#define FIRN_IMAGE_PRIMARIES_H

#include <stdbool.h>

/* Coordinates x and y of red, green, blue and white, as in the attribute `chromaticities` of an
 * EXR. */
struct primaries {
    float red[2], green[2], blue[2], white[2];
};

enum primaries_kind {
    PRIMARIES_REC709, /* within rounding */
    PRIMARIES_OTHER,
    PRIMARIES_INVALID, /* they span no colours */
};

/* Fills `matrix`, in rows, which makes linear colours of Rec.709 from those of `from`; white stays
 * white (Bradford's adaptation). If the result is not PRIMARIES_OTHER, it is the identity. */
enum primaries_kind primaries_to_rec709(const struct primaries *from, float matrix[static 9]);

#endif
