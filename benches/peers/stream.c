/* A duct of cells whose walls are heated: C_f T_f' = mcp(t) (T_before - T_f) + G (T_w - T_f),
   C_w T_w' = P - G (T_w - T_f), mcp(t) = m0 (1 + m1 sin(2 pi t / period)). State 2k is the fluid of
   cell k, 2k + 1 its wall. CVODE with a band of 2.
   stream NET.BIN ROWS.BIN TOLERANCE run */
#include "laws.h"

typedef struct {
    const Net *net;
    double m0, m1, period, inlet; /* W/K, share, s, degC */
    const double *C, *G, *P; /* of the state in J/K; of the cell in W/K, W */
} Duct;

static double capacity_rate(const Duct *duct, double t)
{
    return duct->m1 == 0 ? duct->m0 : duct->m0 * (1 + duct->m1 * sin(2 * M_PI * t / duct->period));
}

static int rate(double t, N_Vector T_, N_Vector rate_, void *data)
{
    const Duct *duct = data;
    const double *T = N_VGetArrayPointer(T_);
    double *rate = N_VGetArrayPointer(rate_), mcp = capacity_rate(duct, t), before = duct->inlet;
    for (int k = 0; k < duct->net->n; k += 2) {
        double flow = duct->G[k / 2] * (T[k + 1] - T[k]);
        rate[k] = (mcp * (before - T[k]) + flow) / duct->C[k];
        rate[k + 1] = (duct->P[k / 2] - flow) / duct->C[k + 1];
        before = T[k];
    }
    return 0;
}

static int jacobian(double t, N_Vector T, N_Vector rate_, SUNMatrix J, void *data, N_Vector a,
                    N_Vector b, N_Vector c)
{
    const Duct *duct = data;
    double mcp = capacity_rate(duct, t);
    for (int k = 0; k < duct->net->n; k += 2) {
        double G = duct->G[k / 2];
        SM_ELEMENT_B(J, k, k) = -(mcp + G) / duct->C[k];
        SM_ELEMENT_B(J, k, k + 1) = G / duct->C[k];
        SM_ELEMENT_B(J, k + 1, k) = G / duct->C[k + 1];
        SM_ELEMENT_B(J, k + 1, k + 1) = -G / duct->C[k + 1];
        if (k > 0)
            SM_ELEMENT_B(J, k, k - 2) = mcp / duct->C[k];
    }
    (void)T, (void)rate_, (void)a, (void)b, (void)c;
    return 0;
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    Net net = load_net(argv[1], argv[3]);
    const double *x = net.array[0] + 3;
    Duct duct = {&net, x[0], x[1], x[2], x[3], net.array[3], net.array[4], net.array[5]};
    Run run = begin(&net, rate, &duct);
    banded(&run, 2, jacobian);
    integrate(&run);
    return finish(&run, argv[2]);
}
