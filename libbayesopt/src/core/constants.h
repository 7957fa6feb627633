/* Numbers that more than one file needs. */
#ifndef BAYESOPT_CONSTANTS_H
#define BAYESOPT_CONSTANTS_H

#define PI 3.14159265358979323846

#endif
