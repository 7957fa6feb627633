/* Numbers that more than one file needs. */
#ifndef GALV_CONSTANTS_H
#define GALV_CONSTANTS_H

#define PI 3.14159265358979323846

#endif
