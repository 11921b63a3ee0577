/* clock.h: how long something takes. */
#ifndef FIRN_BASE_CLOCK_H
#define FIRN_BASE_CLOCK_H

/* Seconds since some moment; never goes back. */
double clock_seconds(void);

/* The same in milliseconds. */
double clock_ms(void);

#endif
