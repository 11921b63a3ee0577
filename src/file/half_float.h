/* half_float.h: conversion of IEEE 754 half-precision floats, with Imath. */
#ifndef FIRN_FILE_HALF_FLOAT_H
#define FIRN_FILE_HALF_FLOAT_H

#include <stdint.h>

/* Rounds a float to half, to nearest even. Out-of-range values become +-65504; NaN stays NaN. */
uint16_t half_from_float(float value);

float half_to_float(uint16_t bits);

#endif
