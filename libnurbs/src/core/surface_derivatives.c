/* Derivatives of surfaces of any order. */
#include "core/surface_derivatives.h"

#include "core/axis_basis.h"

enum { WIDTH = NURBS_MAX_DEGREE + 1, ORDERS = SURFACE_MAX_ORDER + 1 };

/* Place of the derivative k times in u and l times in v: by total order, then by l. */
static size_t triple(int k, int l)
{
    const size_t total = (size_t)(k + l);
    return total * (total + 1) / 2 + (size_t)l;
}

/* S^(k,l) = (A^(k,l) - sum over (i,j) != (0,0) of C(k,i) C(l,j) w^(i,j) S^(k-i,l-j)) / w, The NURBS
 * Book eq. 4.20. out holds the A on entry, w[i][j] the derivatives of the weight. */
static void project(int order, double w[ORDERS][ORDERS], double *out)
{
    for (int total = 0; total <= order; total++)
        for (int l = 0; l <= total; l++) {
            const int k = total - l;
            double *s = out + 3 * triple(k, l);
            double choose_i = 1.0; /* C(k,i) */
            for (int i = 0; i <= k; choose_i = choose_i * (k - i) / (i + 1), i++) {
                double choose_j = 1.0;
                for (int j = 0; j <= l; choose_j = choose_j * (l - j) / (j + 1), j++)
                    for (int c = 0; c < 3 && i + j > 0; c++)
                        s[c] -= choose_i * choose_j * w[i][j] *
                                out[3 * triple(k - i, l - j) + (size_t)c];
            }
            for (int c = 0; c < 3; c++)
                s[c] /= w[0][0];
        }
}

void surface_derivatives(const nurbs_surface *s, int order, const size_t span[2],
                         const double uv[2], double *out)
{
    double basis[2][WIDTH * WIDTH], lines[WIDTH][WIDTH][4], w[ORDERS][ORDERS];
    int kept[2];
    for (int d = 0; d < 2; d++) {
        const struct axis *axis = &s->axis[d];
        kept[d] = order < axis->degree ? order : axis->degree;
        axis_basis(axis, axis->degree, span[d], uv[d], kept[d], basis[d]);
    }
    const int pu = s->axis[0].degree, pv = s->axis[1].degree;
    const size_t stride = 4 * s->axis[1].size;
    const double *net = s->net + (span[0] - (size_t)pu) * stride + 4 * (span[1] - (size_t)pv);
    for (int k = 0; k <= kept[0]; k++) /* lines[k][b]: summed over u */
        for (int b = 0; b <= pv; b++)
            for (int c = 0; c < 4; c++) {
                double sum = 0.0;
                for (int a = 0; a <= pu; a++)
                    sum +=
                        basis[0][k * (pu + 1) + a] * net[(size_t)a * stride + (size_t)(4 * b + c)];
                lines[k][b][c] = sum;
            }
    for (int k = 0; k <= order; k++)
        for (int l = 0; k + l <= order; l++) {
            double sum[4] = {0.0};
            for (int b = 0; b <= pv && k <= kept[0] && l <= kept[1]; b++)
                for (int c = 0; c < 4; c++)
                    sum[c] += basis[1][l * (pv + 1) + b] * lines[k][b][c];
            for (int c = 0; c < 3; c++)
                out[3 * triple(k, l) + (size_t)c] = sum[c];
            w[k][l] = sum[3];
        }
    if (s->weights)
        project(order, w, out);
}
