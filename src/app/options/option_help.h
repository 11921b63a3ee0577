/* option_help.h: the text that --help prints for a command. */
#ifndef FIRN_APP_OPTIONS_OPTION_HELP_H
#define FIRN_APP_OPTIONS_OPTION_HELP_H

#include "src/app/options/option.h"

/* Prints the help of a command on stdout: usage, examples and the options that it accepts. */
void option_help(enum app_command command, const struct option *options, size_t count);

#endif
