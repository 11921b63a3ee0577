/* farm_status.h: which frames of a sequence are there. */
#ifndef FIRN_APP_FARM_STATUS_H
#define FIRN_APP_FARM_STATUS_H

#include "src/app/sequence.h"

/*
 * Prints it, as text or JSON. With a scene (options->positionals[0]) a frame is done if firn render
 * --resume would leave it as it is; without one, if its settings but for the time are those of the
 * newest file. STATUS_FAILED if some are not done; else logs what is wrong.
 */
MUST_USE enum status farm_status(const struct app_options *options,
                                 const struct sequence *sequence);

#endif
