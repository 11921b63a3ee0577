/* process.h: starts other programs, and identifies this process. */
#ifndef FIRN_BASE_PROCESS_H
#define FIRN_BASE_PROCESS_H

/* Returns the number of this process, which differs from those of its parent and children. */
int process_id(void);

/* Runs a script with /bin/sh, which gets default signal handlers, and waits for it. Returns 0, or
 * an errno if the shell cannot be started. *code receives the exit code; -1 after a signal. */
int process_run_shell(const char *script, int *code);

/* Replaces this process by a program. Returns an errno, only on failure. */
int process_replace(const char *program, char *const *arguments);

#endif
