/* Numbers that more than one room needs. */
#ifndef NURBS_CONSTANTS_H
#define NURBS_CONSTANTS_H

#define PI 3.14159265358979323846

#endif
