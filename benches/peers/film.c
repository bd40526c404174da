/* A rod of nodes, each cooled by natural convection: C_i T_i' = P_i + sum (T_j - T_i) / R
   - a |T_i - T_air|^(1/4) (T_i - T_air). CVODE with a tridiagonal Jacobian; steady: Newton.
   film NET.BIN ROWS.BIN TOLERANCE run|steady */
#include "laws.h"

typedef struct {
    const Net *net;
    double a, air; /* W/K^(5/4), degC */
    const double *C, *along, *P; /* J/K, W/K to the next node, W */
} Rod;

/* |x|^(1/4) by two square roots, which are correctly rounded. */
static double quarter(double x) { return sqrt(sqrt(fabs(x))); }

static void heat(const Rod *rod, const double *T, double *q)
{
    int n = rod->net->n;
    for (int i = 0; i < n; i++) {
        double over = T[i] - rod->air;
        q[i] = rod->P[i] - rod->a * quarter(over) * over;
    }
    for (int i = 0; i + 1 < n; i++) {
        double flow = rod->along[i] * (T[i] - T[i + 1]);
        q[i] -= flow;
        q[i + 1] += flow;
    }
}

static int rate(double t, N_Vector T_, N_Vector rate_, void *data)
{
    const Rod *rod = data;
    double *rate = N_VGetArrayPointer(rate_);
    heat(rod, N_VGetArrayPointer(T_), rate);
    for (int i = 0; i < rod->net->n; i++)
        rate[i] /= rod->C[i];
    (void)t;
    return 0;
}

/* -dq_i/dT_i */
static double slope(const Rod *rod, const double *T, int i)
{
    double sum = 1.25 * rod->a * quarter(T[i] - rod->air);
    if (i > 0)
        sum += rod->along[i - 1];
    if (i + 1 < rod->net->n)
        sum += rod->along[i];
    return sum;
}

static int jacobian(double t, N_Vector T_, N_Vector rate_, SUNMatrix J, void *data, N_Vector a,
                    N_Vector b, N_Vector c)
{
    const Rod *rod = data;
    const double *T = N_VGetArrayPointer(T_);
    for (int i = 0; i < rod->net->n; i++) {
        SM_ELEMENT_B(J, i, i) = -slope(rod, T, i) / rod->C[i];
        if (i + 1 < rod->net->n) {
            SM_ELEMENT_B(J, i, i + 1) = rod->along[i] / rod->C[i];
            SM_ELEMENT_B(J, i + 1, i) = rod->along[i] / rod->C[i + 1];
        }
    }
    (void)t, (void)rate_, (void)a, (void)b, (void)c;
    return 0;
}

/* One Newton step by elimination along the rod; the largest change. */
static double newton(const Rod *rod, double *T, double *q, double *ratio)
{
    int n = rod->net->n;
    double largest = 0;
    heat(rod, T, q);
    for (int i = 0; i < n; i++) {
        double pivot = slope(rod, T, i);
        if (i > 0) {
            pivot -= rod->along[i - 1] * ratio[i - 1];
            q[i] += ratio[i - 1] * q[i - 1];
        }
        ratio[i] = i + 1 < n ? rod->along[i] / pivot : 1 / pivot;
        if (i + 1 == n)
            q[i] /= pivot;
    }
    for (int i = n - 2; i >= 0; i--)
        q[i] = ratio[i] * (q[i] / rod->along[i] + q[i + 1]);
    for (int i = 0; i < n; i++) {
        T[i] += q[i];
        largest = fmax(largest, fabs(q[i]));
    }
    return largest;
}

static void settle(const Rod *rod, Run *run)
{
    double *T = N_VGetArrayPointer(run->state), *q = doubles(rod->net->n);
    double *ratio = doubles(rod->net->n);
    for (int i = 0; i < rod->net->n; i++)
        T[i] += 1; /* the slope of the law vanishes at the air's temperature */
    for (int k = 0; k < 100 && newton(rod, T, q, ratio) > rod->net->tolerance; k++)
        ;
    keep_row(run);
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    Net net = load_net(argv[1], argv[3]);
    Rod rod = {&net, net.array[0][3], net.array[0][4], net.array[3], net.array[4], net.array[5]};
    Run run = begin(&net, rate, &rod);
    banded(&run, 1, jacobian);
    if (!strcmp(argv[4], "steady"))
        settle(&rod, &run);
    else
        integrate(&run);
    return finish(&run, argv[2]);
}
