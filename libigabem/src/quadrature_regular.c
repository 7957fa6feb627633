#include "quadrature_regular.h"

#include <limits.h>
#include <math.h>

int regular_points(double distance, double half, double scale, double tolerance)
{
    double z = distance / half;
    if (!(z > 1.0 + 1e-3))
        return INT_MAX;
    if (scale <= tolerance)
        return 1;
    double rho = z + sqrt(z * z - 1.0);
    return (int)ceil(0.5 * log(scale / tolerance) / log(rho)) + 1;
}
