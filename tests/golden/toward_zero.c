/* Loaded before a program (LD_PRELOAD), it makes the program's arithmetic round toward zero. */
#include <fenv.h>

__attribute__((constructor)) static void round_toward_zero(void) { fesetround(FE_TOWARDZERO); }
