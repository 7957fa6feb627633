#define KELVIN_WAVE_KERNEL kelvin_wave_base
#include "kelvin/kelvin_wave_integral.h"
