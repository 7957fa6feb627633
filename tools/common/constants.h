/* Numbers that more than one command needs. */
#ifndef TOOLS_CONSTANTS_H
#define TOOLS_CONSTANTS_H

#define PI 3.14159265358979323846

#endif
