/* farm_status.h: finds out which frames of a sequence are complete. */
#ifndef FIRN_APP_FARM_STATUS_H
#define FIRN_APP_FARM_STATUS_H

#include "src/app/sequence.h"

/* Prints the state of all frames, as text or JSON. With a scene (options->positionals[0]) a frame
 * is done if firn render --resume would keep it; without one, if its settings except for the time
 * are those of the newest file. Returns STATUS_FAILED if some are not done; logs other errors. */
MUST_USE enum status farm_status(const struct app_options *options,
                                 const struct sequence *sequence);

#endif
