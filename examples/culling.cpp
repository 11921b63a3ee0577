// culling.cpp: culling.c compiled as C++20. Its tables are valid in both languages: designators in the
// order of the fields, none nested, and no compound literals but those of RG_USES() and the like.
#include "culling.c"
