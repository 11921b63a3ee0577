/* farm_status.h: finds out which frames of a sequence are complete. */
#ifndef FIRN_APP_FARM_STATUS_H
#define FIRN_APP_FARM_STATUS_H

#include "src/app/frame_sequence.h"

/* Prints the state of all frames, as text or JSON. A frame is done if firn render --resume would
 * keep it. Without a scene name, it is done if its settings, except for the time, equal those of
 * the newest file. Returns STATUS_FAILED if some frames are not done; logs other errors. */
MUST_USE enum status farm_status(const struct app_options *options,
                                 const struct sequence *sequence);

#endif
